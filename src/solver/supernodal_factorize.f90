!> Supernodal Cholesky factor of one matrix by all threads that have nothing else to do
!>
!> Small branches of the tree of supernodes are factored one after the other, some branches at once; then
!> the supernodes above them, the rows of each panel shared among threads. What is shared how is a matter
!> of the structure alone, and every number is made by the same operations in the same order whoever makes
!> it: not a bit depends on the number of threads.
module axijoint_solver_supernodal_factorize
   use, intrinsic :: iso_c_binding, only : c_double, c_int32_t, c_int64_t
   use omp_lib, only : omp_in_parallel, omp_get_thread_num, omp_get_max_threads, omp_get_num_threads
   use axijoint_base_kinds, only : wp
   use axijoint_base_ranges, only : range_end
   use axijoint_solver_panel, only : panel_load, panel_triangle, panel_below
   use axijoint_solver_supernodal, only : supernodal_structure_type, progress_type, room_type, waiting_type, nobody, &
      start_progress, make_room, factor_run, subtract_update, next_owner, enlist, columns_in, find_places
   implicit none
   private
   public :: supernodal_factorize

   !> Work from which on a matrix is shared among threads [operations]
   real(wp), parameter :: worth_sharing = 2.0e8_wp
   !> Branches with no more than this part of the work are factored as they are
   real(wp), parameter :: small_branch = 1.0_wp/8
   !> Columns of a panel's triangle that are factored before the rows below follow, rows of a panel that one thread
   !> works on at least, and parts of its rows at most
   integer, parameter :: block_size = 96, least_rows = 64, most_parts = 8

   !> What is done with some rows of a panel at once
   integer, parameter :: gather = 1, eliminate = 2

   !> A run of supernodes
   type :: run_type
      !> First and last of them
      integer :: first = 0, last = nobody
      !> What they leave to others
      type(waiting_type) :: waiting
      !> Column whose pivot is not positive; -1 if there is none
      integer(c_int64_t) :: failed = -1
      !> 1 if there was no memory
      integer(c_int32_t) :: code = 0
   end type run_type

   !> The panel that threads share
   type :: shared_type
      !> The supernode, its rows and columns
      integer :: s = 0, height = 0, width = 0
      !> Place in it of each of its rows
      integer, allocatable :: place(:)
      !> Supernodes that leave it something, in order, and their columns in it
      integer, allocatable :: givers(:), columns(:)
      integer :: n_givers = 0
      !> Columns that are eliminated, and those that are next
      integer :: first = 0, last = 0
      !> One over the diagonal
      real(wp), allocatable :: over(:)
   end type shared_type

