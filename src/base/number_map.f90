!> From the user's numbers of things to their indices
module axijoint_base_number_map
   use axijoint_base_kinds, only : i8
   implicit none
   private
   public :: number_map_type, find_number, insert_number

   !> Hash table with open addressing; a default one is empty
   type :: number_map_type
      private
      !> Numbers in use; `free` where none is
      integer, allocatable :: number(:)
      !> Index of each number
      integer, allocatable :: index(:)
      !> How many numbers are in use
      integer :: n = 0
   end type number_map_type

   !> Mark of a free place: no thing has the number 0
   integer, parameter :: free = 0
   !> Places of the smallest table, a power of two
   integer, parameter :: least_size = 16

contains

   !> Index of a number; 0 if it is not there
   pure integer function find_number(map, number) result(index)
      !> The map
      type(number_map_type), intent(in) :: map
      !> The number
      integer, intent(in) :: number

      index = 0
      if (.not. allocated(map%number) .or. number == free) return
      index = map%index(place_of(map%number, number))
   end function find_number

   !> Give a number its index; a number that is there gets the new index
   pure subroutine insert_number(map, number, index)
      !> The map
      type(number_map_type), intent(inout) :: map
      !> The number, not 0
      integer, intent(in) :: number
      !> Its index, above 0
      integer, intent(in) :: index

      integer :: place

      if (.not. allocated(map%number)) call resize(map, least_size)
      if (2*map%n >= size(map%number)) call resize(map, 2*size(map%number))
      place = place_of(map%number, number)
      if (map%number(place) == free) map%n = map%n + 1
      map%number(place) = number
      map%index(place) = index
   end subroutine insert_number

   !> Place of a number, or the free place where it would go
   pure integer function place_of(numbers, number) result(place)
      !> The table
      integer, intent(in) :: numbers(:)
      !> The number
      integer, intent(in) :: number

      !> 2^32 over the golden ratio: multiples of it spread evenly, those of consecutive numbers and of numbers far apart
      integer(i8), parameter :: golden = 2654435769_i8, low = 4294967295_i8
      integer :: bits

      bits = trailz(size(numbers))
      place = int(ishft(iand(golden*iand(number, huge(number)), low), bits - 32)) + 1
      do while (numbers(place) /= free .and. numbers(place) /= number)
         place = iand(place, size(numbers) - 1) + 1
      end do
   end function place_of

   !> Change the number of places
   pure subroutine resize(map, new_size)
      !> The map
      type(number_map_type), intent(inout) :: map
      !> Places, a power of two
      integer, intent(in) :: new_size

      integer, allocatable :: number(:), index(:)
      integer :: i, place

      allocate (number(new_size), source=free)
      allocate (index(new_size), source=0)
      if (allocated(map%number)) then
         do i = 1, size(map%number)
            if (map%number(i) == free) cycle
            place = place_of(number, map%number(i))
            number(place) = map%number(i)
            index(place) = map%index(i)
         end do
      end if
      call move_alloc(number, map%number)
      call move_alloc(index, map%index)
   end subroutine resize

end module axijoint_base_number_map
