!> How the strips of blocks are divided where a job was refined: in the listing and the summary
module axijoint_output_table_strips
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp
   use axijoint_model_model, only : model_type
   use axijoint_model_strips, only : strip_type, n_intervals
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_heading
   use axijoint_output_file_json, only : json_number
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_strips, strips_json

   !> Columns of a real
   integer, parameter :: wide = 15

contains

   !> Whether there are strips that may have been divided anew
   pure logical function are_divided(model, results)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      are_divided = .false.
      if (allocated(results%rounds)) are_divided = size(results%rounds) > 1 .and. &
         allocated(model%grid)
   end function are_divided

   !> Table of the strips
   subroutine write_strips(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=10) :: n
      integer :: k

      if (.not. are_divided(model, results)) return
      call write_heading(file, "BLOCKS AS DIVIDED (all sides that go on across these are alike)")
      call file%put("  elements         from r              z           to r              z"// &
         "       shortest        longest")
      do k = 1, size(model%grid%strips)
         associate (strip => model%grid%strips(k))
            write (n, '(i10)') n_intervals(strip)
            call file%put(n//columns([strip%line(:, 1), strip%line(:, 2), extremes(strip)], wide))
         end associate
      end do
   end subroutine write_strips

   !> The strips for the summary
   pure function strips_json(model, results) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      real(wp) :: lengths(2)
      integer :: k

      json = "["
      if (are_divided(model, results)) then
         do k = 1, size(model%grid%strips)
            if (k > 1) json = json//", "
            associate (strip => model%grid%strips(k))
               lengths = extremes(strip)
               json = json//'{"from": '//place_json(strip%line(:, 1))//', "to": '// &
                  place_json(strip%line(:, 2))//', "elements": '// &
                  json_number(n_intervals(strip))//', "shortest": '// &
                  json_number(lengths(1))//', "longest": '//json_number(lengths(2))//'}'
            end associate
         end do
      end if
      json = json//"]"
   end function strips_json

   !> r and z
   pure function place_json(place) result(json)
      !> The place
      real(wp), intent(in) :: place(2)
      !> A JSON array
      character(len=:), allocatable :: json

      json = "["//json_number(place(1))//", "//json_number(place(2))//"]"
   end function place_json

   !> Shortest and longest interval
   pure function extremes(strip) result(lengths)
      !> The strip
      type(strip_type), intent(in) :: strip
      !> Both [length]
      real(wp) :: lengths(2)

      associate (parts => strip%ends(2:) - strip%ends(:n_intervals(strip)))
         lengths = norm2(strip%line(:, 2) - strip%line(:, 1))*[minval(parts), maxval(parts)]
      end associate
   end function extremes

end module axijoint_output_table_strips
