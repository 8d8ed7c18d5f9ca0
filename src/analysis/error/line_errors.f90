!> Errors of the stresses along lines: what the same averages at nodes are on a mesh of elements half as large, and after what changes
!> displacements
module axijoint_analysis_error_line_errors
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_core_watched_lines, only : amplitude_on_lines
   use axijoint_analysis_core_watched_stress, only : watched_stress
   use axijoint_analysis_fine_level, only : fine_load_type, new_fine_load
   use axijoint_analysis_fine_mesh, only : prolong
   use axijoint_analysis_fine_mesh_error, only : mesh_error_type
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_solid_force, only : initial_state_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_element_kind, only : is_reduced
   use axijoint_joints_planes, only : planes_type, analyse, synthesize
   use axijoint_joints_residual, only : ratio
   use axijoint_model_locking, only : effective_ratio
   use axijoint_model_mesh, only : n_elements, n_nodes
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : line_type
   implicit none
   private
   public :: find_held_on_lines, change_on_lines, stress_beyond

   !> The error over the difference to a mesh of elements half as large: smoothed to nodes, stresses of quadratic elements fall with the
   !> square of their size, those of linear ones with their size
   real(wp), parameter :: of_quadratic = 4.0_wp/3.0_wp, of_linear = 2.0_wp
   !> Nodes of the smallest quadratic element
   integer, parameter :: quadratic = 6

