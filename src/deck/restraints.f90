!> Fixed displacements of nodes and faces
module axijoint_deck_restraints
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_diagnostics, only : diagnostics_type
   use axijoint_deck_draft, only : draft_type
   use axijoint_deck_faces, only : find_face
   use axijoint_deck_source, only : source_type
   use axijoint_deck_table, only : table_type, integer_value, field_error
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

      integer :: entry, first, last, step

      do entry = 1, table%n
         if (.not. table%good(entry)) cycle
         first = integer_value(table, field_first, entry)
         last = first
         if (table%given(field_last, entry)) last = integer_value(table, field_last, entry)
         step = integer_value(table, field_step, entry)
         if (mod(abs(last - first), step) /= 0) then
            call field_error(diagnostics, source, table, entry, &
                             merge(field_step, field_last, table%given(field_step, entry)), &
                             'the step does not lead from node '//to_text(first)//' to node '// &
                             to_text(last), allowed='a divisor of '//to_text(abs(last - first)))
         else
            call fix_range(source, table, entry, first, last, sign(step, last - first), draft, fixed, &
                           diagnostics)
         end if
      end do
   end subroutine fix_nodes

   !> Fix nodes first, first + step, ..., last
   subroutine fix_range(source, table, entry, first, last, step, draft, fixed, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> RESTRAINTS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Numbers of the nodes
      integer, intent(in) :: first, last, step
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Fixed components u, v, w of each node
      logical, intent(inout) :: fixed(:, :)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, label, node

      do i = 0, (last - first)/step
         label = first + i*step
         node = find_number(draft%node_of, label)
         if (node == 0) then
            if (.not. draft%nodes_complete) return
            call field_error(diagnostics, source, table, entry, merge(field_last, field_first, i > 0), &
                             'node '//to_text(label)//' is not defined', &
                             allowed='nodes first, first + step, ..., last must all exist')
            return
         end if
         fixed(:, node) = fixed(:, node) .or. components(table, entry)
      end do
   end subroutine fix_range

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
