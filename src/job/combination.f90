!> Solves a job, one combination of its load cases after the other
module axijoint_job_combination
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : build_structure
   use axijoint_analysis_static, only : analyse_combination
   use axijoint_base_error, only : error_type
   use axijoint_base_stop, only : check_stop
   use axijoint_job_job, only : job_type
   implicit none
   private
   public :: solve_combination, combination_label

contains

   !> Solve one combination; the first one assembles and factors the equations
   subroutine solve_combination(job, k, results, error)
      !> The job
      type(job_type), intent(inout), target :: job
      !> Place of the combination
      integer, intent(in) :: k
      !> What was found
      type(results_type), intent(out) :: results
      !> Singular stiffness, or out of memory
      type(error_type), allocatable, intent(out) :: error

      call check_stop(error)
      if (allocated(error)) return
      if (.not. allocated(job%structure)) then
         allocate (job%structure)
         call build_structure(job%model, job%structure, job%timer, job%progress, error, job%options%estimated, listed=.true.)
         if (allocated(error)) then
            deallocate (job%structure)
            return
         end if
      end if
      job%checkpoint%at = k
      call analyse_combination(job%model, job%structure, job%model%combinations(k), results, &
         job%timer, job%progress, error, job%options%estimated, job%checkpoint)
      results%combination = combination_label(job, k)
   end subroutine solve_combination

   !> The user's number of a combination; 0 if there is one only
   pure integer function combination_label(job, k) result(label)
      !> The job
      type(job_type), intent(in) :: job
      !> Place of the combination
      integer, intent(in) :: k

      label = 0
      if (size(job%model%combinations) > 1) label = job%model%combinations(k)%label
   end function combination_label

end module axijoint_job_combination
