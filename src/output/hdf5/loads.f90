!> Loads and springs in the HDF5 file: what figures of the mesh need
module axijoint_output_hdf5_loads
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type
   use axijoint_output_file_hdf5, only : hdf5_file_type
   implicit none
   private
   public :: write_load_group, write_restraint_group, write_spring_group

contains

   !> Load cases with their factors in this combination, and their loads
   subroutine write_load_group(file, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=:), allocatable :: names
      integer :: k

      names = ""
      do k = 1, size(model%load_cases)
         if (k > 1) names = names//new_line("a")
         names = names//trim(model%load_cases(k)%name)
      end do
      call file%group("/loads")
      call file%attribute("/loads", "case_names", names)
      call file%write("/loads/case_label", (model%load_cases%label), &
         "Number of the load case; (case)")
      call file%write("/loads/case_factor", case_factor(model, results%combination), &
         "Its factor in this combination; (case)")
      call write_edge_loads(file, model)
      call write_ring_loads(file, model)
      call write_body_loads(file, model)
      call write_prescribed(file, model)
   end subroutine write_load_group

   !> Factors of the load cases in a combination
   pure function case_factor(model, combination) result(factor)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of the combination; 0 if there is one only
      integer, intent(in) :: combination
      !> Factors, shape (cases)
      real(wp), allocatable :: factor(:)

      integer :: k

      do k = 1, size(model%combinations)
         factor = model%combinations(k)%factor
         if (model%combinations(k)%label == combination) return
      end do
   end function case_factor

   !> Tractions on edges, each mode of each load by itself
   subroutine write_edge_loads(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      associate (loads => model%edge_loads, n => size(model%edge_loads))
         call write_tags(file, "/loads/edge", (loads%mode), (loads%case))
         call file%write("/loads/edge/nodes", reshape([(loads(i)%nodes, i=1, n)], [3, n]), &
            "First, last and middle node of the edge, 0 if it has none; (3, load)")
         call file%write("/loads/edge/traction", &
            reshape([(loads(i)%traction, i=1, n)], [3, 3, n]), &
            "Amplitudes of t_r, t_z, t_theta at these nodes; (3, node of the edge, load) [stress]")
      end associate
   end subroutine write_edge_loads

   !> Loads on nodal circles
   subroutine write_ring_loads(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      associate (loads => model%ring_loads, n => size(model%ring_loads))
         call write_tags(file, "/loads/ring", (loads%mode), (loads%case))
         call file%write("/loads/ring/node", (loads%node), "Node; (load)")
         call file%write("/loads/ring/force", reshape([(loads(i)%force, i=1, n)], [3, n]), &
            "Work over the circle on unit amplitudes of u, v, w; (3, load) [force]")
      end associate
   end subroutine write_ring_loads

   !> Forces on the mass
   subroutine write_body_loads(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      associate (loads => model%body_loads, n => size(model%body_loads))
         call write_tags(file, "/loads/body", (loads%mode), (loads%case))
         call file%write("/loads/body/acceleration", &
            reshape([(loads(i)%acceleration, i=1, n)], [3, n]), &
            "Amplitudes along r, z, theta; (3, load) [length/time^2]")
         call file%write("/loads/body/spin_squared", (loads%spin_squared), &
            "Square of the angular velocity; (load) [1/time^2]")
      end associate
   end subroutine write_body_loads

   !> Given displacements
   subroutine write_prescribed(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      associate (moves => model%prescribed)
         call write_tags(file, "/loads/prescribed", (moves%mode), (moves%case))
         call file%write("/loads/prescribed/node", (moves%node), "Node; (load)")
         call file%write("/loads/prescribed/component", (moves%component), "1 u, 2 v, 3 w; (load)")
         call file%write("/loads/prescribed/value", (moves%value), "Amplitude; (load) [length]")
      end associate
   end subroutine write_prescribed

   !> Group of one kind of load, with the mode and the load case of each
   subroutine write_tags(file, group, modes, cases)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> Its group
      character(len=*), intent(in) :: group
      !> Harmonic and family of each load
      type(mode_type), intent(in) :: modes(:)
      !> Load case (index) of each load
      integer, contiguous, intent(in) :: cases(:)

      call file%group(group)
      call file%write(group//"/harmonic", (modes%harmonic), "Harmonic m; (load)")
      call file%write(group//"/family", (modes%family), "1 symmetric, 2 antisymmetric; (load)")
      call file%write(group//"/case", cases, "Load case (index); (load)")
   end subroutine write_tags

   !> Springs to the ground
   subroutine write_spring_group(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      call file%group("/springs")
      associate (springs => model%edge_supports, n => size(model%edge_supports))
         call file%write("/springs/nodes", reshape([(springs(i)%nodes, i=1, n)], [3, n]), &
            "First, last and middle node of the edge, 0 if it has none; (3, spring)")
         call file%write("/springs/stiffness", reshape([(springs(i)%stiffness, i=1, n)], [3, n]), &
            "Normal to the edge, along it, along theta; (3, spring) [stress/length]")
      end associate
   end subroutine write_spring_group

   !> Restraints that hold in some modes only; no group if there are none
   subroutine write_restraint_group(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      integer, allocatable :: held(:, :, :)
      integer :: k

      if (.not. allocated(model%restraints)) return
      if (size(model%restraints) == 0) return
      allocate (held(3, n_nodes(model%mesh), size(model%restraints)))
      call file%group("/restraints")
      associate (restraints => model%restraints)
         do k = 1, size(restraints)
            held(:, :, k) = merge(1, 0, restraints(k)%held)
         end do
         call file%write("/restraints/first", (restraints%first), "First harmonic; (restraint)")
         call file%write("/restraints/last", (restraints%last), "Last harmonic; (restraint)")
         call file%write("/restraints/family", (restraints%family), &
            "1 symmetric, 2 antisymmetric, 0 both; (restraint)")
         call file%write("/restraints/held", held, "1 where u, v, w is held; (3, node, restraint)")
      end associate
   end subroutine write_restraint_group

end module axijoint_output_hdf5_loads
