!> How much of a load in some direction joints can carry: the largest factor that there is
!> equilibrium for, on a path of growing load
module axijoint_study_envelope
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_static, only : analyse_combination
   use axijoint_base_error, only : error_type, fatal_error, exit_ok, exit_not_converged, exit_singular
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_progress, only : progress_type
   use axijoint_base_timer, only : timer_type
   use axijoint_model_load, only : increment_type, combination_type
   use axijoint_model_model, only : model_type
   use axijoint_output_file_run, only : exit_code_of
   use axijoint_output_listing_solution, only : convergence_text
   implicit none
   private
   public :: capacity_type, search_direction

   !> What is found in a direction
   type :: capacity_type
      !> Largest factor that equilibrium was found for, and the least at which none was; not found if
      !> there is equilibrium at the largest factor that is tried: `without` is zero then
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
   !> Paths that close in on what is open, at most
   integer, parameter :: most_rounds = 12
   !> Where a path comes no farther than the farthest one: the parts of what is open that the next ones go to first, one
   !> after the other. Joints slip otherwise on the way there, and what depends on rounding goes otherwise
   real(wp), parameter :: detours(7) = [0.5_wp, 0.25_wp, 0.75_wp, 0.125_wp, 0.375_wp, 0.625_wp, 0.875_wp]

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
      !> Out of memory; the increments that come first have no equilibrium
      type(error_type), allocatable, intent(out) :: error

      type(capacity_type) :: found
      real(wp), allocatable :: factors(:)
      real(wp) :: greatest, share
      integer(i8) :: start, now, rate
      integer :: k, round, n_smaller, n_detours

      call system_clock(start, rate)
      factors = [first, (first*2.0_wp**k, k=0, most_doublings)]
      do n_smaller = 0, most_beginnings
         call follow(model, structure, control, direction, factors, timer, progress, capacity, error)
         if (allocated(error)) return
         if (capacity%factor > 0.0_wp .or. .not. capacity%without > 0.0_wp) exit
         ! nothing was reached: the first factor may have been far too large
         factors = [(smaller*capacity%without*2.0_wp**max(0, k - 1), k=0, most_doublings)]
      end do
      greatest = sum(factors)
      n_detours = 0
      do round = 1, most_rounds
         if (.not. capacity%factor > 0.0_wp .or. capacity%code == exit_ok) exit
         if (is_closed(capacity, tolerance)) exit
         if (n_detours > size(detours)) exit
         share = 0.0_wp
         if (n_detours > 0) share = detours(n_detours)
         found%n_increments = capacity%n_increments
         factors = path_within(capacity, share, tolerance, greatest)
         call follow(model, structure, control, direction, factors, timer, progress, found, error)
         if (allocated(error)) return
         capacity%n_increments = found%n_increments
         n_detours = n_detours + 1
         if (.not. is_better(found, capacity, tolerance)) cycle
         capacity = found
         if (capacity%without - capacity%factor > tolerance*capacity%without) n_detours = 0
      end do
      call system_clock(now)
      capacity%seconds = real(now - start, wp)/rate
   end subroutine search_direction

   !> Whether a mechanism ends the path, and so little is open that no other path is needed. Where the iteration found
   !> nothing, another path may come farther
   pure logical function is_closed(capacity, tolerance)
      !> What the path came to
      type(capacity_type), intent(in) :: capacity
      !> Part of the factor that may be left open
      real(wp), intent(in) :: tolerance

      is_closed = capacity%code == exit_singular .and. &
                  capacity%without - capacity%factor <= tolerance*capacity%without
   end function is_closed

   !> Whether a path came farther than another, or as far, and tells more of what is beyond. A mechanism tells more than an
   !> iteration that found nothing: for it a path may fall short by what may be left open
   pure logical function is_better(path, other, tolerance)
      !> What they came to
      type(capacity_type), intent(in) :: path, other
      !> Part of the factor that may be left open
      real(wp), intent(in) :: tolerance

      if (is_closed(path, tolerance) .and. other%code == exit_not_converged) then
         is_better = path%factor >= (1.0_wp - tolerance)*other%factor
      else if (path%factor < other%factor .or. path%factor > other%factor) then
         is_better = path%factor > other%factor
      else if (path%code == exit_singular .neqv. other%code == exit_singular) then
         is_better = path%code == exit_singular
      else
         is_better = path%without < other%without
      end if
   end function is_better

   !> Increments of a load that go to a part of what is open, through the rest of it, and on, for this path may come
   !> beyond what another did not reach. Where an iteration found nothing, no less than may be left open is gone through
   !> in other steps: what it is that numbers cannot tell apart there is not asked more and more closely
   pure function path_within(capacity, share, tolerance, greatest) result(factors)
      !> What is open
      type(capacity_type), intent(in) :: capacity
      !> The part
      real(wp), intent(in) :: share
      !> Part of the factor that may be left open
      real(wp), intent(in) :: tolerance
      !> Where nothing ends the path
      real(wp), intent(in) :: greatest
      !> The increments
      real(wp), allocatable :: factors(:)

      real(wp) :: open
      integer :: k, n

      open = capacity%without - capacity%factor
      if (capacity%code == exit_not_converged) open = max(open, tolerance*capacity%without)
      n = 0
      if (greatest > capacity%without) n = ceiling(log(greatest/capacity%without)/log(2.0_wp)) + 6
      factors = [path_to(capacity%without - (1.0_wp - share)*open), (1.0_wp - share)*open, &
                 (capacity%without*2.0_wp**(k - 6), k=1, n)]
   end function path_within

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
      !> Takes the ends of what is open, and what ends the path
      type(capacity_type), intent(inout) :: capacity
      !> Out of memory; the increments that come first have no equilibrium
      type(error_type), allocatable, intent(out) :: error

      type(model_type), target :: loaded
      type(results_type) :: results
      type(increment_type) :: increment
      real(wp) :: base
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
      capacity%factor = sum(factors)
      capacity%without = 0.0_wp
      if (capacity%code == exit_ok) return
      capacity%factor = 0.0_wp
      base = sum(model%increments%factor)
      last = size(results%states)
      k = results%states(last)%increment - n_base
      if (k <= 0) then  ! what comes first is not carried: no direction has a capacity
         if (.not. allocated(results%mechanism)) capacity%message = convergence_text(results)
         capacity%message = capacity%message(:index(capacity%message//'; results are', '; results are') - 1)
         call fatal_error(error, capacity%code, 'no equilibrium was found of the increments that come first, so '// &
            'nothing can be searched'//new_line('a')//capacity%message)
         return
      end if
      capacity%factor = max(0.0_wp, results%reached - base)
      if (allocated(results%mechanism)) then
         capacity%without = min(sum(factors(:k)), capacity%factor + left_open*factors(k))
      else
         ! the step that failed, which may be a part of the increment
         capacity%without = min(sum(factors(:k)), results%states(last)%load_factor - base)
      end if
   end subroutine follow

end module axijoint_study_envelope
