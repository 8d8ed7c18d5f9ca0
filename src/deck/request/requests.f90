!> Where results are wanted: SECTIONS, CUTS, and faces that are held
module axijoint_deck_request_requests
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_number_map, only : number_map_type, find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, place_text
   use axijoint_deck_mesh_places, only : same_place
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_text_labels, only : check_label
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error, entry_error
   use axijoint_model_locate, only : locate_points, line_position
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_request, only : line_type, cut_type, supported_face_type
   implicit none
   private
   public :: read_lines, read_cuts, place_lines, place_cuts, gather_supported_faces

   !> Fields of SECTIONS: number, r and z of both ends, number of points, angles
   integer, parameter :: field_label = 1, field_ends = 2, field_points = 6, field_angles = 7
   !> Further fields of CUTS
   integer, parameter :: field_z = 2, field_body = 3

contains

   !> Read SECTIONS as far as their cards tell
   subroutine read_lines(source, table, default_angles, lines, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> SECTIONS
      type(table_type), intent(in) :: table
      !> Angles of sections without angles [radian]
      real(wp), intent(in) :: default_angles(:)
      !> One line an entry
      type(line_type), allocatable, intent(out) :: lines(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: seen
      integer :: entry

      allocate (lines(table%n))
      do entry = 1, table%n
         call check_label(source, table, entry, 'section', seen, diagnostics, &
                          allowed='a number of its own for each section')
         associate (line => lines(entry), values => table%values(:, entry), given => table%given(:, entry))
            line%label = integer_value(table, field_label, entry)
            line%first = values(field_ends:field_ends + 1)
            line%last = values(field_ends + 2:field_ends + 3)
            line%n_points = integer_value(table, field_points, entry)
            line%angles = degree*pack(values(field_angles:), given(field_angles:))
            if (size(line%angles) == 0) line%angles = default_angles
            if (.not. table%good(entry)) cycle
            if (norm2(line%last - line%first) <= same_place*maxval(abs([line%first, line%last]))) then
               call entry_error(diagnostics, table, entry, 'the section has no length', &
                                found=place_text(line%first)//' at both ends', &
                                mend='give two different points')
            end if
         end associate
      end do
   end subroutine read_lines

   !> Read CUTS as far as their cards tell
   subroutine read_cuts(source, table, cuts, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> CUTS
      type(table_type), intent(in) :: table
      !> One cut an entry
      type(cut_type), allocatable, intent(out) :: cuts(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: seen
      integer :: entry

      allocate (cuts(table%n))
      do entry = 1, table%n
         call check_label(source, table, entry, 'cut', seen, diagnostics, &
                          allowed='a number of its own for each cut')
         cuts(entry)%label = integer_value(table, field_label, entry)
         cuts(entry)%z = table%values(field_z, entry)
         if (table%given(field_body, entry)) cuts(entry)%body = integer_value(table, field_body, entry)
      end do
   end subroutine read_cuts

   !> Find the elements of the points of all lines; tell of points outside
   subroutine place_lines(table, mesh, lines, diagnostics)
      !> SECTIONS
      type(table_type), intent(in) :: table
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The lines
      type(line_type), intent(inout) :: lines(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      logical, allocatable :: lies(:)
      integer :: entry, outside, missing

      do entry = 1, size(lines)
         if (.not. table%good(entry)) cycle
         associate (line => lines(entry))
            call locate_points(mesh, line)
            if (allocated(lies)) deallocate (lies)
            allocate (lies(line%n_points), source=.false.)
            lies(line%points%number) = .true.
            outside = count(.not. lies)
            missing = findloc(lies, .false., 1)
            if (outside == line%n_points) then
               call entry_error(diagnostics, table, entry, &
                                'no point of section '//to_text(line%label)//' lies in the mesh', &
                                allowed='points in elements: r from '//range_text(mesh, 1)// &
                                   ', z from '//range_text(mesh, 2))
            else if (outside > 0) then
               call add_warning(diagnostics, table%cards(1, entry), 0, 0, to_text(outside)//' of the '// &
                                to_text(line%n_points)//' points of section '//to_text(line%label)// &
                                trim(merge(' lies', ' lie ', outside == 1))//' outside the mesh: no results there', &
                                found='the first at '//place_text(line_position(line, missing)))
            end if
         end associate
      end do
   end subroutine place_lines

   !> Check that cuts pass through their bodies
   subroutine place_cuts(source, table, mesh, cuts, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> CUTS
      type(table_type), intent(in) :: table
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The cuts
      type(cut_type), intent(in) :: cuts(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: low, high
      integer :: entry, element

      do entry = 1, size(cuts)
         if (.not. table%good(entry)) cycle
         associate (cut => cuts(entry))
            if (cut%body > 0 .and. .not. any(mesh%element_body == cut%body)) then
               call field_error(diagnostics, source, table, entry, field_body, &
                                'body '//to_text(cut%body)//' has no elements')
               cycle
            end if
            low = huge(low)
            high = -huge(high)
            do element = 1, size(mesh%element_body)
               if (cut%body > 0 .and. mesh%element_body(element) /= cut%body) cycle
               associate (z => mesh%coordinates(2, mesh%element_nodes(:mesh%element_size(element), element)))
                  low = min(low, minval(z))
                  high = max(high, maxval(z))
               end associate
            end do
            if (cut%z >= low .and. cut%z <= high) cycle
            call field_error(diagnostics, source, table, entry, field_z, 'the cut misses '// &
                             trim(merge('the body  ', 'all bodies', cut%body > 0)), &
                             allowed='z from '//to_text(low)//' to '//to_text(high))
         end associate
      end do
   end subroutine place_cuts

   !> Faces that cards of some sections hold, each once, with the nodes that no face
   !> before it has
   pure function gather_supported_faces(draft, tables) result(faces)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Sections whose first field is a face
      type(table_type), intent(in) :: tables(:)
      !> The faces
      type(supported_face_type), allocatable :: faces(:)

      logical, allocatable :: known(:), new(:)
      integer :: k, entry, face, i

      allocate (faces(0))
      allocate (known(draft%n_nodes), new(draft%n_nodes), source=.false.)
      do k = 1, size(tables)
         do entry = 1, tables(k)%n
            if (.not. tables(k)%good(entry)) cycle
            face = find_number(draft%face_of, integer_value(tables(k), field_label, entry))
            if (face == 0) cycle
            if (.not. draft%faces(face)%good .or. any(faces%label == draft%faces(face)%label)) cycle
            faces = [faces, supported_face_type(draft%faces(face)%label, [integer ::])]
            new = .false.
            do i = 1, size(draft%faces(face)%edges)
               associate (nodes => draft%faces(face)%edges(i)%nodes)
                  new(nodes(:count(nodes > 0))) = .true.
               end associate
            end do
            faces(size(faces))%nodes = pack([(i, i=1, size(new))], new .and. .not. known)
            known = known .or. new
         end do
      end do
   end function gather_supported_faces

   !> Smallest and largest coordinate of the mesh
   pure function range_text(mesh, axis) result(text)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> 1 for r, 2 for z
      integer, intent(in) :: axis
      !> Such as "0 to 2"
      character(len=:), allocatable :: text

      text = to_text(minval(mesh%coordinates(axis, :)))//' to '//to_text(maxval(mesh%coordinates(axis, :)))
   end function range_text

end module axijoint_deck_request_requests
