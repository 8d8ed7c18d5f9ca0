!> What a run of a deck will take: seconds by phase, memory, disk
module axijoint_estimate_forecast
   use axijoint_analysis_core_structure, only : structure_type, expect_estimates, plan_structure
   use axijoint_assembly_equations, only : factoring_operations
   use axijoint_base_error, only : error_type, exit_memory
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_progress, only : progress_type
   use axijoint_base_timer, only : timer_type, phase_read, phase_assemble
   use axijoint_deck_text_source, only : source_type
   use axijoint_estimate_iterations, only : n_iterations
   use axijoint_estimate_machine, only : machine_type, reference
   use axijoint_estimate_peak, only : peak_bytes
   use axijoint_estimate_terms, only : terms, n_terms, n_phases, common, products, beginning, &
      reading, ordering
   use axijoint_estimate_volume, only : add_volume
   use axijoint_estimate_work, only : structure_work, state_work
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: forecast_type, plan_run, forecast_run, term_seconds, phase_seconds, whole_seconds

   !> A forecast
   type :: forecast_type
      !> Counts of all terms
      real(wp) :: work(n_terms) = 0.0_wp
      !> Harmonics that are worked on at once, and factors that are there at once
      integer :: n_workers = 1, n_factors = 0
      !> Rounds that an error target is expected to take, and what they take beside the first
      integer :: n_rounds = 1
      real(wp) :: rounds = 1.0_wp
      !> Processes that share the rows of a study, and what each does beside its rows [second]
      integer :: n_processes = 1
      real(wp) :: apart = 0.0_wp
      !> Iterations of all increments and combinations
      real(wp) :: iterations = 0.0_wp
      !> Floating-point operations of one factorization of all systems
      real(wp) :: operations = 0.0_wp
      !> Bytes at the peak, and on the disk
      integer(i8) :: memory = 0
      real(wp) :: disk = 0.0_wp
   end type forecast_type

   !> Rounds of a job with an error target that are usual, and how many times as long each is as the
   !> one before
   integer, parameter :: usual_rounds = 3
   real(wp), parameter :: longer_round = 3.0_wp

contains

   !> Plan the equations of a job as a run would, and measure how long that takes
   subroutine plan_run(model, timer, structure, error, estimated, no_room, listed)
      !> The job
      type(model_type), intent(in) :: model
      !> Takes the time
      type(timer_type), intent(inout) :: timer
      !> The structure, planned
      type(structure_type), intent(out) :: structure
      !> A mechanism
      type(error_type), allocatable, intent(out) :: error
      !> Whether errors are estimated; true if absent
      logical, intent(in), optional :: estimated
      !> How a run would end here and now for want of memory; not allocated if it has the room
      type(error_type), allocatable, intent(out), optional :: no_room
      !> Whether results are listed; as errors are estimated if absent
      logical, intent(in), optional :: listed

      type(progress_type) :: progress

      call expect_estimates(model, structure, estimated)
      if (present(listed)) structure%listed = listed
      call timer%push(phase_assemble)
      call plan_structure(model, structure, progress, error)
      call timer%pop()
      if (.not. allocated(error)) return
      ! too little memory here is none of what the job takes
      if (error%code /= exit_memory .or. .not. allocated(structure%equations)) return
      if (present(no_room)) then
         call move_alloc(error, no_room)
      else
         deallocate (error)
      end if
   end subroutine plan_run

   !> Forecast a run of a planned job
   function forecast_run(model, source, structure, timer, machine, each, estimated) result(forecast)
      !> The job
      type(model_type), intent(in) :: model
      !> Cards of its deck
      type(source_type), intent(in) :: source
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> What reading and planning took
      type(timer_type), intent(in) :: timer
      !> The machine
      type(machine_type), intent(in) :: machine
      !> Iterations of an increment; zero for what is usual
      integer, intent(in) :: each
      !> Whether errors are estimated
      logical, intent(in) :: estimated
      !> The forecast
      type(forecast_type) :: forecast

      real(wp) :: n, of_one(n_terms)
      integer :: k

      n = size(model%combinations)
      forecast%iterations = n_iterations(model, each)
      of_one = state_work(model, structure, forecast%iterations/n, estimated, run=.true.)
      call add_volume(model, source, structure%modes, structure%joint_points, forecast%iterations/n, estimated, of_one, &
         forecast%disk)
      forecast%disk = n*forecast%disk
      associate (work => forecast%work)
         work = structure_work(model, structure, machine%product_rate) + n*of_one
         work(beginning) = 1.0_wp
         work(reading) = timer%cpu_seconds(phase_read)
         work(ordering) = timer%cpu_seconds(phase_assemble)
      end associate
      associate (equations => structure%equations)
         forecast%n_workers = equations%n_workers
         forecast%operations = factoring_operations(equations)
         forecast%n_factors = equations%n_kept + &
            min(equations%n_workers, size(equations%systems) - equations%n_kept)
      end associate
      forecast%memory = peak_bytes(model, structure, machine%program_bytes)
      if (.not. model%error_goal%wanted) return
      forecast%n_rounds = min(usual_rounds, model%error_goal%most_rounds)
      forecast%rounds = sum([(longer_round**k, k=0, forecast%n_rounds - 1)])
      ! memory and files are those of the last round, which grow like its time
      associate (last => longer_round**(forecast%n_rounds - 1))
         forecast%memory = machine%program_bytes + nint(last*(forecast%memory - machine%program_bytes), i8)
         forecast%disk = last*forecast%disk
      end associate
   end function forecast_run

   !> Seconds of each term
   pure function term_seconds(forecast, machine, n_workers) result(seconds)
      !> The forecast
      type(forecast_type), intent(in) :: forecast
      !> The machine
      type(machine_type), intent(in) :: machine
      !> Harmonics at once; 1 for the time of all processors together
      integer, intent(in) :: n_workers
      !> Of all terms
      real(wp) :: seconds(n_terms)

      integer :: k

      do k = 1, n_terms
         seconds(k) = forecast%work(k)*terms(k)%seconds
         if (terms(k)%speed == common) &
            seconds(k) = seconds(k)*reference%text_rate/machine%text_rate
         if (terms(k)%speed == products) &
            seconds(k) = seconds(k)*reference%product_rate/machine%product_rate
         if (terms(k)%shared) seconds(k) = seconds(k)/n_workers
      end do
   end function term_seconds

   !> Seconds from begin to end, by threads or processes
   pure real(wp) function whole_seconds(forecast, machine) result(seconds)
      !> The forecast
      type(forecast_type), intent(in) :: forecast
      !> The machine
      type(machine_type), intent(in) :: machine

      if (forecast%n_processes > 1) then
         seconds = forecast%apart + sum(term_seconds(forecast, machine, 1))/forecast%n_processes
      else
         seconds = forecast%rounds*sum(term_seconds(forecast, machine, forecast%n_workers))
      end if
   end function whole_seconds

   !> Seconds of each phase
   pure function phase_seconds(seconds) result(total)
      !> Of all terms
      real(wp), intent(in) :: seconds(n_terms)
      !> Of all phases
      real(wp) :: total(n_phases)

      integer :: p

      total = [(sum(seconds, mask=terms%phase == p), p=1, n_phases)]
   end function phase_seconds

end module axijoint_estimate_forecast
