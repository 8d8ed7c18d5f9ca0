!> How fast the machine is on which an estimate is made, measured in some hundredths of a second
module axijoint_estimate_machine
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : resident_bytes
   use axijoint_linalg_lapack, only : product_rate
   implicit none
   private
   public :: machine_type, this_machine, reference

   !> What is measured
   type :: machine_type
      !> Large matrix products in one thread [operations/second]
      real(wp) :: product_rate = 0.0_wp
      !> Numbers written as text, which stands for all common work [numbers/second]
      real(wp) :: text_rate = 0.0_wp
      !> What the program and its libraries take when they start [byte]
      integer(i8) :: program_bytes = 0
   end type machine_type

   !> The machine that the seconds of `axijoint_estimate_terms` were fitted on
   type(machine_type), parameter :: reference = machine_type(45.0e9_wp, 4.5e5_wp, 7000000_i8)

contains

   !> Measure this machine
   function this_machine() result(machine)
      !> Its rates
      type(machine_type) :: machine

      machine%program_bytes = resident_bytes()
      if (machine%program_bytes == 0) machine%program_bytes = reference%program_bytes
      machine%product_rate = product_rate()
      machine%text_rate = text_rate()
   end function this_machine

   !> Rate of numbers written as text by this thread, on average: where others share the processor
   !> its speed changes within hundredths of a second, and a run has the mean of it
   function text_rate() result(rate)
      !> Numbers a second
      real(wp) :: rate

      integer, parameter :: n = 16000
      character(len=14) :: text(n)
      real(wp) :: start, finish
      integer :: i

      rate = 0.0_wp
      call cpu_time(start)  ! one thread: other jobs do not count
      do i = 1, n
         write (text(i), '(es14.6)') real(i, wp)/7.0_wp
      end do
      call cpu_time(finish)
      if (finish > start .and. text(n) /= '') rate = n/(finish - start)
   end function text_rate

end module axijoint_estimate_machine
