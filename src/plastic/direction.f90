!> Newton's direction: the tangent of the structure, (K - C) p = r, solved to a forcing term by some
!> steps of a Krylov method in the energy of the elastic structure, whose factors precondition it
module axijoint_plastic_direction
   use axijoint_base_kinds, only : wp
   use axijoint_plastic_elastic, only : stiff_force
   use axijoint_plastic_field, only : body_field_type
   use axijoint_plastic_problem, only : problem_type, iterate_type, turn, give_way
   use axijoint_plastic_residual, only : yielding_force
   implicit none
   private
   public :: newton_direction

   !> Curvature, as a share of that of the elastic structure, that counts as none: a mechanism
   real(wp), parameter :: flat = 1.0e-10_wp

contains

   !> Direction of a step
   subroutine newton_direction(problem, field, iterate, forcing, most, direction)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state, evaluated
      type(body_field_type), intent(in) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(in) :: iterate
      !> Share of the residual, in energy, that may be left, and most steps
      real(wp), intent(in) :: forcing
      integer, intent(in) :: most
      !> The direction p
      real(wp), intent(out) :: direction(:)

      if (problem%has_potential) then
         call conjugate_gradients(problem, field, iterate, forcing, most, direction)
      else
         call minimal_residuals(problem, field, iterate, forcing, most, direction)
      end if
   end subroutine newton_direction

   !> Conjugate gradients, which end where the curvature does
   subroutine conjugate_gradients(problem, field, iterate, forcing, most, direction)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state, evaluated
      type(body_field_type), intent(in) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(in) :: iterate
      !> Share of the residual, in energy, that may be left, and most steps
      real(wp), intent(in) :: forcing
      integer, intent(in) :: most
      !> The direction p
      real(wp), intent(out) :: direction(:)

      !> Residual, its response, search direction s, K s, C s
      real(wp), dimension(size(direction)) :: r, z, s, stiff, soft
      real(wp) :: energy, before, length, curvature, unused
      integer :: k

      direction = 0.0_wp
      r = iterate%residual
      z = iterate%response
      energy = dot_product(r, z)
      s = z
      stiff = r
      do k = 1, most
         call yielding_force(problem%equations, problem%bodies, problem%planes, field, s, soft)
         curvature = dot_product(s, stiff) - dot_product(s, soft)
         if (.not. curvature > flat*dot_product(s, stiff)) then
            if (k == 1) direction = z
            return
         end if
         length = energy/curvature
         direction = direction + length*s
         r = r - length*(stiff - soft)
         call turn(problem, r, z, unused)
         before = energy
         energy = dot_product(r, z)
         if (energy <= (forcing*iterate%energy)**2) return
         s = z + energy/before*s
         stiff = r + energy/before*stiff
      end do
   end subroutine conjugate_gradients

   !> Minimal residuals in the norm sqrt(r K^-1 r), for tangents that are not symmetric: each search
   !> direction s is made such that (K - C) s is at right angles to those before, in that norm
   subroutine minimal_residuals(problem, field, iterate, forcing, most, direction)
      !> The problem
      type(problem_type), intent(inout) :: problem
      !> The state, evaluated
      type(body_field_type), intent(in) :: field
      !> What it leaves out of balance
      type(iterate_type), intent(in) :: iterate
      !> Share of the residual, in energy, that may be left, and most steps
      real(wp), intent(in) :: forcing
      integer, intent(in) :: most
      !> The direction p
      real(wp), intent(out) :: direction(:)

      !> Search directions, what the tangent makes of them, and the responses to that
      real(wp), allocatable :: s(:, :), product(:, :), answer(:, :)
      !> Residual, its response, K times the search direction
      real(wp), dimension(size(direction)) :: r, z, stiff
      real(wp) :: length, along, energy, unused
      integer :: i, k, pass

      allocate (s(size(direction), most), product(size(direction), most), &
         answer(size(direction), most))
      direction = 0.0_wp
      z = iterate%response
      r = iterate%residual
      if (allocated(problem%joints)) r = stiff_force(problem%equations, z)  ! of the pile, too
      energy = dot_product(r, z)
      do k = 1, most
         s(:, k) = z
         stiff = r
         call yielding_force(problem%equations, problem%bodies, problem%planes, field, s(:, k), &
                             product(:, k))
         call give_way(problem, product(:, k))
         product(:, k) = stiff - product(:, k)
         call turn(problem, product(:, k), answer(:, k), unused)
         do pass = 1, 2  ! twice is enough
            do i = 1, k - 1
               along = dot_product(product(:, k), answer(:, i))
               s(:, k) = s(:, k) - along*s(:, i)
               product(:, k) = product(:, k) - along*product(:, i)
               answer(:, k) = answer(:, k) - along*answer(:, i)
            end do
         end do
         length = sqrt(max(0.0_wp, dot_product(product(:, k), answer(:, k))))
         if (.not. length > flat*sqrt(energy)) return
         s(:, k) = s(:, k)/length
         product(:, k) = product(:, k)/length
         answer(:, k) = answer(:, k)/length
         along = dot_product(r, answer(:, k))
         direction = direction + along*s(:, k)
         r = r - along*product(:, k)
         z = z - along*answer(:, k)
         if (dot_product(r, z) <= forcing**2*energy) return
      end do
   end subroutine minimal_residuals

end module axijoint_plastic_direction
