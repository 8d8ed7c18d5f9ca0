!> Lists of integers that grow, and such lists with names
module axijoint_legacy_list
   use axijoint_base_text, only : upper
   implicit none
   private
   public :: list_type, set_type, add, open_set, find_set

   !> Integers
   type :: list_type
      !> At least n of them
      integer, allocatable :: value(:)
      integer :: n = 0
   end type list_type

   !> A list with a name
   type :: set_type
      !> The name, in capital letters
      character(len=:), allocatable :: name
      !> Its members
      type(list_type) :: list
      !> The card that begins it
      integer :: card = 0
   end type set_type

contains

   !> Add an integer
   subroutine add(list, value)
      !> The list
      type(list_type), intent(inout) :: list
      !> The integer
      integer, intent(in) :: value

      integer, allocatable :: more(:)

      if (.not. allocated(list%value)) allocate (list%value(8), source=0)
      if (list%n == size(list%value)) then
         allocate (more(max(8, 2*list%n)), source=0)
         more(:list%n) = list%value(:list%n)
         call move_alloc(more, list%value)
      end if
      list%n = list%n + 1
      list%value(list%n) = value
   end subroutine add

   !> Place of a set, a new one if there is none of the name
   subroutine open_set(sets, name, card, found)
      !> The sets
      type(set_type), allocatable, intent(inout) :: sets(:)
      !> The name
      character(len=*), intent(in) :: name
      !> The card that names it
      integer, intent(in) :: card
      !> The place
      integer, intent(out) :: found

      type(set_type), allocatable :: more(:)
      integer :: k

      if (.not. allocated(sets)) allocate (sets(0))
      found = find_set(sets, name)
      if (found > 0) return
      found = size(sets) + 1
      allocate (more(found))
      do k = 1, size(sets)
         more(k) = sets(k)
      end do
      more(found)%name = upper(name)
      more(found)%card = card
      call move_alloc(more, sets)
   end subroutine open_set

   !> Place of a set; 0 if there is none of the name
   pure integer function find_set(sets, name) result(found)
      !> The sets
      type(set_type), intent(in), allocatable :: sets(:)
      !> The name; letter case does not count
      character(len=*), intent(in) :: name

      found = 0
      if (.not. allocated(sets)) return
      do found = size(sets), 1, -1
         if (sets(found)%name == upper(name)) return
      end do
   end function find_set

end module axijoint_legacy_list
