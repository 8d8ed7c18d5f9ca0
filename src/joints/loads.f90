!> What loads do to the condensed structure
module axijoint_joints_loads
   use axijoint_assembly_equations, only : equations_type, solve_mode
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
      release_factor
   use axijoint_assembly_force, only : joint_jump
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_floating, only : floating_motion_type
   use axijoint_joints_residual, only : reference_type
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: joint_loads_type, new_joint_loads, put_loads, put_work, answer_type
   public :: case_answer_type, is_known, learn_case, put_sum

   !> Loads as the joint points see them
   type :: joint_loads_type
      !> Jumps from the loads, joints elastic, shape (components, points, modes)
      real(wp), allocatable :: free(:, :, :)
      !> Largest displacement from the loads, joints elastic, shape (modes)
      real(wp), allocatable :: largest(:)
      !> Work on the floating motions, and the largest so far of the sum of its terms taken as
      !> positive, shape (motions)
      real(wp), allocatable :: work(:), size(:)
      !> Largest joint stress so far, its components taken as positive, shape (components, points)
      real(wp), allocatable :: stress(:, :)
      !> What residual forces are held against
      type(reference_type) :: reference
   end type joint_loads_type

   !> What loads did when they were put on last: to many states of a study the same is done
   type :: answer_type
      !> Right sides, and displacements that are held, shape (3, nodes, modes)
      real(wp), allocatable :: right(:, :, :), held(:, :, :)
      !> Jumps, and largest displacements, as above
      real(wp), allocatable :: free(:, :, :), largest(:)
   end type answer_type

   !> Displacements of a mode; not allocated where nothing loads it
   type :: displacement_type
      !> Shape (3, nodes)
      real(wp), allocatable :: values(:, :)
   end type displacement_type

   !> What a load case does by itself under a factor of one, joints elastic: loads of increments are sums of such.
   !> Nothing is allocated until it is learnt
   type :: case_answer_type
      private
      !> Jumps, shape (components, points, modes), and displacements of the modes of this rank, shape (modes)
      real(wp), allocatable :: free(:, :, :)
      type(displacement_type), allocatable :: displacements(:)
   end type case_answer_type

