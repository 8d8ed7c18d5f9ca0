!> Files that hold how far a program has come: a few lines that say what of, then bytes, then a hash
!> of all that stands before it. A file appears when it is complete, in the place of an earlier one
module axijoint_base_state_file
   use axijoint_base_kinds, only : i8
   use axijoint_base_process, only : host_name
   use axijoint_base_sha256, only : sha256
   use axijoint_base_system, only : error_text, path_file, process_id, rename_path, target_kind, unlink_path
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : first_bytes, read_whole_file, write_new_file, is_not_there
   implicit none
   private
   public :: state_mark_type, write_state_file, read_state_file, is_state_file

   !> What a state of any version begins with
   character(len=*), parameter :: opening = 'axijoint state '
   !> First line, and digits of the hash with the end of its line
   character(len=*), parameter :: first_line = opening//'1'
   integer, parameter :: hash_length = 65
   character(len=1), parameter :: nl = new_line('a')

   !> What a state is of
   type :: state_mark_type
      !> The program, with its version; hash of what it reads; options that results depend on
      character(len=:), allocatable :: program, deck, options
      !> How far it is, and when that was, in words
      character(len=:), allocatable :: place, date
   end type state_mark_type

contains

   !> Write a state in the place of an earlier one
   subroutine write_state_file(path, mark, body, failure)
      !> The file
      character(len=*), intent(in) :: path
      !> What it is of; its date is that of now
      type(state_mark_type), intent(in) :: mark
      !> What it holds
      character(len=*), intent(in) :: body
      !> What failed, and then the earlier one stands; not allocated if nothing did
      character(len=:), allocatable, intent(out) :: failure

      character(len=:), allocatable :: head, text, beside
      character(len=8) :: day
      character(len=10) :: clock
      character(len=5) :: zone
      integer(i8) :: n
      integer :: errno, ignored

      call date_and_time(day, clock, zone)
      head = first_line//nl//'program '//mark%program//nl//'deck '//mark%deck//nl//'options '// &
         mark%options//nl//'place '//mark%place//nl//'date '//day(:4)//'-'//day(5:6)//'-'// &
         day(7:)//' '//clock(:2)//':'//clock(3:4)//':'//clock(5:6)//' '//zone//nl//'bytes '// &
         to_text(len(body, i8))//nl
      n = len(head, i8) + len(body, i8)
      allocate (character(len=n + hash_length) :: text)  ! a history may take much of the memory: no copies more
      text(:len(head)) = head
      text(len(head) + 1:n) = body
      text(n + 1:) = sha256(text(:n))//nl
      beside = path//'.'//host_name()//'.'//to_text(process_id())//'.tmp'
      call unlink_path(beside, ignored)
      call write_new_file(beside, text, errno)
      if (errno == 0) call rename_path(beside, path, errno)
      if (errno == 0) return
      call unlink_path(beside, ignored)
      failure = error_text(errno)
   end subroutine write_state_file

   !> Whether a file is a state of some version, damaged or not; all others are somebody else's
   logical function is_state_file(path)
      !> The file
      character(len=*), intent(in) :: path

      is_state_file = target_kind(path) == path_file
      if (is_state_file) is_state_file = first_bytes(path, len(opening)) == opening
   end function is_state_file

   !> Read a state
   subroutine read_state_file(path, mark, body, there, failure)
      !> The file
      character(len=*), intent(in) :: path
      !> What it is of
      type(state_mark_type), intent(out) :: mark
      !> What it holds
      character(len=:), allocatable, intent(out) :: body
      !> Whether there is such a file
      logical, intent(out) :: there
      !> What is wrong with it; not allocated if nothing is
      character(len=:), allocatable, intent(out) :: failure

      character(len=:), allocatable :: text
      integer(i8) :: end_of_body
      integer :: errno

      call read_whole_file(path, text, errno)
      there = .not. is_not_there(errno)
      if (.not. there) return
      if (errno /= 0) then
         failure = 'cannot be read: '//error_text(errno)
         return
      end if
      if (index(text, opening) /= 1) then
         failure = 'is no state of axijoint'
         return
      end if
      if (index(text, first_line//nl) /= 1) then
         failure = 'is a state of another version of axijoint'
         return
      end if
      end_of_body = len(text, i8) - hash_length
      failure = 'is damaged: it is not what was written'
      if (end_of_body < 0) return
      if (text(end_of_body + 1:) /= sha256(text(:end_of_body))//nl) return
      deallocate (failure)
      mark%program = value_of('program')
      mark%deck = value_of('deck')
      mark%options = value_of('options')
      mark%place = value_of('place')
      mark%date = value_of('date')
      body = text(index(text, nl//'bytes '//value_of('bytes')//nl) + &
                  len(nl//'bytes '//value_of('bytes')//nl):end_of_body)

   contains

      !> What follows the first word of a line
      function value_of(name) result(value)
         !> The word
         character(len=*), intent(in) :: name
         !> What follows
         character(len=:), allocatable :: value

         integer :: first, last

         first = index(text, nl//name//' ') + len(name) + 2
         last = first + index(text(first:), nl) - 2
         value = text(first:last)
      end function value_of

   end subroutine read_state_file

end module axijoint_base_state_file
