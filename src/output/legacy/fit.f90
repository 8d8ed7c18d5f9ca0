!> Whether the old layout can show a job: axisymmetric states of quadrilaterals without joints
module axijoint_output_legacy_fit
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_element_yield_law, only : yield_none
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_mesh, only : n_joints
   use axijoint_model_model, only : model_type
   use axijoint_model_modes, only : used_modes
   implicit none
   private
   public :: check_fit

contains

   !> Refuse a job that has what the layout has no place for
   subroutine check_fit(model, error)
      !> The job
      type(model_type), intent(in) :: model
      !> What it has
      type(error_type), allocatable, intent(out) :: error

      associate (mesh => model%mesh, laws => model%materials%yield)
         if (.not. all(same_mode(used_modes(model), mode_type(0)))) then
            call refuse('loads or supports of other harmonics than 0, or torsion', error)
         else if (n_joints(mesh) > 0) then
            call refuse('joints', error)
         else if (any(n_corners(mesh%element_size) /= 4)) then
            call refuse('triangles', error)
         else if (size(mesh%kinds) > 1) then
            call refuse('elements of several numbers of nodes or Gauss points', error)
         else if (any(model%materials%orthotropic)) then
            call refuse('orthotropic materials', error)
         else if (any(laws%criterion /= yield_none .and. laws%criterion /= &
            maxval(laws%criterion))) then
            call refuse('several criteria of yielding', error)
         else if (any(laws%criterion /= yield_none .and. (laws%tension < huge(laws%tension) .or. &
            abs(laws%gradient) > 0.0 .or. abs(laws%friction - laws%dilation) > 0.0))) then
            call refuse('a limit of tension, a strength that grows with depth or flow that is '// &
               'not associated', error)
         end if
      end associate
   end subroutine check_fit

   !> The refusal
   subroutine refuse(what, error)
      !> What the job has
      character(len=*), intent(in) :: what
      !> The error
      type(error_type), allocatable, intent(out) :: error

      call fatal_error(error, exit_deck, 'the job has '//what//', for which the listing of Owen '// &
         'and Hinton''s program has no place'//new_line('a')//'mend: leave out --listing '// &
         'owen-hinton; NAME.lis, NAME.json and NAME.h5 show all')
   end subroutine refuse

end module axijoint_output_legacy_fit
