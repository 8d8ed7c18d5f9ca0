!> All sections that a deck may have. A section stands in a file of `deck/section`, with its fields
!> and its reader; here it is put on the list
module axijoint_deck_registry
   use axijoint_deck_job_deck, only : read_section_type, reader_type
   use axijoint_deck_section_blocks, only : blocks_section
   use axijoint_deck_section_case, only : case_section
   use axijoint_deck_section_chains, only : chains_section
   use axijoint_deck_section_combine, only : combine_section
   use axijoint_deck_section_control, only : control_section
   use axijoint_deck_section_cuts, only : cuts_section
   use axijoint_deck_section_elements, only : elements_section
   use axijoint_deck_section_error, only : error_section
   use axijoint_deck_section_faces, only : faces_section
   use axijoint_deck_section_fixed_faces, only : fixed_faces_section
   use axijoint_deck_section_frame, only : title_section, include_section, end_section
   use axijoint_deck_section_gmsh, only : gmsh_section
   use axijoint_deck_section_gravity, only : gravity_section
   use axijoint_deck_section_groups, only : groups_section
   use axijoint_deck_section_harmonics, only : harmonics_section
   use axijoint_deck_section_in_situ, only : in_situ_section
   use axijoint_deck_section_increments, only : increments_section
   use axijoint_deck_section_interfaces, only : interfaces_section
   use axijoint_deck_section_joints, only : joints_section
   use axijoint_deck_section_keep, only : keep_section
   use axijoint_deck_section_kinds, only : kinds_section
   use axijoint_deck_section_law_details, only : law_details_section
   use axijoint_deck_section_laws, only : laws_section
   use axijoint_deck_section_lines, only : lines_section
   use axijoint_deck_section_materials, only : materials_section
   use axijoint_deck_section_moved_faces, only : moved_faces_section
   use axijoint_deck_section_moved_nodes, only : moved_nodes_section
   use axijoint_deck_section_node_temps, only : node_temps_section
   use axijoint_deck_section_nodes, only : nodes_section
   use axijoint_deck_section_old_listing, only : old_listing_section
   use axijoint_deck_section_orthotropic, only : orthotropic_section
   use axijoint_deck_section_output, only : output_section
   use axijoint_deck_section_points, only : points_section
   use axijoint_deck_section_point_loads, only : point_loads_section
   use axijoint_deck_section_print, only : print_section
   use axijoint_deck_section_pressures, only : pressures_section
   use axijoint_deck_section_restraints, only : restraints_section
   use axijoint_deck_section_resultants, only : resultants_section
   use axijoint_deck_section_ring_loads, only : ring_loads_section
   use axijoint_deck_section_rotation, only : rotation_section
   use axijoint_deck_section_sections, only : sections_section
   use axijoint_deck_section_shapes, only : shapes_section
   use axijoint_deck_section_springs, only : springs_section
   use axijoint_deck_section_sweep, only : sweep_section
   use axijoint_deck_section_temperatures, only : temperatures_section
   use axijoint_deck_section_tractions, only : tractions_section
   use axijoint_deck_section_yield, only : yield_section
   use axijoint_deck_section_yield_depth, only : yield_depth_section
   use axijoint_deck_text_section, only : section_type
   implicit none
   private
   public :: all_sections, all_readers

   !> The sections and their readers, made when they are first asked for: the same for any deck
   type(section_type), allocatable, target, save :: known(:)
   type(reader_type), allocatable, target, save :: readers(:)

contains

   !> The sections: what their cards look like
   function all_sections() result(sections)
      !> The sections; not to be changed
      type(section_type), pointer :: sections(:)

      !$omp critical (axijoint_sections)
      if (.not. allocated(known)) call make_known()
      !$omp end critical (axijoint_sections)
      sections => known
   end function all_sections

   !> Their readers. Those of one stage are called in this order
   function all_readers() result(section_readers)
      !> The readers, one a section; not to be changed
      type(reader_type), pointer :: section_readers(:)

      associate (made => all_sections())
         section_readers => readers(:size(made))
      end associate
   end function all_readers

   !> Make the list
   subroutine make_known()
      integer :: n

      n = 0
      allocate (known(50), readers(50))
      call add(title_section())
      call add(control_section())
      call add(increments_section())
      call add(output_section())
      call add(materials_section())
      call add(orthotropic_section())
      call add(yield_section())
      call add(yield_depth_section())
      call add(laws_section())
      call add(law_details_section())
      call add(gmsh_section())
      call add(groups_section())
      call add(nodes_section())
      call add(lines_section())
      call add(elements_section())
      call add(blocks_section())
      call add(kinds_section())
      call add(faces_section())
      call add(chains_section())
      call add(joints_section())
      call add(interfaces_section())
      call add(harmonics_section())
      call add(shapes_section())
      call add(restraints_section())
      call add(fixed_faces_section())
      call add(case_section())
      call add(tractions_section())
      call add(pressures_section())
      call add(resultants_section())
      call add(ring_loads_section())
      call add(point_loads_section())
      call add(gravity_section())
      call add(rotation_section())
      call add(temperatures_section())
      call add(node_temps_section())
      call add(moved_nodes_section())
      call add(moved_faces_section())
      call add(in_situ_section())
      call add(springs_section())
      call add(combine_section())
      call add(sections_section())
      call add(cuts_section())
      call add(points_section())
      call add(keep_section())
      call add(print_section())
      call add(old_listing_section())
      call add(sweep_section())
      call add(error_section())
      call add(include_section())
      call add(end_section())

   contains

      !> The next section; one by one, as an array of results of functions is never given back
      subroutine add(section)
         !> The section
         type(read_section_type), intent(in) :: section

         n = n + 1
         known(n) = section%section_type
         readers(n)%stage = section%stage
         readers(n)%read => section%read
         if (.not. allocated(known(n)%fields)) allocate (known(n)%fields(0))
      end subroutine add

   end subroutine make_known

end module axijoint_deck_registry
