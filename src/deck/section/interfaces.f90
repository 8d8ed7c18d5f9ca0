!> INTERFACES: joints between two coinciding faces
module axijoint_deck_section_interfaces
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_joints
   use axijoint_deck_mesh_draft, only : draft_type, edge_type, place_text
   use axijoint_deck_mesh_faces, only : find_face
   use axijoint_deck_mesh_joint_layer, only : check_layer, lay_joints
   use axijoint_deck_property_properties, only : find_law
   use axijoint_deck_text_common_fields, only : number, face
   use axijoint_deck_text_entry, only : integer_of, is_good, card_fault, first_card
   use axijoint_deck_text_field, only : described
   implicit none
   private
   public :: interfaces_section, lay_interfaces

   !> The keyword
   character(len=*), parameter :: keyword_interfaces = 'INTERFACES'
   !> Fields
   integer, parameter :: field_law = 1, field_a = 2, field_b = 3

contains

   !> INTERFACES
   function interfaces_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_interfaces
      section%purpose = 'joints along two coinciding faces of two bodies'
      section%stage = stage_joints
      section%read => read_interfaces
      section%fields = [described(number('the law', 1), 'law', limits='of LAWS'), &
                        face(6, 'face a'), face(11, 'face b')]
   end function interfaces_section

   !> Find the laws and faces that the cards name, so that those that do not exist are reported
   !> whatever is wrong with the mesh
   subroutine read_interfaces(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: law, face

      card = cards_of(deck, keyword_interfaces)
      do while (next_card(card))
         call find_law(card, field_law, deck%properties, law)
         call find_face(card, field_a, deck%draft, face)
         call find_face(card, field_b, deck%draft, face)
      end do
   end subroutine read_interfaces

   !> Add the joints of all interfaces, numbered on from the highest number
   subroutine lay_interfaces(deck)
      !> The deck with the edges of its faces
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(edge_type), allocatable :: a(:), b(:)
      integer :: law, faces(2), errors_before

      card = cards_of(deck, keyword_interfaces)
      do while (next_card(card))
         law = find_number(deck%properties%law_of, integer_of(card, field_law))
         faces = [find_number(deck%draft%face_of, integer_of(card, field_a)), &
                  find_number(deck%draft%face_of, integer_of(card, field_b))]
         if (law == 0 .or. any(faces == 0) .or. .not. is_good(card)) cycle
         associate (draft => deck%draft)
            if (.not. all(draft%faces(faces)%good)) cycle
            errors_before = deck%diagnostics%n_errors
            call match_faces(card, faces, deck%group, draft, a, b)
            if (deck%diagnostics%n_errors > errors_before) cycle
            call check_layer(card, [field_law, field_b], deck%properties%laws(law)%rule, draft, a, &
               b)
            if (deck%diagnostics%n_errors > errors_before) cycle
            call lay_joints(first_card(card), law, a, b, draft)
         end associate
      end do
   end subroutine lay_interfaces

   !> Bring the edges of face b into the order and direction of face a
   subroutine match_faces(card, faces, group, draft, a, b)
      !> The card
      type(card_type), intent(in) :: card
      !> Face a and face b
      integer, intent(in) :: faces(2)
      !> Number of each node's place
      integer, intent(in) :: group(:)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of both faces
      type(edge_type), allocatable, intent(out) :: a(:), b(:)

      character(len=:), allocatable :: names
      integer :: i

      a = draft%faces(faces(1))%edges
      b = draft%faces(faces(2))%edges
      names = 'faces '//to_text(draft%faces(faces(1))%label)//' and '// &
              to_text(draft%faces(faces(2))%label)
      if (group(a(1)%nodes(1)) /= group(b(1)%nodes(1)) .or. &
          group(a(size(a))%nodes(2)) /= group(b(size(b))%nodes(2))) call reverse(b)
      if (group(a(1)%nodes(1)) /= group(b(1)%nodes(1)) .or. &
          group(a(size(a))%nodes(2)) /= group(b(size(b))%nodes(2))) then
         call card_fault(card, names//' do not have the same ends', &
                          found=span_text(draft, a)//'; '//span_text(draft, b), &
                          allowed='two faces that coincide from end to end')
         return
      end if
      do i = 1, min(size(a), size(b))
         if (group(a(i)%nodes(2)) == group(b(i)%nodes(2))) cycle
         call card_fault(card, names//' do not have the same nodes', &
                          found=count_of(size(a), 'edge')//' and '//count_of(size(b), 'edge')// &
                          '; they part at '//place_text(draft%position(:, a(i)%nodes(1))), &
                          allowed='the same nodes along both faces', &
                          mend='divide both bodies alike there')
         return
      end do
      do i = 1, size(a)
         if (count(a(i)%nodes > 0) == count(b(i)%nodes > 0)) then
            if (a(i)%nodes(3) == 0) cycle
            if (group(a(i)%nodes(3)) == group(b(i)%nodes(3))) cycle
         end if
         call card_fault(card, names//' do not have the same middle nodes', &
                          found='an edge from '//span_text(draft, a(i:i)), &
                          allowed='4-node elements on both sides, or 8- and 9-node elements '// &
                          'with the ' &
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

end module axijoint_deck_section_interfaces
