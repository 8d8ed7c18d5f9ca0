!> Results file for programs: all arrays of a run in HDF5 (doc/results.md)
module axijoint_output_hdf5_results
   use axijoint_analysis_core_results, only : results_type, source_names
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : lower, to_text
   use axijoint_base_version, only : program_name, program_version
   use axijoint_deck_text_source, only : source_type
   use axijoint_element_joint_law, only : law_names
   use axijoint_model_model, only : model_type
   use axijoint_output_file_echo, only : deck_text
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_run, only : run_type, status_name
   use axijoint_output_hdf5_loads, only : write_load_group, write_restraint_group, &
      write_spring_group
   use axijoint_output_hdf5_sections, only : write_section_groups, write_cut_group
   use axijoint_output_table_face_reactions, only : write_support_group
   use axijoint_output_table_in_situ, only : write_in_situ_group
   use axijoint_output_table_interfaces, only : write_interface_group
   use axijoint_output_table_joint_proportion, only : write_proportion_arrays
   use axijoint_output_table_residuals, only : write_residual_arrays
   use axijoint_output_table_yielding, only : write_yield_group
   implicit none
   private
   public :: write_results

   !> Signs and components, for a reader without the manual
   character(len=*), parameter :: conventions = &
      "Components u (r), v (z), w (theta). Symmetric family: u, v ~ cos(m theta), "// &
      "w ~ sin(m theta); antisymmetric family: u, v ~ sin(m theta), w ~ -cos(m theta). "// &
      "Stresses r, z, theta, rz go with u and v, r-theta and z-theta with w; tension is "// &
      "positive. Joints: xi along side 1-2, eta from side 1-2 to side 4-3, positive opens, "// &
      "theta. Angles in radians; lengths, forces and stresses in the units of the deck. "// &
      "Index lists are in Fortran order; readers in C order see them reversed. Nodes, "// &
      "elements and joints count from 1; labels are the numbers of the deck."

