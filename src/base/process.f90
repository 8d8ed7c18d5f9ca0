!> Who a process is, so that another can tell whether it still runs
module axijoint_base_process
   use, intrinsic :: iso_c_binding, only : c_char, c_int, c_int64_t, c_null_char, c_size_t
   use axijoint_base_kinds, only : i8
   use axijoint_base_system, only : process_id
   implicit none
   private
   public :: process_type, this_process, is_dead, same_process, same_machine, host_name, runs_here

   !> Longest name of a machine
   integer, parameter :: longest = 256
   !> Names that a machine has, as process_shim.c counts them
   integer, parameter :: name_host = 0, name_installation = 1, name_boot = 2, name_space = 3

   !> A process
   type :: process_type
      !> Name of its host; what tells hosts of one name apart; when it was started; the space that
      !> the number of the process is of
      character(len=:), allocatable :: host, installation, boot, space
      !> Its number, and when it began [ticks of the host's clock]; 0 if not known
      integer :: id = 0
      integer(i8) :: start = 0
   end type process_type

   interface
      !> Names of this machine; process_shim.c
      subroutine c_machine_name(which, text, size) bind(c, name='axijoint_machine_name')
         import :: c_char, c_int, c_size_t
         integer(c_int), value :: which
         character(kind=c_char), intent(inout) :: text(*)
         integer(c_size_t), value :: size
      end subroutine c_machine_name

      !> When a process began; process_shim.c
      function c_process_start(process) bind(c, name='axijoint_process_start')
         import :: c_int, c_int64_t
         integer(c_int), value :: process
         integer(c_int64_t) :: c_process_start
      end function c_process_start
   end interface

contains

   !> This process
   function this_process() result(process)
      !> The process
      type(process_type) :: process

      process%host = host_name()
      process%installation = machine_name(name_installation)
      process%boot = machine_name(name_boot)
      process%space = machine_name(name_space)
      process%id = process_id()
      process%start = max(0_i8, int(c_process_start(int(process%id, c_int)), i8))
   end function this_process

   !> Name of this host
   function host_name() result(name)
      !> The name
      character(len=:), allocatable :: name

      name = machine_name(name_host)
      if (len(name) == 0) name = 'localhost'
   end function host_name

   !> Whether a process ended for certain: of another host that cannot be told
   logical function is_dead(process)
      !> The process
      type(process_type), intent(in) :: process

      type(process_type) :: own
      integer(i8) :: start

      own = this_process()
      is_dead = .false.
      if (process%host /= own%host .or. process%installation /= own%installation) return
      is_dead = process%boot /= own%boot  ! the machine was started anew since
      if (is_dead .or. process%space /= own%space) return
      start = c_process_start(int(process%id, c_int))
      ! a number that is given anew is of a process that began later
      is_dead = start < 0 .or. (start > 0 .and. process%start > 0 .and. start /= process%start)
   end function is_dead

   !> Whether two descriptions are of one process
   pure logical function same_process(a, b)
      !> The descriptions
      type(process_type), intent(in) :: a, b

      same_process = same_machine(a, b) .and. a%boot == b%boot .and. a%id == b%id .and. &
         a%start == b%start
   end function same_process

   !> Whether two processes are of one machine and one space of numbers: they can see each other
   pure logical function same_machine(a, b)
      !> The processes
      type(process_type), intent(in) :: a, b

      same_machine = a%host == b%host .and. a%installation == b%installation .and. &
         a%space == b%space
   end function same_machine

   !> Whether a process of some number runs on this host
   logical function runs_here(id)
      !> The number
      integer, intent(in) :: id

      runs_here = c_process_start(int(id, c_int)) >= 0
   end function runs_here

   !> A name of this machine, empty if it has none
   function machine_name(which) result(name)
      !> One of the `name_` parameters
      integer, intent(in) :: which
      !> The name
      character(len=:), allocatable :: name

      character(kind=c_char) :: buffer(longest)
      integer :: k

      call c_machine_name(int(which, c_int), buffer, int(longest, c_size_t))
      name = ''
      do k = 1, longest
         if (buffer(k) == c_null_char) exit
         name = name//buffer(k)
      end do
   end function machine_name

end module axijoint_base_process
