!> POINTS: points with names, whose displacements are followed from increment to increment
module axijoint_deck_section_points
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_text_common_fields, only : number, length, body
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_entry, only : is_given, integer_of, reals_of, text_of, is_good, &
      card_fault, field_fault, first_card
   use axijoint_deck_text_field, only : text_field, described
   use axijoint_deck_text_labels, only : check_label
   use axijoint_fe_shape, only : shape_element
   use axijoint_model_locate, only : locate_points, locate_beside
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_request, only : point_type, line_type, line_point_type
   implicit none
   private
   public :: points_section, place_points, keyword_points

   !> The keyword
   character(len=*), parameter :: keyword_points = 'POINTS'
   !> Fields: number, r and z, body, name
   integer, parameter :: field_label = 1, field_place = 2, field_body = 4, field_name = 5

contains

   !> POINTS
   function points_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_points
      section%purpose = 'points with names whose displacements are followed through the increments'
      section%numbered = .true.
      section%stage = stage_requests
      section%read => read_points
      section%fields = [described(number('the point', 1), 'point', limits='each number once'), &
                        described([length('r', 6, 0.0_wp), length('z', 16)], &
                                  'r z: place [length]', limits='in the mesh'), &
                        described(body(26), 'body', blank='the lowest there'), &
                        described(text_field('the name', 31, 46), 'name', &
                                  blank='point and its number', limits='each once')]
      section%fields(field_name)%required = .false.
   end function points_section

   !> Read the points as far as their cards tell
   subroutine read_points(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(number_map_type) :: seen

      card = cards_of(deck, keyword_points)
      allocate (deck%model%points(card%table%n))
      do while (next_card(card))
         call check_label(card, field_label, 'point', seen, &
            allowed='a number of its own for each point')
         associate (points => deck%model%points)
            points(card%entry)%label = integer_of(card, field_label)
            points(card%entry)%name = 'point '//to_text(integer_of(card, field_label))
            if (is_given(card, field_name)) points(card%entry)%name = text_of(card, field_name)
            points(card%entry)%position = reals_of(card, field_place, 2)
            if (is_given(card, field_body)) points(card%entry)%body = integer_of(card, field_body)
            if (any(points(:card%entry - 1)%name == points(card%entry)%name)) &
               call field_fault(card, field_name, 'another point has this name', &
                                allowed='a name of its own for each point')
         end associate
      end do
   end subroutine read_points

   !> Find the elements of the points. Where bodies meet that move by themselves, the lowest is followed unless one is named
   subroutine place_points(deck, mesh)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> The mesh
      type(mesh_type), intent(in) :: mesh

      type(card_type) :: card
      type(point_type) :: other
      type(line_type) :: line
      type(line_point_type) :: side
      integer :: k, body, apart
      logical :: beside

      card = cards_of(deck, keyword_points)
      do while (next_card(card))
         if (.not. is_good(card)) cycle
         associate (point => deck%model%points(card%entry))
            if (point%body > 0 .and. .not. any(mesh%element_body == point%body)) then
               call field_fault(card, field_body, 'body '//to_text(point%body)//' has no elements')
               cycle
            end if
            ! a line of two points at the same place
            line%first = point%position
            line%last = point%position
            line%n_points = 2
            call locate_points(mesh, line)
            apart = 0
            body = 0
            do k = 1, size(line%points)
               associate (here => mesh%element_body(line%points(k)%element))
                  if (point%body > 0 .and. here /= point%body) cycle
                  call place_in_element(mesh, line%points(k), other)
                  if (body > 0 .and. apart == 0) then
                     if (.not. same_nodes(point, other)) apart = max(here, body)
                  end if
                  if (body > 0 .and. here >= body) cycle
                  body = here
                  point%nodes = other%nodes
                  point%shape = other%shape
               end associate
            end do
            if (body == 0) then
               call locate_beside(mesh, point%position, point%body, side, beside)
               if (beside) then
                  call place_in_element(mesh, side, point)
                  call add_warning(deck%diagnostics, first_card(card), 0, 0, 'point '//to_text(point%label)// &
                                   ' lies just outside: it follows the nearest side', &
                                   found='a distance of '//to_text(norm2(side%position - point%position)))
               else
                  call card_fault(card, 'the point does not lie in '// &
                                  trim(merge('the body', 'the mesh', point%body > 0)), &
                                  allowed='a point in an element, or at its edge')
               end if
            end if
            if (apart > 0 .and. point%body == 0) &
               call add_warning(deck%diagnostics, first_card(card), 0, 0, 'point '//to_text(point%label)// &
                                ' lies on bodies '//to_text(body)//' and '//to_text(apart)// &
                                ', which move apart: it follows body '//to_text(body), &
                                mend='name the body in columns 26-30')
         end associate
      end do
   end subroutine place_points

   !> Nodes of an element, and what they have of a point in it
   subroutine place_in_element(mesh, place, point)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Where the point is
      type(line_point_type), intent(in) :: place
      !> Takes both
      type(point_type), intent(inout) :: point

      real(wp), allocatable :: derivative(:, :)
      integer :: n

      n = mesh%element_size(place%element)
      point%nodes = mesh%element_nodes(:n, place%element)
      if (allocated(point%shape)) deallocate (point%shape)
      allocate (point%shape(n), derivative(2, n))
      call shape_element(n, place%natural(1), place%natural(2), point%shape, derivative)
   end subroutine place_in_element

   !> Whether two points are at the same nodes, but for rounding
   pure logical function same_nodes(a, b)
      !> The points, in their elements
      type(point_type), intent(in) :: a, b

      real(wp), parameter :: rounding = 1.0e-6_wp
      integer :: k

      same_nodes = .true.
      do k = 1, size(a%nodes)
         if (abs(a%shape(k)) > rounding) same_nodes = same_nodes .and. any(b%nodes == a%nodes(k))
      end do
   end function same_nodes

end module axijoint_deck_section_points
