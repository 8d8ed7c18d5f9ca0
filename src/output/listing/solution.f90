!> Tables of the listing that show equations, convergence, displacements,
!> reactions and equilibrium
module axijoint_output_listing_solution
   use axijoint_analysis_core_fields, only : n_resultants, torque
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_totals, only : circle_type, new_circle, total_displacement, n_unknowns
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_system, only : peak_memory_mb
   use axijoint_base_text, only : to_text, count_of
   use axijoint_base_timer, only : timer_type, n_phases, phase_names, phase_total
   use axijoint_fe_mode, only : mode_type, mode_name, family_symmetric
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : print_amplitude, print_totals, print_reactions, print_path
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_heading, write_lines, write_result_heading, mark_not_converged
   use axijoint_output_file_row, only : row_type
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_listing_choice, only : chosen_places, chosen_lines, none_asked, write_left
   use axijoint_output_listing_extremes, only : extremes_type, begin_table
   implicit none
   private
   public :: write_equations, write_convergence, write_displacements, write_total_displacements
   public :: write_reactions, write_equilibrium, write_times, convergence_text

   !> Columns of the number of an entry
   integer, parameter :: label = 10
   !> Harmonic and family, number of equations, entries of the factor
   character(len=*), parameter :: format_equations = '(i10, 1x, a1, i14, i16)'
   !> Increment and iteration
   character(len=*), parameter :: format_iteration = '(2i12)'
   !> Name of an order, its half-bandwidth, profile and fill
   character(len=*), parameter :: format_order = '(2x, a22, i10, 2i16)'
   !> Node that stands for a part
   character(len=*), parameter :: format_part = '(i16)'
   !> Points that slip and that are open
   character(len=*), parameter :: format_states = '(2i12)'
   !> Phase, its wall clock and processor time, its share
   character(len=*), parameter :: format_time = '(2x, a, t14, 2f14.3, f12.1)'
   !> Time of the increments, and of the error estimates, part of the phases above
   character(len=*), parameter :: format_increments = &
      '(2x, "increments", t14, f14.3, "  (part of joints)")'
   character(len=*), parameter :: format_estimates = &
      '(2x, "estimates", t14, f14.3, "  (part of joints and recover)")'
   !> Memory
   character(len=*), parameter :: format_memory = '(2x, a, t14, f14.1, a)'
   !> Bytes
   real(wp), parameter :: megabyte = 2.0_wp**20
   !> Columns of coordinates and of results
   integer, parameter :: narrow = 13, wide = 15

   !> Names of the components of displacement
   character(len=1), parameter :: components(3) = ["u", "v", "w"]
   !> Names of the resultants, in the order of the results
   character(len=34), parameter :: resultant_names(n_resultants) = [character(len=34) :: &
      "axial force (along z)", "lateral force (along theta = 0)", &
      "moment (lifts theta = 0)", "torque (about z)", "lateral force (along theta = 90)", &
      "moment (lifts theta = 90)"]

