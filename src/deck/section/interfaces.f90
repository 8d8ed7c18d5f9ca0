!> INTERFACES: joints, or shared nodes, along two coinciding faces
module axijoint_deck_section_interfaces
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_joints
   use axijoint_deck_mesh_bonds, only : bond_edges
   use axijoint_deck_mesh_draft, only : draft_type, edge_type, place_text
   use axijoint_deck_mesh_faces, only : find_face
   use axijoint_deck_mesh_joint_layer, only : check_layer, lay_joints
   use axijoint_deck_property_properties, only : find_law
   use axijoint_deck_text_common_fields, only : number, face
   use axijoint_deck_text_entry, only : integer_of, text_of, is_given, is_good, card_fault, &
      field_fault, first_card
   use axijoint_deck_text_field, only : described, word_field, text_field
   use axijoint_model_interface, only : interface_type, name_length
   use axijoint_model_material, only : rule_gauss
   implicit none
   private
   public :: interfaces_section, lay_interfaces

   !> The keyword
   character(len=*), parameter :: keyword_interfaces = 'INTERFACES'
   !> Fields
   integer, parameter :: field_law = 1, field_a = 2, field_b = 3, field_kind = 4, field_name = 5
   !> What an interface is made of: joints, or nodes that both bodies share
   character(len=6), parameter :: kinds(2) = [character(len=6) :: 'JOINTS', 'BONDED']
   integer, parameter :: kind_joints = 1, kind_bonded = 2

contains

   !> INTERFACES
   function interfaces_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_interfaces
      section%purpose = 'joints along two coinciding faces of two bodies, or a bond'
      section%stage = stage_joints
      section%read => read_interfaces
      section%fields = [described(number('the law', 1), 'law', &
                                  blank='none', limits='of LAWS; blank if BONDED'), &
                        face(6, 'face a'), face(11, 'face b'), &
                        described(word_field('the kind of interface', 16, 25, kinds, 1), &
                                  'JOINTS: joints of the law; BONDED: the bodies share the '// &
                                  'nodes of both faces'), &
                        described(text_field('the name', 26, 25 + name_length), &
                                  'name, without commas', blank='"interface n", n the card')]
      section%fields([field_law, field_name])%required = .false.
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
         call check_kind(card)
         call check_name(card)
         call find_law(card, field_law, deck%properties, law)
         call find_face(card, field_a, deck%draft, face)
         call find_face(card, field_b, deck%draft, face)
      end do
   end subroutine read_interfaces

   !> Check that joints have a law, and a bond has none
   subroutine check_kind(card)
      !> The card
      type(card_type), intent(in) :: card

      if (.not. is_good(card)) return
      if (integer_of(card, field_kind) == kind_bonded .and. is_given(card, field_law)) then
         call field_fault(card, field_law, 'a bonded interface has no law', allowed='blank', &
                          mend='leave the field blank, or write JOINTS instead of BONDED')
      else if (integer_of(card, field_kind) == kind_joints .and. &
               .not. is_given(card, field_law)) then
         call field_fault(card, field_law, 'the law is blank', allowed='a law of LAWS', &
                          mend='give a law, or write BONDED in columns 16-25 if both bodies '// &
                          'are to share their nodes')
      end if
   end subroutine check_kind

   !> Check that the name fits tables
   subroutine check_name(card)
      !> The card
      type(card_type), intent(in) :: card

      if (.not. is_given(card, field_name)) return
      if (len(text_of(card, field_name)) <= name_length) return
      call field_fault(card, field_name, 'the name is too long', &
                       allowed='at most '//to_text(name_length)//' characters')
   end subroutine check_name

   !> Bond the faces of bonded interfaces, and add the joints of the others, numbered on from the
   !> highest number
   subroutine lay_interfaces(deck)
      !> The deck with the edges of its faces
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: faces(2), law

      card = cards_of(deck, keyword_interfaces)
      do while (next_card(card))
         law = find_number(deck%properties%law_of, integer_of(card, field_law))
         faces = [find_number(deck%draft%face_of, integer_of(card, field_a)), &
                  find_number(deck%draft%face_of, integer_of(card, field_b))]
         if (any(faces == 0) .or. .not. is_good(card)) cycle
         if (law == 0 .and. integer_of(card, field_kind) == kind_joints) cycle
         if (.not. all(deck%draft%faces(faces)%good)) cycle
         call lay_interface(card, law, faces, deck)
      end do
   end subroutine lay_interfaces

   !> Lay one interface
   subroutine lay_interface(card, law, faces, deck)
      !> The card
      type(card_type), intent(in) :: card
      !> The law (index); 0 of a bonded interface
      integer, intent(in) :: law
      !> Face a and face b (index)
      integer, intent(in) :: faces(2)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(edge_type), allocatable :: a(:), b(:)
      type(interface_type) :: interface
      integer :: errors_before, rule

      associate (draft => deck%draft)
         errors_before = deck%diagnostics%n_errors
         call match_faces(card, faces, deck%group, draft, a, b)
         if (deck%diagnostics%n_errors > errors_before) return
         rule = rule_gauss
         if (law > 0) rule = deck%properties%laws(law)%rule
         call check_layer(card, [field_law, field_b], rule, draft, a, b)
         if (deck%diagnostics%n_errors > errors_before) return
         interface%law = law
         interface%faces = draft%faces(faces)%label
         if (is_given(card, field_name)) interface%name = text_of(card, field_name)
         if (law > 0) then
            call lay_joints(first_card(card), interface, a, b, draft)
         else
            call bond_edges(interface, a, b, draft)
         end if
      end associate
   end subroutine lay_interface

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
