!> Summary of a run in JSON, for scripts
module axijoint_output_summary
   use axijoint_analysis_core_results, only : results_type, error_share_type, source_names
   use axijoint_analysis_core_series, only : series_type
   use axijoint_analysis_core_totals, only : count_states, n_unknowns
   use axijoint_analysis_error_cut_errors, only : n_kinds, kind_names, sizes_on_cuts
   use axijoint_analysis_error_budget, only : sum_of_shares
   use axijoint_base_kinds, only : wp
   use axijoint_base_sha256, only : sha256
   use axijoint_base_system, only : peak_memory_mb
   use axijoint_base_text, only : lower
   use axijoint_base_timer, only : timer_type, phase_names, phase_read, phase_assemble, &
      phase_factor, phase_joints, phase_recover, phase_write, phase_total
   use axijoint_base_version, only : program_name, program_version
   use axijoint_element_joint_law, only : state_stick, state_slip, state_open
   use axijoint_fe_mode, only : family_symmetric, family_antisymmetric
   use axijoint_job_job, only : job_type
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type, method_names
   use axijoint_output_done, only : job_hash
   use axijoint_output_file_echo, only : deck_text
   use axijoint_output_file_json, only : json_string, json_number, known_number, json_integers, json_strings
   use axijoint_output_file_run, only : run_type, status_name, status_error
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_listing_budget, only : sum_text, laws_at
   use axijoint_output_table_in_situ, only : in_situ_json
   use axijoint_output_table_increments, only : increments_json
   use axijoint_output_table_interfaces, only : interfaces_json
   use axijoint_output_table_joint_edge, only : edge_json
   use axijoint_output_table_joint_proportion, only : proportions_json
   use axijoint_output_table_modes, only : modes_json, truncations_json
   use axijoint_output_table_residuals, only : residuals_json
   use axijoint_output_table_strips, only : strips_json
   use axijoint_output_table_yielding, only : yielding_json
   implicit none
   private
   public :: write_summary, write_failure_summary

   !> Phases in the order in which they are written
   integer, parameter :: phases(7) = [phase_total, phase_read, phase_assemble, phase_factor, &
      phase_joints, phase_recover, phase_write]

