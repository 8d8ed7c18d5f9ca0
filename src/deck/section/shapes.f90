!> SHAPES: functions of theta
module axijoint_deck_section_shapes
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_load_shapes, only : shapes_type
   use axijoint_deck_text_common_fields, only : number, largest_harmonic
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, field_fault, card_fault
   use axijoint_deck_text_field, only : real_field, word_field, described
   use axijoint_deck_text_labels, only : repeated_label
   use axijoint_fe_circle_function, only : circle_function_type, new_patch, new_cosine, new_table
   implicit none
   private
   public :: shapes_section

   !> The keyword
   character(len=*), parameter :: keyword_shapes = 'SHAPES'
   !> Fields; the meaning of the numbers from `field_number` on depends on the kind
   integer, parameter :: field_label = 1, field_kind = 2, field_number = 3
   !> Kinds, and their places
   character(len=6), parameter :: kinds(3) = [character(len=6) :: 'PATCH', 'COSINE', 'TABLE']
   integer, parameter :: kind_patch = 1, kind_cosine = 2, kind_table = 3

contains

   !> SHAPES
   function shapes_section() result(section)
      !> The section
      type(read_section_type) :: section

      integer :: i

      section%name = keyword_shapes
      section%purpose = 'functions f(θ) by which loads go round the circle'
      section%numbered = .true.
      section%stage = stage_loads
      section%read => read_shapes
      section%fields = &
         [number('the shape', 1), described(word_field('the kind of shape', 6, 15, kinds), &
         'kind'), &
          described([(real_field('number '//to_text(i)//' of the shape', 6 + 10*i, &
                                 default=0.0_wp), i=1, 6)], &
                    'PATCH: θ1 θ2 [degree], f = 1 between them; COSINE: m θ0, f = cos m(θ − '// &
                    'θ0); '// &
                    'TABLE: θ f θ f θ f, linear between; further cards of the same number go on', blank='θ0 of COSINE: 0', &
                    limits='θ: −360 … 360; m: 0, 1, …, 9999')]
      section%fields(field_number)%required = .true.
   end function shapes_section

   !> Make the functions
   subroutine read_shapes(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer, allocatable :: first_entry(:), shape_of_entry(:)
      integer :: shape, n

      card = cards_of(deck, keyword_shapes)
      associate (shapes => deck%shapes, table => card%table)
         allocate (shapes%functions(table%n), first_entry(table%n))
         allocate (shapes%good(table%n), source=.false.)
         allocate (shape_of_entry(table%n), source=0)
         do while (next_card(card))
            call number_shape(card, first_entry, shape_of_entry, shapes)
         end do
         n = maxval([0, shape_of_entry])
         shapes%label = nint(table%values(field_label, first_entry(:n)))
         shapes%card = table%cards(1, first_entry(:n))
         do shape = 1, n
            shapes%good(shape) = all(pack(table%good(:table%n), shape_of_entry == shape))
            if (.not. shapes%good(shape)) cycle
            card%entry = first_entry(shape)
            card%errors_before = deck%diagnostics%n_errors
            select case (integer_of(card, field_kind))
            case (kind_patch)
               call read_patch(card, shapes%functions(shape))
            case (kind_cosine)
               call read_cosine(card, shapes%functions(shape))
            case (kind_table)
               call read_table(card, shape_of_entry == shape, shapes%functions(shape))
            end select
            shapes%good(shape) = deck%diagnostics%n_errors == card%errors_before
         end do
      end associate
   end subroutine read_shapes

   !> Note the number of a card's shape. A table may go on on a further card
   subroutine number_shape(card, first_entry, shape_of_entry, shapes)
      !> The card
      type(card_type), intent(in) :: card
      !> First entry of each shape
      integer, intent(inout) :: first_entry(:)
      !> Shape of each entry
      integer, intent(inout) :: shape_of_entry(:)
      !> The functions, of which the number is noted
      type(shapes_type), intent(inout) :: shapes

      integer :: label, known, n

      if (.not. is_given(card, field_label)) then
         shapes%complete = .false.
         return
      end if
      n = maxval([0, shape_of_entry])
      label = integer_of(card, field_label)
      known = find_number(shapes%shape_of, label)
      if (known == 0) then
         call insert_number(shapes%shape_of, label, n + 1)
         first_entry(n + 1) = card%entry
         shape_of_entry(card%entry) = n + 1
      else if (all(nint(card%table%values(field_kind, &
         [first_entry(known), card%entry])) == kind_table)) then
         shape_of_entry(card%entry) = known
      else if (all(card%table%given(field_kind, [first_entry(known), card%entry]))) then
         call repeated_label(card, field_label, 'shape', card%table%cards(1, first_entry(known)), &
                             mend='only a TABLE goes on on further cards')
      end if
   end subroutine number_shape

   !> A function that is 1 between two angles
   subroutine read_patch(card, f)
      !> The card
      type(card_type), intent(in) :: card
      !> The function
      type(circle_function_type), intent(out) :: f

      real(wp) :: from, width
      integer :: errors_before

      errors_before = card%diagnostics%n_errors
      call check_angle(card, field_number)
      if (.not. is_given(card, field_number + 1)) then
         call field_fault(card, field_number + 1, &
                          'the patch has no second angle', allowed='theta1 and theta2 of a patch')
         return
      end if
      call check_angle(card, field_number + 1)
      call check_blank(card, field_number + 2)
      if (card%diagnostics%n_errors > errors_before) return
      from = real_of(card, field_number)
      width = real_of(card, field_number + 1) - from
      if (width > 360.0_wp) then
         call field_fault(card, field_number + 1, &
                          'the patch is wider than the circle', &
                          allowed='at most 360 degrees beyond theta1', &
                          mend='the whole circle is 0 to 360')
         return
      end if
      if (width < 0.0_wp) width = modulo(width, 360.0_wp)
      if (.not. width > 0.0_wp) then
         call field_fault(card, field_number + 1, 'the patch has no width', &
                          allowed='two different angles; the patch goes from the first '// &
                          'counterclockwise ' &
                          //'to the second', mend='the whole circle is 0 to 360')
         return
      end if
      f = new_patch(from, from + width)
   end subroutine read_patch

   !> cos m(theta - theta0)
   subroutine read_cosine(card, f)
      !> The card
      type(card_type), intent(in) :: card
      !> The function
      type(circle_function_type), intent(out) :: f

      associate (m => real_of(card, field_number))
         if (m < 0.0_wp .or. m > real(largest_harmonic, wp) .or. abs(m - anint(m)) > 0.0_wp) then
            call field_fault(card, field_number, &
                             'the harmonic of the cosine is not an integer from 0 to ' &
                             //to_text(largest_harmonic), allowed='m of cos m(theta - theta0)')
            return
         end if
         call check_angle(card, field_number + 1)
         call check_blank(card, field_number + 2)
         f = new_cosine(nint(m), real_of(card, field_number + 1))
      end associate
   end subroutine read_cosine

   !> Linear between the points of one card or more
   subroutine read_table(card, belongs, f)
      !> The first of the cards
      type(card_type), intent(in) :: card
      !> Which entries belong to the shape
      logical, intent(in) :: belongs(:)
      !> The function
      type(circle_function_type), intent(out) :: f

      type(card_type) :: next
      real(wp), allocatable :: angles(:), values(:)
      integer :: field, errors_before

      errors_before = card%diagnostics%n_errors
      allocate (angles(0), values(0))
      next = card
      do while (next%entry <= size(belongs))
         do field = field_number, size(card%table%fields), 2
            if (.not. belongs(next%entry)) exit
            if (.not. (is_given(next, field) .or. is_given(next, field + 1))) cycle
            call check_point(next, field, angles)
            angles = [angles, real_of(next, field)]
            values = [values, real_of(next, field + 1)]
         end do
         next%entry = next%entry + 1
      end do
      if (card%diagnostics%n_errors > errors_before) return
      if (size(angles) < 2) then
         call card_fault(card, 'the table has one point only', &
            allowed='two points theta, f at least', &
                         mend='a load that does not depend on theta has harmonic 0 and no shape')
         return
      end if
      f = new_table(angles, values)
   end subroutine read_table

   !> Check a point of a table: both numbers, and an angle beyond the one before
   subroutine check_point(card, field, angles)
      !> The card, and its field of the angle
      type(card_type), intent(in) :: card
      integer, intent(in) :: field
      !> Angles before
      real(wp), intent(in) :: angles(:)

      associate (angle => real_of(card, field), n => size(angles))
         if (.not. (is_given(card, field) .and. is_given(card, field + 1))) then
            call field_fault(card, merge(field + 1, field, is_given(card, field)), &
                             'a point of the table is not complete', allowed='pairs theta, f')
            return
         end if
         call check_angle(card, field)
         if (n == 0) return
         if (.not. angle > angles(n)) then
            call field_fault(card, field, 'the angles do not ascend', &
                             allowed='above '//to_text(angles(n))//', the angle before')
         else if (angle > angles(1) + 360.0_wp) then
            call field_fault(card, field, 'the table goes more than once round the circle', &
                             allowed='at most '//to_text(angles(1) + 360.0_wp))
         end if
      end associate
   end subroutine check_point

   !> Check that an angle is in the range of angles
   subroutine check_angle(card, field)
      !> The card, and its field
      type(card_type), intent(in) :: card
      integer, intent(in) :: field

      if (abs(real_of(card, field)) <= 360.0_wp) return
      call field_fault(card, field, 'the angle is out of range', &
                       allowed='-360 <= theta <= 360')
   end subroutine check_angle

   !> Check that the fields of points beyond the first are blank
   subroutine check_blank(card, first)
      !> The card
      type(card_type), intent(in) :: card
      !> The first field that must be blank
      integer, intent(in) :: first

      integer :: field

      do field = first, size(card%table%fields)
         if (.not. is_given(card, field)) cycle
         call field_fault(card, field, &
                          'only a TABLE has more than two numbers', allowed='blank')
         return
      end do
   end subroutine check_blank

end module axijoint_deck_section_shapes
