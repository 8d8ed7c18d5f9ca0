!> Decks of NASTRAN for solids of revolution under loads in harmonics: AXIC, RINGAX, CTRAPAX, CTRIAAX
!> (NASTRAN User's Manual, 2.4)
module axijoint_legacy_nastran
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_mesh_places, only : clear_rounding
   use axijoint_deck_text_diagnostics, only : add_error, add_warning
   use axijoint_deck_text_file_bytes, only : line_end, next_line
   use axijoint_deck_text_source, only : card_text
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_nastran_cards, only : entry_type, next_entry, integer_in, real_in, is_in, &
      fault_in
   use axijoint_legacy_nastran_loads, only : case_type, add_pressure, add_force, add_gravity, &
      add_constraint, gather_sets, hold
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_materials, part_nodes, &
      part_elements
   use axijoint_legacy_words, only : put, exact, integers
   implicit none
   private
   public :: read_nastran, looks_like_nastran

   !> What is wrong with another file, and what is allowed
   character(len=*), parameter :: included = 'INCLUDE is not read', &
      itself = 'the lines of the file itself'

contains

   !> Whether a text is such a deck
   pure logical function looks_like_nastran(bytes)
      !> The text
      character(len=*), intent(in) :: bytes

      character(len=:), allocatable :: line
      logical :: bulk
      integer :: first, last

      looks_like_nastran = .false.
      bulk = .false.
      first = 1
      do while (first <= len(bytes) .and. .not. looks_like_nastran)
         last = line_end(bytes, first)
         line = upper(bytes(first:min(last, first + 15)))
         bulk = bulk .or. index(adjustl(line), 'BEGIN BULK') == 1
         looks_like_nastran = bulk .and. (index(line, 'AXIC') == 1 .or. index(line, 'RINGAX') == 1)
         first = next_line(bytes, last)
      end do
   end function looks_like_nastran

   !> Read a deck
   subroutine read_nastran(cards, sketch)
      !> Its cards
      type(cards_type), intent(inout) :: cards
      !> What is made of it
      type(sketch_type), intent(inout) :: sketch

      type(case_type) :: case
      type(entry_type) :: entry
      integer :: bulk, at
      logical :: known

      call read_case(cards, case, sketch, bulk)
      call gather_sets(cards, bulk, case)
      call read_rings(cards, bulk, case, sketch)
      at = bulk
      do
         call next_entry(cards, at, entry)
         if (entry%name == '' .or. entry%name == 'ENDDATA') exit
         call leave_fields(entry, sketch)
         select case (entry%name)
         case ('AXIC', 'RINGAX', 'PTRAPAX', 'PTRIAAX', 'SPCADD', 'LOAD')
         case ('CTRAPAX')
            call add_element(cards, entry, 4, case, sketch)
         case ('CTRIAAX')
            call add_element(cards, entry, 3, case, sketch)
         case ('MAT1')
            call add_material(cards, entry, sketch)
         case ('PRESAX')
            call add_pressure(cards, entry, case, sketch)
         case ('FORCEAX', 'GRAV', 'SPCAX')
            if (entry%name == 'FORCEAX') call add_force(cards, entry, case, sketch, known)
            if (entry%name == 'GRAV') call add_gravity(cards, entry, case, sketch, known)
            if (entry%name == 'SPCAX') call add_constraint(cards, entry, case, sketch, known)
            if (.not. known) call leave_all(entry, sketch)
         case ('INCLUDE')
            call add_error(cards%diagnostics, entry%first, 0, 0, included, allowed=itself)
         case ('CCONEAX', 'PCONEAX')
            call fault_in(cards, entry, 0, entry%name//': conical shells are no solids', &
               'CTRAPAX and CTRIAAX')
         case default
            call leave_all(entry, sketch)
         end select
      end do
      if (sketch%parts(part_elements)%used == 0 .and. cards%diagnostics%n_errors == 0) &
         call add_error(cards%diagnostics, bulk, 0, 0, 'there are no elements', &
         allowed='CTRAPAX and CTRIAAX')
   end subroutine read_nastran

   !> Note that all cards of an entry are not translated
   subroutine leave_all(entry, sketch)
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      integer :: k

      do k = entry%first, entry%last
         call leave_out(sketch, k, entry%name)
      end do
   end subroutine leave_all

   !> Note fields of an entry that are neither read nor blank nor zero
   subroutine leave_fields(entry, sketch)
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      integer :: field

      do field = 2, entry%n + 1
         if (is_read(entry%name, field) .or. verify(entry%text(field - 1), '+-0. ') == 0) cycle
         call leave_out(sketch, entry%place(1, field - 1), 'field '//to_text(field)//' of '//entry%name//', '// &
            trim(entry%text(field - 1)))
      end do
   end subroutine leave_fields

   !> Whether a field of an entry is read, or asks for output alone
   pure logical function is_read(name, field)
      !> Name of the entry
      character(len=*), intent(in) :: name
      !> The field, from 2
      integer, intent(in) :: field

      select case (name)
      case ('AXIC')
         is_read = field == 2
      case ('RINGAX')
         is_read = any(field == [2, 4, 5, 8])
      case ('PTRAPAX', 'PTRIAAX')
         is_read = field /= 3  ! angles of stresses from field 5 on
      case ('MAT1')
         is_read = field < 7 .or. any(field == [10, 11, 12])  ! limits of stresses
      case ('CTRIAAX', 'SPCAX')
         is_read = field < 7
      case ('CTRAPAX', 'PRESAX', 'GRAV')
         is_read = field < 8
      case ('FORCEAX')
         is_read = field < 9
      case default  ! all of it, or it is left out as a whole
         is_read = .true.
      end select
   end function is_read

   !> Executive and case control: title, sets, family
   subroutine read_case(cards, case, sketch, bulk)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> What is asked for
      type(case_type), intent(inout) :: case
      !> The new deck
      type(sketch_type), intent(inout) :: sketch
      !> The card BEGIN BULK
      integer, intent(out) :: bulk

      character(len=:), allocatable :: line, word, value
      integer :: fault, equals
      logical :: control, chosen

      control = .false.
      chosen = .false.
      sketch%title = ''
      do bulk = 1, cards%source%n_cards
         line = trim(adjustl(upper(card_text(cards%source, bulk))))
         if (index(line, 'BEGIN BULK') == 1) exit
         if (len(line) == 0) cycle
         if (line(1:1) == '$') cycle
         if (index(line, 'INCLUDE') == 1) call add_error(cards%diagnostics, bulk, 0, 0, included, &
            allowed=itself)
         if (line == 'CEND') control = .true.
         if (.not. control .and. index(line, 'SOL ') == 1) then
            if (all(first_word(line(5:)) /= [character(len=7) :: '1', '101', 'STATICS', 'STATIC'])) &
               call leave_out(sketch, bulk, trim(line)//': linear statics is translated')
         end if
         if (.not. control .or. line == 'CEND') cycle  ! executive control
         equals = index(line//'=', '=')
         word = trim(line(:equals - 1))
         value = ''
         if (equals < len(line)) value = trim(adjustl(line(equals + 1:)))
         fault = 0
         if (begins_subcase(word)) case%n_subcases = case%n_subcases + 1
         if (case%n_subcases > 1) then
            call leave_out(sketch, bulk, 'case control of further subcases: '//case%subcase// &
               ', the first, is translated')
         else if (begins_subcase(word)) then
            case%subcase = word
         else if (word == 'TITLE') then
            sketch%title = value
            sketch%title_card = bulk
         else if (word == 'LOAD') then
            read (value, *, iostat=fault) case%load
         else if (word == 'SPC') then
            read (value, *, iostat=fault) case%constraint
         else if (index(word, 'AXISYM') == 1) then
            case%symmetric = index(value, 'SIN') /= 1
            chosen = any(value == [character(len=6) :: 'COSINE', 'SINE'])
            if (.not. chosen) fault = 1
         else if (word == 'SUBTITLE' .or. word == 'LABEL') then
            cycle
         else
            call leave_out(sketch, bulk, word(:min(24, index(word//' ', ' ') - 1)))
         end if
         if (fault /= 0) call add_error(cards%diagnostics, bulk, 0, 0, word//': this value is '// &
            'not known', found=value)
      end do
      if (.not. chosen) call add_warning(cards%diagnostics, 1, 0, 0, &
         'no AXISYMMETRIC = COSINE or SINE: taken as COSINE')
   end subroutine read_case

   !> What stands before a comma or a blank
   pure function first_word(text) result(word)
      !> The text
      character(len=*), intent(in) :: text
      !> The word
      character(len=:), allocatable :: word

      word = trim(adjustl(text))
      word = word(:scan(word//' ', ' ,') - 1)
   end function first_word

   !> Whether a line of case control begins a subcase, or one that is made of others
   pure logical function begins_subcase(word)
      !> What stands before its equals sign
      character(len=*), intent(in) :: word

      begins_subcase = any(word(:index(word//' ', ' ') - 1) == [character(len=7) :: 'SUBCASE', &
         'SUBCOM', 'SYM', 'SYMCOM', 'REPCASE'])
   end function begins_subcase

   !> Harmonics, rings, and the materials of properties
   subroutine read_rings(cards, bulk, case, sketch)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The card BEGIN BULK
      integer, intent(in) :: bulk
      !> Takes the rings
      type(case_type), intent(inout) :: case
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      type(entry_type) :: entry
      integer, allocatable :: rings(:)
      integer :: at, ring, n, k

      n = cards%source%n_cards
      allocate (case%position(2, n), case%material(n), rings(n))
      at = bulk
      do
         call next_entry(cards, at, entry)
         if (entry%name == '') exit
         select case (entry%name)
         case ('AXIC')
            sketch%harmonic = integer_in(cards, entry, 2, 0)
            if (sketch%harmonic < 0 .or. sketch%harmonic > 9999) &
               call fault_in(cards, entry, 2, 'this is no highest harmonic', '0 to 9999')
         case ('RINGAX')
            ring = integer_in(cards, entry, 2, 0)
            if (ring < 1 .or. find_number(case%rings, ring) > 0) then
               call fault_in(cards, entry, 2, 'no number of a ring, or there already', '1 to 999999')
               cycle
            end if
            case%n_rings = case%n_rings + 1
            call insert_number(case%rings, ring, case%n_rings)
            case%position(:, case%n_rings) = [real_in(cards, entry, 4, 0.0_wp), &
               real_in(cards, entry, 5, 0.0_wp)]
            rings(case%n_rings) = ring
            if (is_in(entry, 8)) call hold(cards, entry, 8, ring, '', sketch)
         case ('PTRAPAX', 'PTRIAAX')
            case%n_materials = case%n_materials + 1
            call claim_number(cards, entry, 'a property', case%n_materials, case%properties)
            case%material(case%n_materials) = integer_in(cards, entry, 4, 0)
         case ('MAT1')
            call claim_number(cards, entry, 'a material', 1, case%materials)
         case ('CTRAPAX', 'CTRIAAX')
            call claim_number(cards, entry, 'an element', 1, case%elements)
         end select
      end do
      call clear_rounding(case%position(:, :case%n_rings))
      do k = 1, case%n_rings
         call put(sketch%parts(part_nodes), to_text(rings(k))//', '//exact(case%position(1, k))//', '//exact(case%position(2, k)))
      end do
   end subroutine read_rings

   !> The number of a thing in field 2: an error if it is none, or there already
   subroutine claim_number(cards, entry, what, index, map)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> What has the number
      character(len=*), intent(in) :: what
      !> Index of it
      integer, intent(in) :: index
      !> Numbers of all of them
      type(number_map_type), intent(inout) :: map

      integer :: number

      number = integer_in(cards, entry, 2, 0)
      if (number < 1) then
         call fault_in(cards, entry, 2, 'this is no number of '//what, '1, 2, ...')
      else if (find_number(map, number) > 0) then
         call fault_in(cards, entry, 2, what//' of this number is there already', &
            'each number once')
      else
         call insert_number(map, number, index)
      end if
   end subroutine claim_number

   !> CTRAPAX and CTRIAAX: nodes counterclockwise
   subroutine add_element(cards, entry, n, case, sketch)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> Corners
      integer, intent(in) :: n
      !> Rings and properties
      type(case_type), intent(in) :: case
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      integer :: nodes(n), rings(n), property, k
      real(wp) :: area

      do k = 1, n
         nodes(k) = integer_in(cards, entry, 3 + k, 0)
         rings(k) = find_number(case%rings, nodes(k))
         if (rings(k) == 0) call fault_in(cards, entry, 3 + k, 'there is no such ring', 'RINGAX')
      end do
      property = find_number(case%properties, integer_in(cards, entry, 3, &
         integer_in(cards, entry, 2, 0)))
      if (property == 0) call fault_in(cards, entry, 3, 'there is no such property', &
         'PTRAPAX and PTRIAAX')
      if (any(rings == 0) .or. property == 0) return
      if (find_number(case%materials, case%material(property)) == 0) then
         call fault_in(cards, entry, 3, 'its property has material '// &
            to_text(case%material(property))//', and there is no MAT1 of this number', 'MAT1')
         return
      end if
      area = 0.0_wp
      do k = 1, n
         associate (a => case%position(:, rings(k)), b => case%position(:, rings(mod(k, n) + 1)))
            area = area + a(1)*b(2) - b(1)*a(2)
         end associate
      end do
      if (area < 0.0_wp) nodes = nodes(n:1:-1)
      call put(sketch%parts(part_elements), to_text(integer_in(cards, entry, 2, 0))//', '// &
         to_text(case%material(property))//', 1'//integers(nodes))
   end subroutine add_element

   !> MAT1: two of E, G and nu
   subroutine add_material(cards, entry, sketch)
      !> The deck
      type(cards_type), intent(inout) :: cards
      !> The entry
      type(entry_type), intent(in) :: entry
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      real(wp) :: young, shear, poisson

      young = real_in(cards, entry, 3, 0.0_wp)
      shear = real_in(cards, entry, 4, 0.0_wp)
      poisson = real_in(cards, entry, 5, 0.0_wp)
      if (.not. is_in(entry, 5) .and. shear > 0.0_wp .and. young > 0.0_wp) &
         poisson = young/(2.0_wp*shear) - 1.0_wp
      if (.not. is_in(entry, 3)) young = 2.0_wp*shear*(1.0_wp + poisson)
      if (is_in(entry, 3) .and. is_in(entry, 4) .and. is_in(entry, 5) .and. &
          abs(2.0_wp*shear*(1.0_wp + poisson) - young) > 1.0e-3_wp*young) &
         call leave_out(sketch, entry%first, 'G of MAT1, which is not that of E and nu')
      if (.not. young > 0.0_wp) call fault_in(cards, entry, 3, 'two of E, G and nu are needed', &
         'E > 0')
      call put(sketch%parts(part_materials), to_text(integer_in(cards, entry, 2, 0))//', '// &
         exact(young)//', '//exact(poisson)//', '//exact(real_in(cards, entry, 6, 0.0_wp)))
   end subroutine add_material

end module axijoint_legacy_nastran
