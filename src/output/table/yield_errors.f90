!> What mesh, harmonics, planes and iteration leave of the error where bodies yield: in the listing,
!> the summary, the results file and on the screen
module axijoint_output_table_yield_errors
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_yield_errors, only : yield_errors_type, yield_share_type, &
      sum_of_yield_shares, loses_displacement, yield_sources, yield_iteration
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, fine_percent
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_json, only : json_number, json_string
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_yield_errors, yield_errors_json, write_yield_errors_group, yield_errors_text

   !> How they are found, and what is not promised
   character(len=*), parameter :: way(3) = [character(len=80) :: &
      'the state was found again in one step from no plastic strain, with twice the', &
      'harmonics, planes, on elements half as large; not promised: a bound; what the', &
      'steps leave; stress, strain and displacement at a point; one state if psi < phi']
   !> Columns of a value
   integer, parameter :: wide = 23

contains

   !> The table of the listing
   subroutine write_yield_errors(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      integer :: i

      if (.not. allocated(results%yield_errors)) return
      associate (errors => results%yield_errors)
         call write_result_heading(file, "ERROR BUDGET (estimates; relative, - not known)", &
            results%converged)
         call file%put("  left by             load, displacement     displacement, load")
         call file%put("                            kept the same          kept the same")
         do i = 1, size(errors%shares)
            call file%put("  "//yield_sources(i)//share_text(errors%shares(i)))
         end do
         call file%put("  "//"sum           "//share_text(sum_of_yield_shares(errors)))
         call file%put("  "//yield_errors_text(errors))
         if (errors%turned_back) return
         do i = 1, size(way)
            call file%put("  ("//trim(way(i))//")")
         end do
      end associate
   end subroutine write_yield_errors

   !> A share as columns of the table
   pure function share_text(share) result(text)
      !> The share
      type(yield_share_type), intent(in) :: share
      !> The columns
      character(len=:), allocatable :: text

      text = value_text(share%load)//value_text(share%displacement)
   end function share_text

   !> A value in its columns
   pure function value_text(value) result(text)
      !> Relative value, negative if not known
      real(wp), intent(in) :: value
      !> The text
      character(len=wide) :: text

      text = repeat(" ", wide - 1)//"-"
      if (value >= 0.0_wp) text = columns([value], wide)
   end function value_text

   !> Both in all, and what leaves most
   pure function yield_errors_text(errors) result(text)
      !> The errors
      type(yield_errors_type), intent(in) :: errors
      !> A sentence
      character(len=:), allocatable :: text

      type(yield_share_type) :: total

      if (errors%turned_back) then
         text = 'not estimated: loads were taken back on the way, and what stays of plastic '// &
            'strain then is not known to a state found in one step'
         return
      end if
      total = sum_of_yield_shares(errors)
      text = quantity_text('load', (errors%shares%load), total%load)
      if (all(errors%shares(:yield_iteration - 1)%load < 0.0_wp .and. &
              errors%shares(:yield_iteration - 1)%displacement < 0.0_wp)) then
         text = 'not estimated: the state was not found again in one step'
      else if (total%displacement >= 0.0_wp) then
         text = text//'; '//quantity_text('displacement', (errors%shares%displacement), &
            total%displacement)
      else if (.not. loses_displacement(errors)) then
         text = text//'; displacement given'
      else if (errors%softness > 0.0_wp) then
         text = text//'; displacement not estimated: near the limit load it grew '// &
            to_text(errors%softness)//' times faster than the load'
      else
         text = text//'; displacement not estimated: the load grew no more'
      end if
   end function yield_errors_text

   !> A quantity in all, and its largest source
   pure function quantity_text(name, shares, total) result(text)
      !> What it is
      character(len=*), intent(in) :: name
      !> Its shares, and their sum
      real(wp), intent(in) :: shares(:), total
      !> Such as load 4.62 %, most by planes (2.31 %)
      character(len=:), allocatable :: text

      text = name//' not estimated'
      if (all(shares(:yield_iteration - 1) < 0.0_wp)) return
      text = name//' '//fine_percent(total)
      if (any(shares(:yield_iteration - 1) < 0.0_wp)) text = name//' at least '//fine_percent(total)
      if (total > 0.0_wp) text = text//', most by '//trim(yield_sources(maxloc(shares, 1)))// &
         ' ('//fine_percent(maxval(shares))//')'
   end function quantity_text

   !> In the summary
   pure function yield_errors_json(errors) result(json)
      !> The errors
      type(yield_errors_type), intent(in) :: errors
      !> A JSON object
      character(len=:), allocatable :: json

      integer :: i

      json = '{'
      do i = 1, size(errors%shares)
         json = json//'"'//trim(yield_sources(i))//'": '//share_json(errors%shares(i))//', '
      end do
      json = json//'"sum": '//share_json(sum_of_yield_shares(errors))//', "softness": '// &
         known(errors%softness)//', "in_words": '//json_string(yield_errors_text(errors))//'}'
   end function yield_errors_json

   !> A share in the summary
   pure function share_json(share) result(json)
      !> The share
      type(yield_share_type), intent(in) :: share
      !> A JSON object
      character(len=:), allocatable :: json

      json = '{"load": '//known(share%load)//', "displacement": '//known(share%displacement)//'}'
   end function share_json

   !> A value; null if it is not known
   pure function known(value) result(json)
      !> The value
      real(wp), intent(in) :: value
      !> JSON
      character(len=:), allocatable :: json

      json = "null"
      if (value >= 0.0_wp) json = json_number(value)
   end function known

   !> In the group /yield of the results file
   subroutine write_yield_errors_group(file, errors)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The errors
      type(yield_errors_type), intent(in) :: errors

      character(len=:), allocatable :: sources
      integer :: i

      sources = trim(yield_sources(1))
      do i = 2, size(yield_sources)
         sources = sources//', '//trim(yield_sources(i))
      end do
      call file%attribute("/yield", "error_sources", sources)
      call file%attribute("/yield", "errors", yield_errors_text(errors))
      call file%attribute("/yield", "softness", errors%softness)
      call file%write("/yield/error_load", (errors%shares%load), "Of the loads of the last "// &
         "increment, or of what holds given displacements, at the same displacement; (source), "// &
         "relative, negative if not known")
      call file%write("/yield/error_displacement", (errors%shares%displacement), &
         "Of the displacement that these loads do work on; (source), relative, negative if not known")
   end subroutine write_yield_errors_group

end module axijoint_output_table_yield_errors
