!> Loads on faces
module axijoint_deck_loads
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_text, only : to_text
   use axijoint_deck_diagnostics, only : diagnostics_type
   use axijoint_deck_draft, only : draft_type, edge_type
   use axijoint_deck_faces, only : find_face
   use axijoint_deck_source, only : source_type
   use axijoint_deck_table, only : table_type, integer_value, field_error, entry_error
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_line
   use axijoint_model_load, only : edge_load_type
   implicit none
   private
   public :: read_tractions, read_resultants, check_amplitudes

   !> Fields of TRACTIONS and RINGLOADS; RESULTANTS has a kind and a value
   integer, parameter :: field_place = 1, field_harmonic = 2, field_first = 3, field_last = 6, &
      field_kind = 2, field_value = 3
   !> The word LATERAL of RESULTANTS
   integer, parameter :: kind_lateral = 1

contains

   !> Add the edge loads of the TRACTIONS cards
   subroutine read_tractions(source, table, draft, max_harmonic, loads, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> TRACTIONS
      type(table_type), intent(in) :: table
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: max_harmonic
      !> The loads
      type(edge_load_type), allocatable, intent(inout) :: loads(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, face, errors_before

      do entry = 1, table%n
         errors_before = diagnostics%n_errors
         call find_face(source, table, entry, field_place, draft, face, diagnostics)
         call check_amplitudes(source, table, entry, max_harmonic, diagnostics)
         if (face == 0) cycle
         if (.not. draft%faces(face)%good) cycle
         call check_area(source, table, entry, draft, draft%faces(face)%edges, diagnostics)
         if (diagnostics%n_errors > errors_before .or. .not. table%good(entry)) cycle
         loads = [loads, traction_loads(table, entry, draft, draft%faces(face)%edges)]
      end do
   end subroutine read_tractions

   !> Check the harmonic and the amplitudes of a TRACTIONS or RINGLOADS card
   subroutine check_amplitudes(source, table, entry, max_harmonic, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: max_harmonic
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: harmonic, field

      if (table%good(entry) .and. .not. any(table%given(field_first:, entry))) then
         call field_error(diagnostics, source, table, entry, field_first, 'the card gives no load', &
                          allowed='at least one amplitude; blank ones are 0')
      end if
      if (.not. table%given(field_harmonic, entry)) return
      harmonic = integer_value(table, field_harmonic, entry)
      if (max_harmonic >= 0 .and. harmonic > max_harmonic) then
         call field_error(diagnostics, source, table, entry, field_harmonic, &
                          'the load''s harmonic '//to_text(harmonic)//' is above the highest, M = '// &
                          to_text(max_harmonic), allowed='0 to '//to_text(max_harmonic), &
                          mend='raise M on the CONTROL card to '//to_text(harmonic))
      end if
      do field = field_first + 2, size(table%fields), 3
         if (harmonic > 0 .or. .not. abs(table%values(field, entry)) > 0.0_wp) cycle
         call field_error(diagnostics, source, table, entry, field, &
                          'a load along theta in harmonic 0 is torsion', &
                          allowed='blank or 0: the loads are symmetric to the plane theta = 0, ' &
                          //'torsion is antisymmetric and not available')
      end do
   end subroutine check_amplitudes

   !> Check that a loaded face has an area
   subroutine check_area(source, table, entry, draft, edges, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The section
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      if (moment_of_radius(draft, edges, 1) > 0.0_wp) return
      call field_error(diagnostics, source, table, entry, field_place, &
                       'the loaded face lies on the axis: it has no area', allowed='a face with r > 0')
   end subroutine check_area

   !> Tractions that vary linearly with the arc length between the ends of a face
   pure function traction_loads(table, entry, draft, edges) result(loads)
      !> TRACTIONS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> One load for each edge
      type(edge_load_type) :: loads(size(edges))

      real(wp) :: first(3), last(3), total, from, half
      integer :: i

      first = table%values(field_first:field_first + 2, entry)
      last = merge(table%values(field_last:field_last + 2, entry), first, &
                   table%given(field_last:field_last + 2, entry))
      total = 0.0_wp
      do i = 1, size(edges)
         total = total + arc_length(draft, edges(i), 1.0_wp)
      end do
      from = 0.0_wp
      do i = 1, size(edges)
         loads(i)%mode%harmonic = integer_value(table, field_harmonic, entry)
         loads(i)%nodes = edges(i)%nodes
         half = from + arc_length(draft, edges(i), 0.0_wp)
         loads(i)%traction(:, 1) = first + from/total*(last - first)
         from = from + arc_length(draft, edges(i), 1.0_wp)
         loads(i)%traction(:, 2) = first + from/total*(last - first)
         if (edges(i)%nodes(3) > 0) loads(i)%traction(:, 3) = first + half/total*(last - first)
      end do
   end function traction_loads

   !> Length of an edge from its first node to a natural coordinate
   pure real(wp) function arc_length(draft, edge, to) result(length)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The edge
      type(edge_type), intent(in) :: edge
      !> Natural coordinate, -1 to 1
      real(wp), intent(in) :: to

      real(wp) :: x(3), w(3), shape(3), derivative(3)
      integer :: k, n

      n = count(edge%nodes > 0)
      call gauss_rule(3, x, w)
      length = 0.0_wp
      do k = 1, 3
         call shape_line(n, 0.5_wp*(1.0_wp + to)*(1.0_wp + x(k)) - 1.0_wp, shape(:n), derivative(:n))
         length = length + 0.5_wp*(1.0_wp + to)*w(k) &
                  *norm2(matmul(draft%position(:, edge%nodes(:n)), derivative(:n)))
      end do
   end function arc_length

   !> Integral of r**power ds over a face, by the rule that integrates tractions
   pure real(wp) function moment_of_radius(draft, edges, power) result(moment)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> Power of r
      integer, intent(in) :: power

      real(wp) :: x(3), w(3), shape(3), derivative(3)
      integer :: i, k, n

      call gauss_rule(3, x, w)
      moment = 0.0_wp
      do i = 1, size(edges)
         n = count(edges(i)%nodes > 0)
         associate (corners => draft%position(:, edges(i)%nodes(:n)))
            do k = 1, 3
               call shape_line(n, x(k), shape(:n), derivative(:n))
               moment = moment + w(k)*norm2(matmul(corners, derivative(:n))) &
                        *dot_product(corners(1, :), shape(:n))**power
            end do
         end associate
      end do
   end function moment_of_radius

   !> Add the edge loads of the RESULTANTS cards
   subroutine read_resultants(source, table, draft, max_harmonic, loads, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> RESULTANTS
      type(table_type), intent(in) :: table
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: max_harmonic
      !> The loads
      type(edge_load_type), allocatable, intent(inout) :: loads(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, face, errors_before

      do entry = 1, table%n
         errors_before = diagnostics%n_errors
         call find_face(source, table, entry, field_place, draft, face, diagnostics)
         if (max_harmonic == 0) then
            call entry_error(diagnostics, table, entry, &
                             'a lateral force or a moment is a load of harmonic 1, and M is 0', &
                             mend='raise M on the CONTROL card to 1 or more')
         end if
         if (face == 0) cycle
         if (.not. draft%faces(face)%good) cycle
         call check_area(source, table, entry, draft, draft%faces(face)%edges, diagnostics)
         if (diagnostics%n_errors > errors_before .or. .not. table%good(entry)) cycle
         loads = [loads, resultant_loads(table, entry, draft, draft%faces(face)%edges)]
      end do
   end subroutine read_resultants

   !> Tractions of harmonic 1 with a given resultant: for a lateral force H
   !> t_r = H/A, t_theta = -H/A; for a moment M t_z = M r/I
   pure function resultant_loads(table, entry, draft, edges) result(loads)
      !> RESULTANTS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Edges of the face
      type(edge_type), intent(in) :: edges(:)
      !> One load for each edge
      type(edge_load_type) :: loads(size(edges))

      real(wp) :: stress, area_moment
      logical :: lateral
      integer :: i, k

      lateral = integer_value(table, field_kind, entry) == kind_lateral
      area_moment = moment_of_radius(draft, edges, merge(1, 3, lateral))
      associate (value => table%values(field_value, entry))
         do i = 1, size(edges)
            loads(i)%mode%harmonic = 1
            loads(i)%nodes = edges(i)%nodes
            do k = 1, count(edges(i)%nodes > 0)
               if (lateral) then
                  stress = value/(2.0_wp*pi*area_moment)
                  loads(i)%traction(:, k) = [stress, 0.0_wp, -stress]
               else
                  stress = value*draft%position(1, edges(i)%nodes(k))/(pi*area_moment)
                  loads(i)%traction(:, k) = [0.0_wp, stress, 0.0_wp]
               end if
            end do
         end do
      end associate
   end function resultant_loads

end module axijoint_deck_loads
