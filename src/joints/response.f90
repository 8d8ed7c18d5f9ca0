!> What the structure does at its joints: relative displacements from loads and
!> from joint stress that is not admitted, condensed to the joint points
module axijoint_joints_response
   use axijoint_assembly_equations, only : equations_type, solve_mode
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
                                         release_factor
   use axijoint_assembly_force, only : joint_jump
   use axijoint_assembly_loading, only : loading_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_rows, only : jump_rows
   use axijoint_linalg_lapack, only : matrix_vector
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: response_type, new_response, load_response, jumps, own_flexibility

   !> Joint points from which on products of the harmonics are worth threads
   integer, parameter :: worth_points = 64

   !> Flexibility of one harmonic
   type :: flexibility_type
      !> Jumps that unit amplitudes of excess stress give: N K_m^-1 N^T c_m w,
      !> for xi, eta, theta of point 1, 2, ..., shape (3 points, 3 points)
      real(wp), allocatable :: matrix(:, :)
   end type flexibility_type

   !> Response of the joint points, d_m = d0_m + F_m e_m
   type :: response_type
      !> Flexibilities, one a system of equations
      type(flexibility_type), allocatable :: flexibilities(:)
      !> System of each mode
      integer, allocatable :: system(:)
      !> Factor of each mode on its flexibility; allocated if some are taken from another harmonic
      real(wp), allocatable :: scale(:)
      !> Jumps from the loads, joints elastic, shape (3, points, modes)
      real(wp), allocatable :: free(:, :, :)
      !> Largest displacement from the loads, joints elastic, shape (modes)
      real(wp), allocatable :: largest(:)
   end type response_type

contains

   !> Condense every harmonic to the joint points
   subroutine new_response(equations, points, response, error)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> The response, without loads
      type(response_type), intent(out) :: response
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: failure
      type(workspace_type), allocatable :: spaces(:)
      integer :: s

      response%system = equations%system
      allocate (response%flexibilities(size(equations%systems)))
      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) private(failure) num_threads(size(spaces))
      do s = 1, size(equations%systems)
         call hold_factor(equations, s, spaces(own()))
         if (equations%systems(s)%failed) cycle
         call condense(equations, s, points, response%flexibilities(s)%matrix, failure)
         call release_factor(equations, s, spaces(own()))
         !$omp critical
         if (allocated(failure)) error = failure
         !$omp end critical
      end do
      !$omp end parallel do
   end subroutine new_response

   !> Flexibility of one harmonic
   subroutine condense(equations, s, points, matrix, error)
      !> Equations of all modes, factored
      type(equations_type), intent(in) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> N K^-1 N^T c_m w
      real(wp), allocatable, intent(out) :: matrix(:, :)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: unknowns(:), place(:, :, :)
      real(wp), allocatable :: coefficient(:, :, :), inverse(:, :), half(:, :)
      integer :: k, i, column

      associate (dofs => equations%classes(equations%systems(s)%class)%dofs)
         call jump_rows(dofs, points, unknowns, place, coefficient)
      end associate
      call equations%systems(s)%factor%inverse_block(unknowns, inverse, error)
      if (allocated(error)) return
      allocate (half(size(unknowns), 3*size(points)), matrix(3*size(points), 3*size(points)))
      do k = 1, size(points)
         do i = 1, 3
            column = 3*(k - 1) + i
            half(:, column) = combination(inverse, place(:, i, k), coefficient(:, i, k))
            half(:, column) = circle_integral(equations%systems(s)%harmonic)*points(k)%weight*half(:, column)
         end do
      end do
      half = transpose(half)
      do k = 1, size(points)
         do i = 1, 3
            column = 3*(k - 1) + i
            matrix(:, column) = combination(half, place(:, i, k), coefficient(:, i, k))
         end do
      end do
      matrix = transpose(matrix)

   contains

      !> Sum of some columns
      pure function combination(columns, place, coefficient) result(total)
         !> The columns
         real(wp), intent(in) :: columns(:, :)
         !> Which, zero for none, and their factors
         integer, intent(in) :: place(:)
         real(wp), intent(in) :: coefficient(:)
         !> The sum
         real(wp) :: total(size(columns, 1))

         integer :: l

         total = 0.0_wp
         do l = 1, size(place)
            if (place(l) > 0) total = total + coefficient(l)*columns(:, place(l))
         end do
      end function combination

   end subroutine condense

   !> Jumps from loads, joints elastic
   subroutine load_response(equations, points, loading, response)
      !> Equations of all modes, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> The loads
      type(loading_type), intent(in) :: loading
      !> The response
      type(response_type), intent(inout) :: response

      real(wp), allocatable :: displacement(:, :)  ! threads have small stacks
      type(workspace_type), allocatable :: spaces(:)
      integer :: s, i, k

      if (.not. allocated(response%free)) then
         allocate (response%free(3, size(points), size(equations%modes)))
         allocate (response%largest(size(equations%modes)))
      end if
      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) private(i, k, displacement) num_threads(size(spaces))
      do s = 1, size(equations%systems)
         call hold_factor(equations, s, spaces(own()))
         if (equations%systems(s)%failed) cycle
         do i = 1, size(equations%systems(s)%modes)
            k = equations%systems(s)%modes(i)
            displacement = loading%right(:, :, k)
            if (any(abs(displacement) > 0.0_wp)) then  ! most harmonics of most jobs are not loaded
               call solve_mode(equations, k, loading%right(:, :, k), displacement)
            end if
            if (allocated(loading%held)) displacement = displacement + loading%held(:, :, k)
            response%free(:, :, k) = joint_jump(points, displacement)
            response%largest(k) = maxval(abs(displacement))
         end do
         call release_factor(equations, s, spaces(own()))
      end do
      !$omp end parallel do
   end subroutine load_response

   !> Jumps of a point from unit amplitudes of its own excess stress
   pure function own_flexibility(response, mode, k) result(flexibility)
      !> The response
      type(response_type), intent(in) :: response
      !> Place of the mode, and the point
      integer, intent(in) :: mode, k
      !> The jumps, one column a component of stress
      real(wp) :: flexibility(3, 3)

      flexibility = response%flexibilities(response%system(mode))%matrix(3*k - 2:3*k, 3*k - 2:3*k)
   end function own_flexibility

   !> Jumps from loads and excess stress, or from the latter alone
   function jumps(response, excess, free) result(jump)
      !> The response
      type(response_type), intent(in) :: response
      !> Amplitudes of the excess stress, shape (3, points, modes)
      real(wp), intent(in), contiguous :: excess(:, :, :)
      !> Whether the loads act, too
      logical, intent(in) :: free
      !> Amplitudes of the jumps, same shape
      real(wp) :: jump(3, size(excess, 2), size(excess, 3))

      integer :: k

      !$omp parallel do schedule(static, 1) if (size(excess, 2) >= worth_points)
      do k = 1, size(excess, 3)
         call matrix_vector(response%flexibilities(response%system(k))%matrix, excess(:, :, k), &
                             jump(:, :, k))
         if (allocated(response%scale)) jump(:, :, k) = response%scale(k)*jump(:, :, k)
      end do
      !$omp end parallel do
      if (free) jump = jump + response%free
   end function jumps

end module axijoint_joints_response
