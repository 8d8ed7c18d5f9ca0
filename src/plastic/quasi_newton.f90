!> Directions of the limited-memory BFGS method: the inverse of the elastic structure, corrected by
!> what the last steps showed of the tangent. For associated flow, where there is a potential
!> (Nocedal and Wright, Numerical optimization, algorithm 7.4)
module axijoint_plastic_quasi_newton
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: curvature_type, new_curvature, quasi_newton_direction

   !> Curvature of a step, as a share of that of the elastic structure, that is not learned from
   real(wp), parameter :: flat = 1.0e-10_wp

   !> The last steps
   type :: curvature_type
      private
      !> Changes of the unknowns, of the forces that balance them, -r, and of the responses -K^-1 r to
      !> those, the latest first; products of the first two
      real(wp), allocatable :: du(:, :), df(:, :), dz(:, :), work(:)
      !> The last unknowns, residual and response
      real(wp), allocatable :: u(:), r(:), z(:)
      !> Steps in use
      integer :: n = 0
   end type curvature_type

contains

   !> Without memory yet
   pure function new_curvature(size, depth) result(memory)
      !> Number of unknowns, and steps to remember
      integer, intent(in) :: size, depth
      !> The memory
      type(curvature_type) :: memory

      allocate (memory%du(size, depth), memory%df(size, depth), memory%dz(size, depth), &
         memory%work(depth))
   end function new_curvature

   !> Direction from an iterate u with residual r and response z = K^-1 r. It takes no elastic
   !> solution: the responses to all residuals are known
   subroutine quasi_newton_direction(memory, u, r, z, direction)
      !> The memory
      type(curvature_type), intent(inout) :: memory
      !> Iterate, residual, response
      real(wp), intent(in) :: u(:), r(:), z(:)
      !> The direction; downhill, as all remembered curvatures are positive
      real(wp), intent(out) :: direction(:)

      real(wp) :: share(size(memory%work)), left(size(r))
      integer :: i

      if (allocated(memory%u)) call learn(memory, u - memory%u, memory%r - r, memory%z - z)
      memory%u = u
      memory%r = r
      memory%z = z
      left = r
      direction = z
      do i = 1, memory%n
         share(i) = dot_product(memory%du(:, i), left)/memory%work(i)
         left = left - share(i)*memory%df(:, i)
         direction = direction - share(i)*memory%dz(:, i)
      end do
      if (memory%n > 0) direction = direction*memory%work(1) &
         /dot_product(memory%df(:, 1), memory%dz(:, 1))  ! as soft as the last step
      do i = memory%n, 1, -1
         direction = direction + memory%du(:, i) &
            *(share(i) - dot_product(memory%df(:, i), direction)/memory%work(i))
      end do
   end subroutine quasi_newton_direction

   !> Remember a step, if it met resistance
   subroutine learn(memory, du, df, dz)
      !> The memory
      type(curvature_type), intent(inout) :: memory
      !> Changes of unknowns, balancing forces, and responses to those
      real(wp), intent(in) :: du(:), df(:), dz(:)

      real(wp) :: work

      work = dot_product(du, df)
      if (.not. work > flat*dot_product(df, dz)) return
      memory%n = min(memory%n + 1, size(memory%work))
      associate (n => memory%n)
         memory%du(:, 2:n) = memory%du(:, :n - 1)
         memory%df(:, 2:n) = memory%df(:, :n - 1)
         memory%dz(:, 2:n) = memory%dz(:, :n - 1)
         memory%work(2:n) = memory%work(:n - 1)
      end associate
      memory%du(:, 1) = du
      memory%df(:, 1) = df
      memory%dz(:, 1) = dz
      memory%work(1) = work
   end subroutine learn

end module axijoint_plastic_quasi_newton
