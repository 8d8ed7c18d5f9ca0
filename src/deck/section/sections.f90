!> SECTIONS: lines along which results are given
module axijoint_deck_section_sections
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_number_map, only : number_map_type
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_mesh_draft, only : place_text
   use axijoint_deck_mesh_places, only : same_place
   use axijoint_deck_text_common_fields, only : number, length, angle, largest_division
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_entry, only : integer_of, reals_of, is_good, card_fault, first_card
   use axijoint_deck_text_field, only : integer_field, described
   use axijoint_deck_text_labels, only : check_label
   use axijoint_model_locate, only : locate_points, locate_beside, line_position
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_request, only : line_type, line_point_type
   implicit none
   private
   public :: sections_section, place_lines, keyword_sections

   !> The keyword
   character(len=*), parameter :: keyword_sections = 'SECTIONS'
   !> Fields: number, r and z of both ends, number of points, angles
   integer, parameter :: field_label = 1, field_first = 2, field_last = 4, field_points = 6, &
      field_angles = 7

contains

   !> SECTIONS
   function sections_section() result(section)
      !> The section
      type(read_section_type) :: section

      integer :: i

      section%name = keyword_sections
      section%purpose = 'results along straight lines in the r-z plane'
      section%numbered = .true.
      section%stage = stage_requests
      section%read => read_lines
      section%fields = &
         [described(number('the section', 1), 'section', limits='each number once'), &
          described([length('r of the first point', 6, 0.0_wp), &
          length('z of the first point', 16)], &
                    'r1 z1: first point', limits='r ≥ 0'), &
          described([length('r of the last point', 26, 0.0_wp), &
          length('z of the last point', 36)], &
                    'r2 z2: last point', limits='r ≥ 0; not the first point'), &
          described(integer_field('the number of points', 46, 50, 2, largest_division, &
          default=11), &
                    'number of points, at equal distances'), &
          described([(angle('angle '//to_text(i), 41 + 10*i), i=1, 3)], 'angles θ [degree]', &
                    blank='those of OUTPUT')]
   end function sections_section

   !> Read the lines as far as their cards tell
   subroutine read_lines(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(number_map_type) :: seen

      card = cards_of(deck, keyword_sections)
      allocate (deck%model%lines(card%table%n))
      do while (next_card(card))
         call check_label(card, field_label, 'section', seen, &
                          allowed='a number of its own for each section')
         associate (line => deck%model%lines(card%entry), table => card%table)
            line%label = integer_of(card, field_label)
            line%first = reals_of(card, field_first, 2)
            line%last = reals_of(card, field_last, 2)
            line%n_points = integer_of(card, field_points)
            line%angles = degree*pack(table%values(field_angles:, card%entry), &
               table%given(field_angles:, card%entry))
            if (size(line%angles) == 0) line%angles = deck%model%output_angles
            if (.not. is_good(card)) cycle
            if (norm2(line%last - line%first) <= same_place*maxval(abs([line%first, &
               line%last]))) then
               call card_fault(card, 'the section has no length', found=place_text(line%first)// &
                               ' at both ends', &
                               mend='give two different points')
            end if
         end associate
      end do
   end subroutine read_lines

   !> Find the elements of the points of all lines; tell of points outside
   subroutine place_lines(deck, mesh)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> The mesh
      type(mesh_type), intent(in) :: mesh

      type(card_type) :: card
      logical, allocatable :: lies(:)
      integer :: outside, missing

      card = cards_of(deck, keyword_sections)
      do while (next_card(card))
         if (.not. is_good(card)) cycle
         associate (line => deck%model%lines(card%entry))
            call locate_points(mesh, line)
            if (size(line%points) > 0) call add_ends(deck, card, mesh, line)
            if (allocated(lies)) deallocate (lies)
            allocate (lies(line%n_points), source=.false.)
            lies(line%points%number) = .true.
            outside = count(.not. lies)
            missing = findloc(lies, .false., 1)
            if (outside == line%n_points) then
               call card_fault(card, 'no point of section '//to_text(line%label)// &
                  ' lies in the mesh', &
                               allowed='points in elements: r from '//range_text(mesh, 1)// &
                                  ', z from '//range_text(mesh, 2))
            else if (outside > 0) then
               call add_warning(deck%diagnostics, first_card(card), 0, 0, to_text(outside)// &
                                ' of the '// &
                                to_text(line%n_points)//' points of section '// &
                                to_text(line%label)// &
                                trim(merge(' lies', ' lie ', outside == 1))// &
                                ' outside the mesh: no results there', &
                                found='the first at '//place_text(line_position(line, missing)))
            end if
         end associate
      end do
   end subroutine place_lines

   !> Put ends of a line that lie just outside the body that it comes from, as on an outline that curves, on its nearest side
   subroutine add_ends(deck, card, mesh, line)
      !> Takes warnings
      type(deck_type), intent(inout) :: deck
      !> The card of the line
      type(card_type), intent(in) :: card
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The line, some points of which lie in elements
      type(line_type), intent(inout) :: line

      type(line_point_type) :: hit, neighbour
      logical :: found

      neighbour = line%points(1)
      if (neighbour%number > 1) then
         hit%number = 1
         call locate_beside(mesh, line%first, mesh%element_body(neighbour%element), hit, found)
         if (found) found = reaches(line%first)
         if (found) call tell(line%first)
         if (found) line%points = [hit, line%points]
      end if
      neighbour = line%points(size(line%points))
      if (neighbour%number < line%n_points) then
         hit%number = line%n_points
         call locate_beside(mesh, line%last, mesh%element_body(neighbour%element), hit, found)
         if (found) found = reaches(line%last)
         if (found) call tell(line%last)
         if (found) line%points = [line%points, hit]
      end if

   contains

      !> Whether there is nothing between the side and the point of the line before it but what the side is off
      pure logical function reaches(end)
         !> The end of the line
         real(wp), intent(in) :: end(2)

         real(wp) :: spacing

         spacing = norm2(line%last - line%first)/(line%n_points - 1)
         reaches = norm2(end - neighbour%position) <= 2.0_wp*norm2(end - hit%position) + 1.5_wp*spacing
      end function reaches

      !> Say how far the end is moved
      subroutine tell(end)
         !> It
         real(wp), intent(in) :: end(2)

         call add_warning(deck%diagnostics, first_card(card), 0, 0, 'an end of section '//to_text(line%label)// &
                          ' lies just outside: it is put on the nearest side', &
                          found='a distance of '//to_text(norm2(end - hit%position)))
      end subroutine tell

   end subroutine add_ends

   !> Smallest and largest coordinate of the mesh
   pure function range_text(mesh, axis) result(text)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> 1 for r, 2 for z
      integer, intent(in) :: axis
      !> Such as "0 to 2"
      character(len=:), allocatable :: text

      text = to_text(minval(mesh%coordinates(axis, :)))//' to '// &
         to_text(maxval(mesh%coordinates(axis, :)))
   end function range_text

end module axijoint_deck_section_sections
