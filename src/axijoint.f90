!> What a program needs that uses this library: read a job from a deck or describe it, solve it,
!> write its results. doc/user.md shows how
module axijoint
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_element_joint_law, only : joint_law_type, law_elastic, law_paper
   use axijoint_fe_mode, only : mode_type
   use axijoint_job_job, only : job_type, new_job
   use axijoint_job_read, only : read_job
   use axijoint_job_solve, only : solve
   use axijoint_model_blank, only : new_model
   use axijoint_model_build, only : add_material, add_law, add_block, add_rectangle, &
      add_interface, hold_edges, &
      add_traction, node_at
   use axijoint_model_material, only : solid_material_type, rule_centroid, rule_gauss, rule_lobatto
   use axijoint_model_model, only : model_type
   use axijoint_output_claim, only : claim_type, claim_output, release_output
   use axijoint_output_output, only : check_output, write_output
   implicit none
   private
   public :: wp, error_type, diagnostics_type, render
   public :: job_type, read_job, new_job, solve, write_results, results_type
   public :: model_type, new_model, add_material, add_law, add_block, add_rectangle, &
      add_interface, hold_edges, &
      add_traction, node_at
   public :: solid_material_type, joint_law_type, law_elastic, law_paper, rule_centroid, &
      rule_gauss, rule_lobatto
   public :: mode_type

contains

   !> Write listing, summary, HDF5 file and pictures of all combinations. Files appear when they are
   !> complete
   subroutine write_results(job, results, error)
      !> The job, solved; the directory is one of its options
      type(job_type), intent(inout), target :: job
      !> What was found, one entry a combination
      type(results_type), intent(in) :: results(:)
      !> A file cannot be written
      type(error_type), allocatable, intent(out) :: error

      type(claim_type) :: claim
      character(len=:), allocatable :: notes
      integer :: k

      call check_output(job, error)
      if (.not. allocated(error)) call claim_output(job, claim, notes, error)
      do k = 1, size(results)
         if (allocated(error)) exit
         call write_output(job, results(k), error)
      end do
      call release_output(claim)
   end subroutine write_results

end module axijoint
