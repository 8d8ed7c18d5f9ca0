!> Directions in the space of some load cases, spread evenly
module axijoint_study_directions
   use axijoint_base_kinds, only : wp, pi
   use axijoint_study_draw, only : generator_type, new_generator, next_uniform, quantile, &
      distribution_normal
   implicit none
   private
   public :: spread_directions

contains

   !> Unit vectors: of one case to and fro; of two cases at equal angles, the first along the first case; of three on a
   !> spiral round the sphere (Swinbank and Purser, Q. J. R. Meteorol. Soc. 132, 2006); of more
   !> drawn
   function spread_directions(positive, n) result(directions)
      !> Whether a case acts with positive factors alone, shape (cases)
      logical, intent(in) :: positive(:)
      !> How many; of one case there are two, or one, at most
      integer, intent(in) :: n
      !> Shape (cases, n)
      real(wp), allocatable :: directions(:, :)

      type(generator_type) :: generator
      real(wp) :: from, to, angle, height, share
      integer :: i, k

      if (size(positive) == 1) then
         directions = reshape([1.0_wp, -1.0_wp], [1, min(n, merge(1, 2, positive(1)))])
         return
      end if
      allocate (directions(size(positive), n))
      select case (size(positive))
      case (2)
         from = merge(-0.5_wp*pi, 0.0_wp, positive(1) .and. .not. positive(2))
         to = from + merge(2.0_wp, merge(0.5_wp, 1.0_wp, all(positive)), .not. any(positive))*pi
         do i = 1, n
            ! both ends of an arc are there; a circle has none
            angle = from + (to - from)*(i - 1)/max(1, merge(n - 1, n, any(positive)))
            directions(:, i) = [cos(angle), sin(angle)]
         end do
         where (abs(directions) < epsilon(1.0_wp)) directions = 0.0_wp
      case (3)
         do i = 1, n
            height = 1.0_wp - (2.0_wp*i - 1.0_wp)/n
            angle = pi*(3.0_wp - sqrt(5.0_wp))*(i - 1)
            directions(:, i) = [sqrt(1.0_wp - height**2)*[cos(angle), sin(angle)], height]
         end do
      case default
         generator = new_generator(1, size(positive))
         do i = 1, n
            do k = 1, size(positive)
               call next_uniform(generator, share)
               directions(k, i) = quantile(distribution_normal, [0.0_wp, 1.0_wp], share)
            end do
            directions(:, i) = directions(:, i)/norm2(directions(:, i))
         end do
      end select
      do k = 1, size(positive)
         if (positive(k)) directions(k, :) = abs(directions(k, :))
      end do
   end function spread_directions

end module axijoint_study_directions
