!> How each harmonic was solved, and what the harmonics leave of loads: in the summary
module axijoint_output_table_modes
   use axijoint_analysis_core_results, only : results_type
   use axijoint_fe_mode, only : family_symmetric
   use axijoint_model_model, only : model_type
   use axijoint_output_file_json, only : json_number, json_string
   implicit none
   private
   public :: modes_json, truncations_json

contains

   !> Unknowns, backward error and condition number of each harmonic
   pure function modes_json(results) result(json)
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, size(results%solves)
         if (i > 1) json = json//", "
         associate (solve => results%solves(i))
            json = json//'{"harmonic": '//json_number(solve%mode%harmonic)//', "family": "'// &
               trim(merge("symmetric    ", "antisymmetric", &
                          solve%mode%family == family_symmetric))// &
               '", "unknowns": '//json_number(solve%n_equations)// &
               ', "backward_error": '//json_number(solve%backward_error)// &
               ', "condition": '//json_number(solve%condition)//'}'
         end associate
      end do
      json = json//"]"
   end function modes_json

   !> What the harmonics leave of each load that is given as a function of theta
   pure function truncations_json(model) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> A JSON array
      character(len=:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, size(model%truncations)
         if (i > 1) json = json//", "
         json = json//'{"load": '//json_string(model%truncations(i)%name)//', "left_out": '// &
            json_number(model%truncations(i)%left_out)//'}'
      end do
      json = json//"]"
   end function truncations_json

end module axijoint_output_table_modes
