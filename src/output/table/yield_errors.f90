!> What mesh, harmonics, planes and iteration leave of the error where bodies yield: in the listing,
!> the summary, the results file and on the screen
module axijoint_output_table_yield_errors
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_yield_errors, only : yield_errors_type, yield_share_type, &
      sum_of_yield_shares, loses_displacement, yield_sources, yield_iteration
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, fine_percent
   use axijoint_output_file_columns, only : known_column
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_result_heading, write_sentence
   use axijoint_output_file_json, only : json_string, known_number
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_yield_errors, yield_errors_json, write_yield_errors_group, yield_errors_text

   !> How they are found, and what is not promised
   character(len=*), parameter :: way(3) = [character(len=83) :: &
      'Found by the last state again, in one step from no plastic strain: with twice the', &
      'harmonics, planes, on elements half as large. Not promised: a bound; what the', &
      'steps leave; stress, strain, displacement at a point; one state if psi < phi.']
   !> Columns of a value, and before it
   integer, parameter :: wide = 15, gap = 8

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
         call file%put("  "//merge("sum (at least)", "sum           ", some_unknown(errors))// &
                       share_text(sum_of_yield_shares(errors)))
         call write_sentence(file, "  ", yield_errors_text(errors))
         if (errors%turned_back .or. errors%at_limit .or. errors%other_way > 0.0_wp) return
         do i = 1, size(way)
            call file%put("  "//trim(way(i)))
         end do
      end associate
   end subroutine write_yield_errors

   !> Whether a sum lacks a source that is not known
   pure logical function some_unknown(errors)
      !> The errors
      type(yield_errors_type), intent(in) :: errors

      associate (shares => errors%shares(:yield_iteration - 1))
         some_unknown = lacks((shares%load)) .or. lacks((shares%displacement))
      end associate

   contains

      !> Whether some are known, not all
      pure logical function lacks(values)
         !> Negative if not known
         real(wp), intent(in) :: values(:)

         lacks = any(values >= 0.0_wp) .and. any(values < 0.0_wp)
      end function lacks

   end function some_unknown

   !> A share as columns of the table
   pure function share_text(share) result(text)
      !> The share
      type(yield_share_type), intent(in) :: share
      !> The columns
      character(len=:), allocatable :: text

      text = repeat(" ", gap)//known_column(share%load, wide)//repeat(" ", gap)// &
         known_column(share%displacement, wide)
   end function share_text

   !> Both in all, and what leaves most
   pure function yield_errors_text(errors) result(text)
      !> The errors
      type(yield_errors_type), intent(in) :: errors
      !> A sentence
      character(len=:), allocatable :: text

      type(yield_share_type) :: total
      integer :: i

      if (errors%turned_back) then
         text = 'not estimated: loads were taken back on the way, and what stays of plastic '// &
            'strain then is not known to a state found in one step'
         return
      end if
      if (errors%at_limit) then
         text = 'not estimated: the history ended before its loads, and displacements under '// &
            'loads that are almost the last say nothing'
         return
      end if
      if (errors%other_way > 0.0_wp) then
         text = 'not estimated: the state found again in one step is another one, by '//fine_percent(errors%other_way)// &
            ' of the load: the order of the loads made this one'
         return
      end if
      total = sum_of_yield_shares(errors)
      text = quantity_text('load', (errors%shares%load), total%load)
      if (total%load < 0.0_wp .and. total%displacement < 0.0_wp) then
         text = 'not estimated: the state was not found again in one step'
         if (any(errors%shares%no_memory)) text = 'not estimated'
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
      do i = 1, size(errors%shares)
         if (errors%shares(i)%no_memory) text = text//'; '//trim(yield_sources(i))// &
            ' left out: it needs more memory than there is'
      end do
   end function yield_errors_text

   !> A quantity in all, and its largest source
   pure function quantity_text(name, shares, total) result(text)
      !> What it is
      character(len=*), intent(in) :: name
      !> Its shares, and their sum
      real(wp), intent(in) :: shares(:), total
      !> Such as load 4.62 %, most by planes (2.31 %), or load at least 0.12 %, of what is known most by planes (0.1 %), not
      !> known: discretization
      character(len=:), allocatable :: text

      logical :: known
      integer :: i

      text = name//' not estimated'
      if (total < 0.0_wp) return
      known = all(shares(:yield_iteration - 1) >= 0.0_wp)
      text = name//trim(merge('         ', ' at least', known))//' '//fine_percent(total)
      if (total > 0.0_wp) text = text//','//trim(merge('                 ', ' of what is known', known))//' most by '// &
         trim(yield_sources(maxloc(shares, 1)))//' ('//fine_percent(maxval(shares))//')'
      if (known) return
      text = text//', not known:'
      do i = 1, yield_iteration - 1
         if (shares(i) < 0.0_wp) text = text//' '//trim(yield_sources(i))//','
      end do
      text = text(:len(text) - 1)
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
         known_number(errors%softness)//', "in_words": '//json_string(yield_errors_text(errors))//'}'
   end function yield_errors_json

   !> A share in the summary
   pure function share_json(share) result(json)
      !> The share
      type(yield_share_type), intent(in) :: share
      !> A JSON object
      character(len=:), allocatable :: json

      json = '{"load": '//known_number(share%load)//', "displacement": '//known_number(share%displacement)//'}'
   end function share_json

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
