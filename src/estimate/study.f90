!> What a study will take: its structures, and its rows on them
module axijoint_estimate_study
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_error, only : error_type, fatal_error, exit_deck
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : free_memory
   use axijoint_base_timer, only : timer_type, phase_assemble
   use axijoint_estimate_forecast, only : forecast_type, plan_run, term_seconds
   use axijoint_estimate_iterations, only : n_iterations
   use axijoint_estimate_machine, only : machine_type
   use axijoint_estimate_peak, only : peak_bytes
   use axijoint_estimate_terms, only : n_terms, beginning, reading, ordering, files, rows
   use axijoint_estimate_work, only : structure_work, state_work, row_work
   use axijoint_model_model, only : model_type
   use axijoint_study_parts, only : part_type, first_row, last_row, processes_that_pay
   use axijoint_study_quantities, only : quantity_names
   use axijoint_study_rows, only : rows_type, row_type, make_row, row_order
   use axijoint_study_table, only : study_table_type
   use omp_lib, only : omp_get_max_threads
   implicit none
   private
   public :: study_size_type, forecast_study

   !> Structures that are planned; others are taken to be like these on average
   integer, parameter :: most_samples = 5
   !> Structures that are looked at, whether any of their rows can be solved
   integer, parameter :: most_judged = 100
   !> Bytes that rows without estimates of errors take less than a run with its files, as measured
   integer(i8), parameter :: spared_bytes = 1000000_i8
   !> Bytes of a real, and of a row in the table of results and in the journal beside its numbers
   real(wp), parameter :: real_bytes = 8.0_wp, row_bytes = 1000.0_wp

   !> Size of a study
   type :: study_size_type
      !> Rows, and structures that they need
      integer :: n_rows = 0, n_structures = 0
   end type study_size_type

