!> Energy in joints, and what sliding in them dissipates
module axijoint_analysis_core_joint_work
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_force, only : joint_jump
   use axijoint_assembly_unit_loads, only : in_situ_joint_stress
   use axijoint_base_kinds, only : wp, pi
   use axijoint_element_joint_law, only : joint_law_type, state_open, eta
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_joints_field, only : joint_field_type, new_joint_field, set_initial_stress
   use axijoint_joints_planes, only : planes_type
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_joint_points, only : model_joint_point_type, law_at
   use axijoint_model_model, only : model_type, can_yield_at
   implicit none
   private
   public :: joint_energy, in_situ_shift, sliding_work

contains

   !> Energy in the springs of all joints: of those that can yield on the planes, of others harmonic
   !> by harmonic. Relative displacements d count from the state in situ, whose stress t0 is there
   !> without them: the energy is (t^2 - t0^2)/2k. The initial stress of a law loads nothing: what
   !> balances it outside of the model takes its work on d
   function joint_energy(model, structure, state, displacement) result(energy)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> State of the joints that can yield
      type(increment_state_type), intent(in) :: state
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The energy [force length]
      real(wp) :: energy

      type(model_joint_point_type), allocatable :: elastic(:)
      real(wp), allocatable :: jump(:, :), in_situ(:, :), balanced(:, :)
      type(joint_field_type) :: before
      type(joint_law_type) :: law
      real(wp), allocatable :: weight(:)
      integer :: i, j, k

      energy = 0.0_wp
      elastic = pack(structure%joint_points, &
                     .not. can_yield_at(model, structure%joint_points%material))
      in_situ = in_situ_joint_stress(model, elastic, state%case_factor)
      do i = 1, size(structure%modes)
         jump = joint_jump(elastic, displacement(:, :, i))
         do k = 1, size(elastic)
            energy = energy + 0.5_wp*circle_integral(structure%modes(i)%harmonic) &
               *elastic(k)%weight*sum(elastic(k)%base*jump(:, k)**2)
            if (same_mode(structure%modes(i), mode_type())) &
               energy = energy + circle_integral(0)*elastic(k)%weight*sum(in_situ(:, k)*jump(:, k))
         end do
      end do
      if (.not. allocated(state%stress)) return
      before = new_joint_field(size(structure%condensed%points), 1, size(structure%modes), 0)
      call set_initial_stress(model, structure%condensed%points, state%case_factor, before)
      balanced = before%initial - before%in_situ
      weight = circle_weights(structure%planes)
      do j = 1, size(weight)
         do k = 1, size(structure%condensed%points)
            associate (point => structure%condensed%points(k))
               law = law_at(point, model%joint_materials(point%material))
               energy = energy + weight(j)*point%weight &
                  *(0.5_wp*sum((state%stress(:, k, j)**2 - before%initial(:, k)**2)/law%stiffness, &
                               law%stiffness > 0.0_wp) - sum(balanced(:, k)*state%jump(:, k, j)))
            end associate
         end do
      end do
   end function joint_energy

   !> What energy of joints is gained by no work where stress in situ is new while joints are strained: that changes nothing but
   !> where their stress counts from
   function in_situ_shift(model, structure, before, now, displacement) result(energy)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Both states; the first has no stress if nothing has happened before
      type(increment_state_type), intent(in) :: before, now
      !> Displacement amplitudes of the first, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The energy [force length]
      real(wp) :: energy

      type(model_joint_point_type), allocatable :: elastic(:)
      real(wp), allocatable :: jump(:, :), gained(:, :), weight(:)
      type(joint_field_type) :: first
      integer :: i, j, k

      energy = 0.0_wp
      if (size(model%initial_stresses) == 0 .or. .not. allocated(before%case_factor)) return
      elastic = pack(structure%joint_points, .not. can_yield_at(model, structure%joint_points%material))
      gained = in_situ_joint_stress(model, elastic, now%case_factor - before%case_factor)
      do i = 1, size(structure%modes)
         if (.not. same_mode(structure%modes(i), mode_type())) cycle
         jump = joint_jump(elastic, displacement(:, :, i))
         do k = 1, size(elastic)
            energy = energy + circle_integral(0)*elastic(k)%weight*sum(gained(:, k)*jump(:, k))
         end do
      end do
      if (.not. allocated(before%stress)) return
      gained = new_in_situ(model, structure, before, now)
      first = new_joint_field(size(structure%condensed%points), 1, size(structure%modes), 0)
      call set_initial_stress(model, structure%condensed%points, before%case_factor, first)
      weight = circle_weights(structure%planes)
      do j = 1, size(weight)
         do k = 1, size(structure%condensed%points)
            associate (point => structure%condensed%points(k))
               associate (law => law_at(point, model%joint_materials(point%material)))
                  energy = energy + weight(j)*point%weight*sum(gained(:, k)*(before%stress(:, k, j) - first%initial(:, k)) &
                     /law%stiffness, law%stiffness > 0.0_wp)
               end associate
            end associate
         end do
      end do
   end function in_situ_shift

   !> Work that shear stress has done on slip from one state to the next, by the mean of both
   !> stresses: exact if friction does not change in between; by the second one where the first pointed
   !> against the slip, which began after that had turned. Slip is the relative displacement less what
   !> the springs take; of points that open none counts. What slip lifts by dilation is lifted against the
   !> normal stress, which takes of that work. Stress in situ is there before anything moves
   function sliding_work(model, structure, before, now) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Both states; the first has no stress if nothing has happened before
      type(increment_state_type), intent(in) :: before, now
      !> The work [force length]
      real(wp) :: work

      integer, parameter :: shear(2) = [1, 3]
      !> Stress before, over that after, whose direction is rounding
      real(wp), parameter :: none = 1.0e-9_wp
      real(wp), allocatable :: weight(:), in_situ(:, :)
      real(wp) :: stress(2), start(2), slip(2)
      integer :: j, k

      work = 0.0_wp
      if (.not. allocated(now%stress)) return
      weight = circle_weights(structure%planes)
      in_situ = new_in_situ(model, structure, before, now)
      do j = 1, size(weight)
         do k = 1, size(structure%condensed%points)
            if (now%state(k, j) == state_open) cycle
            stress = now%stress(shear, k, j)
            start = in_situ(shear, k)
            slip = now%jump(shear, k, j)
            if (allocated(before%stress)) then
               start = start + before%stress(shear, k, j)
               slip = slip - before%jump(shear, k, j)
            end if
            associate (point => structure%condensed%points(k))
               associate (law => law_at(point, model%joint_materials(point%material)))
                  where (law%stiffness(shear) > 0.0_wp)
                     slip = slip - (stress - start)/law%stiffness(shear)
                  elsewhere
                     slip = 0.0_wp
                  end where
                  if (law%dilation > 0.0_wp) work = work + weight(j)*point%weight*lifting_work(law, k, j)
               end associate
               if (dot_product(start, slip) < -none*norm2(stress)*norm2(slip)) start = stress
               work = work + weight(j)*point%weight*dot_product(0.5_wp*(start + stress), slip)
            end associate
         end do
      end do

   contains

      !> Work of the normal stress on what slip has lifted, negative, per area; none where the joint stood open before
      real(wp) function lifting_work(law, k, j) result(work)
         !> Properties of the joint
         type(joint_law_type), intent(in) :: law
         !> Point and plane
         integer, intent(in) :: k, j

         real(wp) :: first, lifted

         work = 0.0_wp
         first = in_situ(eta, k)
         lifted = now%jump(eta, k, j)
         if (allocated(before%stress)) then
            if (before%state(k, j) == state_open) return
            first = first + before%stress(eta, k, j)
            lifted = lifted - before%jump(eta, k, j)
         else
            if (law%gap > 0.0_wp) return
            first = first + law%initial_stress
         end if
         lifted = lifted - (now%stress(eta, k, j) - first)/law%stiffness(eta)
         work = 0.5_wp*(first + now%stress(eta, k, j))*lifted
      end function lifting_work

   end function sliding_work

   !> Stress in situ of the joints that can yield, that is new from one state to the next
   function new_in_situ(model, structure, before, now) result(stress)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure
      type(structure_type), intent(in) :: structure
      !> Both states; the first has no stress if nothing has happened before
      type(increment_state_type), intent(in) :: before, now
      !> Shape (3, points)
      real(wp), allocatable :: stress(:, :)

      associate (points => structure%condensed%points)
         stress = in_situ_joint_stress(model, points, now%case_factor)
         if (allocated(before%stress)) &
            stress = stress - in_situ_joint_stress(model, points, before%case_factor)
      end associate
   end function new_in_situ

   !> Weights of the planes in an integral over the circle: trapezium rule
   pure function circle_weights(planes) result(weight)
      !> All planes
      type(planes_type), intent(in) :: planes
      !> One a plane; their sum is 2 pi
      real(wp), allocatable :: weight(:)

      integer :: n

      n = size(planes%angle)
      allocate (weight(n), source=2.0_wp*pi/max(1, n))
      if (n < 2) return
      if (planes%angle(n) < pi*(1.0_wp - 1.0e-6_wp) .or. n > planes%n) return
      weight = 2.0_wp*pi/(n - 1)  ! from 0 to pi, which stands for the other half
      weight([1, n]) = 0.5_wp*weight([1, n])
   end function circle_weights

end module axijoint_analysis_core_joint_work
