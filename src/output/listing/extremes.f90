!> The least and the largest value of each column of a table that the listing does not show whole
module axijoint_output_listing_extremes
   use axijoint_base_kinds, only : wp, degree
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_listing_choice, only : write_left
   implicit none
   private
   public :: extremes_type, begin_table

   !> Number of an entry, angle in degrees
   character(len=*), parameter :: format_label = '(i10)', format_angle = '(f9.3)'
   !> Columns of a value, and of a coordinate
   integer, parameter :: wide = 15, narrow = 12

   !> A value and where it stands
   type :: peak_type
      !> The value
      real(wp) :: value = 0.0_wp
      !> Number in the deck of node, element or joint
      integer :: label = 0
      !> r and z
      real(wp) :: place(2) = 0.0_wp
      !> Plane [radian]
      real(wp) :: angle = 0.0_wp
   end type peak_type

   !> Extremes of a table
   type :: extremes_type
      !> Its title, and whether the results are in equilibrium
      character(len=:), allocatable :: title
      logical :: converged = .false.
      !> Names of its columns
      character(len=12), allocatable :: names(:)
      !> Whether they are looked for: not all rows are listed
      logical :: wanted = .false.
      !> Whether its rows are of planes
      logical :: on_planes = .false.
      !> Rows that have been looked at
      integer :: n = 0
      !> Of each column
      type(peak_type), allocatable :: least(:), largest(:)
   contains
      !> Look at a row
      procedure :: note
      !> End the table
      procedure :: write => write_extremes
   end type extremes_type

contains

   !> Heading of a table of results and names of its columns, if a row is listed
   subroutine begin_table(file, title, header, converged, listed, names, extremes, on_planes)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Title of the table, line with the names of its columns
      character(len=*), intent(in) :: title, header
      !> Whether the results are in equilibrium
      logical, intent(in) :: converged
      !> Which of its rows are listed
      logical, intent(in) :: listed(:)
      !> Names of the columns whose extremes are of interest
      character(len=*), intent(in) :: names(:)
      !> Takes them
      type(extremes_type), intent(out) :: extremes
      !> Whether the rows are of planes; false if absent
      logical, intent(in), optional :: on_planes

      if (any(listed) .or. size(listed) == 0) then
         call write_result_heading(file, title, converged)
         call file%put(header)
      end if
      extremes%title = title
      extremes%converged = converged
      extremes%names = names
      extremes%wanted = .not. all(listed)
      if (present(on_planes)) extremes%on_planes = on_planes
      allocate (extremes%least(size(names)), extremes%largest(size(names)))
   end subroutine begin_table

   !> Look at a row
   pure subroutine note(self, label, place, values, angle)
      !> The extremes
      class(extremes_type), intent(inout) :: self
      !> Number in the deck of node, element or joint
      integer, intent(in) :: label
      !> r and z
      real(wp), intent(in) :: place(2)
      !> Of each column
      real(wp), intent(in) :: values(:)
      !> Plane [radian]
      real(wp), intent(in), optional :: angle

      real(wp) :: theta
      integer :: k

      if (.not. self%wanted) return
      theta = 0.0_wp
      if (present(angle)) theta = angle
      do k = 1, size(values)
         if (self%n == 0 .or. values(k) < self%least(k)%value) &
            self%least(k) = peak_type(values(k), label, place, theta)
         if (self%n == 0 .or. values(k) > self%largest(k)%value) &
            self%largest(k) = peak_type(values(k), label, place, theta)
      end do
      self%n = self%n + 1
   end subroutine note

   !> End a table: nothing more, if all of its rows are listed
   subroutine write_extremes(self, file, n_listed, what)
      !> The extremes of all rows
      class(extremes_type), intent(in) :: self
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Rows that are listed
      integer, intent(in) :: n_listed
      !> What stands at the places: node, element, joint
      character(len=*), intent(in) :: what

      character(len=:), allocatable :: head
      character(len=10) :: noun
      integer :: k

      if (.not. self%wanted .or. self%n == 0) return
      call write_result_heading(file, 'EXTREMES OF '//self%title, self%converged)
      call write_left(file, '', n_listed, self%n)
      noun = adjustr(what//repeat(' ', len(noun) - len(what)))
      head = noun//'           r           z'
      if (self%on_planes) head = head//'    theta'
      call file%put('  column                least'//head//'        largest'//head)
      do k = 1, size(self%names)
         call file%put('  '//self%names(k)//place_text(self%least(k))// &
            place_text(self%largest(k)))
      end do

   contains

      !> A value and its place
      function place_text(peak) result(text)
         !> Value and place
         type(peak_type), intent(in) :: peak
         !> The text
         character(len=:), allocatable :: text

         character(len=10) :: label
         character(len=9) :: angle

         write (label, format_label) peak%label
         text = columns([peak%value], wide)//label//columns(peak%place, narrow)
         if (.not. self%on_planes) return
         write (angle, format_angle) peak%angle/degree
         text = text//angle
      end function place_text

   end subroutine write_extremes

end module axijoint_output_listing_extremes