contains

   !> Factor a matrix
   subroutine supernodal_factorize(structure, value, l, failed, code) &
      bind(c, name='axijoint_supernodal_factorize')
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> Values of the matrix
      real(c_double), intent(in) :: value(0:*)
      !> The factor, panel by panel
      real(c_double), intent(inout) :: l(0:*)
      !> Column whose pivot is not positive; -1 if there is none
      integer(c_int64_t), intent(out) :: failed
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(out) :: code

      type(progress_type) :: at
      type(room_type), allocatable :: rooms(:)
      type(run_type), allocatable :: runs(:)
      logical, allocatable :: shared(:)
      logical :: team

      failed = -1
      call start_progress(structure, at, code)
      if (code /= 0) return
      call find_runs(at, runs, shared)
      team = omp_in_parallel()
      if (team .or. (size(runs) <= 1 .and. .not. any(shared))) then
         allocate (rooms(0:omp_get_num_threads() - 1))
         call factor_tree(at, runs, shared, value, l, rooms, failed, code)
         return
      end if
      allocate (rooms(0:omp_get_max_threads() - 1))
      !$omp parallel
      !$omp single
      call factor_tree(at, runs, shared, value, l, rooms, failed, code)
      !$omp end single
      !$omp end parallel
   end subroutine supernodal_factorize

   !> Runs of supernodes in small branches, and the supernodes above all small branches
   subroutine find_runs(at, runs, shared)
      !> The structure
      type(progress_type), intent(in) :: at
      !> The runs, ascending
      type(run_type), allocatable, intent(out) :: runs(:)
      !> Whether a supernode is above the small branches, shape (0:supernodes - 1)
      logical, allocatable, intent(out) :: shared(:)

      real(wp) :: work(0:at%n_supernodes), limit, gathered
      integer :: parent(0:at%n_supernodes)
      integer :: s, m, first
      logical :: ends

      m = at%n_supernodes
      work(:m - 1) = [(real(at%column(s + 1) - at%column(s), wp)*real(at%first_row(s + 1) - at%first_row(s), wp)**2, &
         s=0, m - 1)]
      allocate (shared(0:m), source=.false.)
      allocate (runs(0))
      if (sum(work(:m - 1)) < worth_sharing) then
         runs = [run_type(0, m - 1)]
         return
      end if
      limit = small_branch*sum(work(:m - 1))
      do s = 0, m - 1
         parent(s) = nobody
         associate (width => at%column(s + 1) - at%column(s))
            if (at%first_row(s) + width < at%first_row(s + 1)) parent(s) = at%supernode(at%row(at%first_row(s) + width))
         end associate
         shared(s) = work(s) > limit
         if (parent(s) /= nobody) work(parent(s)) = work(parent(s)) + work(s)
      end do
      first = 0
      gathered = 0.0_wp
      do s = 0, m - 1
         if (shared(s)) then
            first = s + 1
            cycle
         end if
         ends = parent(s) == nobody
         if (.not. ends) ends = shared(parent(s))
         if (.not. ends) cycle
         gathered = gathered + work(s)
         if (gathered < 0.5_wp*limit .and. .not. shared(s + 1) .and. s < m - 1) cycle
         runs = [runs, run_type(first, s)]
         first = s + 1
         gathered = 0.0_wp
      end do
   end subroutine find_runs

   !> Factor all runs, then all that is above them. Called by one thread; others of its team help
   subroutine factor_tree(at, runs, shared, value, l, rooms, failed, code)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> The runs
      type(run_type), intent(inout) :: runs(:)
      !> Whether a supernode is above them
      logical, intent(in) :: shared(0:)
      !> Values of the matrix
      real(wp), intent(in) :: value(0:*)
      !> The factor, panel by panel
      real(wp), intent(inout) :: l(0:*)
      !> Memory of each thread
      type(room_type), intent(inout) :: rooms(0:)
      !> Column whose pivot is not positive; not changed if there is none
      integer(c_int64_t), intent(inout) :: failed
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(inout) :: code

      type(shared_type) :: panel
      integer :: k, s

      do k = 1, size(runs)
         !$omp task default(shared) firstprivate(k) if (size(runs) > 1)
         call make_room(at, rooms(omp_get_thread_num()), runs(k)%code)
         if (runs(k)%code == 0) call factor_run(at, runs(k)%first, runs(k)%last, value, l, rooms(omp_get_thread_num()), &
            runs(k)%waiting, runs(k)%failed)
         !$omp end task
      end do
      !$omp taskwait
      code = maxval([0_c_int32_t, runs%code])
      k = findloc(runs%failed >= 0, .true., 1)
      if (k > 0) failed = runs(k)%failed
      if (code /= 0 .or. failed >= 0 .or. .not. any(shared)) return
      allocate (panel%place(0:at%n), panel%givers(at%n_supernodes), panel%columns(at%n_supernodes), &
                panel%over(at%most_rows))
      k = 1
      do s = 0, at%n_supernodes - 1
         if (.not. shared(s)) cycle
         do while (k <= size(runs))
            if (runs(k)%first > s) exit
            call release(at, runs(k)%waiting)
            k = k + 1
         end do
         call factor_shared(at, s, panel, value, l, rooms, failed, code)
         if (code /= 0 .or. failed >= 0) return
      end do
   end subroutine factor_tree

   !> Put what a run leaves into the lists of the supernodes behind it
   subroutine release(at, waiting)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> The supernodes that leave it
      type(waiting_type), intent(in) :: waiting

      integer :: d, following

      d = waiting%first
      do while (d /= nobody)
         following = at%next(d)
         call enlist(at, d)
         d = following
      end do
   end subroutine release

   !> Factor one panel, its rows shared among threads
   subroutine factor_shared(at, s, panel, value, l, rooms, failed, code)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> The supernode
      integer, intent(in) :: s
      !> Memory for what threads must know
      type(shared_type), intent(inout) :: panel
      !> Values of the matrix
      real(wp), intent(in) :: value(0:*)
      !> The factor, panel by panel
      real(wp), intent(inout) :: l(0:*)
      !> Memory of each thread
      type(room_type), intent(inout) :: rooms(0:)
      !> Column whose pivot is not positive; not changed if there is none
      integer(c_int64_t), intent(inout) :: failed
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(inout) :: code

      integer :: info

      panel%s = s
      panel%height = int(at%first_row(s + 1) - at%first_row(s))
      panel%width = int(at%column(s + 1) - at%column(s))
      call find_places(at, s, panel%place)
      call list_givers(at, panel)
      call share_rows(at, gather, 0, panel, value, l, rooms, code)
      if (code /= 0) return
      call pass_on(at, panel)
      do while (panel%last < panel%width)
         panel%first = panel%last
         panel%last = min(panel%width, panel%first + block_size)
         info = panel_triangle(at%at_once, panel%first, panel%last, panel%height, l(at%first_number(s)), panel%over)
         if (info /= 0) then
            failed = at%column(s) + info - 1
            return
         end if
         if (panel%last < panel%height) call share_rows(at, eliminate, panel%last, panel, value, l, rooms, code)
      end do
   end subroutine factor_shared

   !> The supernodes that leave something to a panel
   subroutine list_givers(at, panel)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> The panel; takes the list
      type(shared_type), intent(inout) :: panel

      integer :: d

      panel%first = 0
      panel%last = 0
      panel%n_givers = 0
      d = at%head(panel%s)
      do while (d /= nobody)
         panel%n_givers = panel%n_givers + 1
         panel%givers(panel%n_givers) = d
         panel%columns(panel%n_givers) = columns_in(at, panel%s, d)
         d = at%next(d)
      end do
   end subroutine list_givers

   !> Hand those that have left something to a panel, and the panel, on to the next
   subroutine pass_on(at, panel)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> The panel
      type(shared_type), intent(in) :: panel

      integer :: k

      do k = 1, panel%n_givers
         associate (d => panel%givers(k))
            at%done(d) = at%done(d) + panel%columns(k)
            if (next_owner(at, d) /= nobody) call enlist(at, d)
         end associate
      end do
      at%done(panel%s) = panel%width
      if (next_owner(at, panel%s) /= nobody) call enlist(at, panel%s)
   end subroutine pass_on

   !> Do something with the rows of a panel from one on, in parts
   subroutine share_rows(at, what, from, panel, value, l, rooms, code)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> What is done, and the first of the rows
      integer, intent(in) :: what, from
      !> The panel
      type(shared_type), intent(in) :: panel
      !> Values of the matrix
      real(wp), intent(in) :: value(0:*)
      !> The factor, panel by panel
      real(wp), intent(inout) :: l(0:*)
      !> Memory of each thread
      type(room_type), intent(inout) :: rooms(0:)
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(inout) :: code

      integer(c_int32_t) :: codes(most_parts)
      integer :: n, k

      n = max(1, min(most_parts, (panel%height - from)/least_rows))
      codes = 0
      do k = n, 1, -1
         !$omp task default(shared) firstprivate(k)
         call work_on_rows(at, what, from + range_end(panel%height - from, k - 1, n), &
            from + range_end(panel%height - from, k, n), panel, value, l, rooms(omp_get_thread_num()), codes(k))
         !$omp end task
      end do
      !$omp taskwait
      code = max(code, maxval(codes))
   end subroutine share_rows

   !> Do something with some rows of a panel
   subroutine work_on_rows(at, what, from, to, panel, value, l, room, code)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> What is done, the first row, and up to which
      integer, intent(in) :: what, from, to
      !> The panel
      type(shared_type), intent(in) :: panel
      !> Values of the matrix
      real(wp), intent(in) :: value(0:*)
      !> The factor, panel by panel
      real(wp), intent(inout) :: l(0:*)
      !> Memory of the thread
      type(room_type), intent(inout) :: room
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(inout) :: code

      integer(c_int64_t) :: start
      integer :: k

      start = at%first_number(panel%s)
      associate (height => panel%height)
         select case (what)
         case (gather)
            call make_room(at, room, code)
            if (code /= 0) return
            call panel_load(from, to, height, panel%width, at%matrix_start(at%column(panel%s):), at%matrix_row, at%from, value, &
               panel%place, l(start))
            do k = 1, panel%n_givers
               call subtract_update(at, panel%givers(k), panel%columns(k), panel%place, room, from, to, &
                  l(at%first_number(panel%givers(k))), height, l(start))
            end do
         case (eliminate)
            call panel_below(at%at_once, to - from, panel%first, panel%last, height, l(start), panel%over, l(start + from))
         end select
      end associate
   end subroutine work_on_rows

end module axijoint_solver_supernodal_factorize