contains

   !> Everything, group by group
   subroutine write_results(file, run, source, messages, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> Warnings and how the iteration ended
      character(len=*), intent(in) :: messages(:)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      call write_tags(file, run, messages, model, results)
      call file%write("/deck", deck_text(source), "Cards as read, included files in place")
      call write_mesh(file, model)
      call write_materials(file, model)
      call write_proportion_arrays(file, model)
      call write_interface_group(file, model)
      call write_load_group(file, model, results)
      call write_spring_group(file, model)
      call write_solution(file, results)
      call write_errors(file, results)
      call write_stress(file, results)
      call write_discretization(file, results)
      call write_yield_group(file, model, results)
      call write_joints(file, results)
      call write_section_groups(file, model, results)
      call write_cut_group(file, model, results)
      call write_support_group(file, model, results)
      call write_in_situ_group(file, results%in_situ)
      call write_convergence(file, model, results)
   end subroutine write_results

   !> Attributes of the whole file
   subroutine write_tags(file, run, messages, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> Warnings and how the iteration ended
      character(len=*), intent(in) :: messages(:)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      call file%attribute("/", "program", program_name)
      call file%attribute("/", "version", program_version)
      call file%attribute("/", "deck", run%deck)
      call file%attribute("/", "title", model%title)
      call file%attribute("/", "date", run%date)
      call file%attribute("/", "run", run%stamp)
      call file%attribute("/", "status", status_name(results))
      call file%attribute("/", "combination", results%combination)
      call file%attribute("/", "exit_code", run%exit_code)
      call file%attribute("/", "conventions", conventions)
      call file%write("/messages", joined(messages), "Warnings and how the iteration ended")
   end subroutine write_tags

   !> Nodes, elements, joints
   subroutine write_mesh(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      call file%group("/mesh")
      associate (mesh => model%mesh)
         call file%write("/mesh/coordinates", mesh%coordinates, "r and z; (2, node) [length]")
         call file%write("/mesh/node_label", mesh%node_label, "Number in the deck; (node)")
         call file%write("/mesh/fixed", merge(1, 0, model%fixed), &
            "1 where u, v, w is fixed in every mode; (3, node)")
         call file%write("/mesh/element_label", mesh%element_label, "Number; (element)")
         call file%write("/mesh/element_material", mesh%element_material, &
            "Index into /materials; (element)")
         call file%write("/mesh/element_body", mesh%element_body, "Body; (element)")
         call file%write("/mesh/element_size", mesh%element_size, "Number of nodes; (element)")
         call file%write("/mesh/element_nodes", mesh%element_nodes, &
            "Corners counterclockwise, mid-sides, centre, then zeros; (9, element)")
         call file%write("/mesh/joint_label", mesh%joint_label, "Number; (joint)")
         call file%write("/mesh/joint_material", mesh%joint_material, &
            "Index into /joint_materials; (joint)")
         call file%write("/mesh/joint_size", mesh%joint_size, "Number of nodes; (joint)")
         call file%write("/mesh/joint_nodes", mesh%joint_nodes, &
            "1-2 one side, 4-3 opposite, 5 and 6 mid-sides, then zeros; (6, joint)")
         call file%write("/mesh/joint_interface", mesh%joint_interface, &
            "Index into /interfaces, 0 if to none; (joint)")
         call file%write("/mesh/shared_label", mesh%shared_label, &
            "Numbers of nodes that bonded bodies share: number in node_label, further number; "// &
            "(2, further numbers)")
      end associate
      call write_restraint_group(file, model)
   end subroutine write_mesh

   !> Materials and joint laws. Parentheses make a component of an array of
   !> types contiguous, here and below.
   subroutine write_materials(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      call file%group("/materials")
      call file%write("/materials/label", (model%materials%label), "Number; (material)")
      call file%write("/materials/young", (model%materials%young), &
         "E, 0 if orthotropic; (material) [stress]")
      call file%write("/materials/poisson", (model%materials%poisson), &
         "nu, 0 if orthotropic; (material)")
      call file%write("/materials/density", (model%materials%density), "(material) [mass/volume]")
      associate (materials => model%materials, n => size(model%materials))
         call file%write("/materials/expansion", &
            reshape([(materials(i)%expansion, i=1, n)], [3, n]), &
            "Along directions 1, 2, 3; (3, material) [1/temperature]")
         call file%write("/materials/orthotropic", merge(1, 0, materials%orthotropic), &
            "1 if orthotropic; (material)")
         call file%write("/materials/moduli", reshape([(materials(i)%moduli, i=1, n)], [3, n]), &
            "E_1, E_2, E_3, 0 if isotropic; (3, material) [stress]")
         call file%write("/materials/ratios", reshape([(materials(i)%ratios, i=1, n)], [3, n]), &
            "nu_12, nu_23, nu_13, 0 if isotropic; (3, material)")
         call file%write("/materials/shears", reshape([(materials(i)%shears, i=1, n)], [3, n]), &
            "G_12, G_23, G_13, 0 if isotropic; (3, material) [stress]")
         call file%write("/materials/angle", (materials%angle), &
            "From r to direction 1; (material) [radian]")
      end associate
      call file%group("/joint_materials")
      associate (materials => model%joint_materials)
         call file%write("/joint_materials/label", (materials%label), "Number; (law)")
         call file%write("/joint_materials/rule", (materials%rule), &
            "1 centroid, 2 Gauss, 3 Lobatto; (law)")
         call file%write("/joint_materials/kind", (materials%law%kind), law_kinds()//"; (law)")
         call file%write("/joint_materials/stiffness", &
            reshape([(materials(i)%law%stiffness, i=1, size(materials))], [3, size(materials)]), &
            "k_xi, k_eta, k_theta; (3, law) [stress/length]")
         call file%write("/joint_materials/cohesion", (materials%law%cohesion), "C; (law) [stress]")
         call file%write("/joint_materials/friction", (materials%law%friction), "tan(phi); (law)")
         call file%write("/joint_materials/slip", (materials%law%slip), &
            "1 components, 2 resultant; (law)")
         call file%write("/joint_materials/opening", (materials%law%opening), &
            "1 reversible, 2 bond; (law)")
         call file%write("/joint_materials/residual_cohesion", &
            merge(materials%law%residual_cohesion, materials%law%cohesion, materials%law%softens), &
            "C once a point has slipped; (law) [stress]")
         call file%write("/joint_materials/residual_friction", &
            merge(materials%law%residual_friction, materials%law%friction, materials%law%softens), &
            "tan(phi) once a point has slipped; (law)")
         call file%write("/joint_materials/dilation", (materials%law%dilation), "tan(psi); (law)")
         call file%write("/joint_materials/gap", (materials%law%gap), &
            "Before loading; (law) [length]")
         call file%write("/joint_materials/initial_stress", (materials%law%initial_stress), &
            "Normal, before loading; (law) [stress]")
      end associate
   end subroutine write_materials

   !> Numbers of the kinds of joint laws: "0 elastic, 1 paper"
   pure function law_kinds() result(text)
      !> The text
      character(len=:), allocatable :: text

      integer :: kind

      text = ""
      do kind = lbound(law_names, 1), ubound(law_names, 1)
         text = text//", "//to_text(kind)//" "//lower(trim(law_names(kind)))
      end do
      text = text(3:)
   end function law_kinds

   !> Equations, displacements, reactions, resultants
   subroutine write_solution(file, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      call file%group("/modes")
      call file%write("/modes/harmonic", (results%modes%harmonic), "Harmonic m; (mode)")
      call file%write("/modes/family", (results%modes%family), &
         "1 symmetric, 2 antisymmetric; (mode)")
      call file%write("/displacement", results%displacement, &
         "Amplitudes u, v, w; (3, node, mode) [length]")
      call file%write("/reaction", results%reaction, "Work of the reactions over the circle "// &
         "on unit amplitudes; (3, node, mode) [force]")
      call file%group("/equations")
      associate (solves => results%solves)
         call file%write("/equations/number", (solves%n_equations), "Unknowns; (mode)")
         call file%write("/equations/factor_entries", real(solves%factor_entries, wp), &
            "Entries of the factor; (mode)")
         call file%write("/equations/smallest_pivot", (solves%smallest_pivot), &
            "Smallest ratio of a pivot to its diagonal entry; (mode)")
         call file%write("/equations/backward_error", (solves%backward_error), &
            "Backward error after one step of refinement; (mode)")
         call file%write("/equations/condition", (solves%condition), &
            "Estimate of the condition number, 1-norm; (mode)")
      end associate
      call file%group("/resultants")
      call file%write("/resultants/applied", results%applied, &
         "Axial force, lateral force, moment, torque, lateral force and moment at 90 degrees; (6)")
      call file%write("/resultants/reacted", results%reacted, "The same of the reactions; (6)")
      call file%attribute("/resultants", "equilibrium_error", results%equilibrium_error)
      call file%attribute("/resultants", "part_equilibrium_error", results%part_error)
   end subroutine write_solution

   !> Estimates of the errors
   subroutine write_errors(file, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      character(len=:), allocatable :: sources
      integer :: i

      if (.not. allocated(results%budget)) return
      associate (budget => results%budget)
         sources = trim(source_names(budget(1)%source))
         do i = 2, size(budget)
            sources = sources//', '//trim(source_names(budget(i)%source))
         end do
         call file%group("/errors")
         call file%attribute("/errors", "sources", sources)
         call file%write("/errors/energy", (budget%energy), &
            "Of the stresses in the energy norm; "// &
            "(source), relative, negative if not known")
         call file%write("/errors/displacement", (budget%displacement), &
            "Of displacements; (source), relative, negative if not known")
         call file%write("/errors/joint_stress", (budget%joint_stress), &
            "Of the largest joint stress; (source), relative, negative if not known")
         call file%write("/errors/load", (budget%load), &
            "Of loads given as functions of theta; (source), relative, negative if not known")
         if (size(results%cut_resultants, 2) > 0) then
            call file%write("/errors/cuts", (budget%cuts), &
               "Of resultants on cuts, over the largest of their kind; (source), relative, negative if not known")
            call file%write("/errors/on_cuts", reshape([(budget(i)%on_cuts, i=1, size(budget))], &
               [size(budget(1)%on_cuts, 1), size(results%cut_resultants, 2), size(budget)]), &
               "Of axial force, lateral force, moment, torque, whatever their angle, on each cut, as in /cuts; "// &
               "(4, cut, source) [force, force length], negative if not known")
         end if
         if (allocated(results%discretization%line_stress)) then
            call file%write("/errors/sections", (budget%sections), &
               "Of stresses along sections, over the largest on any; (source), relative, negative if not known")
            call file%write("/errors/on_sections", reshape([(budget(i)%on_lines, i=1, size(budget))], &
               [size(budget(1)%on_lines), size(budget)]), &
               "Of the largest of six stresses along each section, round the circle, as in /sections; "// &
               "(section, source) [stress], negative if not known")
            call file%write("/errors/section_stress", results%discretization%line_stress, &
               "Largest stress along each of them, where it is judged; (section) [stress], negative where it is nowhere")
            call file%write("/errors/section_points", results%discretization%line_points, &
               "Points of each that are judged, away from infinite stresses, and all in elements; (2, section)")
         end if
         if (size(results%point_size) == 0) return
         call file%write("/errors/points", (budget%points), &
            "Of displacements at points with names, over the largest of these; (source), relative, negative if not known")
         call file%write("/errors/at_points", reshape([(budget(i)%at_points, i=1, size(budget))], &
            [size(results%point_size), size(budget)]), &
            "Of the displacement of each point with a name, as in /history/points; "// &
            "(point, source) [length], negative if not known")
         call file%write("/errors/point_size", results%point_size, "Largest displacement of each of them; (point) [length]")
      end associate
   end subroutine write_errors

   !> Stresses of the solids
   subroutine write_stress(file, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      call file%group("/stress")
      call file%write("/stress/element", results%point_element, "Element (index); (point)")
      call file%write("/stress/position", results%point_position, "r and z; (2, point) [length]")
      call file%write("/stress/amplitude", results%stress, "Amplitudes r, z, theta, rz, "// &
         "r-theta, z-theta; (6, point, mode) [stress]")
      call file%write("/stress/nodal_node", results%nodal%node, &
         "Node (index); (value). A node on a boundary of materials has several values")
      call file%write("/stress/nodal_material", results%nodal%material, &
         "Index into /materials; (value)")
      call file%write("/stress/nodal", results%nodal%amplitude, "Amplitudes smoothed to the "// &
         "nodes, averaged within each material; (6, value, mode) [stress]")
   end subroutine write_stress

   !> What the mesh leaves of the error
   subroutine write_discretization(file, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      call file%group("/error")
      call file%group("/error/discretization")
      if (.not. allocated(results%discretization%energy)) return  ! not estimated
      associate (estimate => results%discretization)
         call file%write("/error/discretization/error_energy", estimate%error_energy, &
            "Estimated energy of the error; (mode) [force length]")
         call file%write("/error/discretization/energy", estimate%energy, &
            "Energy of the solution: solids, joints, springs; (mode) [force length]")
         call file%write("/error/discretization/relative", estimate%mode_relative, &
            "Error over solution in the energy norm; (mode)")
         call file%write("/error/discretization/element", estimate%element, &
            "Energy of the error of all modes over the energy of the whole solution; (element)")
         call file%attribute("/error/discretization", "relative", estimate%relative)
         call file%attribute("/error/discretization", "displacement", estimate%displacement)
         call file%attribute("/error/discretization", "joint_stress", estimate%joint_stress)
         call file%attribute("/error/discretization", "seconds", estimate%seconds)
      end associate
   end subroutine write_discretization

   !> Joints on the planes
   subroutine write_joints(file, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      call file%group("/joints")
      call file%write("/joints/planes", results%plane_angles, "theta; (plane) [radian]")
      call file%write("/joints/joint", results%joint_point_joint, "Joint (index); (point)")
      call file%write("/joints/position", results%joint_point_position, &
         "r and z; (2, point) [length]")
      call file%write("/joints/jump", results%joint_jump, &
         "Relative displacement xi, eta, theta; (3, point, plane) [length]")
      call file%write("/joints/stress", results%joint_stress, &
         "tau_xi, sigma, tau_theta; (3, point, plane) [stress]")
      call file%write("/joints/state", results%joint_state, &
         "0 stick, 1 slip, 2 open; (point, plane)")
   end subroutine write_joints

   !> Load increments and convergence path
   subroutine write_convergence(file, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      call file%group("/increments")
      call file%write("/increments/factor", (model%increments%factor), "Added factor; (increment)")
      call file%write("/increments/tolerance", (model%increments%tolerance), &
         "Tolerance on the residual ratio; (increment)")
      call file%write("/increments/case", (model%increments%case), &
         "Load case (index) that the factor belongs to, 0 for all; (increment)")
      call file%write("/increments/given", (merge(1, 0, model%increments%steered)), &
         "What the factor is of: 0 the load, 1 the displacement of elastic bodies; (increment)")
      call file%write("/increments/max_iterations", (model%increments%max_iterations), &
         "Most iterations; (increment)")
      call file%group("/convergence")
      associate (path => results%path)
         call file%write("/convergence/increment", (path%increment), "Increment; (step)")
         call file%write("/convergence/iteration", (path%iteration), "Iteration in it; (step)")
         call file%write("/convergence/load_factor", (path%load_factor), "Load factor; (step)")
         call file%write("/convergence/ratio", (path%ratio), "Residual ratio (Eq. 17); (step)")
         call file%write("/convergence/n_slip", (path%n_slip), "Points that slip; (step)")
         call file%write("/convergence/n_open", (path%n_open), "Points that are open; (step)")
      end associate
      call write_residual_arrays(file, results)
      call file%attribute("/convergence", "residual_ratio", results%residual_ratio)
      call file%attribute("/convergence", "tolerance", results%tolerance)
   end subroutine write_convergence

   !> Texts as lines
   pure function joined(texts) result(text)
      !> Texts, trailing blanks cut
      character(len=*), intent(in) :: texts(:)
      !> Lines
      character(len=:), allocatable :: text

      integer :: i

      text = ""
      do i = 1, size(texts)
         text = text//trim(texts(i))//new_line("a")
      end do
   end function joined

end module axijoint_output_hdf5_results