contains

   !> How the equations of each harmonic were solved
   subroutine write_equations(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      character(len=42) :: numbers
      character(len=66) :: order
      integer :: i

      call write_heading(file, "EQUATIONS ("//to_text(n_unknowns(results))//" unknowns in all)")
      call file%put("  solver: "//trim(results%solver%name)//", nodes ordered by "// &
         trim(results%solver%order_name))
      if (results%solver%note /= "") call file%put("  "//trim(results%solver%note))
      call file%put("  order of the nodes       bandwidth         profile            fill")
      do i = 1, size(results%orderings)
         associate (ordering => results%orderings(i))
            write (order, format_order) ordering%name, ordering%bandwidth, ordering%profile, &
               ordering%fill
            call file%put(order)
         end associate
      end do
      call file%put("  harmonic       equations  factor entries smallest pivot backward "// &
         "error      condition")
      do i = 1, size(results%solves)
         associate (solve => results%solves(i))
            write (numbers, format_equations) solve%mode%harmonic, family_letter(solve%mode), &
               solve%n_equations, &
               solve%factor_entries
            call file%put(numbers//columns([solve%smallest_pivot, solve%backward_error, &
               solve%condition], wide))
         end associate
      end do
   end subroutine write_equations

   !> Convergence path (Fig. 17), and how it ended
   subroutine write_convergence(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=24) :: steps, states
      logical :: listed(size(results%path))
      integer :: i

      call write_result_heading(file, "CONVERGENCE PATH", results%converged)
      listed = chosen_lines(model, print_path, size(results%path))
      if (any(listed)) then
         call file%put("  ("//to_text(size(results%joint_state))// &
            " states: joint points times planes; ratio of the whole or of the worst part, whichever is larger)")
         call file%put("   increment   iteration    load factor residual ratio        slip"// &
            "        open")
      end if
      do i = 1, size(results%path)
         if (.not. listed(i)) cycle
         associate (step => results%path(i))
            write (steps, format_iteration) step%increment, step%iteration
            write (states, format_states) step%n_slip, step%n_open
            call file%put(steps//columns([step%load_factor, step%ratio], wide)//states)
         end associate
      end do
      if (.not. none_asked(model, print_path)) &
         call write_left(file, "", count(listed), size(listed))
      call write_lines(file, "  ", convergence_text(results), of_words=.true.)
      if (.not. results%other_loop >= 0.0_wp) return
      if (results%accumulated) then
         call file%put("  joint stresses differ by up to "//to_text(100.0_wp*results%other_loop)// &
            " % of the largest from equilibrium on total relative displacements (NEWTON)")
      else
         call file%put("  the paper's loop to its tolerance of 3 % would leave joint stresses "// &
            "up to "// &
            to_text(100.0_wp*results%other_loop)//" % of the largest wrong")
      end if
   end subroutine write_convergence

   !> How the iteration ended, in a sentence
   pure function convergence_text(results) result(text)
      !> Results
      type(results_type), intent(in) :: results
      !> The sentence
      character(len=:), allocatable :: text

      character(len=:), allocatable :: ratio, tolerance

      ratio = to_text(results%residual_ratio)
      tolerance = to_text(results%tolerance)
      if (.not. results%converged .and. size(results%path) == 0) then
         text = mark_not_converged//" linear job: its equations are ill-conditioned; residual "// &
            "ratio "//ratio//", tolerance "//tolerance
      else if (allocated(results%mechanism) .or. results%strayed) then
         text = mark_not_converged//" after "//count_of(size(results%path), "iteration")//": "// &
            merge("they run away", "a mechanism  ", results%strayed)
         text = trim(text)//"; results are those of the last equilibrium, residual ratio "//ratio
      else if (.not. results%converged .and. results%residual_ratio <= results%tolerance .and. &
               results%mismatch <= results%tolerance) then
         text = mark_not_converged//" forces are balanced (residual ratio "//ratio// &
            ", tolerance "//tolerance//"), but iterations or rounding leave displacements or "// &
            "stresses less certain than that claims"
      else if (.not. results%converged .and. results%residual_ratio <= results%tolerance) then
         text = mark_not_converged//" joints are balanced (ratio "//ratio//"), jumps of the bodies differ by "// &
            to_text(results%mismatch)//", tolerance "//tolerance
      else if (.not. results%converged) then
         text = mark_not_converged//" residual ratio "//ratio//", tolerance "//tolerance// &
            ", after "//count_of(size(results%path), "iteration")//": these results are no equilibrium"
      else if (size(results%path) == 0) then
         text = "linear job, no joint can yield: no iterations; residual ratio "//ratio
      else
         text = "converged in "//count_of(size(results%path), "iteration")//": residual ratio "// &
            ratio//" within the tolerance "//tolerance
      end if
   end function convergence_text

   !> Displacement amplitudes of each harmonic
   subroutine write_displacements(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      logical :: listed(n_nodes(model%mesh))
      integer :: i

      if (none_asked(model, print_amplitude)) return
      listed = chosen_places(model, results, print_amplitude)
      do i = 1, size(results%modes)
         call write_nodes(file, model, "DISPLACEMENT AMPLITUDES, harmonic "// &
            mode_name(results%modes(i))//" ("//factors_text(results%modes(i))//")", &
            components, results%converged, listed, results%displacement(:, :, i))
      end do
   end subroutine write_displacements

   !> Sums of all harmonics at the angles of the deck
   subroutine write_total_displacements(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      real(wp), allocatable :: total(:, :)
      type(circle_type) :: circle
      logical :: listed(n_nodes(model%mesh))
      integer :: i, node

      if (none_asked(model, print_totals)) return
      listed = chosen_places(model, results, print_totals)
      allocate (total(3, size(listed)))
      do i = 1, size(model%output_angles)
         circle = new_circle(results%modes, model%output_angles(i))
         do node = 1, size(listed)
            total(:, node) = total_displacement(results%displacement(:, node, :), circle)
         end do
         call write_nodes(file, model, "TOTAL DISPLACEMENTS, theta = "// &
            to_text(circle%angle/degree)//" degrees", components, results%converged, listed, total)
      end do
   end subroutine write_total_displacements

   !> Reactions of the restrained nodes for each harmonic
   subroutine write_reactions(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      logical :: there(n_nodes(model%mesh)), listed(n_nodes(model%mesh))
      integer :: i, node

      if (none_asked(model, print_reactions)) return
      do i = 1, size(results%modes)
         do node = 1, size(there)
            there(node) = any(model%fixed(:, node) .or. abs(results%reaction(:, node, i)) > 0.0_wp)
         end do
         listed = chosen_places(model, results, print_reactions, there=there)
         call write_nodes(file, model, "REACTIONS, harmonic "//mode_name(results%modes(i))// &
            " (work over the circle on unit amplitudes)", ["R_u", "R_v", "R_w"], &
            results%converged, listed, results%reaction(:, :, i), there)
      end do
   end subroutine write_reactions

   !> Applied and reacted resultants
   subroutine write_equilibrium(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=16) :: node
      integer :: i

      call write_result_heading(file, "EQUILIBRIUM", results%converged)
      call file%put("                                            applied        "// &
         "reacted            sum")
      do i = 1, n_shown(results)
         call file%put("  "//resultant_names(i)//columns([results%applied(i), results%reacted(i), &
            results%applied(i) + results%reacted(i)], wide))
      end do
      call file%put("  equilibrium error (largest sum over the resultants of the loads)"// &
         columns([results%equilibrium_error], wide))
      if (size(results%part_node) < 2) return
      call file%put("")
      call file%put("  forces on each part that nothing balances: the joints' share of the "// &
         "residual")
      if (n_shown(results) == torque) then
         call file%put("  part with node      axial force  lateral force         "// &
            "moment         torque")
      else
         call file%put("  part with node      axial force  lateral force         "// &
            "moment         torque"// &
            "  lateral at 90   moment at 90")
      end if
      do i = 1, size(results%part_node)
         write (node, format_part) model%mesh%node_label(results%part_node(i))
         call file%put(node//columns(results%part_unbalance(:n_shown(results), i), wide))
      end do
      call file%put("  largest of these over the resultants of the loads"// &
         columns([results%part_error], wide))
   end subroutine write_equilibrium

   !> Where the time went, and the memory
   subroutine write_times(file, results, timer)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results, with the times of their error estimates
      type(results_type), intent(in) :: results
      !> Times of the run
      type(timer_type), intent(in) :: timer

      character(len=80) :: line
      real(wp) :: seconds(n_phases), total
      integer :: phase

      seconds = [(timer%seconds(phase), phase=1, n_phases)]
      total = max(seconds(phase_total), tiny(total))
      call write_heading(file, "TIMES (writing: up to here)")
      call file%put("                     seconds  processor s           %")
      do phase = 1, n_phases
         write (line, format_time) phase_names(phase), seconds(phase), &
            timer%cpu_seconds(phase), 100.0_wp*seconds(phase)/total
         call file%put(line)
      end do
      if (results%increment_seconds > 0.0_wp) then
         write (line, format_increments) results%increment_seconds
         call file%put(line)
      end if
      if (allocated(results%budget)) then
         write (line, format_estimates) sum(results%budget%seconds)
         call file%put(line)
      end if
      if (allocated(results%yield_errors)) then
         write (line, format_estimates) results%yield_errors%seconds
         call file%put(line)
      end if
      write (line, format_memory) "peak memory", peak_memory_mb(), " MB"
      call file%put(line)
      if (results%exchanged(2) == 0) return
      write (line, format_memory) "exchanged", results%exchanged(2)/megabyte, " MB"
      call file%put(line)
      write (line, format_memory) "in joints", results%exchanged(1)/megabyte, " MB"
      call file%put(line)
   end subroutine write_times

   !> A table of three components at nodes
   subroutine write_nodes(file, model, title, names, converged, listed, values, there)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Title, and names of the components
      character(len=*), intent(in) :: title, names(3)
      !> Whether the results are in equilibrium
      logical, intent(in) :: converged
      !> Nodes that are listed
      logical, intent(in) :: listed(:)
      !> Components along r, z, theta, shape (3, nodes)
      real(wp), intent(in) :: values(:, :)
      !> Nodes that belong to the table; all if absent
      logical, intent(in), optional :: there(:)

      character(len=15) :: wide_names(3)
      type(extremes_type) :: extremes
      logical :: belongs(size(listed))
      integer :: node

      belongs = .true.
      if (present(there)) belongs = there
      wide_names = adjustr([character(len=15) :: names])
      call begin_table(file, title, "      node            r            z"//wide_names(1)// &
         wide_names(2)//wide_names(3), converged, pack(listed, belongs), names, extremes)
      do node = 1, size(listed)
         if (listed(node)) call write_node(file, model, node, values(:, node))
         if (belongs(node)) call extremes%note(model%mesh%node_label(node), &
            model%mesh%coordinates(:, node), values(:, node))
      end do
      call extremes%write(file, count(listed), "node")
   end subroutine write_nodes

   !> Line of a node: number, r, z, three components
   subroutine write_node(file, model, node, components)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Index of the node
      integer, intent(in) :: node
      !> Along r, z, theta
      real(wp), intent(in) :: components(3)

      type(row_type) :: row

      call row%begin()
      call row%integers([model%mesh%node_label(node)], label)
      call row%reals(model%mesh%coordinates(:, node), narrow)
      call row%reals(components, wide)
      call row%put(file)
   end subroutine write_node

   !> Resultants worth showing: those along theta = 90 only if a load or a
   !> displacement is antisymmetric
   pure integer function n_shown(results)
      !> Results
      type(results_type), intent(in) :: results

      n_shown = merge(torque, n_resultants, all(results%modes%family == family_symmetric))
   end function n_shown

   !> S or A
   pure function family_letter(mode) result(letter)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The letter
      character(len=1) :: letter

      letter = merge("S", "A", mode%family == family_symmetric)
   end function family_letter

   !> What the components of a mode are multiplied by
   pure function factors_text(mode) result(text)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The words
      character(len=:), allocatable :: text

      text = "u, v ~ cos, w ~ sin"
      if (mode%family /= family_symmetric) text = "u, v ~ sin, w ~ -cos"
   end function factors_text

end module axijoint_output_listing_solution
