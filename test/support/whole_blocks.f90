!> Whole matrices from blocks of two nodes, as `axijoint_element_blocks` packs them
module axijoint_test_whole_blocks
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: put_block

contains

   !> Put a block, and its transpose, into whole matrices
   pure subroutine put_block(block, i, j, a, s, c)
      !> The block, shape (2, 3, 3)
      real(wp), intent(in) :: block(:, :, :)
      !> Numbers of its nodes within the element
      integer, intent(in) :: i, j
      !> The matrices, shape (3n, 3n)
      real(wp), intent(inout) :: a(:, :), s(:, :), c(:, :)

      real(wp) :: part(3, 3)
      logical :: odd(3, 3)

      odd = .false.
      odd(3, 1:2) = .true.
      odd(1:2, 3) = .true.
      part = merge(0.0_wp, block(1, :, :), odd)
      a(3*j - 2:3*j, 3*i - 2:3*i) = part
      a(3*i - 2:3*i, 3*j - 2:3*j) = transpose(part)
      part = merge(block(1, :, :), 0.0_wp, odd)
      s(3*j - 2:3*j, 3*i - 2:3*i) = part
      s(3*i - 2:3*i, 3*j - 2:3*j) = transpose(part)
      part = block(2, :, :)
      c(3*j - 2:3*j, 3*i - 2:3*i) = part
      c(3*i - 2:3*i, 3*j - 2:3*j) = transpose(part)
   end subroutine put_block

end module axijoint_test_whole_blocks
