!> Fixed displacements of nodes and faces: RESTRAINTS, FIXEDFACES
module axijoint_deck_load_restraints
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_mesh_faces, only : find_face
   use axijoint_deck_mesh_node_range, only : find_nodes
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error
   use axijoint_model_model, only : model_type
   use axijoint_model_restraint, only : restraint_type, hold_in
   implicit none
   private
   public :: read_restraints

   !> Fields of both sections; RESTRAINTS has a last node and a step, too
   integer, parameter :: field_first = 1, field_code = 2, field_last = 3, field_step = 4
   !> First of the fields that say in which harmonics it holds: first, last, family
   integer, parameter :: range_of_nodes = 5, range_of_faces = 3

contains

   !> Hold nodes and faces
   subroutine read_restraints(source, of_nodes, of_faces, draft, highest, model, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> RESTRAINTS, FIXEDFACES
      type(table_type), intent(in) :: of_nodes, of_faces
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: highest
      !> The job, which takes the restraints
      type(model_type), intent(inout) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: nodes(:)
      integer :: entry, face

      allocate (model%fixed(3, draft%n_nodes), model%held_by_default(3, draft%n_nodes), source=.false.)
      allocate (model%restraints(0))
      do entry = 1, of_nodes%n
         call find_nodes(source, of_nodes, entry, field_last, field_step, draft, nodes, diagnostics)
         call hold(source, of_nodes, entry, range_of_nodes, nodes, highest, model, diagnostics)
      end do
      model%held_by_default = model%fixed
      do entry = 1, of_faces%n
         call find_face(source, of_faces, entry, field_first, draft, face, diagnostics)
         if (face > 0) nodes = nodes_of_face(draft, face)
         if (face == 0) nodes = [integer ::]
         call hold(source, of_faces, entry, range_of_faces, nodes, highest, model, diagnostics)
      end do
   end subroutine read_restraints

   !> Nodes of a face; none if it is at fault itself
   pure function nodes_of_face(draft, face) result(nodes)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The face
      integer, intent(in) :: face
      !> Its nodes, some of them twice
      integer, allocatable :: nodes(:)

      integer :: i

      allocate (nodes(0))
      if (.not. draft%faces(face)%good) return
      associate (edges => draft%faces(face)%edges)
         nodes = [(edges(i)%nodes, i=1, size(edges))]
      end associate
      nodes = pack(nodes, nodes > 0)
   end function nodes_of_face

   !> Hold the nodes of one card
   subroutine hold(source, table, entry, field_range, nodes, highest, model, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> The entry, and the field of its first harmonic
      integer, intent(in) :: entry, field_range
      !> The nodes
      integer, intent(in) :: nodes(:)
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: highest
      !> The job, which takes the restraints
      type(model_type), intent(inout) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(restraint_type) :: range
      logical :: components(3)
      integer :: i

      if (.not. table%good(entry)) return
      associate (code => integer_value(table, field_code, entry))
         components = [btest(code, 2), btest(code, 1), btest(code, 0)]
      end associate
      if (any(table%given(field_range:field_range + 2, entry))) then
         call read_range(source, table, entry, field_range, highest, range, diagnostics)
         call hold_in(model%restraints, range, size(model%fixed, 2), nodes, components)
         return
      end if
      do i = 1, 3
         if (.not. components(i)) cycle
         model%fixed(i, nodes) = .true.
         if (field_range == range_of_faces) model%held_by_default(i, nodes) = .false.
      end do
   end subroutine hold

   !> In which harmonics and families a card holds
   subroutine read_range(source, table, entry, field, highest, range, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> The entry, and the field of its first harmonic; the last and the family follow
      integer, intent(in) :: entry, field
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: highest
      !> Takes them; every harmonic, either family if the card does not say
      type(restraint_type), intent(inout) :: range
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, parameter :: last = 1, family = 2

      if (table%given(field + family, entry)) range%family = integer_value(table, field + family, entry)
      if (.not. table%given(field, entry)) then
         if (table%given(field + last, entry)) call field_error(diagnostics, source, table, entry, field + last, &
            'the first harmonic is blank', allowed='both harmonics, the first alone, or none')
         return
      end if
      range%first = integer_value(table, field, entry)
      range%last = range%first
      if (table%given(field + last, entry)) range%last = integer_value(table, field + last, entry)
      if (range%last < range%first) then
         call field_error(diagnostics, source, table, entry, field + last, &
                          'the last harmonic is below the first', allowed=to_text(range%first)//' or more')
      else if (highest >= 0 .and. range%first > highest) then
         call field_error(diagnostics, source, table, entry, field, &
                          'harmonic '//to_text(range%first)//' is above the highest, M = '//to_text(highest), &
                          allowed='0 to '//to_text(highest), &
                          mend='what holds in every harmonic needs no harmonic on its card')
      end if
   end subroutine read_range

end module axijoint_deck_load_restraints
