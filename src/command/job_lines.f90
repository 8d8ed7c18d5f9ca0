!> Lines of a job script for Slurm that ask for what an estimate says
module axijoint_command_job_lines
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_text, only : to_text, lower
   use axijoint_command_line, only : command_type
   use axijoint_estimate_forecast, only : forecast_type, whole_seconds
   use axijoint_estimate_machine, only : machine_type
   use axijoint_job_job, only : job_name
   implicit none
   private
   public :: needs_type, add_needs, print_job_lines, clock_text, asked_seconds, asked_megabytes

   !> Time asked for: so many times the estimate, and what stopping in time takes besides [second]
   real(wp), parameter :: times_as_long = 3.0_wp, to_stop = 300.0_wp
   !> Memory asked for: so many times the estimate, and what the program leaves free for its
   !> libraries and the system counts besides [MB]
   real(wp), parameter :: times_as_much = 1.2_wp, to_spare = 256.0_wp
   real(wp), parameter :: megabyte = 2.0_wp**20

   !> What the largest of some decks needs
   type :: needs_type
      !> Decks
      integer :: n = 0
      !> Name of the job
      character(len=:), allocatable :: name
      !> Time with threads [second], memory [byte], threads that have something to do
      real(wp) :: seconds = 0.0_wp
      integer(i8) :: memory = 0
      integer :: threads = 1
   end type needs_type

contains

   !> Take a deck into account
   subroutine add_needs(deck, forecast, machine, needs)
      !> The deck
      character(len=*), intent(in) :: deck
      !> What it takes
      type(forecast_type), intent(in) :: forecast
      !> The machine
      type(machine_type), intent(in) :: machine
      !> The largest so far
      type(needs_type), intent(inout) :: needs

      needs%n = needs%n + 1
      needs%name = 'axijoint'
      if (needs%n == 1) needs%name = job_name(deck)
      needs%seconds = max(needs%seconds, whole_seconds(forecast, machine))
      needs%memory = max(needs%memory, forecast%memory)
      needs%threads = max(needs%threads, forecast%n_workers, forecast%n_processes)
   end subroutine add_needs

   !> Print the lines
   subroutine print_job_lines(command, needs)
      !> Options
      type(command_type), intent(in) :: command
      !> What the largest deck needs
      type(needs_type), intent(in) :: needs

      write (output_unit, '(a)') '#SBATCH --job-name='//one_word(needs%name), &
         '#SBATCH --nodes=1', '#SBATCH --ntasks=1', &
         '#SBATCH --cpus-per-task='//to_text(max(command%threads, needs%threads)), &
         '#SBATCH --mem='//to_text(asked_megabytes(needs%memory))//'M', &
         '#SBATCH --time='//clock_text(asked_seconds(needs%seconds)), &
         '#SBATCH --signal=B:USR1@120', '#SBATCH --requeue', '#SBATCH --open-mode=append'
   end subroutine print_job_lines

   !> A name as sbatch takes it: it divides lines at blanks, and gives quotes, #, backslashes and more a meaning of
   !> their own, so that all but letters, digits and a few marks become _
   pure function one_word(name) result(word)
      !> The name
      character(len=*), intent(in) :: name
      !> The same in one word
      character(len=len(name)) :: word

      character(len=*), parameter :: plain = 'abcdefghijklmnopqrstuvwxyz0123456789._-+'
      !> Bytes from here on are parts of letters that ASCII lacks
      integer, parameter :: beyond_ascii = 128
      integer :: k

      word = name
      do k = 1, len(name)
         if (index(plain, lower(name(k:k))) == 0 .and. ichar(name(k:k)) < beyond_ascii) word(k:k) = '_'
      end do
   end function one_word

   !> Time to ask for [second]
   pure integer(i8) function asked_seconds(seconds)
      !> The estimate [second]
      real(wp), intent(in) :: seconds

      asked_seconds = ceiling((times_as_long*seconds + to_stop)/60.0_wp, i8)*60
   end function asked_seconds

   !> Memory to ask for [MB]
   pure integer function asked_megabytes(bytes)
      !> The estimate [byte]
      integer(i8), intent(in) :: bytes

      asked_megabytes = ceiling(times_as_much*real(bytes, wp)/megabyte + to_spare)
   end function asked_megabytes

   !> Hours, minutes and seconds
   pure function clock_text(seconds) result(text)
      !> The time [second]
      integer(i8), intent(in) :: seconds
      !> As 1:00:00
      character(len=:), allocatable :: text

      character(len=5) :: rest

      write (rest, '(i2.2, ":", i2.2)') mod(seconds/60, 60_i8), mod(seconds, 60_i8)
      text = to_text(seconds/3600)//':'//rest
   end function clock_text

end module axijoint_command_job_lines
