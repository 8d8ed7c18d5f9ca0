!> A card of a load with all that it is read against, so that the readers of the
!> sections need not hand it on piece by piece
module axijoint_deck_load_card
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_load_cases, only : cases_type, case_of_card
   use axijoint_deck_load_shapes, only : shapes_type
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_mesh_face_geometry, only : moment_of_radius
   use axijoint_deck_mesh_faces, only : find_face
   use axijoint_deck_mesh_node_range, only : find_nodes
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_layout, only : section_names
   use axijoint_deck_text_load_fields, only : name_last, name_step
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, field_error, field_warning, entry_error, &
      table_integer => integer_value
   implicit none
   private
   public :: load_card_type, open_section, next_card
   public :: is_given, integer_of, real_of, reals_of, field_named, section_name
   public :: field_fault, field_doubt, card_fault, is_sound
   public :: find_loaded_face, find_any_face, find_node, find_row, check_body

   !> One card of a section, and the deck around it
   type :: load_card_type
      !> The deck
      type(source_type), pointer :: source => null()
      !> Its sections, and the one that the card belongs to
      type(sections_type), pointer :: sections => null()
      type(table_type), pointer :: table => null()
      !> Number of that section
      integer :: section = 0
      !> The entry
      integer :: entry = 0
      !> The mesh
      type(draft_type), pointer :: draft => null()
      !> Messages, and how many errors there were before the card
      type(diagnostics_type), pointer :: diagnostics => null()
      integer :: errors_before = 0
      !> Materials by number
      type(number_map_type) :: material_of
      !> Functions of theta
      type(shapes_type) :: shapes
      !> Highest harmonic of the job; negative if it is not known
      integer :: highest = -1
      !> Harmonics in use; all up to M unless HARMONICS gives others
      integer, allocatable :: harmonics(:)
      !> Load cases, and that of the card (index)
      type(cases_type) :: cases
      integer :: case = 1
   end type load_card_type

