!> SHAPES: functions of theta by number
module axijoint_deck_load_shapes
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error, entry_error
   use axijoint_fe_circle_function, only : circle_function_type, new_patch, new_cosine, new_table
   implicit none
   private
   public :: shapes_type, read_shapes

   !> Fields of SHAPES
   integer, parameter :: field_label = 1, field_kind = 2, field_number = 3
   !> Places of the words PATCH, COSINE and TABLE
   integer, parameter :: kind_patch = 1, kind_cosine = 2, kind_table = 3

   !> Functions of theta
   type :: shapes_type
      !> The functions
      type(circle_function_type), allocatable :: functions(:)
      !> Whether a function is without a fault
      logical, allocatable :: good(:)
      !> Functions by number
      type(number_map_type) :: shape_of
      !> False if a card is so wrong that its number is not known
      logical :: complete = .true.
   end type shapes_type

contains

   !> Read SHAPES
   subroutine read_shapes(source, table, shapes, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> The functions
      type(shapes_type), intent(out) :: shapes
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: first_entry(:), shape_of_entry(:)
      integer :: entry, shape, errors_before

      allocate (shapes%functions(table%n), first_entry(table%n))
      allocate (shapes%good(table%n), source=.false.)
      allocate (shape_of_entry(table%n), source=0)
      do entry = 1, table%n
         call number_shape(source, table, entry, first_entry, shape_of_entry, shapes, diagnostics)
      end do
      do shape = 1, table%n
         if (.not. any(shape_of_entry == shape)) exit
         entry = first_entry(shape)
         shapes%good(shape) = all(pack(table%good(:table%n), shape_of_entry == shape))
         if (.not. shapes%good(shape)) cycle
         errors_before = diagnostics%n_errors
         select case (integer_value(table, field_kind, entry))
         case (kind_patch)
            call read_patch(source, table, entry, shapes%functions(shape), diagnostics)
         case (kind_cosine)
            call read_cosine(source, table, entry, shapes%functions(shape), diagnostics)
         case (kind_table)
            call read_table(source, table, shape_of_entry == shape, shapes%functions(shape), diagnostics)
         end select
         shapes%good(shape) = diagnostics%n_errors == errors_before
      end do
   end subroutine read_shapes

   !> Note the number of a card's shape. A table may go on on a further card
   subroutine number_shape(source, table, entry, first_entry, shape_of_entry, shapes, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> First entry of each shape
      integer, intent(inout) :: first_entry(:)
      !> Shape of each entry
      integer, intent(inout) :: shape_of_entry(:)
      !> The functions, of which the number is noted
      type(shapes_type), intent(inout) :: shapes
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: label, known, n

      if (.not. table%given(field_label, entry)) then
         shapes%complete = .false.
         return
      end if
      n = maxval([0, shape_of_entry])
      label = integer_value(table, field_label, entry)
      known = find_number(shapes%shape_of, label)
      if (known == 0) then
         call insert_number(shapes%shape_of, label, n + 1)
         first_entry(n + 1) = entry
         shape_of_entry(entry) = n + 1
      else if (all(nint(table%values(field_kind, [first_entry(known), entry])) == kind_table)) then
         shape_of_entry(entry) = known
      else if (all(table%given(field_kind, [first_entry(known), entry]))) then
         call repeated_label(source, table, entry, field_label, 'shape', table%cards(1, first_entry(known)), &
                             diagnostics, mend='only a TABLE goes on on further cards')
      end if
   end subroutine number_shape

   !> A function that is 1 between two angles
   subroutine read_patch(source, table, entry, f, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The function
      type(circle_function_type), intent(out) :: f
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: from, width
      integer :: errors_before

      errors_before = diagnostics%n_errors
      call check_angle(source, table, entry, field_number, diagnostics)
      if (.not. table%given(field_number + 1, entry)) then
         call field_error(diagnostics, source, table, entry, field_number + 1, &
                          'the patch has no second angle', allowed='theta1 and theta2 of a patch')
         return
      end if
      call check_angle(source, table, entry, field_number + 1, diagnostics)
      call check_blank(source, table, entry, field_number + 2, diagnostics)
      if (diagnostics%n_errors > errors_before) return
      from = table%values(field_number, entry)
      width = table%values(field_number + 1, entry) - from
      if (width > 360.0_wp) then
         call field_error(diagnostics, source, table, entry, field_number + 1, &
                          'the patch is wider than the circle', allowed='at most 360 degrees beyond theta1', &
                          mend='the whole circle is 0 to 360')
         return
      end if
      if (width < 0.0_wp) width = modulo(width, 360.0_wp)
      if (.not. width > 0.0_wp) then
         call field_error(diagnostics, source, table, entry, field_number + 1, 'the patch has no width', &
                          allowed='two different angles; the patch goes from the first counterclockwise ' &
                          //'to the second', mend='the whole circle is 0 to 360')
         return
      end if
      f = new_patch(from, from + width)
   end subroutine read_patch

   !> cos m(theta - theta0)
   subroutine read_cosine(source, table, entry, f, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The function
      type(circle_function_type), intent(out) :: f
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, parameter :: largest_harmonic = 9999

      associate (m => table%values(field_number, entry))
         if (m < 0.0_wp .or. m > real(largest_harmonic, wp) .or. abs(m - anint(m)) > 0.0_wp) then
            call field_error(diagnostics, source, table, entry, field_number, &
                             'the harmonic of the cosine is not an integer from 0 to ' &
                             //to_text(largest_harmonic), allowed='m of cos m(theta - theta0)')
            return
         end if
         call check_angle(source, table, entry, field_number + 1, diagnostics)
         call check_blank(source, table, entry, field_number + 2, diagnostics)
         f = new_cosine(nint(m), table%values(field_number + 1, entry))
      end associate
   end subroutine read_cosine

   !> Linear between the points of one card or more
   subroutine read_table(source, table, belongs, f, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> Which entries belong to the shape
      logical, intent(in) :: belongs(:)
      !> The function
      type(circle_function_type), intent(out) :: f
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp), allocatable :: angles(:), values(:)
      integer :: entry, field, errors_before

      errors_before = diagnostics%n_errors
      allocate (angles(0), values(0))
      do entry = 1, size(belongs)
         if (.not. belongs(entry)) cycle
         do field = field_number, size(table%fields), 2
            if (.not. any(table%given(field:field + 1, entry))) cycle
            call check_point(source, table, entry, field, angles, diagnostics)
            angles = [angles, table%values(field, entry)]
            values = [values, table%values(field + 1, entry)]
         end do
      end do
      if (diagnostics%n_errors > errors_before) return
      if (size(angles) < 2) then
         call entry_error(diagnostics, table, findloc(belongs, .true., 1), &
                          'the table has one point only', allowed='two points theta, f at least', &
                          mend='a load that does not depend on theta has harmonic 0 and no shape')
         return
      end if
      f = new_table(angles, values)
   end subroutine read_table

   !> Check a point of a table: both numbers, and an angle beyond the one before
   subroutine check_point(source, table, entry, field, angles, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> The entry, and the field of the angle
      integer, intent(in) :: entry, field
      !> Angles before
      real(wp), intent(in) :: angles(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      associate (angle => table%values(field, entry), n => size(angles))
         if (.not. all(table%given(field:field + 1, entry))) then
            call field_error(diagnostics, source, table, entry, &
                             merge(field + 1, field, table%given(field, entry)), &
                             'a point of the table is not complete', allowed='pairs theta, f')
            return
         end if
         call check_angle(source, table, entry, field, diagnostics)
         if (n == 0) return
         if (.not. angle > angles(n)) then
            call field_error(diagnostics, source, table, entry, field, 'the angles do not ascend', &
                             allowed='above '//to_text(angles(n))//', the angle before')
         else if (angle > angles(1) + 360.0_wp) then
            call field_error(diagnostics, source, table, entry, field, &
                             'the table goes more than once round the circle', &
                             allowed='at most '//to_text(angles(1) + 360.0_wp))
         end if
      end associate
   end subroutine check_point

   !> Check that an angle is in the range of angles
   subroutine check_angle(source, table, entry, field, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> Entry and field
      integer, intent(in) :: entry, field
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (abs(table%values(field, entry)) <= 360.0_wp) return
      call field_error(diagnostics, source, table, entry, field, 'the angle is out of range', &
                       allowed='-360 <= theta <= 360')
   end subroutine check_angle

   !> Check that the fields of points beyond the first are blank
   subroutine check_blank(source, table, entry, first, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SHAPES
      type(table_type), intent(in) :: table
      !> The entry, and the first field that must be blank
      integer, intent(in) :: entry, first
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: field

      do field = first, size(table%fields)
         if (.not. table%given(field, entry)) cycle
         call field_error(diagnostics, source, table, entry, field, &
                          'only a TABLE has more than two numbers', allowed='blank')
         return
      end do
   end subroutine check_blank

end module axijoint_deck_load_shapes
