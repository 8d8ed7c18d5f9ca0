!> Joints laid between two coinciding faces
module axijoint_deck_mesh_interfaces
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_mesh_draft, only : draft_type, edge_type, add_joint, place_text
   use axijoint_deck_mesh_faces, only : find_face
   use axijoint_deck_property_properties, only : properties_type, find_property
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, field_error, entry_error
   use axijoint_model_material, only : rule_centroid
   implicit none
   private
   public :: refer_interfaces, lay_interfaces, check_interface, lay_interface

   !> Fields of INTERFACES
   integer, parameter :: field_law = 1, field_a = 2, field_b = 3

contains

   !> Find the laws and faces that the cards name
   subroutine refer_interfaces(source, table, properties, draft, reference, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> INTERFACES
      type(table_type), intent(in) :: table
      !> Laws
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Law, face a and face b of each entry, 0 where unknown
      integer, allocatable, intent(out) :: reference(:, :)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry

      allocate (reference(3, table%n), source=0)
      do entry = 1, table%n
         call find_property(source, table, entry, field_law, properties%law_of, &
                            properties%laws_complete, 'law', reference(field_law, entry), diagnostics)
         call find_face(source, table, entry, field_a, draft, reference(field_a, entry), diagnostics)
         call find_face(source, table, entry, field_b, draft, reference(field_b, entry), diagnostics)
      end do
   end subroutine refer_interfaces

   !> Add the joints of all interfaces, numbered on from the highest number
   subroutine lay_interfaces(source, table, reference, properties, group, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> INTERFACES
      type(table_type), intent(in) :: table
      !> Law, face a and face b of each entry
      integer, intent(in) :: reference(:, :)
      !> Laws
      type(properties_type), intent(in) :: properties
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, errors_before
      type(edge_type), allocatable :: a(:), b(:)

      do entry = 1, table%n
         if (any(reference(:, entry) == 0) .or. .not. table%good(entry)) cycle
         if (.not. all(draft%faces(reference(field_a:, entry))%good)) cycle
         errors_before = diagnostics%n_errors
         call match_faces(table, entry, reference(:, entry), group, draft, a, b, diagnostics)
         if (diagnostics%n_errors > errors_before) cycle
         call check_interface(source, table, entry, [field_law, field_b], &
                              properties%laws(reference(field_law, entry))%rule, &
                              draft, a, b, diagnostics)
         if (diagnostics%n_errors > errors_before) cycle
         call lay_interface(table%cards(1, entry), reference(field_law, entry), a, b, draft)
      end do
   end subroutine lay_interfaces

   !> Bring the edges of face b into the order and direction of face a
   subroutine match_faces(table, entry, reference, group, draft, a, b, diagnostics)
      !> INTERFACES
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Law, face a and face b
      integer, intent(in) :: reference(:)
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of both faces
      type(edge_type), allocatable, intent(out) :: a(:), b(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: names
      integer :: i

      a = draft%faces(reference(field_a))%edges
      b = draft%faces(reference(field_b))%edges
      names = 'faces '//to_text(draft%faces(reference(field_a))%label)//' and '// &
              to_text(draft%faces(reference(field_b))%label)
      if (group(a(1)%nodes(1)) /= group(b(1)%nodes(1)) .or. &
          group(a(size(a))%nodes(2)) /= group(b(size(b))%nodes(2))) call reverse(b)
      if (group(a(1)%nodes(1)) /= group(b(1)%nodes(1)) .or. &
          group(a(size(a))%nodes(2)) /= group(b(size(b))%nodes(2))) then
         call entry_error(diagnostics, table, entry, names//' do not have the same ends', &
                          found=span_text(draft, a)//'; '//span_text(draft, b), &
                          allowed='two faces that coincide from end to end')
         return
      end if
      do i = 1, min(size(a), size(b))
         if (group(a(i)%nodes(2)) == group(b(i)%nodes(2))) cycle
         call entry_error(diagnostics, table, entry, names//' do not have the same nodes', &
                          found=count_of(size(a), 'edge')//' and '//count_of(size(b), 'edge')// &
                          '; they part at '//place_text(draft%position(:, a(i)%nodes(1))), &
                          allowed='the same nodes along both faces', mend='divide both bodies alike there')
         return
      end do
      do i = 1, size(a)
         if (count(a(i)%nodes > 0) == count(b(i)%nodes > 0)) then
            if (a(i)%nodes(3) == 0) cycle
            if (group(a(i)%nodes(3)) == group(b(i)%nodes(3))) cycle
         end if
         call entry_error(diagnostics, table, entry, names//' do not have the same middle nodes', &
                          found='an edge from '//span_text(draft, a(i:i)), &
                          allowed='4-node elements on both sides, or 8- and 9-node elements with the ' &
                          //'same middle nodes')
         return
      end do
   end subroutine match_faces

   !> Where edges begin and end, for messages
   pure function span_text(draft, edges) result(text)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges, one after another
      type(edge_type), intent(in) :: edges(:)
      !> The text
      character(len=:), allocatable :: text

      text = place_text(draft%position(:, edges(1)%nodes(1)))//' to '// &
             place_text(draft%position(:, edges(size(edges))%nodes(2)))
   end function span_text

   !> Run through edges in the opposite direction
   pure subroutine reverse(edges)
      !> The edges
      type(edge_type), intent(inout) :: edges(:)

      integer :: i

      edges = edges(size(edges):1:-1)
      do i = 1, size(edges)
         edges(i)%nodes(:2) = edges(i)%nodes([2, 1])
         edges(i)%body_on_left = .not. edges(i)%body_on_left
      end do
   end subroutine reverse

   !> Check that joints may lie between two faces that match
   subroutine check_interface(source, table, entry, fields, rule, draft, a, b, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> INTERFACES or GROUPS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Fields of the law and of the faces
      integer, intent(in) :: fields(2)
      !> Rule of the law
      integer, intent(in) :: rule
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of both faces
      type(edge_type), intent(in) :: a(:), b(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i

      if (a(1)%element == b(1)%element .or. &
          draft%element_body(a(1)%element) == draft%element_body(b(1)%element)) then
         call field_error(diagnostics, source, table, entry, fields(2), &
                          'both faces belong to body '//to_text(draft%element_body(a(1)%element)), &
                          allowed='faces of two bodies')
         return
      end if
      if (rule == rule_centroid .and. any(a%nodes(3) > 0)) then
         call field_error(diagnostics, source, table, entry, fields(1), &
                          'the rule CENTROID is for joints of four nodes; here they have six', &
                          mend='choose the rule GAUSS or LOBATTO in LAWS')
      end if
      do i = 1, size(a)
         if (a(i)%body_on_left .eqv. b(i)%body_on_left) then
            call entry_error(diagnostics, table, entry, 'both bodies lie on the same side of the interface', &
                             found='at '//place_text(draft%position(:, a(i)%nodes(1))), &
                             allowed='bodies on opposite sides; they must not overlap')
            return
         else if (.not. any(draft%position(1, a(i)%nodes(:2)) > 0.0_wp)) then
            call entry_error(diagnostics, table, entry, 'a joint would lie on the axis, where it has no area', &
                             found='at '//place_text(draft%position(:, a(i)%nodes(1))), &
                             allowed='r > 0 at one end of each edge at least')
            return
         end if
      end do
   end subroutine check_interface

   !> Add the joints of one interface: side 1-2 on face a, which lies on the right of
   !> the direction from 1 to 2, so that eta leads to face b
   pure subroutine lay_interface(card, law, a, b, draft)
      !> Card of the interface, and its law
      integer, intent(in) :: card, law
      !> Edges of both faces
      type(edge_type), intent(in) :: a(:), b(:)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer :: i, label, nodes(6)

      label = maxval([0, draft%joint_label(:draft%n_joints)])
      do i = 1, size(a)
         nodes = [a(i)%nodes(1), a(i)%nodes(2), b(i)%nodes(2), b(i)%nodes(1), a(i)%nodes(3), b(i)%nodes(3)]
         if (a(i)%body_on_left) nodes(:4) = nodes([2, 1, 4, 3])
         call add_joint(draft, label + i, card, 0, law, nodes(:merge(6, 4, nodes(5) > 0)))
      end do
   end subroutine lay_interface

end module axijoint_deck_mesh_interfaces
