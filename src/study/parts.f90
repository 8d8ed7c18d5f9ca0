!> Parts of a study, which processes solve each by itself, and their journals
module axijoint_study_parts
   use axijoint_base_kinds, only : i8
   use axijoint_base_system, only : unlink_path
   use axijoint_base_text, only : to_text
   use axijoint_study_journal, only : read_journal
   use axijoint_study_rows, only : row_type
   implicit none
   private
   public :: part_type, whole, part_name, journal_path, first_row, last_row, gather_parts, &
      remove_parts

   !> A part: its number and how many there are
   type :: part_type
      !> 0 for the whole, gathered from `n` parts if there are any
      integer :: number = 0, n = 0
   end type part_type

   !> All rows, by one process
   type(part_type), parameter :: whole = part_type(0, 0)

contains

   !> Name of the files of a part, without ending
   pure function part_name(name, part) result(text)
      !> Name of the study, or path of its files without ending
      character(len=*), intent(in) :: name
      !> The part
      type(part_type), intent(in) :: part
      !> The name
      character(len=:), allocatable :: text

      text = name
      if (part%number > 0) text = name//'.'//to_text(part%number)//'of'//to_text(part%n)
   end function part_name

   !> Path of its journal
   pure function journal_path(stem, part) result(path)
      !> Path of the study's files without ending
      character(len=*), intent(in) :: stem
      !> The part
      type(part_type), intent(in) :: part
      !> The path
      character(len=:), allocatable :: path

      path = part_name(stem, part)//'.rows'
   end function journal_path

   !> Place of its first row in the order of the rows
   pure integer function first_row(part, n_rows)
      !> The part
      type(part_type), intent(in) :: part
      !> Rows of the study
      integer, intent(in) :: n_rows

      first_row = 1
      if (part%number > 1) first_row = last_row(part_type(part%number - 1, part%n), n_rows) + 1
   end function first_row

   !> Place of its last row
   pure integer function last_row(part, n_rows)
      !> The part
      type(part_type), intent(in) :: part
      !> Rows of the study
      integer, intent(in) :: n_rows

      last_row = n_rows
      if (part%number > 0) last_row = int(int(n_rows, i8)*part%number/part%n)
   end function last_row

   !> Take the rows that parts have done
   subroutine gather_parts(stem, key, n_quantities, n_parts, rows)
      !> Path of the study's files without ending, and what tells it from others
      character(len=*), intent(in) :: stem, key
      !> Quantities of a row
      integer, intent(in) :: n_quantities
      !> Number of parts
      integer, intent(in) :: n_parts
      !> Rows by number; takes those that are done
      type(row_type), intent(inout) :: rows(:)

      logical :: there, ours, torn
      integer :: k

      do k = 1, n_parts
         call read_journal(journal_path(stem, part_type(k, n_parts)), key, n_quantities, rows, &
            there, ours, torn)
      end do
   end subroutine gather_parts

   !> Remove the journals of parts: their rows stand in the files of the study. Those of another
   !> study stay
   subroutine remove_parts(stem, key, n_quantities, n_parts)
      !> As for `gather_parts`
      character(len=*), intent(in) :: stem, key
      integer, intent(in) :: n_quantities, n_parts

      type(row_type) :: none(0)
      character(len=:), allocatable :: path
      logical :: there, ours, torn
      integer :: k, errno

      do k = 1, n_parts
         path = journal_path(stem, part_type(k, n_parts))
         call read_journal(path, key, n_quantities, none, there, ours, torn)
         if (ours) call unlink_path(path, errno)
      end do
   end subroutine remove_parts

end module axijoint_study_parts
