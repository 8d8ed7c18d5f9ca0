!> How much of a load in some direction joints can carry: the largest factor that there is
!> equilibrium for, on a path of growing load
module axijoint_study_envelope
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_static, only : analyse_combination
   use axijoint_base_error, only : error_type, exit_ok, exit_not_converged
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_progress, only : progress_type
   use axijoint_base_timer, only : timer_type
   use axijoint_model_load, only : increment_type, combination_type
   use axijoint_model_model, only : model_type
   use axijoint_output_file_run, only : exit_code_of
   implicit none
   private
   public :: capacity_type, search_direction

   !> What is found in a direction
   type :: capacity_type
      !> Largest factor with equilibrium, and the least known to have none; not found if there is
      !> equilibrium at the largest factor that is tried: `without` is zero then
      real(wp) :: factor = 0.0_wp, without = 0.0_wp
      !> 4 if a mechanism ends the path, 3 if the iteration found no equilibrium, 0 if nothing does
      integer :: code = exit_not_converged
      !> Increments that were solved
      integer :: n_increments = 0
      !> Time [second]
      real(wp) :: seconds = 0.0_wp
      !> The mechanism, in words
      character(len=:), allocatable :: message
   end type capacity_type

   !> An increment that finds no equilibrium is halved so often at most: its part that is left open
   real(wp), parameter :: left_open = 1.0_wp/64.0_wp
   !> Factors grow to at most this power of two times the first one
   integer, parameter :: most_doublings = 40
   !> Where even the first of them finds nothing, the search begins anew with so small a part of what had none, so often
   integer, parameter :: most_beginnings = 3
   real(wp), parameter :: smaller = 2.0_wp**(-12)
   !> Rounds of a search, each closing in on what the one before it left open
   integer, parameter :: most_rounds = 6

contains

   !> Search along a direction
   subroutine search_direction(model, structure, control, direction, first, tolerance, timer, &
      progress, capacity, error)
      !> The job; its increments come first
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(inout) :: structure
      !> Tolerance and iterations of the increments of growing load
      type(increment_type), intent(in) :: control
      !> Multiple of each load case, shape (cases)
      real(wp), intent(in) :: direction(:)
      !> Factor to begin with, below the capacity if possible
      real(wp), intent(in) :: first
      !> Part of the factor that may be left open
      real(wp), intent(in) :: tolerance
      !> Times of the phases, and where progress is shown
      type(timer_type), intent(inout) :: timer
      type(progress_type), intent(inout) :: progress
      !> What is found
      type(capacity_type), intent(out) :: capacity
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      real(wp), allocatable :: factors(:)
      real(wp) :: before(2)
      integer(i8) :: start, now, rate
      integer :: k, round, n_smaller

      call system_clock(start, rate)
      capacity%message = ''
      factors = [first, (first*2.0_wp**k, k=0, most_doublings)]
      n_smaller = 0
      round = 0
      do while (round < most_rounds)
         round = round + 1
         before = [capacity%factor, capacity%without]
         call follow(model, structure, control, direction, factors, timer, progress, capacity, &
            error)
         if (allocated(error)) return
         if (capacity%code == exit_ok) then
            if (round == 1) exit
            ! smaller steps came beyond what larger ones did not reach: on from there
            factors = [path_to(capacity%factor), &
                       (capacity%factor*2.0_wp**(k - 5), k=0, most_doublings)]
         else if (capacity%factor < before(1)) then
            capacity%factor = before(1)  ! another path came farther
            capacity%without = before(2)
            exit
         else if (.not. capacity%factor > 0.0_wp) then
            ! nothing was reached: the first factor may have been far too large
            if (n_smaller == most_beginnings .or. .not. capacity%without > 0.0_wp) exit
            n_smaller = n_smaller + 1
            round = 0
            factors = [(smaller*capacity%without*2.0_wp**max(0, k - 1), k=0, most_doublings)]
         else if (capacity%without - capacity%factor <= tolerance*capacity%without) then
            exit
         else
            factors = [path_to(capacity%factor), capacity%without - capacity%factor]
         end if
      end do
      call system_clock(now)
      capacity%seconds = real(now - start, wp)/rate
   end subroutine search_direction

   !> Increments of a load that end at a factor: half of it, half of the rest, ...
   pure function path_to(factor) result(factors)
      !> The factor
      real(wp), intent(in) :: factor
      !> The increments
      real(wp) :: factors(5)

      integer :: k

      factors = [(factor*0.5_wp**k, k=1, 4), factor*0.5_wp**4]
   end function path_to

   !> Follow a path of growing load to its end
   subroutine follow(model, structure, control, direction, factors, timer, progress, capacity, &
      error)
      !> The job
      type(model_type), intent(in) :: model
      !> Its structure
      type(structure_type), intent(inout) :: structure
      !> Tolerance and iterations
      type(increment_type), intent(in) :: control
      !> Multiple of each load case
      real(wp), intent(in) :: direction(:)
      !> Factors of the increments
      real(wp), intent(in) :: factors(:)
      !> Times of the phases, and where progress is shown
      type(timer_type), intent(inout) :: timer
      type(progress_type), intent(inout) :: progress
      !> Takes the ends of what is open
      type(capacity_type), intent(inout) :: capacity
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(model_type), target :: loaded
      type(results_type) :: results
      type(increment_type) :: increment
      real(wp) :: base, reached
      integer :: k, n_base, last

      loaded = model
      n_base = size(model%increments)
      increment = control
      increment%case = 0
      increment%direction = direction
      deallocate (loaded%increments)
      allocate (loaded%increments(n_base + size(factors)))
      do k = 1, n_base
         loaded%increments(k) = model%increments(k)
      end do
      do k = 1, size(factors)
         loaded%increments(n_base + k) = increment
         loaded%increments(n_base + k)%factor = factors(k)
      end do
      call analyse_combination(loaded, structure, loaded%combinations(1), results, timer, &
         progress, error, estimated=.false.)
      if (allocated(error)) return
      capacity%code = exit_code_of(results)
      capacity%n_increments = capacity%n_increments + size(results%states)
      capacity%message = ''
      if (allocated(results%mechanism)) capacity%message = results%mechanism
      base = sum(model%increments%factor)
      last = size(results%states)
      if (capacity%code == exit_ok) then
         capacity%factor = sum(factors)
         capacity%without = 0.0_wp
         return
      end if
      reached = results%states(last)%load_factor
      if (.not. allocated(results%mechanism)) then
         reached = 0.0_wp
         if (last > 1) reached = results%states(last - 1)%load_factor
      end if
      if (results%states(last)%increment <= n_base) return  ! what comes first is not carried
      k = results%states(last)%increment - n_base
      capacity%factor = max(0.0_wp, reached - base)
      capacity%without = min(sum(factors(:k)), capacity%factor + left_open*factors(k))
      if (.not. allocated(results%mechanism)) capacity%without = sum(factors(:k))
   end subroutine follow

end module axijoint_study_envelope
