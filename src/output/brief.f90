!> A finished run in a dozen lines, for the terminal
module axijoint_output_brief
   use axijoint_analysis_core_fields, only : peak_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_totals, only : largest_displacement, count_states, n_unknowns
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_system, only : peak_memory_mb
   use axijoint_base_text, only : to_text, count_of
   use axijoint_base_timer, only : phase_total
   use axijoint_element_joint_law, only : state_stick, state_slip, state_open
   use axijoint_job_job, only : job_type, result_name, deck_name
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type
   use axijoint_output_file_headings, only : mark_not_converged
   use axijoint_output_file_names, only : endings, files_of, file_arrays, file_listing, file_summary
   use axijoint_output_file_pending, only : join_path
   use axijoint_output_listing_budget, only : sum_text, remedy_text, singular_text
   use axijoint_output_table_joint_edge, only : edge_text
   use axijoint_output_table_joint_proportion, only : proportions_text, stiffer_laws_text
   use axijoint_output_table_yield_errors, only : yield_errors_text
   implicit none
   private
   public :: brief_text, status_text, reason_text

   !> Columns of the words before the values
   integer, parameter :: margin = 22

contains

   !> What ran, how it ended, the extreme values, the cost, the files
   function brief_text(job, results) result(text)
      !> The job
      type(job_type), intent(in) :: job
      !> Results of a combination
      type(results_type), intent(in) :: results
      !> Lines, the last without its end
      character(len=:), allocatable :: text

      text = line("deck", deck_name(job%deck))
      if (results%combination > 0) text = text//line("combination", to_text(results%combination))
      text = text//line("status", status_text(results))
      if (len(reason_text(results)) > 0) &
         text = text//line(merge("mechanism", "reason   ", allocated(results%mechanism)), reason_text(results))
      text = text// &
         line("mesh", to_text(n_nodes(job%model%mesh))//" nodes, "// &
         to_text(n_elements(job%model%mesh))//" elements, "// &
         count_of(n_joints(job%model%mesh), "joint"))// &
         line("unknowns", to_text(n_unknowns(results))//" in "// &
         modes_text((results%modes%harmonic))//", highest m = "// &
         to_text(maxval(results%modes%harmonic)))
      if (n_joints(job%model%mesh) > 0) text = text//stiffness_lines(job%model, results)
      if (size(results%joint_state) > 0) text = text//joint_lines(job%model, results)
      text = text//line("residual ratio", to_text(results%residual_ratio))// &
         line("equilibrium error", to_text(results%equilibrium_error)//" on the whole, "// &
         to_text(results%part_error)//" on the worst part")// &
         displacement_line(job%model, results)
      if (len(singular_text(job%model, results)) > 0) then
         text = text//line("infinite stresses", singular_text(job%model, results))
      end if
      if (.not. job%options%estimated) text = text//line("error estimates", "none, as --no-estimates asks")
      if (allocated(results%budget)) then
         text = text//line("error estimates", sum_text(results))
         if (len(remedy_text(results%budget)) > 0) &
            text = text//line("about half with", remedy_text(results%budget))
      end if
      if (allocated(results%yield_errors) .and. job%options%estimated) &
         text = text//line("error estimates", yield_errors_text(results%yield_errors))
      text = text//remark_lines(results)// &
         line("time, peak memory", seconds_text(job%timer%seconds(phase_total))//" s, "// &
         to_text(nint(peak_memory_mb()))//" MB")// &
         line("files", join_path(job%options%directory, result_name(job, results%combination))// &
         ".lis .json .h5"//further_endings(job%model))
      text = text(:len(text) - 1)
   end function brief_text

   !> Endings of the files that are not always there
   pure function further_endings(model) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Such as " .vtkhdf"
      character(len=:), allocatable :: text

      integer, allocatable :: files(:)
      integer :: k

      text = ""
      files = files_of(model)
      do k = 1, size(files)
         if (all(files(k) /= [file_listing, file_summary, file_arrays])) &
            text = text//" "//trim(endings(files(k)))
      end do
   end function further_endings

   !> Converged, or how it failed
   pure function status_text(results) result(text)
      !> Results
      type(results_type), intent(in) :: results
      !> The words
      character(len=:), allocatable :: text

      if (.not. results%converged .and. size(results%path) == 0) then
         text = mark_not_converged//" (linear): the equations are ill-conditioned"
      else if (.not. results%converged) then
         text = mark_not_converged//" after "//count_of(size(results%path), "iteration")// &
            " (tolerance "//to_text(results%tolerance)//")"
      else if (size(results%path) == 0) then
         text = "converged (linear)"
      else
         text = "converged in "//count_of(size(results%path), "iteration")//" (tolerance "// &
            to_text(results%tolerance)//")"
      end if
   end function status_text

   !> Why there is no equilibrium
   pure function reason_text(results) result(text)
      !> Results
      type(results_type), intent(in) :: results
      !> The mechanism, or another reason; empty if there is none
      character(len=:), allocatable :: text

      integer :: k

      text = ""
      if (allocated(results%mechanism)) then
         text = results%mechanism
      else if (allocated(results%remarks)) then
         do k = 1, size(results%remarks)
            if (results%remarks(k)%says_why) text = results%remarks(k)%text
         end do
      end if
   end function reason_text

   !> What else the user should know
   pure function remark_lines(results) result(text)
      !> Results
      type(results_type), intent(in) :: results
      !> A line a remark
      character(len=:), allocatable :: text

      integer :: k

      text = ""
      if (.not. allocated(results%remarks)) return
      do k = 1, size(results%remarks)
         associate (remark => results%remarks(k))
            if (.not. (remark%says_why .or. remark%said_elsewhere)) text = text//line("remark", remark%text)
         end associate
      end do
   end function remark_lines

   !> Stiffness of the joints beside the bodies, and what stiffer ones would change
   pure function stiffness_lines(model, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A line, and one for the soft and one for the stiff laws if there are any
      character(len=:), allocatable :: text

      integer :: i

      text = line("joint stiffness", proportions_text(model))
      if (.not. allocated(results%stiffer)) return
      do i = 1, size(results%stiffer)
         if (results%stiffer(i)%known) &
            text = text//line("ten times as stiff", stiffer_laws_text(model, results%stiffer(i)))
      end do
   end function stiffness_lines

   !> Number of the modes: of one family harmonics, of two more
   pure function modes_text(harmonic) result(text)
      !> Their harmonics
      integer, intent(in) :: harmonic(:)
      !> Such as '5 harmonics', '9 modes of 5 harmonics'
      character(len=:), allocatable :: text

      integer :: k, n

      n = count([(all(harmonic(:k - 1) /= harmonic(k)), k=1, size(harmonic))])
      text = count_of(n, "harmonic")
      if (n < size(harmonic)) text = count_of(size(harmonic), "mode")//" of "//text
   end function modes_text

   !> States of the joints and the largest pressure
   pure function joint_lines(model, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Results with at least one joint point
      type(results_type), intent(in) :: results
      !> Two lines, or three
      character(len=:), allocatable :: text

      text = line("joint states", to_text(count_states(results, state_stick))//" stick, "// &
         to_text(count_states(results, state_slip))//" slip, "// &
         to_text(count_states(results, state_open))//" open (points times planes)")
      associate (peak => results%pressure)
         if (peak%value > 0.0_wp) then
            text = text//line("largest pressure", to_text(peak%value)//" at r = "// &
               to_text(results%joint_point_position(1, peak%place))//", z = "// &
               to_text(results%joint_point_position(2, peak%place))//", theta = "// &
               to_text(peak%angle/degree)//" degrees")
         else
            text = text//line("largest pressure", "none, no joint is pressed")
         end if
      end associate
      if (len(edge_text(model, results)) > 0) text = text//line("at an edge of joints", edge_text(model, results))
   end function joint_lines

   !> The largest displacement
   pure function displacement_line(model, results) result(text)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A line
      character(len=:), allocatable :: text

      type(peak_type) :: peak

      peak = largest_displacement(results%modes, results%displacement)
      if (peak%place == 0) then
         text = line("largest displacement", "none is finite")
         return
      end if
      text = line("largest displacement", to_text(peak%value)//" at node "// &
         to_text(model%mesh%node_label(peak%place))//" (r = "// &
         to_text(model%mesh%coordinates(1, peak%place))//", z = "// &
         to_text(model%mesh%coordinates(2, peak%place))//"), theta = "// &
         to_text(peak%angle/degree)//" degrees")
   end function displacement_line

   !> Word and value, with the line's end
   pure function line(word, value) result(text)
      !> What it is
      character(len=*), intent(in) :: word
      !> Its value
      character(len=*), intent(in) :: value
      !> The line
      character(len=:), allocatable :: text

      character(len=margin) :: head

      head = word
      text = head//value//new_line("a")
   end function line

   !> Seconds with three decimals
   pure function seconds_text(seconds) result(text)
      !> Time [second]
      real(wp), intent(in) :: seconds
      !> Such as 0.125
      character(len=:), allocatable :: text

      character(len=16) :: number

      write (number, '(f16.3)') seconds
      text = trim(adjustl(number))
   end function seconds_text

end module axijoint_output_brief
