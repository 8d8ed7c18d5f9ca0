!> The listing: the job as understood and its results, in tables
module axijoint_output_listing_contents
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_series, only : series_type
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type
   use axijoint_base_version, only : program_name, program_version
   use axijoint_deck_text_source, only : source_type, card_keyword
   use axijoint_job_job, only : job_type
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : print_deck
   use axijoint_output_file_echo, only : write_echo
   use axijoint_output_file_headings, only : write_heading, write_lines, rule, mark_not_converged
   use axijoint_output_file_run, only : run_type
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_listing_budget, only : write_left_out, write_budget, write_singular, &
      write_rounds
   use axijoint_output_listing_choice, only : chosen_lines, none_asked, write_left
   use axijoint_output_listing_loads, only : write_loads, write_truncations, write_supports, &
      write_combinations
   use axijoint_output_listing_mesh, only : write_nodes, write_restraints, write_elements, &
      write_joints
   use axijoint_output_listing_model, only : write_warnings, write_model, write_materials, &
      write_joint_materials, write_increments
   use axijoint_output_listing_interfaces, only : write_interface_resultants
   use axijoint_output_listing_sections, only : write_sections, write_cuts, write_named_points
   use axijoint_output_listing_solution, only : write_equations, write_convergence, &
      write_displacements, write_total_displacements, write_reactions, write_equilibrium, &
      write_times, convergence_text
   use axijoint_output_listing_stress, only : write_stresses, write_extremes_round, write_nodal_stresses, &
      write_joint_results
   use axijoint_output_listing_sweep, only : picture_type, write_pictures
   use axijoint_output_table_interfaces, only : write_interfaces
   use axijoint_output_table_face_reactions, only : write_face_reactions
   use axijoint_output_table_in_situ, only : write_in_situ
   use axijoint_output_table_increments, only : write_increment_table
   use axijoint_output_table_joint_edge, only : write_edge
   use axijoint_output_table_joint_proportion, only : write_proportions
   use axijoint_output_table_residuals, only : write_residuals
   use axijoint_output_table_strips, only : write_strips
   use axijoint_output_table_yielding, only : write_yielding
   use axijoint_output_table_yield_errors, only : write_yield_errors
   implicit none
   private
   public :: write_listing, end_listing

   !> Cards below a keyword that are listed of a long deck, too
   integer, parameter :: first_cards = 20

contains

   !> All tables in order, except that of times
   subroutine write_listing(file, run, job, warnings, results, series, pictures)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> Deck, model
      type(job_type), intent(in) :: job
      !> Warnings of the deck
      character(len=*), intent(in) :: warnings(:)
      !> Results
      type(results_type), intent(in) :: results
      !> What is followed from increment to increment
      type(series_type), intent(in) :: series
      !> Files of the swept bodies
      type(picture_type), intent(in) :: pictures(:)

      associate (model => job%model)
         call write_header(file, run, model, results)
         call write_deck(file, model, job%source)
         call write_warnings(file, warnings)

         call write_model(file, model)
         call write_materials(file, model)
         call write_joint_materials(file, model)
         call write_proportions(file, model)
         call write_nodes(file, model, results)
         call write_restraints(file, model, results)
         call write_elements(file, model, results)
         call write_interfaces(file, model)
         call write_joints(file, model, results)
         call write_supports(file, model)
         call write_loads(file, model)
         call write_truncations(file, model)
         call write_combinations(file, model)
         call write_increments(file, model)

         call write_in_situ(file, model, results%in_situ)
         call write_equations(file, results)
         call write_left_out(file, results)
         call write_convergence(file, model, results)
         call write_residuals(file, results)
         call write_increment_table(file, series)
         call write_yielding(file, model, results)
         call write_displacements(file, model, results)
         call write_total_displacements(file, model, results)
         call write_stresses(file, model, results)
         call write_extremes_round(file, model, results)
         call write_nodal_stresses(file, model, results)
         call write_joint_results(file, model, results)
         call write_edge(file, model, results)
         call write_interface_resultants(file, model, results)
         call write_sections(file, model, results)
         call write_cuts(file, model, results)
         call write_named_points(file, model, results, series)
         call write_reactions(file, model, results)
         call write_face_reactions(file, model, results)
         call write_equilibrium(file, model, results)
         if (job%options%estimated) then
            call write_budget(file, model, results)
            call write_yield_errors(file, results)
         else
            call write_heading(file, "ERRORS ARE NOT ESTIMATED (--no-estimates)")
         end if
         call write_singular(file, model, results)
         call write_rounds(file, results)
         call write_strips(file, model, results)
         call write_pictures(file, size(results%states), pictures)
      end associate
   end subroutine write_listing

   !> Times, once the other files are written, and the last line
   subroutine end_listing(file, results, timer)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results
      !> Times of the run
      type(timer_type), intent(in) :: timer

      call write_times(file, results, timer)
      call file%put("")
      call file%put(rule)
      if (results%converged) then
         call file%put("END OF LISTING")
      else
         call file%put("END OF LISTING   "//mark_not_converged)
      end if
   end subroutine end_listing

   !> Program, deck, date, status
   subroutine write_header(file, run, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Name tags of the run
      type(run_type), intent(in) :: run
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      call file%put(rule)
      call file%put(program_name//" "//program_version// &
         "   Fourier finite element analysis of axisymmetric bodies with joints")
      call write_lines(file, "title   ", model%title)
      call write_lines(file, "deck    ", run%deck)
      if (results%combination > 0) &
         call file%put("loads   combination "//to_text(results%combination))
      call file%put("date    "//run%date)
      call file%put("run     "//run%stamp)
      call write_lines(file, "status  ", convergence_text(results), of_words=.true.)
      call file%put(rule)
   end subroutine write_header

   !> The deck; of one that is too long keywords, and the first cards below them
   subroutine write_deck(file, model, source)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Cards of the deck
      type(source_type), intent(in) :: source

      logical, allocatable :: listed(:)
      integer :: card, n

      if (none_asked(model, print_deck)) return
      listed = chosen_lines(model, print_deck, source%n_cards)
      if (.not. all(listed)) then
         n = 0
         do card = 1, source%n_cards
            n = n + 1
            if (source%cards(card)%kind == card_keyword) n = 0
            listed(card) = listed(card) .or. n <= first_cards
         end do
      end if
      call write_echo(file, source, listed)
      call write_left(file, "DECK", count(listed), size(listed))
   end subroutine write_deck

end module axijoint_output_listing_contents
