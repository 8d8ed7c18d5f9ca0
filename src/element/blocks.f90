!> Element matrices in blocks of two nodes, free of the harmonic
!>
!> In K_m = c_m (A + m S + m^2 C) S couples w with u and v, and A and C couple w
!> with w and u, v with u, v. So two numbers an entry are enough: A and C, or S and
!> zero. Block p of an element belongs to the nodes i >= j, column by column of the
!> lower triangle; its entry (k, c, r) is number k of component c of node j in the
!> row of component r of node i.
module axijoint_element_blocks
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: n_blocks, pack_blocks

contains

   !> Number of blocks of an element
   pure integer function n_blocks(n)
      !> Number of nodes
      integer, intent(in) :: n

      n_blocks = n*(n + 1)/2
   end function n_blocks

   !> Blocks of whole matrices
   pure subroutine pack_blocks(n, a, s, c, blocks)
      !> Number of nodes
      integer, intent(in) :: n
      !> A, and S and C if there are any, shape (3n, 3n)
      real(wp), intent(in) :: a(:, :)
      real(wp), intent(in), optional :: s(:, :), c(:, :)
      !> The blocks, shape (2, 3, 3, blocks)
      real(wp), intent(out) :: blocks(:, :, :, :)

      integer :: i, j, p

      p = 0
      do j = 1, n
         do i = j, n
            p = p + 1
            blocks(1, :, :, p) = transpose(a(3*i - 2:3*i, 3*j - 2:3*j))
            blocks(2, :, :, p) = 0.0_wp
            if (.not. present(s)) cycle
            blocks(2, :, :, p) = transpose(c(3*i - 2:3*i, 3*j - 2:3*j))
            blocks(:, 3, 1:2, p) = 0.0_wp
            blocks(:, 1:2, 3, p) = 0.0_wp
            blocks(1, 3, 1:2, p) = s(3*i - 2:3*i - 1, 3*j)
            blocks(1, 1:2, 3, p) = s(3*i, 3*j - 2:3*j - 1)
         end do
      end do
   end subroutine pack_blocks

end module axijoint_element_blocks
