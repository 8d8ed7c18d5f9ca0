!> What `axijoint estimate` prints
module axijoint_command_estimate_table
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, count_of
   use axijoint_estimate_body_work, only : n_body_points
   use axijoint_estimate_forecast, only : forecast_type, term_seconds, phase_seconds, &
      whole_seconds
   use axijoint_estimate_machine, only : machine_type, reference
   use axijoint_estimate_study, only : study_size_type
   use axijoint_estimate_terms, only : terms, n_terms, n_phases, phase_names
   use axijoint_estimate_joint_work, only : n_yielding
   use axijoint_job_job, only : deck_name
   use axijoint_model_model, only : model_type, bodies_yield, method_names, &
      body_method_names
   implicit none
   private
   public :: print_forecast, print_counts, deck_text, study_text

   character(len=*), parameter :: format_seconds = '(2x, a10, f12.3, 2x, a)'
   character(len=*), parameter :: format_count = '(a, t17, es16.8, es14.6)'
   real(wp), parameter :: megabyte = 2.0_wp**20

contains

   !> Seconds by phase, memory, disk
   subroutine print_forecast(model, forecast, machine, each)
      !> The job
      type(model_type), intent(in) :: model
      !> What it takes
      type(forecast_type), intent(in) :: forecast
      !> The machine
      type(machine_type), intent(in) :: machine
      !> Iterations of an increment that the user expects; 0 if none are given
      integer, intent(in) :: each

      real(wp) :: seconds(n_terms), phases(n_phases)
      integer :: p

      seconds = term_seconds(forecast, machine, merge(1, forecast%n_workers, &
         forecast%n_processes > 1))
      phases = phase_seconds(seconds)
      write (output_unit, '(a)') '  phase          seconds  most of it'
      do p = 1, n_phases
         if (.not. phases(p) > 0.0_wp) cycle
         write (output_unit, format_seconds) phase_names(p), phases(p), &
            trim(terms(maxloc(seconds, 1, mask=terms%phase == p))%what)
      end do
      write (output_unit, format_seconds) 'total', whole_seconds(forecast, machine), &
         total_text(forecast, machine)
      write (output_unit, '(a, f10.1, a)') '  memory      ', forecast%memory/megabyte, ' MB'
      write (output_unit, '(a, f10.1, a)') '  files       ', forecast%disk/megabyte, ' MB'
      call print_assumptions(model, forecast, each)
   end subroutine print_forecast

   !> First line: a deck and its size; what users of the solver should know
   function deck_text(deck, model, structure) result(text)
      !> The deck
      character(len=*), intent(in) :: deck
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> The line
      character(len=:), allocatable :: text

      integer :: k, n_unknowns, n_points

      associate (equations => structure%equations)
         n_unknowns = 0
         do k = 1, size(structure%modes)
            associate (system => equations%systems(equations%system(k)))
               n_unknowns = n_unknowns + equations%classes(system%class)%dofs%n_equations
            end associate
         end do
         text = deck_name(deck)//': '//to_text(n_unknowns)//' unknowns in '// &
            count_of(size(structure%modes), 'harmonic')//', '//trim(equations%solver%name)
         if (equations%n_kept > 0 .and. equations%n_kept < size(equations%systems)) text = text// &
            ', '//to_text(equations%n_kept)//' factors kept'
      end associate
      n_points = n_yielding(model, structure)
      if (n_points > 0) text = text//', '//count_of(n_points, 'joint point')//' on '// &
         count_of(model%n_planes, 'plane')
      if (bodies_yield(model)) text = text//', '//count_of(n_body_points(model), &
         'point')//' of bodies that yield'
      if (size(model%increments) > 1) text = text//', '// &
         count_of(size(model%increments), 'increment')
      if (size(model%combinations) > 1) text = text//', '// &
         count_of(size(model%combinations), 'combination')
      associate (note => structure%equations%solver%note)
         if (note /= '') text = text//new_line('a')//'  '//trim(note)
      end associate
   end function deck_text

   !> First line: a study and its size
   pure function study_text(table, extent) result(text)
      !> The table
      character(len=*), intent(in) :: table
      !> Its size
      type(study_size_type), intent(in) :: extent
      !> The line
      character(len=:), allocatable :: text

      text = table//': '//count_of(extent%n_rows, 'row')//' on '// &
         count_of(extent%n_structures, 'structure')
   end function study_text

   !> What stands beside the total
   function total_text(forecast, machine) result(text)
      !> What the job takes
      type(forecast_type), intent(in) :: forecast
      !> The machine
      type(machine_type), intent(in) :: machine
      !> The text
      character(len=:), allocatable :: text

      text = 'one thread'
      if (forecast%n_workers > 1) text = to_text(forecast%n_workers)//' threads; '// &
         to_text(forecast%rounds*sum(term_seconds(forecast, machine, 1)))//' s of one processor'
      if (forecast%n_processes > 1) text = 'rows by '//to_text(forecast%n_processes)// &
         ' processes, '//to_text(forecast%apart)//' s for structures of their own; '// &
         to_text(sum(term_seconds(forecast, machine, 1)))//' s by one thread'
      if (forecast%n_rounds > 1) text = text//', '//to_text(forecast%n_rounds)// &
         ' rounds assumed: memory and files are of the last, and a strict ERROR may take more'
   end function total_text

   !> What nobody knows before, and what was assumed
   subroutine print_assumptions(model, forecast, each)
      !> The job
      type(model_type), intent(in) :: model
      !> What it takes
      type(forecast_type), intent(in) :: forecast
      !> Iterations of an increment that the user expects; 0 if none are given
      integer, intent(in) :: each

      character(len=:), allocatable :: method

      if (.not. forecast%iterations > 0.0_wp) return
      method = trim(method_names(model%method))
      if (bodies_yield(model)) method = trim(body_method_names(model%body_method))
      write (output_unit, '(a)') '  '//to_text(nint(forecast%iterations))// &
         ' iterations of '//method//trim(merge(' as said', ' assumed', each > 0))// &
         '; --iterations N assumes N an increment'
      if (bodies_yield(model)) write (output_unit, '(a)') &
         '  near a limit load bodies that yield take many times as many'
   end subroutine print_assumptions

   !> All terms: name, count, seconds of one; rates here and where these were fitted; what else is
   !> expected
   subroutine print_counts(forecast, machine)
      !> What the job takes
      type(forecast_type), intent(in) :: forecast
      !> The machine
      type(machine_type), intent(in) :: machine

      integer :: k

      do k = 1, n_terms
         write (output_unit, format_count) terms(k)%name, forecast%work(k), terms(k)%seconds
      end do
      write (output_unit, format_count) 'product_rate', machine%product_rate, &
         reference%product_rate, 'text_rate', machine%text_rate, reference%text_rate, &
         'iterations', forecast%iterations, 0.0_wp, &
         'factors', real(forecast%n_factors, wp), 0.0_wp, 'operations', forecast%operations, 0.0_wp, &
         'memory', forecast%memory/megabyte, 0.0_wp, 'disk', forecast%disk/megabyte, 0.0_wp
   end subroutine print_counts

end module axijoint_command_estimate_table