contains

   !> Begin with the cards of a section
   subroutine open_section(card, section)
      !> The card; `next_card` makes it the first one
      type(load_card_type), intent(inout) :: card
      !> The section
      integer, intent(in) :: section

      card%section = section
      card%table => card%sections%tables(section)
      card%entry = 0
   end subroutine open_section

   !> Go on to the next card of the section
   logical function next_card(card) result(there_is_one)
      !> The card
      type(load_card_type), intent(inout) :: card

      card%entry = card%entry + 1
      card%errors_before = card%diagnostics%n_errors
      there_is_one = card%entry <= card%table%n
      if (there_is_one) card%case = case_of_card(card%cases, card%table%cards(1, card%entry))
   end function next_card

   !> Keyword of the card's section
   pure function section_name(card) result(name)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The keyword
      character(len=:), allocatable :: name

      name = trim(section_names(card%section))
   end function section_name

   !> Whether a field has a valid value
   pure logical function is_given(card, field)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The field; 0 for one that the section lacks
      integer, intent(in) :: field

      is_given = .false.
      if (field > 0) is_given = card%table%given(field, card%entry)
   end function is_given

   !> Value of a field as an integer
   pure integer function integer_of(card, field)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field

      integer_of = table_integer(card%table, field, card%entry)
   end function integer_of

   !> Value of a field
   pure real(wp) function real_of(card, field)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field

      real_of = card%table%values(field, card%entry)
   end function real_of

   !> Values of three fields one after another
   pure function reals_of(card, field)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The first field
      integer, intent(in) :: field
      !> Their values
      real(wp) :: reals_of(3)

      reals_of = card%table%values(field:field + 2, card%entry)
   end function reals_of

   !> Place of a field among those of its section; 0 if the section has none of this name
   pure integer function field_named(card, name)
      !> The card
      type(load_card_type), intent(in) :: card
      !> Name of the field
      character(len=*), intent(in) :: name

      do field_named = size(card%table%fields), 1, -1
         if (card%table%fields(field_named)%name == name) return
      end do
   end function field_named

   !> Report a fault of a field
   subroutine field_fault(card, field, text, allowed, mend)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What is allowed, how to mend it
      character(len=*), intent(in), optional :: allowed, mend

      call field_error(card%diagnostics, card%source, card%table, card%entry, field, text, allowed, mend)
   end subroutine field_fault

   !> Warn of the value of a field
   subroutine field_doubt(card, field, text, mend)
      !> The card
      type(load_card_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field
      !> What is doubtful, how to mend it
      character(len=*), intent(in) :: text, mend

      call field_warning(card%diagnostics, card%source, card%table, card%entry, field, text, mend)
   end subroutine field_doubt

   !> Report a fault of the card as a whole
   subroutine card_fault(card, text, found, allowed, mend)
      !> The card
      type(load_card_type), intent(in) :: card
      !> What is wrong
      character(len=*), intent(in) :: text
      !> What was found, what is allowed, how to mend it
      character(len=*), intent(in), optional :: found, allowed, mend

      call entry_error(card%diagnostics, card%table, card%entry, text, found, allowed, mend)
   end subroutine card_fault

   !> Whether nothing was found wrong with the card
   pure logical function is_sound(card)
      !> The card
      type(load_card_type), intent(in) :: card

      is_sound = card%table%good(card%entry) .and. card%diagnostics%n_errors == card%errors_before
   end function is_sound

   !> Find the face that the first field names, or report it
   subroutine find_any_face(card, face)
      !> The card
      type(load_card_type), intent(in) :: card
      !> Its index; 0 if there is none, or if it is at fault itself
      integer, intent(out) :: face

      call find_face(card%source, card%table, card%entry, 1, card%draft, face, card%diagnostics)
      if (face == 0) return
      if (.not. card%draft%faces(face)%good) face = 0
   end subroutine find_any_face

   !> Find the face that the first field names, and check that it has an area
   subroutine find_loaded_face(card, face)
      !> The card
      type(load_card_type), intent(in) :: card
      !> Its index; 0 if there is none, or if it is at fault itself
      integer, intent(out) :: face

      call find_any_face(card, face)
      if (face == 0) return
      if (moment_of_radius(card%draft, card%draft%faces(face)%edges, 1) > 0.0_wp) return
      call field_fault(card, 1, 'the loaded face lies on the axis: it has no area', &
                       allowed='a face with r > 0')
      face = 0
   end subroutine find_loaded_face

   !> Find the node that the first field names, or report it
   subroutine find_node(card, node)
      !> The card
      type(load_card_type), intent(in) :: card
      !> Its index; 0 if there is none, or if it is at fault itself
      integer, intent(out) :: node

      node = 0
      if (.not. is_given(card, 1)) return
      node = find_number(card%draft%node_of, integer_of(card, 1))
      if (node > 0) then
         if (.not. card%draft%node_good(node)) node = 0
      else if (card%draft%nodes_complete) then
         call field_fault(card, 1, 'node '//to_text(integer_of(card, 1))//' is not defined')
      end if
   end subroutine find_node

   !> Find the nodes first, first + step, ..., last, or report those that do not exist
   subroutine find_row(card, nodes)
      !> The card
      type(load_card_type), intent(in) :: card
      !> Their indices; none if one is at fault
      integer, allocatable, intent(out) :: nodes(:)

      call find_nodes(card%source, card%table, card%entry, field_named(card, name_last), &
                      field_named(card, name_step), card%draft, nodes, card%diagnostics)
      if (.not. all(card%draft%node_good(nodes))) nodes = [integer ::]
   end subroutine find_row

   !> Check that the body of the first field, if it is given, has elements
   subroutine check_body(card)
      !> The card
      type(load_card_type), intent(in) :: card

      if (.not. is_given(card, 1) .or. .not. card%draft%elements_complete) return
      if (any(card%draft%element_body(:card%draft%n_elements) == integer_of(card, 1))) return
      call field_fault(card, 1, 'there is no body '//to_text(integer_of(card, 1)), &
                       allowed='the body of an ELEMENTS or BLOCKS card (1 if blank there)')
   end subroutine check_body

end module axijoint_deck_load_card
