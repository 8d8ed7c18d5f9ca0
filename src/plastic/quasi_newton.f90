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
      !> those; products of the first two
      real(wp), allocatable :: du(:, :), df(:, :), dz(:, :), work(:)
      !> Columns of the steps, the latest first
      integer, allocatable :: column(:)
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
         memory%work(depth), memory%column(depth))
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
         associate (c => memory%column(i))
            share(i) = dot_product(memory%du(:, c), left)/memory%work(c)
            left = left - share(i)*memory%df(:, c)
            direction = direction - share(i)*memory%dz(:, c)
         end associate
      end do
      if (memory%n > 0) then  ! as soft as the last step
         associate (c => memory%column(1))
            direction = direction*memory%work(c)/dot_product(memory%df(:, c), memory%dz(:, c))
         end associate
      end if
      do i = memory%n, 1, -1
         associate (c => memory%column(i))
            direction = direction + memory%du(:, c) &
               *(share(i) - dot_product(memory%df(:, c), direction)/memory%work(c))
         end associate
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
      associate (n => memory%n, column => memory%column)
         if (n < size(column)) then
            n = n + 1
            column(n) = n
         end if
         column(:n) = cshift(column(:n), -1)  ! the oldest makes room
         memory%du(:, column(1)) = du
         memory%df(:, column(1)) = df
         memory%dz(:, column(1)) = dz
         memory%work(column(1)) = work
      end associate
   end subroutine learn

end module axijoint_plastic_quasi_newton
