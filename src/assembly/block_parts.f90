!> What is kept of a block of two nodes, for all harmonics: the numbers of `element/blocks` that are not zero for all
!>
!> A or S of each pair of components of K_m = c_m (A + m S + m^2 C), then C of those that A couples.
module axijoint_assembly_block_parts
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   implicit none
   private
   public :: block_size, add_block, harmonic_factors, evaluate

   !> Numbers of a block: A or S, component of the column by component of the row, nine numbers, then C of the pairs
   !> (u, u), (v, u), (u, v), (v, v), (w, w)
   integer, parameter :: block_size = 14

contains

   !> Add a block
   pure subroutine add_block(block, turned, parts)
      !> A or S, and C, by component of the column and component of the row
      real(wp), intent(in) :: block(2, 3, 3)
      !> Whether row and column change places
      logical, intent(in) :: turned
      !> The numbers that are added to
      real(wp), intent(inout) :: parts(block_size)

      integer :: i, j

      if (turned) then
         do j = 1, 3
            do i = 1, 3
               parts(3*(i - 1) + j) = parts(3*(i - 1) + j) + block(1, i, j)
            end do
         end do
         parts(11) = parts(11) + block(2, 1, 2)
         parts(12) = parts(12) + block(2, 2, 1)
      else
         do j = 1, 3
            do i = 1, 3
               parts(3*(j - 1) + i) = parts(3*(j - 1) + i) + block(1, i, j)
            end do
         end do
         parts(11) = parts(11) + block(2, 2, 1)
         parts(12) = parts(12) + block(2, 1, 2)
      end if
      parts(10) = parts(10) + block(2, 1, 1)
      parts(13) = parts(13) + block(2, 2, 2)
      parts(14) = parts(14) + block(2, 3, 3)
   end subroutine add_block

   !> Factors of A, S and C in K_m
   pure function harmonic_factors(harmonic) result(factors)
      !> Harmonic m
      integer, intent(in) :: harmonic
      !> The factors
      real(wp) :: factors(3)

      factors = circle_integral(harmonic)*[1, harmonic, harmonic**2]
   end function harmonic_factors

   !> A block of K_m from its parts
   pure subroutine evaluate(factors, parts, block)
      !> Factors of A, S and C
      real(wp), intent(in) :: factors(3)
      !> The parts
      real(wp), intent(in) :: parts(block_size)
      !> Its values, shape (component of the column, component of the row)
      real(wp), intent(out) :: block(3, 3)

      block(1, 1) = factors(1)*parts(1) + factors(3)*parts(10)
      block(2, 1) = factors(1)*parts(2) + factors(3)*parts(11)
      block(3, 1) = factors(2)*parts(3)
      block(1, 2) = factors(1)*parts(4) + factors(3)*parts(12)
      block(2, 2) = factors(1)*parts(5) + factors(3)*parts(13)
      block(3, 2) = factors(2)*parts(6)
      block(1, 3) = factors(2)*parts(7)
      block(2, 3) = factors(2)*parts(8)
      block(3, 3) = factors(1)*parts(9) + factors(3)*parts(14)
   end subroutine evaluate

end module axijoint_assembly_block_parts
