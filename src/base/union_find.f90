!> Which pieces belong together, as they are united by twos
module axijoint_base_union_find
   implicit none
   private
   public :: unite, find_roots

contains

   !> Unite what two pieces belong to
   pure subroutine unite(root, a, b)
      !> Parent of each piece
      integer, intent(inout) :: root(:)
      !> The pieces
      integer, intent(in) :: a, b

      integer :: from, to

      from = a
      to = b
      call climb(root, from)
      call climb(root, to)
      root(from) = to
   end subroutine unite

   !> Let the parent of each piece be the one that stands for all that belong to it
   pure subroutine find_roots(root)
      !> Parent of each piece
      integer, intent(inout) :: root(:)

      integer :: k, top

      do k = 1, size(root)
         top = k
         call climb(root, top)
         root(k) = top
      end do
   end subroutine find_roots

   !> Go up to the piece that stands for all that belong to it; the way there is half as long afterwards
   pure subroutine climb(root, piece)
      !> Parent of each piece
      integer, intent(inout) :: root(:)
      !> A piece; that one on return
      integer, intent(inout) :: piece

      do while (root(piece) /= piece)
         root(piece) = root(root(piece))
         piece = root(piece)
      end do
   end subroutine climb

end module axijoint_base_union_find