contains

   !> Find what the mesh leaves of the stresses while the excess stress of the joints is held. Nothing is known of bodies
   !> that hardly change their volume in elements of the reduced rule, whose mean stress swings from point to point
   subroutine find_held_on_lines(model, structure, loading, displacement, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes, the fine level, what is watched
      type(structure_type), intent(in) :: structure
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The errors while it is held; takes those of the stresses
      type(mesh_error_type), intent(inout) :: error

      type(fine_load_type) :: load
      real(wp) :: over_difference
      integer :: k

      if (.not. allocated(structure%watched) .or. .not. allocated(error%near_lines)) return
      if (mean_stress_swings(model)) return
      load = new_fine_load(structure%fine, structure%modes, loading)
      associate (watched => structure%watched)
         over_difference = merge(of_linear, of_quadratic, any(model%mesh%element_size(watched%coarse%element) < quadratic))
         allocate (error%on_lines(6, size(watched%coarse%node), size(structure%modes)))
         !$omp parallel do schedule(dynamic)
         do k = 1, size(structure%modes)
            error%on_lines(:, :, k) = over_difference*(on_fine_mesh(k) &
               - watched_stress(model, watched%coarse, loading%initial, k, structure%modes(k), displacement(:, :, k)))
         end do
         !$omp end parallel do
      end associate

   contains

      !> Stresses on the fine mesh in one mode
      function on_fine_mesh(k) result(values)
         !> Its place
         integer, intent(in) :: k
         !> Amplitudes, shape (6, values)
         real(wp), allocatable :: values(:, :)

         real(wp), allocatable :: by_place(:, :), moved(:, :)

         associate (level => structure%fine)
            allocate (by_place(3, n_nodes(level%model%mesh)))
            call prolong(level%parents, displacement(:, :, k), by_place)
            moved = by_place(:, level%stiffness%place)
            moved(:, level%near_lines) = moved(:, level%near_lines) + error%near_lines(:, :, k)
            values = watched_stress(level%model, structure%watched%fine, load%initial, k, structure%modes(k), moved)
         end associate
      end function on_fine_mesh

   end subroutine find_held_on_lines

   !> Whether mean stresses swing from point to point
   pure logical function mean_stress_swings(model) result(swings)
      !> The job
      type(model_type), intent(in) :: model

      !> Poisson's ratio from which on they do: at 0.49 errors of up to 25 times the true ones were told, at 0.499 of 100 times
      real(wp), parameter :: least_ratio = 0.48_wp
      logical :: swinging(size(model%materials))
      integer :: e, k

      swings = .false.
      if (.not. any(is_reduced(model%mesh%kinds))) return
      swinging = [(effective_ratio(model%materials(k)) > least_ratio, k=1, size(swinging))]
      do e = 1, n_elements(model%mesh)
         swings = swings .or. (swinging(model%mesh%element_material(e)) .and. &
                               is_reduced(model%mesh%kinds(model%mesh%element_kind(e))))
      end do
   end function mean_stress_swings

   !> What a change of displacements does to the stresses
   function change_on_lines(model, structure, change) result(on_lines)
      !> The job
      type(model_type), intent(in) :: model
      !> Modes, what is watched
      type(structure_type), intent(in) :: structure
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: change(:, :, :)
      !> Amplitudes, shape (6, values, modes)
      real(wp), allocatable :: on_lines(:, :, :)

      type(initial_state_type) :: none
      integer :: k

      allocate (on_lines(6, size(structure%watched%coarse%node), size(structure%modes)))
      !$omp parallel do schedule(dynamic)
      do k = 1, size(structure%modes)
         on_lines(:, :, k) = watched_stress(model, structure%watched%coarse, none, k, structure%modes(k), change(:, :, k))
      end do
      !$omp end parallel do
   end function change_on_lines

   !> What joints carry in harmonics above M, as far as it reaches the lines: bodies have none of it. Straight from joints it fades like
   !> waves of harmonic M + 1 in a half-space; of the joints the mean counts, by how much of it arrives. Where a wall bends it makes
   !> more of it, as far as the highest harmonics up to M tell: rings that bend have stresses like 1/(m^2 - 1)
   function stress_beyond(model, structure, planes, stress, displacement) result(beyond)
      !> The job
      type(model_type), intent(in) :: model
      !> Joints that yield, what is watched
      type(structure_type), intent(in) :: structure
      !> The planes of the laws
      type(planes_type), intent(in) :: planes
      !> Stress of the joints on these, shape (3, points, planes)
      real(wp), intent(in) :: stress(:, :, :)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Shape (lines) [stress]
      real(wp) :: beyond(size(model%lines))

      !> Part of M above which harmonics are the highest
      real(wp), parameter :: highest = 0.75_wp
      real(wp), allocatable :: carried(:, :, :), along(:, :, :)
      real(wp) :: left(size(stress, 2))
      real(wp) :: share
      integer :: j, k, m

      carried = analyse(planes, stress)
      left = maxval(maxval(abs(stress - synthesize(planes, carried)), 3), 1)
      m = maxval(structure%modes%harmonic)
      along = amplitude_on_lines(structure%watched, change_on_lines(model, structure, displacement))
      do k = 1, size(beyond)
         beyond(k) = reaching(model%lines(k))
         do j = 1, size(structure%modes)
            associate (harmonic => structure%modes(j)%harmonic)
               if (harmonic <= 1 .or. real(harmonic, wp) <= highest*m) cycle
               share = ratio(maxval(along(j, :, k)), mean(maxval(abs(carried(:, :, j)), 1)))*(harmonic**2 - 1)/((m + 1)**2 - 1)
            end associate
            beyond(k) = max(beyond(k), share*mean(left))
         end do
      end do

   contains

      !> Mean over the area of the joints
      pure real(wp) function mean(values)
         !> Shape (joint points)
         real(wp), intent(in) :: values(:)

         associate (area => structure%condensed%points%weight)
            mean = sum(area*values)/sum(area)
         end associate
      end function mean

      !> What reaches a line straight from the joints
      pure real(wp) function reaching(line)
         !> The line
         type(line_type), intent(in) :: line

         !> Pairs of points that are looked at, at most
         real(wp), parameter :: most = 1.0e6_wp
         real(wp) :: faded(size(left))
         integer :: j, p, step

         reaching = 0.0_wp
         step = max(1, ceiling(real(size(line%points), wp)*size(left)/most))
         associate (points => structure%condensed%points)
            do p = 1, size(line%points), step
               do j = 1, size(left)
                  faded(j) = exp(-(m + 1)*norm2(line%points(p)%position - points(j)%position) &
                                 /max(tiny(1.0_wp), points(j)%position(1)))
               end do
               if (.not. any(faded > 0.0_wp)) cycle
               reaching = max(reaching, maxval(faded)*sum(points%weight*faded*left)/sum(points%weight*faded))
            end do
         end associate
      end function reaching

   end function stress_beyond

end module axijoint_analysis_error_line_errors
