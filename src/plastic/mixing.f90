!> Anderson's mix of iterates u -> u + K^-1 r(u), in the energy of the elastic structure: of the
!> last iterates the mix whose residual has the least r K^-1 r. Without memory it is the classical
!> initial-stress loop
module axijoint_plastic_mixing
   use axijoint_base_kinds, only : wp
   use axijoint_linalg_lapack, only : symmetric_eigen
   implicit none
   private
   public :: mixing_type, new_mixing, mix

   !> Differences of residuals that are so much alike, as a share of the energy, are not told apart
   real(wp), parameter :: alike = 1.0e-12_wp

   !> The last iterates
   type :: mixing_type
      private
      !> Differences of iterates, residuals and responses, the latest first
      real(wp), allocatable :: du(:, :), dr(:, :), dz(:, :)
      !> The last of each
      real(wp), allocatable :: u(:), r(:), z(:)
      !> Differences in use
      integer :: n = 0
   end type mixing_type

contains

   !> Without memory yet
   pure function new_mixing(size, depth) result(memory)
      !> Number of unknowns, and iterates to remember
      integer, intent(in) :: size, depth
      !> The memory
      type(mixing_type) :: memory

      allocate (memory%du(size, depth), memory%dr(size, depth), memory%dz(size, depth))
   end function new_mixing

   !> From an iterate u, its residual r and the response z = K^-1 r to the next
   subroutine mix(memory, u, r, z)
      !> The memory
      type(mixing_type), intent(inout) :: memory
      !> Iterate, then the next
      real(wp), intent(inout) :: u(:)
      !> Residual and response
      real(wp), intent(in) :: r(:), z(:)

      real(wp), allocatable :: weight(:)
      integer :: n

      if (allocated(memory%u)) then
         memory%n = min(memory%n + 1, size(memory%du, 2))
         n = memory%n
         memory%du(:, 2:n) = memory%du(:, :n - 1)
         memory%dr(:, 2:n) = memory%dr(:, :n - 1)
         memory%dz(:, 2:n) = memory%dz(:, :n - 1)
         if (n > 0) then
            memory%du(:, 1) = u - memory%u
            memory%dr(:, 1) = r - memory%r
            memory%dz(:, 1) = z - memory%z
         end if
      end if
      memory%u = u
      memory%r = r
      memory%z = z
      u = u + z
      n = memory%n
      if (n == 0) return
      weight = least_energy(matmul(transpose(memory%dr(:, :n)), memory%dz(:, :n)), &
                            matmul(z, memory%dr(:, :n)))
      u = u - matmul(memory%du(:, :n) + memory%dz(:, :n), weight)
   end subroutine mix

   !> Weights of the differences that leave the least energy: the normal equations, without the
   !> directions that rounding fills
   function least_energy(matrix, right) result(weight)
      !> Energies of pairs of differences
      real(wp), intent(in) :: matrix(:, :)
      !> Energies of the differences with the residual
      real(wp), intent(in) :: right(:)
      !> The weights
      real(wp) :: weight(size(right))

      real(wp) :: scale(size(right)), vectors(size(right), size(right)), values(size(right)), along
      integer :: i, info

      do i = 1, size(right)
         scale(i) = 0.0_wp
         if (matrix(i, i) > tiny(1.0_wp)) scale(i) = 1.0_wp/sqrt(matrix(i, i))
      end do
      do i = 1, size(right)
         vectors(:, i) = 0.5_wp*(matrix(:, i) + matrix(i, :))*scale*scale(i)
      end do
      weight = 0.0_wp
      call symmetric_eigen(vectors, values, info)
      if (info /= 0) return
      do i = 1, size(right)
         if (.not. values(i) > alike*values(size(right))) cycle
         along = dot_product(vectors(:, i), scale*right)/values(i)
         weight = weight + along*scale*vectors(:, i)
      end do
   end function least_energy

end module axijoint_plastic_mixing
