!> Colours of cliques, so that those of one colour share no node
module axijoint_order_coloring
   use axijoint_base_kinds, only : i8
   implicit none
   private
   public :: color_cliques

contains

   !> Colour each clique with the first colour that none of its nodes has seen.
   !> Work on the cliques of one colour may go on in parallel, and the colours,
   !> one after the other, always give the same sums.
   pure subroutine color_cliques(n, clique_start, member, color_start, colored)
      !> Number of nodes
      integer, intent(in) :: n
      !> First member of each clique in `member`, shape (cliques + 1)
      integer, intent(in) :: clique_start(:)
      !> Nodes of the cliques; none lies in more than 60 cliques
      integer, intent(in) :: member(:)
      !> First clique of each colour in `colored`, shape (colours + 1)
      integer, allocatable, intent(out) :: color_start(:)
      !> Cliques, colour by colour
      integer, allocatable, intent(out) :: colored(:)

      integer(i8) :: seen(n), free
      integer :: color(size(clique_start) - 1), clique, k, count

      seen = 0_i8
      do clique = 1, size(color)
         associate (nodes => member(clique_start(clique):clique_start(clique + 1) - 1))
            free = not(iany(seen(nodes)))
            color(clique) = trailz(free)
            seen(nodes) = ibset(seen(nodes), color(clique))
         end associate
      end do
      allocate (color_start(maxval([-1, color]) + 2), colored(size(color)))
      count = 0
      do k = 1, size(color_start) - 1
         color_start(k) = count + 1
         do clique = 1, size(color)
            if (color(clique) /= k - 1) cycle
            count = count + 1
            colored(count) = clique
         end do
      end do
      color_start(size(color_start)) = count + 1
   end subroutine color_cliques

end module axijoint_order_coloring
