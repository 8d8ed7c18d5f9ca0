!> The structure as its joints see it, condensed to the joint points: what it does under joint
!> stress that is not admitted, how its parts move where nothing else holds them, how forces on them
!> are measured. Built once; nothing changes it afterwards, so that many states, and many processes,
!> can share it
module axijoint_joints_condensed
   use axijoint_assembly_dofs, only : forces_between
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
      release_factor, &
                                         report_failure
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_stop, only : stop_wished, check_stop
   use axijoint_base_team, only : team_type
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_floating, only : floating_motion_type, new_floating_motions
   use axijoint_joints_pairs, only : pairs_type, new_pairs, flexibility_of_point
   use axijoint_joints_residual, only : measure_type, new_measure
   use axijoint_linalg_symmetric_half, only : symmetric_half_type, new_half
   use axijoint_model_joint_points, only : model_joint_point_type, stiffness_ratio
   use axijoint_model_model, only : model_type, can_yield_at
   implicit none
   private
   public :: condensed_type, flexibility_type, new_condensed, rank_of

   !> Numbers of all flexibilities below which every rank has all of them and multiplies by itself:
   !> that takes less time than to tell each other the products (some 0.05 ms)
   real(wp), parameter :: worth_sharing = 5.0e5_wp

   !> Flexibility of one harmonic
   type :: flexibility_type
      !> Displacements of side 4-3 of the joints against side 1-2 by unit amplitudes of forces between them, symmetric, for all
      !> pairs of nodes along r, z, theta, one row for each pair and component. With the shape functions N of the points it is their
      !> F_m = N K_m^-1 N^T w c_m
      type(symmetric_half_type), allocatable :: matrix
   end type flexibility_type

   !> The condensed structure
   type :: condensed_type
      !> Points that can yield
      type(model_joint_point_type), allocatable :: points(:)
      !> Pairs of nodes that the jumps of these are interpolated between
      type(pairs_type) :: pairs
      !> Modes of the job, and the system of equations of each
      type(mode_type), allocatable :: modes(:)
      integer, allocatable :: system(:)
      !> Flexibilities, one a system; allocated are all if they are small, else those of this rank
      type(flexibility_type), allocatable :: flexibilities(:)
      !> Jumps of each point from its own excess stress, of all systems, shape (components,
      !> components, points, systems)
      real(wp), allocatable :: own(:, :, :, :)
      !> Processes that share the systems; last system and last mode of each, shape (0:ranks)
      class(team_type), allocatable :: team
      integer, allocatable :: last_system(:), last_mode(:)
      !> Whether products with flexibilities are shared among ranks
      logical :: shared = .false.
      !> Rigid motions that only these points resist
      type(floating_motion_type), allocatable :: floating(:)
      !> How stress at the points acts on the parts
      type(measure_type) :: measure
      !> Stiffness of the joints in proportion to the bodies, k h/E
      real(wp) :: proportion = 0.0_wp
   end type condensed_type

