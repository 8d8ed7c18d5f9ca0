!> Load cases: which card belongs to which
module axijoint_deck_load_cases
   use axijoint_base_number_map, only : number_map_type, insert_number
   use axijoint_model_load, only : load_case_type
   implicit none
   private
   public :: cases_type, add_case, case_of_card

   !> Load cases
   type :: cases_type
      !> The cases
      type(load_case_type), allocatable :: cases(:)
      !> Cards of CASE, in the order of the deck, and the case of each
      integer, allocatable :: cards(:), case_of(:)
      !> Cases by number
      type(number_map_type) :: index_of
      !> False if a card is so wrong that its number is not known
      logical :: complete = .true.
   end type cases_type

contains

   !> Add a load case
   subroutine add_case(cases, label, name)
      !> The cases
      type(cases_type), intent(inout) :: cases
      !> Number and name
      integer, intent(in) :: label
      character(len=*), intent(in) :: name

      cases%cases = [cases%cases, load_case_type(label, name)]
      call insert_number(cases%index_of, label, size(cases%cases))
   end subroutine add_case

   !> Load case that a card belongs to: that of the last CASE card before it
   pure integer function case_of_card(cases, card) result(case)
      !> The cases
      type(cases_type), intent(in) :: cases
      !> The card
      integer, intent(in) :: card

      case = count(cases%cards < card)
      if (case > 0) then
         case = cases%case_of(case)
      else
         case = 1
      end if
   end function case_of_card

end module axijoint_deck_load_cases
