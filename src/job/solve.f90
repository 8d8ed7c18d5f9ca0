!> Solves all combinations of a job
module axijoint_job_solve
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_error, only : error_type
   use axijoint_job_combination, only : solve_combination
   use axijoint_job_goal, only : refine_to_goal
   use axijoint_job_job, only : job_type
   use axijoint_model_turning, only : hold_turning
   implicit none
   private
   public :: solve

contains

   !> Solve all combinations, and refine the job if it has an error target
   subroutine solve(job, results, error)
      !> The job
      type(job_type), intent(inout), target :: job
      !> What was found, one entry a combination
      type(results_type), allocatable, intent(out) :: results(:)
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      call hold_turning(job%model)  ! a program may have described it
      if (job%model%error_goal%wanted) then
         call refine_to_goal(job, results, error)
         return
      end if
      allocate (results(size(job%model%combinations)))
      do k = 1, size(results)
         call solve_combination(job, k, results(k), error)
         if (allocated(error)) return
      end do
   end subroutine solve

end module axijoint_job_solve
