!> Names that the tables of two files have
module axijoint_compare_names
   use axijoint_compare_table_table, only : listing_type
   implicit none
   private
   public :: add_tables, add_columns, name_length

   !> Letters of the longest name that is kept
   integer, parameter :: name_length = 64

contains

   !> Add the names of the tables of a file
   pure subroutine add_tables(listing, names)
      !> The file
      type(listing_type), intent(in) :: listing
      !> The names, each once
      character(len=name_length), allocatable, intent(inout) :: names(:)

      integer :: k

      do k = 1, listing%n_tables
         call add_name(listing%tables(k)%name, names)
      end do
   end subroutine add_tables

   !> Add the names of the columns of its tables
   pure subroutine add_columns(listing, names)
      !> The file
      type(listing_type), intent(in) :: listing
      !> The names, each once
      character(len=name_length), allocatable, intent(inout) :: names(:)

      integer :: j, k

      do k = 1, listing%n_tables
         associate (columns => listing%tables(k)%columns)
            do j = 1, size(columns)
               call add_name(columns(j)%name, names)
            end do
         end associate
      end do
   end subroutine add_columns

   !> Add a name unless it is there
   pure subroutine add_name(name, names)
      !> The name
      character(len=*), intent(in) :: name
      !> The names, each once
      character(len=name_length), allocatable, intent(inout) :: names(:)

      character(len=name_length) :: whole

      whole = name
      if (all(names /= whole)) names = [names, whole]
   end subroutine add_name

end module axijoint_compare_names
