!> Lines of an old listing, field by field, with Fortran's edit descriptors; what has no room in its
!> field is printed as there, and noted
module axijoint_output_legacy_page
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: page_type, most_noted

   !> Values without room that are told one by one
   integer, parameter :: most_noted = 100

   !> The listing under way
   type :: page_type
      !> The file
      type(text_file_type) :: file
      !> The line so far
      character(len=:), allocatable :: line
      !> Lines so far
      integer :: n_lines = 0
      !> Values that have no room in their fields, and where the first of them are
      integer :: n_noted = 0
      character(len=80) :: noted(most_noted) = ''
   contains
      !> Add words, an integer of I, a real of F, a real of E14.6
      procedure :: words
      procedure :: whole
      procedure :: fixed
      procedure :: exponential
      !> End the line
      procedure :: end_line
      !> A line of words alone
      procedure :: put
   end type page_type

contains

   !> Add words
   subroutine words(self, text)
      !> The listing
      class(page_type), intent(inout) :: self
      !> The words, blanks and all
      character(len=*), intent(in) :: text

      if (.not. allocated(self%line)) self%line = ''
      self%line = self%line//text
   end subroutine words

   !> Add an integer, Iw: asterisks if it has no room
   subroutine whole(self, value, width)
      !> The listing
      class(page_type), intent(inout) :: self
      !> The integer, and w
      integer, intent(in) :: value, width

      character(len=:), allocatable :: digits

      digits = to_text(value)
      if (len(digits) > width) then
         call note(self, digits)
         digits = repeat('*', width)
      end if
      call self%words(repeat(' ', width - len(digits))//digits)
   end subroutine whole

   !> Add a real, Fw.d: asterisks if it has no room
   subroutine fixed(self, value, width, decimals)
      !> The listing
      class(page_type), intent(inout) :: self
      !> The real
      real(wp), intent(in) :: value
      !> w and d
      integer, intent(in) :: width, decimals

      character(len=width) :: digits
      integer :: status

      write (digits, '(f'//to_text(width)//'.'//to_text(decimals)//')', iostat=status) &
         value + 0.0_wp  ! no negative zero
      if (index(digits, '*') > 0) call note(self, to_text(value))
      call self%words(digits)
   end subroutine fixed

   !> Add a real, E14.6: an exponent of three digits takes the place of the E
   subroutine exponential(self, value)
      !> The listing
      class(page_type), intent(inout) :: self
      !> The real
      real(wp), intent(in) :: value

      character(len=14) :: digits
      integer :: status

      write (digits, '(e14.6)', iostat=status) value + 0.0_wp  ! no negative zero
      if (index(digits, 'E') == 0) call note(self, to_text(value))
      call self%words(digits)
   end subroutine exponential

   !> Note a value without room
   subroutine note(self, value)
      !> The listing
      class(page_type), intent(inout) :: self
      !> The value
      character(len=*), intent(in) :: value

      self%n_noted = self%n_noted + 1
      if (self%n_noted > most_noted) return
      self%noted(self%n_noted) = 'LINE '//to_text(self%n_lines + 1)//', FROM COLUMN '// &
         to_text(len(self%line) + 1)//': '//value
   end subroutine note

   !> End the line
   subroutine end_line(self)
      !> The listing
      class(page_type), intent(inout) :: self

      if (.not. allocated(self%line)) self%line = ''
      call self%file%put(self%line)
      self%n_lines = self%n_lines + 1
      self%line = ''
   end subroutine end_line

   !> A line of words alone
   subroutine put(self, text)
      !> The listing
      class(page_type), intent(inout) :: self
      !> The words
      character(len=*), intent(in) :: text

      call self%words(text)
      call self%end_line()
   end subroutine put

end module axijoint_output_legacy_page
