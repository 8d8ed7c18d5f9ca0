!> Which node, element or joint of one file is which of the other
module axijoint_compare_table_numbering
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   implicit none
   private
   public :: numbering_type, learn, same_numbers, known_partner

   !> Numbers of one kind of things
   type :: numbering_type
      !> Kind: the name of the column
      character(len=32) :: name = ''
      !> From the numbers of the first file to those of the second
      type(number_map_type) :: partner
      !> Whether no thing has different numbers
      logical :: same = .true.
   end type numbering_type

contains

   !> Note that a thing has these numbers
   subroutine learn(numberings, name, a, b)
      !> All kinds of things
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> Kind
      character(len=*), intent(in) :: name
      !> Numbers in both files
      integer, intent(in) :: a, b

      integer :: k

      k = findloc(numberings%name == name, .true., 1)
      if (k == 0) then
         call add_kind(numberings, name)
         k = size(numberings)
      end if
      if (a /= b) numberings(k)%same = .false.
      if (a /= 0 .and. find_number(numberings(k)%partner, a) == 0 .and. b > 0) then
         call insert_number(numberings(k)%partner, a, b)
      end if
   end subroutine learn

   !> Add a kind of things
   subroutine add_kind(numberings, name)
      !> All kinds of things
      type(numbering_type), allocatable, intent(inout) :: numberings(:)
      !> Its name
      character(len=*), intent(in) :: name

      type(numbering_type), allocatable :: larger(:)

      allocate (larger(size(numberings) + 1))
      larger(:size(numberings)) = numberings
      larger(size(larger))%name = name
      call move_alloc(larger, numberings)
   end subroutine add_kind

   !> Whether all things of a kind have the same numbers in both files, as far as is known
   pure logical function same_numbers(numberings, name)
      !> All kinds of things
      type(numbering_type), intent(in) :: numberings(:)
      !> Kind
      character(len=*), intent(in) :: name

      integer :: k

      k = findloc(numberings%name == name, .true., 1)
      same_numbers = .true.
      if (k > 0) same_numbers = numberings(k)%same
   end function same_numbers

   !> Number in the second file of a thing of the first; 0 if it is not known
   pure integer function known_partner(numberings, name, a) result(b)
      !> All kinds of things
      type(numbering_type), intent(in) :: numberings(:)
      !> Kind
      character(len=*), intent(in) :: name
      !> Number in the first file
      integer, intent(in) :: a

      integer :: k

      k = findloc(numberings%name == name, .true., 1)
      b = 0
      if (k > 0) b = find_number(numberings(k)%partner, a)
   end function known_partner

end module axijoint_compare_table_numbering
