!> Fixed displacements of nodes and faces
module axijoint_deck_restraints
   use axijoint_deck_diagnostics, only : diagnostics_type
   use axijoint_deck_draft, only : draft_type
   use axijoint_deck_faces, only : find_face
   use axijoint_deck_node_range, only : find_nodes
   use axijoint_deck_source, only : source_type
   use axijoint_deck_table, only : table_type, integer_value
   implicit none
   private
   public :: fix_nodes, fix_faces

   !> Fields of RESTRAINTS; FIXEDFACES has the first two
   integer, parameter :: field_first = 1, field_code = 2, field_last = 3, field_step = 4

contains

   !> Fix the nodes of the RESTRAINTS cards
   subroutine fix_nodes(source, table, draft, fixed, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> RESTRAINTS
      type(table_type), intent(in) :: table
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Fixed components u, v, w of each node
      logical, intent(inout) :: fixed(:, :)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer, allocatable :: nodes(:)
      integer :: entry, i

      do entry = 1, table%n
         call find_nodes(source, table, entry, field_last, field_step, draft, nodes, diagnostics)
         do i = 1, size(nodes)
            fixed(:, nodes(i)) = fixed(:, nodes(i)) .or. components(table, entry)
         end do
      end do
   end subroutine fix_nodes

   !> Components that a code fixes
   pure function components(table, entry)
      !> RESTRAINTS or FIXEDFACES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Whether u, v and w are fixed
      logical :: components(3)

      integer :: code

      code = integer_value(table, field_code, entry)
      components = [btest(code, 2), btest(code, 1), btest(code, 0)]
   end function components

   !> Fix the nodes of the FIXEDFACES cards
   subroutine fix_faces(source, table, draft, fixed, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> FIXEDFACES
      type(table_type), intent(in) :: table
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Fixed components u, v, w of each node
      logical, intent(inout) :: fixed(:, :)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, face, i, k

      do entry = 1, table%n
         call find_face(source, table, entry, field_first, draft, face, diagnostics)
         if (face == 0 .or. .not. table%good(entry)) cycle
         if (.not. draft%faces(face)%good) cycle
         do i = 1, size(draft%faces(face)%edges)
            associate (nodes => draft%faces(face)%edges(i)%nodes)
               do k = 1, count(nodes > 0)
                  fixed(:, nodes(k)) = fixed(:, nodes(k)) .or. components(table, entry)
               end do
            end associate
         end do
      end do
   end subroutine fix_faces

end module axijoint_deck_restraints
