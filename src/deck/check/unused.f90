!> What a deck gives and nothing uses: often a wrong number on another card
module axijoint_deck_check_unused
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_text_layout, only : section_names, section_materials, section_orthotropic, section_laws, &
      section_shapes, section_interfaces, section_fixed_faces, section_moved_faces, section_springs, &
      section_tractions, section_pressures, section_resultants, section_ring_loads, section_temperatures, &
      section_node_temps
   use axijoint_deck_text_load_fields, only : name_shape
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value
   use axijoint_model_mesh, only : mesh_type
   implicit none
   private
   public :: warn_of_unused

   !> Sections whose first field is a face
   integer, parameter :: sections_of_faces(6) = [section_fixed_faces, section_moved_faces, section_springs, &
      section_tractions, section_pressures, section_resultants]
   !> Faces on the cards of INTERFACES
   integer, parameter :: field_face_a = 2, field_face_b = 3
   !> Sections whose loads may have a shape
   integer, parameter :: sections_with_shapes(5) = [section_tractions, section_pressures, section_ring_loads, &
      section_temperatures, section_node_temps]
   !> Numbers that are listed in a message
   integer, parameter :: most_listed = 10

contains

   !> Warn of materials, laws, faces and shapes that nothing uses, and of sections without cards.
   !> For decks without errors: of others too little is known
   subroutine warn_of_unused(source, sections, draft, mesh, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> Its sections
      type(sections_type), intent(in) :: sections
      !> Faces
      type(draft_type), intent(in) :: draft
      !> Elements and joints, with their materials
      type(mesh_type), intent(in) :: mesh
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: k

      associate (materials => sections%tables(section_materials), orthotropic => sections%tables(section_orthotropic), &
                 laws => sections%tables(section_laws), shapes => sections%tables(section_shapes))
         call tell('material', [numbers_of(materials), numbers_of(orthotropic)], &
                   [cards_of(materials), cards_of(orthotropic)], &
                   occur(mesh%element_material, materials%n + orthotropic%n), &
                   'used by no element', diagnostics)
         call tell('law', numbers_of(laws), cards_of(laws), occur(mesh%joint_material, laws%n), &
                   'used by no joint', diagnostics)
         call tell('face', (draft%faces%label), (draft%faces%card), are_in((draft%faces%label), faces_in_use(sections)), &
                   'used by no card', diagnostics)
         call tell('shape', numbers_of(shapes), cards_of(shapes), &
                   are_in(numbers_of(shapes), shapes_in_use(sections)), 'used by no load', diagnostics)
      end associate
      do k = 1, size(sections%empty)
         call add_warning(diagnostics, sections%empty(k), 0, 0, &
                          trim(section_names(source%cards(sections%empty(k))%keyword))//' has no cards', &
                          mend='remove the keyword, or write 0 behind it from column 11 on if that is meant')
      end do
   end subroutine warn_of_unused

   !> Warn of the things of one kind that nothing uses, in one message
   subroutine tell(noun, numbers, cards, used, what, diagnostics)
      !> What they are
      character(len=*), intent(in) :: noun
      !> Their numbers and cards; a number may be there several times
      integer, intent(in) :: numbers(:), cards(:)
      !> Whether anything uses them
      logical, intent(in) :: used(:)
      !> What is wrong: "used by ..."
      character(len=*), intent(in) :: what
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: told
      character(len=:), allocatable :: list
      integer :: k, n

      n = 0
      list = ''
      do k = 1, size(used)
         if (used(k) .or. find_number(told, numbers(k)) > 0) cycle
         call insert_number(told, numbers(k), k)
         n = n + 1
         if (n <= most_listed) list = list//', '//to_text(numbers(k))
      end do
      if (n == 0) return
      if (n > most_listed) list = list//', ...'
      if (n == 1) list = noun//' '//list(3:)//' is '//what
      if (n > 1) list = to_text(n)//' '//noun//'s are '//what//': '//list(3:)
      call add_warning(diagnostics, cards(findloc(used, .false., 1)), 0, 0, list, &
                       mend='remove what is not needed, or correct the number on the cards that should use it')
   end subroutine tell

   !> Numbers of the entries of a section, its first field
   pure function numbers_of(table) result(numbers)
      !> The section
      type(table_type), intent(in) :: table
      !> The numbers
      integer, allocatable :: numbers(:)

      numbers = nint(table%values(1, :table%n))
   end function numbers_of

   !> First cards of the entries of a section
   pure function cards_of(table) result(cards)
      !> The section
      type(table_type), intent(in) :: table
      !> The cards
      integer, allocatable :: cards(:)

      cards = table%cards(1, :table%n)
   end function cards_of

   !> Whether indices occur in a list
   pure function occur(list, n)
      !> The list
      integer, intent(in) :: list(:)
      !> Largest index
      integer, intent(in) :: n
      !> The answers
      logical :: occur(n)

      occur = .false.
      occur(list) = .true.
   end function occur

   !> Whether numbers are among others
   pure function are_in(numbers, others)
      !> The numbers
      integer, intent(in) :: numbers(:)
      !> The others
      type(number_map_type), intent(in) :: others
      !> The answers
      logical :: are_in(size(numbers))

      integer :: k

      are_in = [(find_number(others, numbers(k)) > 0, k=1, size(numbers))]
   end function are_in

   !> Numbers of the faces that cards name
   pure function faces_in_use(sections) result(numbers)
      !> The sections
      type(sections_type), intent(in) :: sections
      !> The numbers
      type(number_map_type) :: numbers

      integer :: k

      do k = 1, size(sections_of_faces)
         call add_field(sections%tables(sections_of_faces(k)), 1, numbers)
      end do
      call add_field(sections%tables(section_interfaces), field_face_a, numbers)
      call add_field(sections%tables(section_interfaces), field_face_b, numbers)
   end function faces_in_use

   !> Numbers of the shapes that loads name
   pure function shapes_in_use(sections) result(numbers)
      !> The sections
      type(sections_type), intent(in) :: sections
      !> The numbers
      type(number_map_type) :: numbers

      integer :: k, field

      do k = 1, size(sections_with_shapes)
         associate (table => sections%tables(sections_with_shapes(k)))
            do field = 1, size(table%fields)
               if (table%fields(field)%name == name_shape) call add_field(table, field, numbers)
            end do
         end associate
      end do
   end function shapes_in_use

   !> Add the numbers in a field of a section
   pure subroutine add_field(table, field, numbers)
      !> The section
      type(table_type), intent(in) :: table
      !> The field
      integer, intent(in) :: field
      !> The numbers
      type(number_map_type), intent(inout) :: numbers

      integer :: entry

      do entry = 1, table%n
         if (table%given(field, entry)) call insert_number(numbers, integer_value(table, field, entry), entry)
      end do
   end subroutine add_field

end module axijoint_deck_check_unused
