!> A E' S in single precision: amplitudes of the excess stress that slopes of the laws on the planes make of amplitudes of jumps.
!> Sums over modes and planes and what is between them are found together, some planes after the other, so that values on planes
!> stay in the processor
module axijoint_joints_plane_product
   use, intrinsic :: iso_c_binding, only : c_float, c_int, c_long
   use axijoint_base_kinds, only : wp, sp
   use axijoint_joints_circle_sums, only : circle_sums_type, room_on_circle, multiply_on_circle
   use axijoint_joints_planes, only : planes_type
   implicit none
   private
   public :: plane_product_type, put_slopes, multiply_group, n_groups, points_together

   !> Points that are taken together, and planes
   integer, parameter :: points_together = 16, planes_together = 4

   !> What is multiplied, and the product
   type :: plane_product_type
      !> Sums by few operations, where there are enough modes and planes; otherwise not allocated
      type(circle_sums_type), allocatable, private :: circle
      !> Without these: values of the modes on the planes, and what goes back, shape (planes together, even and odd components,
      !> modes, groups of planes); zero beyond the last plane
      real(sp), allocatable, private, dimension(:, :, :, :) :: forth, back
      !> Slopes over the largest of them, shape (points, 3, 3, planes); zero beyond the last point
      real(sp), allocatable, private :: slope(:, :, :, :)
      !> Jumps times the largest slope, which are zero beyond the last point, and the excess stress, shape (points, 3, modes)
      real(sp), allocatable :: jump(:, :, :), excess(:, :, :)
   end type plane_product_type

   interface
      !> The product for the points that are taken together
      pure subroutine c_product(most, modes, planes, lead, forth, back, slope, jump, excess) bind(c, name="axijoint_plane_product")
         import :: c_float, c_int, c_long
         integer(c_int), value :: most, modes, planes
         integer(c_long), value :: lead
         real(c_float), intent(in) :: forth(*), back(*), slope(*), jump(*)
         real(c_float), intent(inout) :: excess(*)
      end subroutine c_product
   end interface

contains

   !> Prepare products with slopes: their numbers in single precision, and room for jumps and excess stress
   subroutine put_slopes(product, planes, slope, largest)
      !> The product, with memory of one before
      type(plane_product_type), intent(inout) :: product
      !> The planes, of components of joints
      type(planes_type), intent(in) :: planes
      !> Slopes, shape (points, 3, 3, planes)
      real(wp), intent(in) :: slope(:, :, :, :)
      !> The largest of them, but not zero
      real(wp), intent(out) :: largest

      integer :: j, n

      n = size(slope, 1)
      call make_room(product, points_together*n_groups(n), size(planes%meridional, 1), size(slope, 4))
      if (allocated(planes%circle)) then
         product%circle = planes%circle
         if (allocated(product%forth)) deallocate (product%forth, product%back)
      else
         if (allocated(product%circle)) deallocate (product%circle)
         call put_planes(product, planes)
      end if
      largest = max(tiny(1.0_wp), maxval(abs(slope)))
      do j = 1, size(slope, 4)
         product%slope(:n, :, :, j) = real(slope(:, :, :, j)/largest, sp)
         product%slope(n + 1:, :, :, j) = 0.0_sp
      end do
      product%jump(n + 1:, :, :) = 0.0_sp
   end subroutine put_slopes

   !> Room for so many points, modes and planes; that of a product before it, if it is the same
   subroutine make_room(product, lead, n_modes, n_planes)
      !> The product
      type(plane_product_type), intent(inout) :: product
      !> Points, with those that fill the last group; modes and planes
      integer, intent(in) :: lead, n_modes, n_planes

      if (allocated(product%slope)) then
         if (all([size(product%slope, 1), size(product%jump, 3), size(product%slope, 4)] == [lead, n_modes, n_planes])) return
         deallocate (product%slope, product%jump, product%excess)
      end if
      allocate (product%slope(lead, 3, 3, n_planes), product%jump(lead, 3, n_modes), product%excess(lead, 3, n_modes))
   end subroutine make_room

   !> Put the values of the modes on the planes
   pure subroutine put_planes(product, planes)
      !> The product
      type(plane_product_type), intent(inout) :: product
      !> The planes
      type(planes_type), intent(in) :: planes

      integer :: group, j, n, place

      n = (size(planes%angle) + planes_together - 1)/planes_together
      if (allocated(product%forth)) deallocate (product%forth, product%back)
      allocate (product%forth(planes_together, 2, size(planes%meridional, 1), n), source=0.0_sp)
      allocate (product%back, source=product%forth)
      do j = 1, size(planes%angle)
         group = 1 + (j - 1)/planes_together
         place = j - (group - 1)*planes_together
         product%forth(place, 1, :, group) = real(planes%meridional(:, j), sp)
         product%forth(place, 2, :, group) = real(planes%circumferential(:, j), sp)
         product%back(place, 1, :, group) = real(planes%meridional_back(j, :), sp)
         product%back(place, 2, :, group) = real(planes%circumferential_back(j, :), sp)
      end do
   end subroutine put_planes

   !> Groups of points that are taken together
   pure integer function n_groups(n)
      !> Number of points
      integer, intent(in) :: n

      n_groups = (n + points_together - 1)/points_together
   end function n_groups

   !> Excess stress of a group of points
   subroutine multiply_group(product, group, at_once)
      !> Slopes and jumps; takes the excess stress
      type(plane_product_type), intent(inout) :: product
      !> Which group
      integer, intent(in) :: group
      !> Points that are taken at once at most; as many as the processor takes if absent
      integer, intent(in), optional :: at_once

      real(sp), allocatable :: room(:)
      integer :: most, first

      most = points_together
      if (present(at_once)) most = at_once
      first = (group - 1)*points_together + 1
      associate (lead => size(product%jump, 1))
         if (allocated(product%circle)) then
            call room_on_circle(product%circle, 3, room)
            call multiply_on_circle(product%circle, lead, product%slope(first, 1, 1, 1), product%jump(first, 1, 1), &
                                    product%excess(first, 1, 1), room, most/2)
            return
         end if
         call c_product(most, size(product%jump, 3), size(product%slope, 4), int(lead, c_long), product%forth, product%back, &
                        product%slope(first, 1, 1, 1), product%jump(first, 1, 1), product%excess(first, 1, 1))
      end associate
   end subroutine multiply_group

end module axijoint_joints_plane_product
