!> What the listing says about approximations: what was left out without any error, and
!> the error that each of the others leaves
module axijoint_output_listing_budget
   use axijoint_analysis_error_budget, only : largest_share
   use axijoint_analysis_results, only : results_type, error_share_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_output_columns, only : columns
   use axijoint_output_headings, only : write_heading, write_result_heading
   use axijoint_output_text_file, only : text_file_type
   implicit none
   private
   public :: write_left_out, write_budget, write_rounds, largest_error_text

   !> Columns of a value
   integer, parameter :: wide = 15

contains

   !> What was not modelled
   subroutine write_left_out(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      integer :: i

      if (.not. allocated(results%left_out)) return
      if (size(results%left_out) == 0) return
      call write_heading(file, "LEFT OUT (exact: zero, or like something else)")
      do i = 1, size(results%left_out)
         call file%put("  "//results%left_out(i)%text)
      end do
   end subroutine write_left_out

   !> Approximations side by side, and the largest
   subroutine write_budget(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      integer :: i

      if (.not. allocated(results%budget)) return
      call write_result_heading(file, "ERROR BUDGET (estimates; relative, - not known)", results%converged)
      call file%put("  left by           energy norm   displacement   joint stress           load")
      do i = 1, size(results%budget)
         associate (share => results%budget(i))
            call file%put("  "//share%source//value_text(share%energy)//value_text(share%displacement)// &
               value_text(share%joint_stress)//value_text(share%load))
         end associate
      end do
      call file%put("  "//largest_error_text(results%budget))
   end subroutine write_budget

   !> Rounds of refinement; no times, which differ from run to run
   subroutine write_rounds(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      character(len=*), parameter :: format_round = "(i10, f13.2, i8, i12, i10, i14)"
      character(len=67) :: line
      integer :: i

      if (.not. allocated(results%rounds)) return
      call write_heading(file, "ROUNDS OF REFINEMENT")
      call file%put("     round   elements x   nodes           M    planes      unknowns          error")
      do i = 1, size(results%rounds)
         associate (round => results%rounds(i))
            write (line, format_round) i, round%mesh, round%nodes, round%harmonic, round%planes, round%n_unknowns
            call file%put(line//value_text(round%error))
         end associate
      end do
   end subroutine write_rounds

   !> A value in its columns
   pure function value_text(value) result(text)
      !> Relative value, negative if not known
      real(wp), intent(in) :: value
      !> The text
      character(len=wide) :: text

      text = repeat(" ", wide - 1)//"-"
      if (value >= 0.0_wp) text = columns([value], wide)
   end function value_text

   !> The largest share, and what would halve it
   pure function largest_error_text(budget) result(text)
      !> The budget
      type(error_share_type), intent(in) :: budget(:)
      !> A sentence
      character(len=:), allocatable :: text

      integer :: place

      place = largest_share(budget)
      if (place == 0) then
         text = "nothing that is known leaves an error"
         return
      end if
      associate (share => budget(place))
         text = "largest: "//trim(share%source)
         if (share%joint_stress >= 0.0_wp) text = text//", joint stress "//percent(share%joint_stress)
         if (share%displacement >= 0.0_wp) text = text//", displacement "//percent(share%displacement)
         if (share%load > 0.0_wp) text = text//", a load "//percent(share%load)
         text = text//"; about half with "//share%remedy
      end associate
   end function largest_error_text

   !> A share in per cent, two digits
   pure function percent(value) result(text)
      !> The share
      real(wp), intent(in) :: value
      !> Such as 0.12 %
      character(len=:), allocatable :: text

      character(len=12) :: number

      write (number, '(es8.1)') 100.0_wp*value
      if (100.0_wp*value >= 0.01_wp .and. value < 10.0_wp) write (number, '(f12.2)') 100.0_wp*value
      text = trim(adjustl(number))//" %"
   end function percent

end module axijoint_output_listing_budget
