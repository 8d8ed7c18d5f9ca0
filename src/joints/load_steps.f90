!> Loads of a job at the ends of its increments
module axijoint_joints_load_steps
   use axijoint_base_kinds, only : wp
   use axijoint_joints_states, only : increment_state_type
   use axijoint_model_load, only : combination_type, increment_type
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: step_type, first_step, next_step, halfway, on_the_way, loads_of_increments, final_factors

   !> Loads of a step
   type :: step_type
      !> Sum of the load factors
      real(wp) :: load_factor = 0.0_wp
      !> Factor of each load case
      real(wp), allocatable :: case_factor(:)
      !> If a displacement is given instead of the loads: what a factor of one adds to the factors of
      !> the load cases, and the share of the increment's displacement that is behind; the factors
      !> above are then what elastic bodies would need, until equilibrium says which
      real(wp), allocatable :: steered(:)
      real(wp) :: share = 0.0_wp
   end type step_type

contains

   !> No load
   pure function first_step(combination) result(step)
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The step
      type(step_type) :: step

      allocate (step%case_factor(size(combination%factor)), source=0.0_wp)
   end function first_step

   !> Loads after one more increment
   pure function next_step(step, increment, combination) result(next)
      !> Loads before
      type(step_type), intent(in) :: step
      !> The increment
      type(increment_type), intent(in) :: increment
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> Loads after it
      type(step_type) :: next

      real(wp), allocatable :: direction(:)

      next = step
      next%load_factor = step%load_factor + increment%factor
      if (allocated(increment%direction)) then
         direction = increment%direction
      else if (increment%case == 0) then
         direction = combination%factor
      else
         direction = 0.0_wp*combination%factor
         direction(increment%case) = combination%factor(increment%case)
      end if
      next%case_factor = step%case_factor + increment%factor*direction
      if (allocated(next%steered)) deallocate (next%steered)
      if (increment%steered) next%steered = direction
      next%share = 1.0_wp
   end function next_step

   !> Loads between two others of an increment
   pure function halfway(from, to) result(middle)
      !> The others
      type(step_type), intent(in) :: from, to
      !> The step
      type(step_type) :: middle

      middle = on_the_way(from, to, 0.5_wp)
   end function halfway

   !> Loads on the way from some to others
   pure function on_the_way(from, to, share) result(step)
      !> The others
      type(step_type), intent(in) :: from, to
      !> Share of the way that is behind
      real(wp), intent(in) :: share
      !> The step
      type(step_type) :: step

      step = to
      step%load_factor = from%load_factor + share*(to%load_factor - from%load_factor)
      step%case_factor = from%case_factor + share*(to%case_factor - from%case_factor)
      step%share = from%share + share*(to%share - from%share)
   end function on_the_way

   !> Loads after each increment, without states of joints
   pure function loads_of_increments(model, combination) result(states)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> One an increment
      type(increment_state_type) :: states(size(model%increments))

      type(step_type) :: step
      integer :: i

      step = first_step(combination)
      do i = 1, size(states)
         step = next_step(step, model%increments(i), combination)
         states(i)%increment = i
         states(i)%load_factor = step%load_factor
         states(i)%case_factor = step%case_factor
      end do
   end function loads_of_increments

   !> Factors of the load cases after all increments
   pure function final_factors(model, combination) result(factor)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of the load cases
      type(combination_type), intent(in) :: combination
      !> The factors, shape (cases)
      real(wp), allocatable :: factor(:)

      type(step_type) :: step
      integer :: i

      step = first_step(combination)
      do i = 1, size(model%increments)
         step = next_step(step, model%increments(i), combination)
      end do
      factor = step%case_factor
   end function final_factors

end module axijoint_joints_load_steps
