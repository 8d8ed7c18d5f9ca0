!> Joints laid between the edges of two bodies
module axijoint_deck_mesh_joint_layer
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, edge_type, add_joint, place_text
   use axijoint_deck_text_entry, only : entry_type, field_fault, card_fault
   use axijoint_model_interface, only : interface_type
   use axijoint_model_material, only : rule_centroid
   implicit none
   private
   public :: check_layer, lay_joints

contains

   !> Check that joints may lie between edges that match
   subroutine check_layer(card, fields, rule, draft, a, b)
      !> The card of the joints
      class(entry_type), intent(in) :: card
      !> Its fields of the law and of the faces
      integer, intent(in) :: fields(2)
      !> Rule of the law
      integer, intent(in) :: rule
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of both bodies
      type(edge_type), intent(in) :: a(:), b(:)

      integer :: i

      if (a(1)%element == b(1)%element .or. &
          draft%element_body(a(1)%element) == draft%element_body(b(1)%element)) then
         call field_fault(card, fields(2), &
                          'both faces belong to body '//to_text(draft%element_body(a(1)%element)), &
                          allowed='faces of two bodies')
         return
      end if
      if (rule == rule_centroid .and. any(a%nodes(3) > 0)) then
         call field_fault(card, fields(1), &
                          'the rule CENTROID is for joints of four nodes; here they have six', &
                          mend='choose the rule GAUSS or LOBATTO in LAWS')
      end if
      do i = 1, size(a)
         if (a(i)%body_on_left .eqv. b(i)%body_on_left) then
            call card_fault(card, 'both bodies lie on the same side of the interface', &
                             found='at '//place_text(draft%position(:, a(i)%nodes(1))), &
                             allowed='bodies on opposite sides; they must not overlap')
            return
         else if (.not. any(draft%position(1, a(i)%nodes(:2)) > 0.0_wp)) then
            call card_fault(card, 'a joint would lie on the axis, where it has no area', &
                             found='at '//place_text(draft%position(:, a(i)%nodes(1))), &
                             allowed='r > 0 at one end of each edge at least')
            return
         end if
      end do
   end subroutine check_layer

   !> Add the joints of one interface: side 1-2 on face a, which lies on the right of
   !> the direction from 1 to 2, so that eta leads to face b
   pure subroutine lay_joints(card, interface, a, b, draft)
      !> Card of the interface
      integer, intent(in) :: card
      !> The interface; its bodies are found here
      type(interface_type), intent(in) :: interface
      !> Edges of both faces
      type(edge_type), intent(in) :: a(:), b(:)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      integer :: i, n, label, nodes(6)

      draft%interfaces = [draft%interfaces, interface]
      n = size(draft%interfaces)
      draft%interfaces(n)%bodies = draft%element_body([a(1)%element, b(1)%element])
      label = maxval([0, draft%joint_label(:draft%n_joints)])
      do i = 1, size(a)
         nodes = [a(i)%nodes(1), a(i)%nodes(2), b(i)%nodes(2), b(i)%nodes(1), a(i)%nodes(3), &
                  b(i)%nodes(3)]
         if (a(i)%body_on_left) nodes(:4) = nodes([2, 1, 4, 3])
         call add_joint(draft, label + i, card, interface%law, nodes(:merge(6, 4, nodes(5) > 0)), &
            interface=n)
      end do
   end subroutine lay_joints

end module axijoint_deck_mesh_joint_layer
