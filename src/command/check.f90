!> `axijoint check`: read decks and report on them
module axijoint_command_check
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_error, only : exit_ok, exit_deck
   use axijoint_base_progress, only : tell_below
   use axijoint_base_text, only : to_text
   use axijoint_command_line, only : command_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, render
   use axijoint_job_job, only : job_type, deck_name
   use axijoint_job_read, only : read_job
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_modes, only : used_modes
   implicit none
   private
   public :: check_decks

contains

   !> Read and check decks; solve nothing
   subroutine check_decks(command, exit_code)
      !> Decks and options
      type(command_type), intent(in) :: command
      !> 0, or 2 if any deck has errors
      integer, intent(out) :: exit_code

      type(job_type) :: job
      type(diagnostics_type) :: diagnostics
      integer :: k

      exit_code = exit_ok
      do k = 1, size(command%decks)
         job = job_type()
         job%options = command%options
         call read_job(command%decks(k)%text, job, diagnostics)
         if (allocated(job%conversion)) call tell_below(job%conversion)
         if (diagnostics%n_errors + diagnostics%n_warnings > 0) then
            call tell_below(render(diagnostics, job%source))
         end if
         if (diagnostics%n_errors > 0) then
            exit_code = exit_deck
         else if (.not. command%quiet) then
            write (output_unit, '(a)') deck_name(command%decks(k)%text)//': ok, '// &
               to_text(n_nodes(job%model%mesh))//' nodes, '// &
               to_text(n_elements(job%model%mesh))//' elements, '// &
               to_text(n_joints(job%model%mesh))//' joints, '// &
               to_text(size(used_modes(job%model)))//' harmonics to solve'
         end if
      end do
   end subroutine check_decks

end module axijoint_command_check