contains

   !> Summary of a finished run
   subroutine write_summary(file, run, messages, job, results, series, file_bytes)
      !> The file
      class(text_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> Warnings and how the iteration ended
      character(len=*), intent(in) :: messages(:)
      !> Deck, model, times
      type(job_type), intent(in) :: job
      !> Results
      type(results_type), intent(in) :: results
      !> What is followed from increment to increment
      type(series_type), intent(in) :: series
      !> Bytes of the other files of the run, JSON object
      character(len=*), intent(in) :: file_bytes

      associate (model => job%model)
         call write_tags(file, run, status_name(results), messages, json_string(model%title))
         call put_pair(file, "deck_sha256", json_string(sha256(deck_text(job%source))))
         call put_pair(file, "job_sha256", json_string(job_hash(job, results%rounds)))
         call put_pair(file, "file_bytes", file_bytes)
         call put_pair(file, "combination", json_number(results%combination))
         call put_pair(file, "nodes", json_number(n_nodes(model%mesh)))
         call put_pair(file, "elements", json_number(n_elements(model%mesh)))
         call put_pair(file, "joints", json_number(n_joints(model%mesh)))
         call put_pair(file, "unknowns", json_number(n_unknowns(results)))
         call put_pair(file, "solver", json_string(lower(trim(results%solver%name))))
         call put_pair(file, "harmonics", json_integers(distinct((results%modes%harmonic))))
         call put_pair(file, "families", json_strings(family_names(results)))
         call put_pair(file, "modes", modes_json(results))
         call put_pair(file, "truncations", truncations_json(model))
         call put_pair(file, "planes", json_number(model%n_planes))
         call put_pair(file, "iterations", json_number(size(results%path)))
         call put_pair(file, "residual_ratio", json_number(results%residual_ratio))
         call put_pair(file, "residuals", residuals_json(results))
         call put_pair(file, "increments", increments_json(series))
         call put_pair(file, "yielding", yielding_json(model, results))
         call put_pair(file, "mismatch", json_number(results%mismatch))
         call put_pair(file, "tolerance", json_number(results%tolerance))
         call put_pair(file, "method", json_string(lower(trim(method_names(model%method)))))
         if (results%other_loop >= 0.0_wp) then
            call put_pair(file, "other_loop_difference", json_number(results%other_loop))
         else
            call put_pair(file, "other_loop_difference", "null")
         end if
         call put_pair(file, "joint_states", states_text(results))
         call put_pair(file, "edge_pressure", edge_json(model, results))
         call put_pair(file, "interfaces", interfaces_json(model))
         call put_pair(file, "joint_stiffness", proportions_json(model, results))
         call put_pair(file, "equilibrium_error", json_number(results%equilibrium_error))
         call put_pair(file, "part_equilibrium_error", json_number(results%part_error))
         call put_pair(file, "in_situ", in_situ_json(model, results%in_situ))
         call put_pair(file, "left_out", left_out_text(results))
         call put_pair(file, "errors", errors_text(results))
         call put_pair(file, "point_errors", point_errors_json(model, results))
         call put_cut_errors(file, model, results)
         call put_pair(file, "section_errors", section_errors_json(model, results))
         call put_pair(file, "singular", singular_json(model, results))
         call put_pair(file, "error_seconds", error_seconds_text(results))
         call put_pair(file, "increment_seconds", json_number(results%increment_seconds))
         if (allocated(results%rounds)) then
            call put_pair(file, "rounds", rounds_text(results))
            call put_pair(file, "strips", strips_json(model, results))
         end if
         call put_pair(file, "seconds", seconds_text(job%timer))
         call put_last(file)
      end associate
   end subroutine write_summary

   !> Rounds of refinement
   pure function rounds_text(results) result(json)
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, size(results%rounds)
         if (i > 1) json = json//", "
         associate (round => results%rounds(i))
            json = json//'{"mesh": '//json_number(round%mesh)//', "element_nodes": '// &
               json_number(round%nodes)// &
               ', "max_harmonic": '//json_number(round%harmonic)// &
               ', "planes": '//json_number(round%planes)//', "unknowns": '// &
               json_number(round%n_unknowns)// &
               ', "error": '//json_number(round%error)//', "seconds": '// &
               json_number(round%seconds)//'}'
         end associate
      end do
      json = json//"]"
   end function rounds_text

   !> What was not modelled
   pure function left_out_text(results) result(json)
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array of sentences
      character(len=:), allocatable :: json

      integer :: i

      json = "["
      if (allocated(results%left_out)) then
         do i = 1, size(results%left_out)
            if (i > 1) json = json//", "
            json = json//json_string(results%left_out(i)%text)
         end do
      end if
      json = json//"]"
   end function left_out_text

   !> Times that the estimates of the errors took
   pure function error_seconds_text(results) result(json)
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON object
      character(len=:), allocatable :: json

      integer :: i

      json = "null"
      if (allocated(results%yield_errors)) &
         json = '{"bodies that yield": '//json_number(results%yield_errors%seconds)//'}'
      if (.not. allocated(results%budget)) return
      json = "{"
      do i = 1, size(results%budget)
         if (i > 1) json = json//", "
         json = json//'"'//trim(source_names(results%budget(i)%source))//'": '// &
            json_number(results%budget(i)%seconds)
      end do
      json = json//"}"
   end function error_seconds_text

   !> Where stresses are infinite
   pure function singular_json(model, results) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      integer :: i

      json = "[]"
      if (.not. allocated(results%singular)) return
      json = "["
      do i = 1, size(results%singular)
         if (i > 1) json = json//", "
         associate (place => results%singular(i))
            json = json//'{"node": '//json_number(model%mesh%node_label(place%node))//', "r": '// &
               json_number(model%mesh%coordinates(1, place%node))//', "z": '// &
               json_number(model%mesh%coordinates(2, place%node))//', "exponent": '// &
               json_number(place%exponent)// &
               ', "distance": '//json_number(place%distance)//', "laws": '// &
               json_integers(laws_at(model, place%node))//'}'
         end associate
      end do
      json = json//"]"
   end function singular_json

   !> Estimates of the errors by what leaves them
   pure function errors_text(results) result(json)
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON object
      character(len=:), allocatable :: json

      integer :: i

      json = "null"
      if (.not. allocated(results%budget)) return
      json = "{"
      do i = 1, size(results%budget)
         json = json//share_text(results%budget(i))
      end do
      json = json//share_text(sum_of_shares(results%budget))//'"in_words": '// &
         json_string(sum_text(results))//'}'

   contains

      !> Errors that a source leaves, with a comma
      pure function share_text(share) result(json)
         !> The source
         type(error_share_type), intent(in) :: share
         !> JSON
         character(len=:), allocatable :: json

         json = '"'//trim(source_names(share%source))//'": {"energy": '//known_number(share%energy)// &
                ', "displacement": '//known_number(share%displacement)//', "joint_stress": '// &
                known_number(share%joint_stress)//', "points": '//known_number(share%points)// &
                ', "cuts": '//known_number(share%cuts)//', "sections": '//known_number(share%sections)//', "load": '// &
                known_number(share%load)//'}, '
      end function share_text

   end function errors_text

   !> What is estimated of the displacement of each point with a name
   pure function point_errors_json(model, results) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      type(error_share_type) :: total
      integer :: i, p

      json = "[]"
      if (.not. allocated(results%budget)) return
      total = sum_of_shares(results%budget)
      json = "["
      do p = 1, size(model%points)
         if (p > 1) json = json//", "
         json = json//'{"point": '//json_number(model%points(p)%label)//', "name": '//json_string(trim(model%points(p)%name))// &
            ', "displacement": '//json_number(results%point_size(p))//', "error": '//known_number(total%at_points(p))
         do i = 1, size(results%budget)
            json = json//', "'//trim(source_names(results%budget(i)%source))//'": '//known_number(results%budget(i)%at_points(p))
         end do
         json = json//"}"
      end do
      json = json//"]"
   end function point_errors_json

   !> What is estimated of the stresses along each line
   pure function section_errors_json(model, results) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      type(error_share_type) :: total
      integer :: i, k

      json = "[]"
      if (.not. allocated(results%budget) .or. size(model%lines) == 0) return
      total = sum_of_shares(results%budget)
      json = "["
      do k = 1, size(model%lines)
         if (k > 1) json = json//", "
         associate (found => results%discretization)
            json = json//'{"section": '//json_number(model%lines(k)%label)//', "points": '//json_number(found%line_points(2, k))// &
               ', "judged": '//json_number(found%line_points(1, k))//', "stress": '//known_number(found%line_stress(k))// &
               ', "error": '//known_number(total%on_lines(k))
         end associate
         do i = 1, size(results%budget)
            json = json//', "'//trim(source_names(results%budget(i)%source))//'": '//known_number(results%budget(i)%on_lines(k))
         end do
         json = json//"}"
      end do
      json = json//"]"
   end function section_errors_json

   !> What is estimated of the resultants on each cut, a line a cut: there may be many
   subroutine put_cut_errors(file, model, results)
      !> The file
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      type(error_share_type) :: total
      real(wp), allocatable :: sizes(:, :)
      character(len=:), allocatable :: line
      integer :: c, k

      if (.not. allocated(results%budget) .or. size(model%cuts) == 0) then
         call put_pair(file, "cut_errors", "[]")
         return
      end if
      total = sum_of_shares(results%budget)
      sizes = sizes_on_cuts(results%cut_resultants)
      call file%put('  "cut_errors": [')
      do c = 1, size(model%cuts)
         line = '    {"cut": '//json_number(model%cuts(c)%label)//', "z": '//json_number(model%cuts(c)%z)
         do k = 1, n_kinds
            line = line//', "'//trim(kind_names(k))//'": '//json_number(sizes(k, c))//', "'//trim(kind_names(k))//'_error": '// &
                   known_number(total%on_cuts(k, c))
         end do
         call file%put(line//trim(merge("},", "} ", c < size(model%cuts))))
      end do
      call file%put("  ],")
   end subroutine put_cut_errors

   !> Summary of a run that ended with an error; what is not known is null
   subroutine write_failure_summary(file, run, messages)
      !> The file
      class(text_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> Causes
      character(len=*), intent(in) :: messages(:)

      character(len=*), parameter :: unknown(8) = [character(len=17) :: "nodes", "elements", &
         "joints", "unknowns", "planes", "iterations", "residual_ratio", "equilibrium_error"]
      integer :: i

      call write_tags(file, run, status_error, messages, "null")
      do i = 1, size(unknown)
         call put_pair(file, trim(unknown(i)), "null")
      end do
      call put_pair(file, "harmonics", "[]")
      call put_pair(file, "families", "[]")
      call put_pair(file, "joint_states", '{"stick": null, "slip": null, "open": null}')
      call put_pair(file, "seconds", no_seconds_text())
      call put_last(file)
   end subroutine write_failure_summary

   !> Begin the summary: what ran, and how it ended
   subroutine write_tags(file, run, status, messages, title)
      !> The file
      class(text_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> Status of the run
      character(len=*), intent(in) :: status
      !> Warnings or causes
      character(len=*), intent(in) :: messages(:)
      !> Title as a JSON value
      character(len=*), intent(in) :: title

      call file%put("{")
      call put_pair(file, "program", json_string(program_name))
      call put_pair(file, "version", json_string(program_version))
      call put_pair(file, "deck", json_string(run%deck))
      call put_pair(file, "title", title)
      call put_pair(file, "date", json_string(run%date))
      call put_pair(file, "run", json_string(run%stamp))
      call put_pair(file, "status", json_string(status))
      call put_pair(file, "exit_code", json_number(run%exit_code))
      call put_pair(file, "messages", json_strings(messages))
   end subroutine write_tags

   !> A key, its value and a comma
   subroutine put_pair(file, key, value)
      !> The file
      class(text_file_type), intent(inout) :: file
      !> The key
      character(len=*), intent(in) :: key
      !> The value, in JSON
      character(len=*), intent(in) :: value

      call file%put('  "'//key//'": '//value//",")
   end subroutine put_pair

   !> The last key, and the end
   subroutine put_last(file)
      !> The file
      class(text_file_type), intent(inout) :: file

      call file%put('  "peak_memory_mb": '//json_number(peak_memory_mb()))
      call file%put("}")
   end subroutine put_last

   !> Number of joint points times planes in each state
   pure function states_text(results) result(json)
      !> Results
      type(results_type), intent(in) :: results
      !> JSON object
      character(len=:), allocatable :: json

      json = '{"stick": '//json_number(count_states(results, state_stick))// &
         ', "slip": '//json_number(count_states(results, state_slip))// &
         ', "open": '//json_number(count_states(results, state_open))//"}"
   end function states_text

   !> Wall-clock times of the phases; writing until now
   function seconds_text(timer) result(json)
      !> Times of the run
      type(timer_type), intent(in) :: timer
      !> JSON object
      character(len=:), allocatable :: json

      integer :: i

      json = "{"
      do i = 1, size(phases)
         if (i > 1) json = json//", "
         json = json//'"'//trim(phase_names(phases(i)))//'": '// &
            json_number(timer%seconds(phases(i)))
      end do
      json = json//"}"
   end function seconds_text

   !> The same keys, nothing known
   pure function no_seconds_text() result(json)
      !> JSON object
      character(len=:), allocatable :: json

      integer :: i

      json = "{"
      do i = 1, size(phases)
         if (i > 1) json = json//", "
         json = json//'"'//trim(phase_names(phases(i)))//'": null'
      end do
      json = json//"}"
   end function no_seconds_text

   !> Ascending numbers, each once
   pure function distinct(numbers)
      !> The numbers, ascending
      integer, intent(in) :: numbers(:)
      !> The same without repetitions
      integer, allocatable :: distinct(:)

      integer :: k

      distinct = pack(numbers, [(k == 1 .or. numbers(k) /= numbers(max(1, k - 1)), &
                                 k=1, size(numbers))])
   end function distinct

   !> Fourier families in use
   pure function family_names(results) result(names)
      !> Results
      type(results_type), intent(in) :: results
      !> The names
      character(len=13), allocatable :: names(:)

      names = pack([character(len=13) :: 'symmetric', 'antisymmetric'], &
                   [any(results%modes%family == family_symmetric), &
                    any(results%modes%family == family_antisymmetric)])
   end function family_names

end module axijoint_output_summary
