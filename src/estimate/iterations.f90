!> How many iterations joints and bodies that yield usually take, which nobody knows before
module axijoint_estimate_iterations
   use axijoint_base_kinds, only : wp
   use axijoint_model_joint_proportion, only : stiffest
   use axijoint_model_load, only : combination_type, increment_type
   use axijoint_model_model, only : model_type, bodies_yield, can_yield, &
      method_newton, method_anderson, body_transfer
   implicit none
   private
   public :: n_iterations

   !> Iterations of an increment by Newton's method: of one whose loads are axisymmetric, such as
   !> weight, which opens little, and of others; and by ANDERSON
   real(wp), parameter :: axisymmetric_newton = 3.0_wp, usual_newton = 6.0_wp, &
      usual_anderson = 15.0_wp
   !> k h/E from which on Newton's method takes more of them, and the power that they grow with
   real(wp), parameter :: stiff = 10.0_wp, growth = 0.2_wp
   !> What the loops of TOTAL and TRANSFER leave falls by a factor of e in so many iterations
   real(wp), parameter :: usual_loop = 5.0_wp
   !> Iterations of an increment of bodies that yield, by methods that learn, and by the loop
   real(wp), parameter :: usual_bodies = 40.0_wp, usual_body_loop = 400.0_wp

contains

   !> Iterations of all increments of all combinations
   pure real(wp) function n_iterations(model, each) result(n)
      !> The job
      type(model_type), intent(in) :: model
      !> Iterations of each increment; zero for what is usual
      integer, intent(in) :: each

      real(wp) :: more
      integer :: i, k

      n = 0.0_wp
      if (.not. (can_yield(model) .or. bodies_yield(model))) return
      more = 1.0_wp
      if (model%method == method_newton .and. .not. bodies_yield(model)) more = max(1.0_wp, stiffest(model)/stiff)**growth
      do k = 1, size(model%combinations)
         do i = 1, size(model%increments)
            if (each > 0) n = n + each
            if (each == 0) n = n + more*usual(model, model%combinations(k), model%increments(i))
         end do
      end do
   end function n_iterations

   !> Iterations of an increment that are usual
   pure real(wp) function usual(model, combination, increment) result(n)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of its load cases
      type(combination_type), intent(in) :: combination
      !> The increment
      type(increment_type), intent(in) :: increment

      if (bodies_yield(model)) then
         n = merge(usual_body_loop, usual_bodies, model%body_method == body_transfer)
         return
      end if
      select case (model%method)
      case (method_newton)
         n = merge(axisymmetric_newton, usual_newton, is_axisymmetric(model, &
            pushed_cases(combination, increment)))
      case (method_anderson)
         n = usual_anderson
      case default
         n = usual_loop*log(1.0_wp/min(0.5_wp, increment%tolerance))
      end select
   end function usual

   !> Load cases that change in an increment
   pure function pushed_cases(combination, increment) result(pushed)
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The increment
      type(increment_type), intent(in) :: increment
      !> Shape (cases)
      logical :: pushed(size(combination%factor))

      pushed = abs(combination%factor) > 0.0_wp
      if (allocated(increment%direction)) then
         pushed = abs(increment%direction) > 0.0_wp
      else if (increment%case > 0) then
         pushed = .false.
         pushed(increment%case) = .true.
      end if
   end function pushed_cases

   !> Whether all loads of some load cases are axisymmetric
   pure logical function is_axisymmetric(model, cases)
      !> The job
      type(model_type), intent(in) :: model
      !> Which cases, shape (cases)
      logical, intent(in) :: cases(:)

      is_axisymmetric = .not. ( &
         any(cases(model%edge_loads%case) .and. model%edge_loads%mode%harmonic > 0) &
         .or. any(cases(model%ring_loads%case) .and. model%ring_loads%mode%harmonic > 0) &
         .or. any(cases(model%body_loads%case) .and. model%body_loads%mode%harmonic > 0) &
         .or. any(cases(model%thermal_loads%case) .and. model%thermal_loads%mode%harmonic > 0) &
         .or. any(cases(model%prescribed%case) .and. model%prescribed%mode%harmonic > 0))
   end function is_axisymmetric

end module axijoint_estimate_iterations
