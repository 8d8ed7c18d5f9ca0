!> Loads on nodal circles
module axijoint_deck_ring_loads
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_diagnostics, only : diagnostics_type
   use axijoint_deck_draft, only : draft_type
   use axijoint_deck_loads, only : check_amplitudes
   use axijoint_deck_source, only : source_type
   use axijoint_deck_table, only : table_type, integer_value, field_error
   use axijoint_model_load, only : ring_load_type
   implicit none
   private
   public :: read_ring_loads

   !> Fields of RINGLOADS
   integer, parameter :: field_place = 1, field_harmonic = 2, field_first = 3

contains

   !> Read the loads on nodal circles
   subroutine read_ring_loads(source, table, draft, max_harmonic, loads, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> RINGLOADS
      type(table_type), intent(in) :: table
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Highest harmonic of the job; negative if it is not known
      integer, intent(in) :: max_harmonic
      !> The loads
      type(ring_load_type), allocatable, intent(out) :: loads(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, node, errors_before

      allocate (loads(table%n))
      do entry = 1, table%n
         errors_before = diagnostics%n_errors
         call check_amplitudes(source, table, entry, max_harmonic, diagnostics)
         if (.not. table%given(field_place, entry)) cycle
         node = find_number(draft%node_of, integer_value(table, field_place, entry))
         if (node == 0) then
            if (draft%nodes_complete) call field_error(diagnostics, source, table, entry, field_place, &
               'node '//to_text(integer_value(table, field_place, entry))//' is not defined')
         else if (table%good(entry) .and. draft%node_good(node) &
                  .and. diagnostics%n_errors == errors_before) then
            call read_ring_load(source, table, entry, node, draft%position(1, node), loads(entry), &
                                diagnostics)
         end if
      end do
   end subroutine read_ring_loads

   !> Read one load on a nodal circle
   subroutine read_ring_load(source, table, entry, node, r, load, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> RINGLOADS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> The node, and its distance from the axis
      integer, intent(in) :: node
      real(wp), intent(in) :: r
      !> The load
      type(ring_load_type), intent(out) :: load
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: component, allowed

      load%node = node
      load%mode%harmonic = integer_value(table, field_harmonic, entry)
      load%force = table%values(field_first:field_first + 2, entry)
      if (r > 0.0_wp) then
         load%force = merge(2.0_wp, 1.0_wp, load%mode%harmonic == 0)*pi*r*load%force
         return
      end if
      ! On the axis the circle is a point: the force itself is given, along z in
      ! harmonic 0 and along theta = 0 in harmonic 1; the work of the latter on the
      ! amplitudes u and w = -u of a translation is counted with u.
      if (load%mode%harmonic > 1) then
         call field_error(diagnostics, source, table, entry, field_harmonic, &
                          'a node on the axis has no load in harmonic '//to_text(load%mode%harmonic), &
                          allowed='0 (axial force in q_z) or 1 (lateral force in q_r)')
         return
      end if
      allowed = merge(2, 1, load%mode%harmonic == 0)
      do component = 1, 3
         if (component == allowed .or. .not. abs(load%force(component)) > 0.0_wp) cycle
         call field_error(diagnostics, source, table, entry, field_first - 1 + component, &
                          'a node on the axis has no such load in harmonic '//to_text(load%mode%harmonic), &
                          allowed='harmonic 0: q_z, the axial force; harmonic 1: q_r, the lateral force')
      end do
   end subroutine read_ring_load

end module axijoint_deck_ring_loads
