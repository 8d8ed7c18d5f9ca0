!> Newton's linear system point by point: where laws are much stiffer than the bodies, what the
!> modes of one point do to each other by the slopes on its planes is inverted, which leaves to the
!> Krylov method what points do to each other
module axijoint_joints_point_blocks
   use axijoint_base_kinds, only : wp
   use axijoint_joints_condensed, only : condensed_type
   use axijoint_joints_scene, only : scene_type, own_flexibility
   use axijoint_linalg_lapack, only : invert, matrix_vector
   implicit none
   private
   public :: point_blocks_type, new_point_blocks, precondition

   !> Operations from which on the threads are woken
   real(wp), parameter :: worth_threads = 1.0e6_wp

   !> Inverse of the system of one point
   type :: block_type
      !> xi, eta, theta of the first mode, of the second ..., shape (3 modes, 3 modes); not
      !> allocated if the point is left as it is
      real(wp), allocatable :: inverse(:, :)
   end type block_type

   !> The systems of all points
   type :: point_blocks_type
      private
      type(block_type), allocatable :: blocks(:)
   end type point_blocks_type

contains

   !> Invert I - A E' S f at the points that are worth it, f the flexibility of a point by itself
   subroutine new_point_blocks(condensed, scene, slope, kept, points, stiff, point_blocks)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Modes and planes
      type(scene_type), intent(in) :: scene
      !> Slopes of the excess stress on the planes, shape (3, 3, points, planes)
      real(wp), intent(in) :: slope(:, :, :, :)
      !> Share of them that acts
      real(wp), intent(in) :: kept
      !> The points, and whether each of all points is worth it
      integer, intent(in) :: points(:)
      logical, intent(in) :: stiff(:)
      !> The inverses
      type(point_blocks_type), intent(out) :: point_blocks

      real(wp) :: operations
      integer :: k, info

      operations = size(points)*real(3*size(scene%planes%meridional, 1), wp)**3
      allocate (point_blocks%blocks(size(points)))
      !$omp parallel do schedule(dynamic) private(info) if (operations > worth_threads)
      do k = 1, size(points)
         if (.not. stiff(points(k))) cycle
         point_blocks%blocks(k)%inverse = block(condensed, scene, &
            kept*slope(:, :, points(k), :), points(k))
         call invert(point_blocks%blocks(k)%inverse, info)
         if (info /= 0) deallocate (point_blocks%blocks(k)%inverse)
      end do
      !$omp end parallel do
   end subroutine new_point_blocks

   !> I - A E' S f of a point
   function block(condensed, scene, slope, k) result(matrix)
      !> The condensed structure
      type(condensed_type), intent(in) :: condensed
      !> Modes and planes
      type(scene_type), intent(in) :: scene
      !> Its slopes, shape (3, 3, planes)
      real(wp), intent(in) :: slope(:, :, :)
      !> The point
      integer, intent(in) :: k
      !> Shape (3 modes, 3 modes)
      real(wp), allocatable :: matrix(:, :)

      real(wp), dimension(size(scene%planes%meridional, 1), size(scene%planes%meridional, 1), 3, &
         3) :: coupling
      real(wp) :: f(3, 3)
      integer :: i, l, m, n, n_modes

      n_modes = size(scene%planes%meridional, 1)
      do l = 1, 3
         do i = 1, 3
            coupling(:, :, i, l) = matmul(transpose(back(i)), &
               transpose(forth(l)*spread(slope(i, l, :), 1, n_modes)))
         end do
      end do
      allocate (matrix(3*n_modes, 3*n_modes))
      do n = 1, n_modes
         f = own_flexibility(condensed, scene, n, k)
         do m = 1, n_modes
            matrix(3*m - 2:3*m, 3*n - 2:3*n) = -matmul(coupling(m, n, :, :), f)
         end do
      end do
      do i = 1, 3*n_modes
         matrix(i, i) = matrix(i, i) + 1.0_wp
      end do

   contains

      !> Modes to planes, shape (modes, planes)
      function forth(component)
         !> xi, eta or theta
         integer, intent(in) :: component
         real(wp), allocatable :: forth(:, :)

         if (component == 3) then
            forth = scene%planes%circumferential
         else
            forth = scene%planes%meridional
         end if
      end function forth

      !> Planes to modes, shape (planes, modes)
      function back(component)
         !> xi, eta or theta
         integer, intent(in) :: component
         real(wp), allocatable :: back(:, :)

         if (component == 3) then
            back = scene%planes%circumferential_back
         else
            back = scene%planes%meridional_back
         end if
      end function back

   end function block

   !> Apply the inverses to amplitudes
   subroutine precondition(point_blocks, amplitude)
      !> The inverses
      type(point_blocks_type), intent(in) :: point_blocks
      !> Shape (points, 3, modes)
      real(wp), intent(inout) :: amplitude(:, :, :)

      real(wp) :: x(3*size(amplitude, 3)), y(3*size(amplitude, 3))
      integer :: k

      do k = 1, size(point_blocks%blocks)
         if (.not. allocated(point_blocks%blocks(k)%inverse)) cycle
         x = reshape(amplitude(k, :, :), [size(x)])
         call matrix_vector(point_blocks%blocks(k)%inverse, x, y)
         amplitude(k, :, :) = reshape(y, [3, size(amplitude, 3)])
      end do
   end subroutine precondition

end module axijoint_joints_point_blocks
