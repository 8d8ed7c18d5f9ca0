!> Where the time of a run goes: a wall clock and a processor clock a phase
module axijoint_base_timer
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : note_stage
   implicit none
   private
   public :: timer_type, n_phases, phase_names
   public :: phase_read, phase_assemble, phase_factor, phase_joints
   public :: phase_recover, phase_write, phase_total

   !> Reading and checking the deck
   integer, parameter :: phase_read = 1
   !> Element matrices, pattern, loads
   integer, parameter :: phase_assemble = 2
   !> Factorizations
   integer, parameter :: phase_factor = 3
   !> Iteration on the joints
   integer, parameter :: phase_joints = 4
   !> Displacements and stresses of the whole body
   integer, parameter :: phase_recover = 5
   !> Files of results
   integer, parameter :: phase_write = 6
   !> The run since `start`, whatever the phase
   integer, parameter :: phase_total = 7
   !> Number of phases, the total among them
   integer, parameter :: n_phases = 7
   !> Name of each phase
   character(len=8), parameter :: phase_names(n_phases) = [character(len=8) :: &
      "read", "assemble", "factor", "joints", "recover", "write", "total"]
   !> What is done in each
   character(len=24), parameter :: phase_words(n_phases) = [character(len=24) :: &
      "reading the deck", "assembling", "factoring", "iterating on the joints", &
      "finding stresses", "writing the results", ""]

   !> Deepest nesting of phases
   integer, parameter :: max_depth = 8

   !> Readings of both clocks [second]
   type :: reading_type
      !> Wall clock
      real(wp) :: wall = 0.0_wp
      !> Processor time of all threads
      real(wp) :: cpu = 0.0_wp
   end type reading_type

   !> Times of a run. A phase that is pushed stops the clock of the phase
   !> below it until it is popped, so the phases never count a second twice.
   !> Before `start` every time is zero.
   type :: timer_type
      private
      !> Whether `start` was called
      logical :: started = .false.
      !> Clocks at the start
      type(reading_type) :: origin
      !> Clocks when the running phase was pushed or went on
      type(reading_type) :: resumed
      !> Time of each phase, without the stretch that is still running
      type(reading_type) :: elapsed(n_phases)
      !> Phases that are open, the running one last
      integer :: open_phases(max_depth) = 0
      !> Number of open phases
      integer :: depth = 0
   contains
      !> Start the clocks from zero
      procedure :: start
      !> Begin a phase
      procedure :: push
      !> End the phase pushed last
      procedure :: pop
      !> Wall-clock time of a phase until now [second]
      procedure :: seconds
      !> Processor time of a phase until now [second]
      procedure :: cpu_seconds
   end type timer_type

contains

   !> Start the clocks from zero, with no phase open
   subroutine start(self)
      !> The timer
      class(timer_type), intent(inout) :: self

      self%started = .true.
      self%elapsed = reading_type()
      self%depth = 0
      self%origin = now()
      self%resumed = self%origin
   end subroutine start

   !> Begin a phase; starts the timer if nobody did. Phases nested deeper
   !> than `max_depth` count for the phase at that depth.
   subroutine push(self, phase)
      !> The timer
      class(timer_type), intent(inout) :: self
      !> One of the `phase_` parameters, except `phase_total`
      integer, intent(in) :: phase

      if (.not. self%started) call self%start()
      call settle(self)
      self%depth = self%depth + 1
      if (self%depth <= max_depth) self%open_phases(self%depth) = phase
      call note_stage(phase_words(phase))
   end subroutine push

   !> End the phase pushed last; nothing happens if none is open
   subroutine pop(self, other, share)
      !> The timer
      class(timer_type), intent(inout) :: self
      !> A phase whose work was done in turn with that of the phase pushed last, since that
      !> was pushed or went on, and its share of the time
      integer, intent(in), optional :: other
      real(wp), intent(in), optional :: share

      type(reading_type) :: before, stretch
      integer :: running

      if (self%depth == 0) return
      running = self%open_phases(min(self%depth, max_depth))
      before = self%elapsed(running)
      call settle(self)
      if (present(other) .and. present(share)) then
         stretch = minus(self%elapsed(running), before)
         stretch = reading_type(share*stretch%wall, share*stretch%cpu)
         self%elapsed(running) = minus(self%elapsed(running), stretch)
         self%elapsed(other) = plus(self%elapsed(other), stretch)
      end if
      self%depth = self%depth - 1
      if (self%depth > 0) call note_stage(phase_words(self%open_phases(min(self%depth, max_depth))))
   end subroutine pop

   !> Wall-clock time of a phase until now [second]
   real(wp) function seconds(self, phase)
      !> The timer
      class(timer_type), intent(in) :: self
      !> One of the `phase_` parameters
      integer, intent(in) :: phase

      type(reading_type) :: time

      time = until_now(self, phase)
      seconds = time%wall
   end function seconds

   !> Processor time of a phase until now, all threads together [second]
   real(wp) function cpu_seconds(self, phase)
      !> The timer
      class(timer_type), intent(in) :: self
      !> One of the `phase_` parameters
      integer, intent(in) :: phase

      type(reading_type) :: time

      time = until_now(self, phase)
      cpu_seconds = time%cpu
   end function cpu_seconds

   !> Give the time since the last change of phase to the running phase
   subroutine settle(self)
      !> The timer
      type(timer_type), intent(inout) :: self

      type(reading_type) :: time
      integer :: running

      time = now()
      if (self%depth > 0) then
         running = self%open_phases(min(self%depth, max_depth))
         self%elapsed(running) = plus(self%elapsed(running), minus(time, self%resumed))
      end if
      self%resumed = time
   end subroutine settle

   !> Time of a phase with the stretch that is still running
   type(reading_type) function until_now(self, phase) result(time)
      !> The timer
      type(timer_type), intent(in) :: self
      !> One of the `phase_` parameters
      integer, intent(in) :: phase

      if (.not. self%started) return
      if (phase == phase_total) then
         time = minus(now(), self%origin)
         return
      end if
      time = self%elapsed(phase)
      if (self%depth == 0) return
      if (self%open_phases(min(self%depth, max_depth)) == phase) then
         time = plus(time, minus(now(), self%resumed))
      end if
   end function until_now

   !> Both clocks
   type(reading_type) function now()
      integer(i8) :: count, rate

      call system_clock(count, rate)
      if (rate > 0_i8) now%wall = real(count, wp)/real(rate, wp)
      call cpu_time(now%cpu)
   end function now

   !> Sum of two readings
   pure type(reading_type) function plus(a, b)
      !> The readings
      type(reading_type), intent(in) :: a, b
      plus = reading_type(a%wall + b%wall, a%cpu + b%cpu)
   end function plus

   !> Time from reading b to reading a
   pure type(reading_type) function minus(a, b)
      !> Later and earlier reading
      type(reading_type), intent(in) :: a, b
      minus = reading_type(a%wall - b%wall, a%cpu - b%cpu)
   end function minus

end module axijoint_base_timer