contains

   !> No loads so far
   pure function new_joint_loads(condensed) result(loads)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The loads
      type(joint_loads_type) :: loads

      associate (n => size(condensed%points), motions => size(condensed%floating))
         allocate (loads%free(3, n, size(condensed%modes)), loads%largest(size(condensed%modes)), &
            source=0.0_wp)
         allocate (loads%work(motions), loads%size(motions), loads%stress(3, n), source=0.0_wp)
      end associate
   end function new_joint_loads

   !> Load the condensed structure
   subroutine put_loads(equations, condensed, loading, loads, answer)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> The loads on its nodes
      type(loading_type), intent(in) :: loading
      !> The loads
      type(joint_loads_type), intent(inout) :: loads
      !> The last answer to loads; becomes that to these
      type(answer_type), intent(inout), optional :: answer

      logical :: known

      known = .false.
      if (present(answer)) known = is_same(loading, answer)
      if (known) then
         loads%free = answer%free
         loads%largest = answer%largest
      else
         call put_jumps(equations, condensed%points, loading, loads)
         if (present(answer)) then
            if (equations%team%all_of(.not. any(equations%systems%failed))) &
               call remember(loading, loads, answer)
         end if
      end if
      call put_work(condensed%floating, loading%external, loads)
   end subroutine put_loads

   !> Whether it is known what a case does
   pure logical function is_known(answer)
      !> What it does
      type(case_answer_type), intent(in) :: answer

      is_known = allocated(answer%free)
   end function is_known

   !> Learn what a case does
   subroutine learn_case(equations, condensed, loading, answer)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Loads of the case under a factor of one
      type(loading_type), intent(in) :: loading
      !> What it does
      type(case_answer_type), intent(out) :: answer

      type(joint_loads_type) :: loads

      loads = new_joint_loads(condensed)
      allocate (answer%displacements(size(condensed%modes)))
      call put_jumps(equations, condensed%points, loading, loads, answer%displacements)
      call move_alloc(loads%free, answer%free)
   end subroutine learn_case

   !> Load the condensed structure by a sum of cases that are known
   subroutine put_sum(condensed, answers, loading, loads)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> What cases do; those with a factor are known
      type(case_answer_type), intent(in) :: answers(:)
      !> The loads on its nodes
      type(loading_type), intent(in) :: loading
      !> The loads
      type(joint_loads_type), intent(inout) :: loads

      real(wp), allocatable :: displacement(:, :)
      integer :: k, mode

      loads%free = 0.0_wp
      do k = 1, size(answers)
         if (abs(loading%case_factor(k)) > 0.0_wp) loads%free = loads%free + loading%case_factor(k)*answers(k)%free
      end do
      loads%largest = 0.0_wp
      allocate (displacement, mold=loading%external(:, :, 1))
      do mode = 1, size(loads%largest)
         displacement = 0.0_wp
         do k = 1, size(answers)
            if (.not. abs(loading%case_factor(k)) > 0.0_wp) cycle
            associate (own => answers(k)%displacements(mode))
               if (allocated(own%values)) displacement = displacement + loading%case_factor(k)*own%values
            end associate
         end do
         loads%largest(mode) = maxval(abs(displacement))
      end do
      call condensed%team%gather(loads%largest, size(loads%largest, kind=i8), condensed%last_mode)
      call put_work(condensed%floating, loading%external, loads)
   end subroutine put_sum

   !> Jumps from loads, joints elastic
   subroutine put_jumps(equations, points, loading, loads, displacements)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Takes the jumps
      type(joint_loads_type), intent(inout) :: loads
      !> Displacements of the modes of this rank that are loaded, shape (modes)
      type(displacement_type), intent(inout), optional :: displacements(:)

      real(wp), allocatable :: displacement(:, :)  ! threads have small stacks
      type(workspace_type), allocatable :: spaces(:)
      integer :: s, i, k

      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) private(i, k, displacement) num_threads(size(spaces))
      do s = equations%first, equations%last
         call hold_factor(equations, s, spaces(own()))
         if (equations%systems(s)%failed) cycle
         do i = 1, size(equations%systems(s)%modes)
            k = equations%systems(s)%modes(i)
            displacement = loading%right(:, :, k)
            if (any(abs(displacement) > 0.0_wp)) then  ! most harmonics of most jobs are not loaded
               call solve_mode(equations, k, loading%right(:, :, k), displacement)
            end if
            if (allocated(loading%held)) displacement = displacement + loading%held(:, :, k)
            loads%largest(k) = maxval(abs(displacement))
            loads%free(:, :, k) = 0.0_wp
            if (loads%largest(k) > 0.0_wp) loads%free(:, :, k) = joint_jump(points, displacement)
            if (present(displacements) .and. loads%largest(k) > 0.0_wp) displacements(k)%values = displacement
         end do
         call release_factor(equations, s, spaces(own()))
      end do
      !$omp end parallel do
      call equations%team%gather(loads%free, size(loads%free, kind=i8), equations%last_mode)
      call equations%team%gather(loads%largest, size(loads%largest, kind=i8), equations%last_mode)
   end subroutine put_jumps

   !> Whether an answer is that to some loads
   pure logical function is_same(loading, answer)
      !> The loads
      type(loading_type), intent(in) :: loading
      !> The answer
      type(answer_type), intent(in) :: answer

      is_same = allocated(answer%right) .and. (allocated(loading%held) .eqv. allocated(answer%held))
      if (is_same) is_same = all(shape(loading%right) == shape(answer%right))
      if (is_same) is_same = .not. any(abs(loading%right - answer%right) > 0.0_wp)
      if (is_same .and. allocated(loading%held)) &
         is_same = .not. any(abs(loading%held - answer%held) > 0.0_wp)
   end function is_same

   !> Keep an answer
   pure subroutine remember(loading, loads, answer)
      !> The loads
      type(loading_type), intent(in) :: loading
      !> What they did
      type(joint_loads_type), intent(in) :: loads
      !> The answer
      type(answer_type), intent(out) :: answer

      answer%right = loading%right
      if (allocated(loading%held)) answer%held = loading%held
      answer%free = loads%free
      answer%largest = loads%largest
   end subroutine remember

   !> Put external forces on the motions
   pure subroutine put_work(motions, external, loads)
      !> The motions
      type(floating_motion_type), intent(in) :: motions(:)
      !> Forces on components, shape (3, nodes, modes)
      real(wp), intent(in) :: external(:, :, :)
      !> The loads
      type(joint_loads_type), intent(inout) :: loads

      integer :: k

      do k = 1, size(motions)
         associate (work => external(:, :, motions(k)%mode)*motions(k)%displacement)
            loads%work(k) = sum(work)
            loads%size(k) = max(loads%size(k), sum(abs(work)))
         end associate
      end do
   end subroutine put_work

end module axijoint_joints_loads