contains

   !> Forecast a study
   subroutine forecast_study(table, shared, part, machine, each, forecast, extent, error)
      !> What varies
      type(study_table_type), intent(in) :: table
      !> What rows share
      type(rows_type), intent(inout), target :: shared
      !> The part to solve
      type(part_type), intent(in) :: part
      !> The machine
      type(machine_type), intent(in) :: machine
      !> Iterations of an increment; zero for what is usual
      integer, intent(in) :: each
      !> The forecast
      type(forecast_type), intent(out) :: forecast
      !> How large the study is
      type(study_size_type), intent(out) :: extent
      !> No row can be solved: why the first cannot
      type(error_type), allocatable, intent(out) :: error

      type(error_type), allocatable :: refused
      real(wp) :: work(n_terms, 2), iterations
      integer, allocatable :: order(:), first(:)
      integer :: k, n_samples, n_good

      order = row_order(table, shared%keeps_structure)
      order = order(first_row(part, size(order)):last_row(part, size(order)))
      extent%n_rows = size(order)
      call rows_of_structures(table, shared, order, first, extent%n_structures)
      n_samples = min(most_samples, size(first))
      work = 0.0_wp
      iterations = 0.0_wp
      n_good = 0
      do k = 1, n_samples
         call sample(first(1 + ((k - 1)*(size(first) - 1))/max(1, n_samples - 1)))
      end do
      do k = 1, size(order)
         if (n_good > 0) exit
         call sample(order(k))
      end do
      if (n_good == 0) then
         call move_alloc(refused, error)
         return
      end if
      work = work/n_good
      if (.not. shared%estimated) forecast%memory = forecast%memory - spared_bytes
      forecast%iterations = extent%n_rows*iterations/n_good
      forecast%work = extent%n_structures*work(:, 1) + extent%n_rows*work(:, 2)
      forecast%work(beginning) = 1.0_wp
      forecast%work(files) = 1.0_wp
      if (part%n == 0) call share_rows(work, extent, machine, shared%options%memory_limit, forecast)

   contains

      !> Take a row into account, and the structure that it begins
      subroutine sample(number)
         !> Its number
         integer, intent(in) :: number

         type(model_type), target :: model
         type(row_type) :: row
         type(structure_type) :: structure
         type(timer_type) :: clock
         type(error_type), allocatable :: why
         real(wp) :: start, finish, numbers
         integer :: again

         do again = 1, 2  ! the second time as most rows find it, the mesh being there
            row = row_type()
            row%message = ''
            call cpu_time(start)
            call make_row(table, number, shared, model, row)
            call cpu_time(finish)
            if (len(row%message) > 0) then
               if (.not. allocated(refused)) call fatal_error(refused, exit_deck, row%message)
               return
            end if
         end do
         call plan_run(model, clock, structure, why, shared%estimated)
         if (allocated(why)) then
            if (.not. allocated(refused)) call move_alloc(why, refused)
            return
         end if
         n_good = n_good + 1
         work(:, 1) = work(:, 1) + structure_work(model, structure, machine%product_rate)
         work(ordering, 1) = work(ordering, 1) + clock%cpu_seconds(phase_assemble)
         work(:, 2) = work(:, 2) + row_work(model, structure) + &
            state_work(model, structure, n_iterations(model, each), shared%estimated, run=.false.)
         work(reading, 2) = work(reading, 2) + finish - start
         work(rows, 2) = work(rows, 2) + size(model%increments)
         iterations = iterations + n_iterations(model, each)
         numbers = size(quantity_names(model))*real(size(model%increments), wp)
         forecast%disk = max(forecast%disk, extent%n_rows*(3.0_wp*real_bytes*numbers + row_bytes))
         forecast%memory = max(forecast%memory, peak_bytes(model, structure, machine%program_bytes) &
                               + nint(2.0_wp*real_bytes*numbers*extent%n_rows, i8))
         forecast%n_workers = structure%equations%n_workers
      end subroutine sample

   end subroutine forecast_study

   !> Share the rows among processes where a study would
   subroutine share_rows(work, extent, machine, memory_limit, forecast)
      !> Counts of a structure and of a row, shape (terms, 2)
      real(wp), intent(in) :: work(:, :)
      !> How large the study is
      type(study_size_type), intent(in) :: extent
      !> The machine
      type(machine_type), intent(in) :: machine
      !> Bytes that the user lets the process take in all
      integer(i8), intent(in) :: memory_limit
      !> Forecast of one process; then of all
      type(forecast_type), intent(inout) :: forecast

      type(forecast_type) :: one
      real(wp) :: structure, row

      one%work = work(:, 1)
      structure = sum(term_seconds(one, machine, 1))
      one%work = work(:, 2)
      row = sum(term_seconds(one, machine, 1))
      associate (n_others => max(1, extent%n_rows - 1), n => forecast%n_processes)
         n = processes_that_pay(row + structure*(extent%n_structures - 1)/n_others, &
            row + structure, extent%n_rows - 2, omp_get_max_threads())
         n = max(1, int(min(int(n, i8), free_memory(memory_limit)/forecast%memory)))
         if (n == 1) return
         forecast%apart = structure*(1.0_wp + max(0.0_wp, 1.0_wp - real(extent%n_structures, wp)/n))
         forecast%n_workers = 1
         forecast%memory = n*forecast%memory + machine%program_bytes
      end associate
   end subroutine share_rows

   !> A row of each structure that can be solved. Structures of rows that the deck refuses are not made
   subroutine rows_of_structures(table, shared, order, first, n_structures)
      !> What varies
      type(study_table_type), intent(in) :: table
      !> What rows share
      type(rows_type), intent(inout), target :: shared
      !> Numbers of the rows in their order
      integer, intent(in) :: order(:)
      !> The rows, of many structures some
      integer, allocatable, intent(out) :: first(:)
      !> How many structures there are; of many as the share is of those that are looked at
      integer, intent(out) :: n_structures

      type(model_type), target :: model
      type(row_type) :: row
      integer, allocatable :: begins(:)
      integer :: k, i, place, last, n_judged

      begins = pack([(k, k=1, size(order))], begins_structure(table, shared%keeps_structure, order))
      n_judged = min(most_judged, size(begins))
      allocate (first(0))
      do k = 1, n_judged
         place = 1 + ((k - 1)*(size(begins) - 1))/max(1, n_judged - 1)
         last = size(order)
         if (place < size(begins)) last = begins(place + 1) - 1
         do i = begins(place), last
            row = row_type()
            row%message = ''
            call make_row(table, order(i), shared, model, row)
            if (len(row%message) > 0) cycle
            first = [first, order(i)]
            exit
         end do
      end do
      n_structures = nint(real(size(first), wp)*size(begins)/max(1, n_judged))
   end subroutine rows_of_structures

   !> Which rows need another structure than the one before, as far as their columns tell
   pure function begins_structure(table, keeps_structure, order) result(begins)
      !> What varies
      type(study_table_type), intent(in) :: table
      !> Columns that leave the structure alone
      logical, intent(in) :: keeps_structure(:)
      !> Numbers of the rows in their order
      integer, intent(in) :: order(:)
      !> Shape (rows)
      logical :: begins(size(order))

      integer :: k

      if (size(order) > 0) begins(1) = .true.
      do k = 2, size(order)
         begins(k) = any(.not. keeps_structure &
            .and. (abs(table%values(:, order(k)) - table%values(:, order(k - 1))) > 0.0_wp &
                   .or. (table%given(:, order(k)) .neqv. table%given(:, order(k - 1)))))
      end do
   end function begins_structure

end module axijoint_estimate_study
