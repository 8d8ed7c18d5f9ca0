!> Functions of theta by number
module axijoint_deck_load_shapes
   use axijoint_base_number_map, only : number_map_type
   use axijoint_fe_circle_function, only : circle_function_type
   implicit none
   private
   public :: shapes_type

   !> Functions of theta
   type :: shapes_type
      !> The functions
      type(circle_function_type), allocatable :: functions(:)
      !> Number and first card of each
      integer, allocatable :: label(:), card(:)
      !> Whether a function is without a fault
      logical, allocatable :: good(:)
      !> Functions by number
      type(number_map_type) :: shape_of
      !> False if a card is so wrong that its number is not known
      logical :: complete = .true.
   end type shapes_type

end module axijoint_deck_load_shapes
