!> Pressure at an edge of joints, where it is more than at any of their points and not infinite
module axijoint_output_table_joint_edge
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_model_model, only : model_type
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_json, only : json_number
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: edge_text, edge_json, write_edge

   !> Pressure at an edge over the largest of points, and over the largest joint stress, at least: less is rounding
   real(wp), parameter :: much_more = 1.02_wp, slight = 1.0e-6_wp
   !> Nodes nearer than this part of the radius are at one place
   real(wp), parameter :: near = 1.0e-9_wp

contains

   !> Whether there is such an edge
   pure logical function is_told(model, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      integer :: k

      is_told = .false.
      associate (edge => results%edge_pressure, x => model%mesh%coordinates)
         if (edge%place == 0 .or. results%at_rest) return
         if (.not. edge%value > max(much_more*results%pressure%value, slight*maxval(abs(results%joint_stress)), &
                                    tiny(1.0_wp)/epsilon(1.0_wp))) return
         is_told = .true.
         if (.not. allocated(results%singular)) return
         do k = 1, size(results%singular)
            if (norm2(x(:, results%singular(k)%node) - x(:, edge%place)) <= near*x(1, edge%place)) is_told = .false.
         end do
      end associate
   end function is_told

   !> The pressure in words, three digits of it
   pure function edge_text(model, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> Such as 'about 2.62 at r = 0.5, z = 0, theta = 0 degrees, ...'; empty if there is nothing to tell
      character(len=:), allocatable :: text

      real(wp) :: digit

      text = ''
      if (.not. is_told(model, results)) return
      associate (edge => results%edge_pressure, x => model%mesh%coordinates(:, results%edge_pressure%place))
         digit = 10.0_wp**(floor(log10(edge%value)) - 2)
         text = 'about '//to_text(digit*anint(edge%value/digit))//' at r = '//to_text(x(1))//', z = '//to_text(x(2))// &
            ', theta = '//to_text(edge%angle/degree)//' degrees, by a line through the points before it'
      end associate
   end function edge_text

   !> The same for the summary
   pure function edge_json(model, results) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> Object with value, r, z, theta [degree], or null
      character(len=:), allocatable :: json

      json = 'null'
      if (.not. is_told(model, results)) return
      associate (edge => results%edge_pressure, x => model%mesh%coordinates(:, results%edge_pressure%place))
         json = '{"value": '//json_number(edge%value)//', "r": '//json_number(x(1))//', "z": '//json_number(x(2))// &
            ', "theta": '//json_number(edge%angle/degree)//'}'
      end associate
   end function edge_json

   !> The same for the listing
   subroutine write_edge(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      if (.not. is_told(model, results)) return
      call write_result_heading(file, 'PRESSURE AT AN EDGE OF JOINTS (beyond their points)', results%converged)
      call file%put('  '//edge_text(model, results))
   end subroutine write_edge

end module axijoint_output_table_joint_edge