contains

   !> Condense a structure
   subroutine new_condensed(model, joint_points, supports, equations, condensed, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints, and of springs
      type(model_joint_point_type), intent(in) :: joint_points(:)
      type(support_point_type), intent(in) :: supports(:)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> The condensed structure
      type(condensed_type), intent(out) :: condensed
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      logical :: yields(size(joint_points))

      yields = can_yield_at(model, joint_points%material)
      condensed%points = pack(joint_points, yields)
      condensed%pairs = new_pairs(condensed%points)
      condensed%modes = equations%modes
      condensed%system = equations%system
      allocate (condensed%team, source=equations%team)
      condensed%last_system = equations%last_system
      condensed%last_mode = equations%last_mode
      condensed%proportion = stiffness_ratio(condensed%points)
      call new_floating_motions(model, pack(joint_points, .not. yields), supports, &
         condensed%modes, condensed%points, &
                                condensed%floating)
      call new_measure(model%mesh, equations, condensed%points, condensed%measure)
      call condense_all(equations, condensed%pairs, condensed%flexibilities, error)
      call condensed%team%agree(error)
      if (.not. allocated(error)) call report_failure(equations, model, error)
      if (.not. allocated(error)) call share_flexibilities(condensed)
   end subroutine new_condensed

   !> Let all ranks know what each point does to itself, and all of the flexibilities if these are
   !> small
   subroutine share_flexibilities(condensed)
      !> The condensed structure
      type(condensed_type), intent(inout) :: condensed

      integer :: s, k, n

      n = 3*size(condensed%pairs%nodes, 2)
      condensed%shared = condensed%team%size > 1 &
         .and. real(n, wp)**2*size(condensed%flexibilities) > worth_sharing
      do s = 1, size(condensed%flexibilities)
         if (condensed%shared) exit
         associate (flexibility => condensed%flexibilities(s))
            if (.not. allocated(flexibility%matrix)) then
               allocate (flexibility%matrix)
               call new_half(n, flexibility%matrix)
            end if
            call condensed%team%broadcast(flexibility%matrix%values, size(flexibility%matrix%values, kind=i8), &
               rank_of(condensed, s))
         end associate
      end do
      allocate (condensed%own(3, 3, size(condensed%points), size(condensed%flexibilities)))
      do s = 1, size(condensed%flexibilities)
         if (.not. allocated(condensed%flexibilities(s)%matrix)) cycle
         do k = 1, size(condensed%points)
            condensed%own(:, :, k, s) = condensed%points(k)%weight &
               *flexibility_of_point(condensed%pairs, condensed%flexibilities(s)%matrix, k)
         end do
      end do
      call condensed%team%gather(condensed%own, size(condensed%own, kind=i8), &
                                 condensed%last_system)
   end subroutine share_flexibilities

   !> Rank that a system belongs to
   pure integer function rank_of(condensed, system)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Place of the system
      integer, intent(in) :: system

      rank_of = count(condensed%last_system < system) - 1
   end function rank_of

   !> Condense every harmonic of this rank to the pairs of nodes of the joints
   subroutine condense_all(equations, pairs, flexibilities, error)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> The pairs
      type(pairs_type), intent(in) :: pairs
      !> Their flexibilities
      type(flexibility_type), allocatable, intent(out) :: flexibilities(:)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: failure
      type(workspace_type), allocatable :: spaces(:)
      type(symmetric_half_type), allocatable :: rooms(:)
      integer :: s

      allocate (flexibilities(size(equations%systems)))
      call new_workspaces(equations, spaces)
      allocate (rooms(size(spaces)))
      !$omp parallel do schedule(dynamic) private(failure) num_threads(size(spaces))
      do s = equations%first, equations%last
         if (stop_wished()) cycle
         call hold_factor(equations, s, spaces(own()))
         if (equations%systems(s)%failed) cycle
         call condense(equations, s, pairs, rooms(own()), flexibilities(s)%matrix, failure)
         call release_factor(equations, s, spaces(own()))
         !$omp critical
         if (allocated(failure)) error = failure
         !$omp end critical
      end do
      !$omp end parallel do
      call check_stop(error)
   end subroutine condense_all

   !> Flexibility of one harmonic
   subroutine condense(equations, s, pairs, room, matrix, error)
      !> Equations of all modes, factored
      type(equations_type), intent(in) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Pairs of nodes
      type(pairs_type), intent(in) :: pairs
      !> Memory of this thread
      type(symmetric_half_type), intent(inout) :: room
      !> Displacements of the pairs by unit forces between them
      type(symmetric_half_type), allocatable, intent(out) :: matrix
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: equation(:, :)
      real(wp), allocatable :: factor(:, :)

      associate (dofs => equations%classes(equations%systems(s)%class)%dofs)
         if (dofs%n_equations == 0) then  ! all that the mode could do is held
            allocate (matrix)
            call new_half(3*size(pairs%nodes, 2), matrix)
            return
         end if
         call forces_between(dofs, pairs%nodes, equation, factor)
      end associate
      call equations%systems(s)%factor%flexibility(equation, factor, room, matrix, error)
      if (.not. allocated(error)) matrix%values = circle_integral(equations%systems(s)%harmonic)*matrix%values
   end subroutine condense

end module axijoint_joints_condensed
