!> The structure as its joints see it, condensed to the joint points: what it does under joint
!> stress that is not admitted, how its parts move where nothing else holds them, how forces on them
!> are measured. Built once; nothing changes it afterwards, so that many states, and many processes,
!> can share it
module axijoint_joints_condensed
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
   use axijoint_joints_residual, only : measure_type, new_measure
   use axijoint_joints_rows, only : jump_rows
   use axijoint_linalg_lapack, only : complete
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
      !> Jumps that unit amplitudes of stress give, over the weights w of their points: N K_m^-1 N^T c_m, symmetric, for
      !> all points of component 1, 2, 3, shape (points components, points components)
      real(wp), allocatable :: matrix(:, :)
   end type flexibility_type

   !> The condensed structure
   type :: condensed_type
      !> Points that can yield
      type(model_joint_point_type), allocatable :: points(:)
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
      call condense_all(equations, condensed%points, condensed%flexibilities, error)
      call condensed%team%agree(error)
      if (.not. allocated(error)) call report_failure(equations, model, error)
      if (.not. allocated(error)) call share_flexibilities(condensed)
   end subroutine new_condensed

   !> Let all ranks know what each point does to itself, and all of the flexibilities if these are
   !> small
   subroutine share_flexibilities(condensed)
      !> The condensed structure
      type(condensed_type), intent(inout) :: condensed

      integer :: s, i, k, n

      n = 3*size(condensed%points)
      condensed%shared = condensed%team%size > 1 &
         .and. real(n, wp)**2*size(condensed%flexibilities) > worth_sharing
      do s = 1, size(condensed%flexibilities)
         if (condensed%shared) exit
         associate (flexibility => condensed%flexibilities(s))
            if (.not. allocated(flexibility%matrix)) allocate (flexibility%matrix(n, n))
            call condensed%team%broadcast(flexibility%matrix, int(n, i8)**2, rank_of(condensed, s))
         end associate
      end do
      allocate (condensed%own(3, 3, size(condensed%points), size(condensed%flexibilities)))
      do s = 1, size(condensed%flexibilities)
         if (.not. allocated(condensed%flexibilities(s)%matrix)) cycle
         do k = 1, size(condensed%points)
            associate (rows => k + [(i*size(condensed%points), i=0, 2)])
               condensed%own(:, :, k, s) = condensed%points(k)%weight*condensed%flexibilities(s)%matrix(rows, rows)
            end associate
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

   !> Condense every harmonic of this rank to the joint points
   subroutine condense_all(equations, points, flexibilities, error)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Their flexibilities
      type(flexibility_type), allocatable, intent(out) :: flexibilities(:)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: failure
      type(workspace_type), allocatable :: spaces(:)
      integer :: s

      allocate (flexibilities(size(equations%systems)))
      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) private(failure) num_threads(size(spaces))
      do s = equations%first, equations%last
         if (stop_wished()) cycle
         call hold_factor(equations, s, spaces(own()))
         if (equations%systems(s)%failed) cycle
         call condense(equations, s, points, flexibilities(s)%matrix, failure)
         call release_factor(equations, s, spaces(own()))
         !$omp critical
         if (allocated(failure)) error = failure
         !$omp end critical
      end do
      !$omp end parallel do
      call check_stop(error)
   end subroutine condense_all

   !> Flexibility of one harmonic
   subroutine condense(equations, s, points, matrix, error)
      !> Equations of all modes, factored
      type(equations_type), intent(in) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> N K^-1 N^T c_m
      real(wp), allocatable, intent(out) :: matrix(:, :)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: unknowns(:), place(:, :, :), first(:), from(:)
      real(wp), allocatable :: coefficient(:, :, :), inverse(:, :), factor(:), half(:)
      integer :: column, row, l

      associate (dofs => equations%classes(equations%systems(s)%class)%dofs)
         call jump_rows(dofs, points, unknowns, place, coefficient)
      end associate
      call equations%systems(s)%factor%inverse_block(unknowns, inverse, error)
      if (allocated(error)) return
      call by_component(place, coefficient, first, from, factor)
      allocate (half(size(unknowns)), matrix(3*size(points), 3*size(points)))
      do column = 1, size(matrix, 2)
         half = 0.0_wp
         do l = first(column), first(column + 1) - 1
            half = half + factor(l)*inverse(:, from(l))
         end do
         half = circle_integral(equations%systems(s)%harmonic)*half
         do row = column, size(matrix, 1)
            matrix(row, column) = 0.0_wp
            do l = first(row), first(row + 1) - 1
               matrix(row, column) = matrix(row, column) + factor(l)*half(from(l))
            end do
         end do
      end do
      call complete(matrix)

   contains

      !> What jumps are made of, without zeros, for all points of component 1, 2, 3
      pure subroutine by_component(place, coefficient, first, from, factor)
         !> For each jump: places among the unknowns, zero for none, and factors, shape (18, 3, points)
         integer, intent(in) :: place(:, :, :)
         real(wp), intent(in) :: coefficient(:, :, :)
         !> First entry of each jump, shape (3 points + 1); place and factor of each entry
         integer, allocatable, intent(out) :: first(:), from(:)
         real(wp), allocatable, intent(out) :: factor(:)

         integer :: i, k, l, n

         allocate (first(3*size(place, 3) + 1), from(size(place)), factor(size(place)))
         n = 0
         do i = 1, 3
            do k = 1, size(place, 3)
               first((i - 1)*size(place, 3) + k) = n + 1
               do l = 1, size(place, 1)
                  if (place(l, i, k) == 0 .or. .not. abs(coefficient(l, i, k)) > 0.0_wp) cycle
                  n = n + 1
                  from(n) = place(l, i, k)
                  factor(n) = coefficient(l, i, k)
               end do
            end do
         end do
         first(size(first)) = n + 1
      end subroutine by_component

   end subroutine condense

end module axijoint_joints_condensed
