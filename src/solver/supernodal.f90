!> Numbers of a supernodal Cholesky factor, whose structure CHOLMOD has found: what the panels of some
!> columns take from those before them
!>
!> Left-looking: each supernode gathers the matrix and what the supernodes before it leave, which
!> wait in the list of the supernode that holds their next row (Ng and Peyton, SIAM J. Sci. Comput.
!> 14, 1993). CHOLMOD does the same, with its loops shared among threads; for a thread that
!> works on a harmonic of its own the calls that this takes are time lost. All that counts starts
!> from zero, as there.
module axijoint_solver_supernodal
   use, intrinsic :: iso_c_binding, only : c_ptr, c_f_pointer, c_int32_t, c_int64_t
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : let_fail
   use axijoint_solver_panel, only : most_at_once, rows_at_once, panel_load, panel_take, panel_triangle, panel_below
   implicit none
   private
   public :: supernodal_structure_type, progress_type, room_type, waiting_type, nobody
   public :: start_progress, make_room, factor_run, subtract_update, next_owner, enlist, columns_in, &
      find_places

   !> Ends a list
   integer, parameter :: nobody = -1

   !> A supernode is a set of neighbouring columns with the same rows, kept as one dense panel
   type, bind(c) :: supernodal_structure_type
      !> Order, number of supernodes
      integer(c_int64_t) :: n, n_supernodes
      !> First column of each supernode, shape (0:n_supernodes)
      type(c_ptr) :: column
      !> First of its rows in `row`, and of its numbers in the factor, shape (0:n_supernodes)
      type(c_ptr) :: first_row, first_number
      !> Rows of all supernodes, ascending in each
      type(c_ptr) :: row
      !> Lower triangle of the matrix by columns: first entry of each column, shape (0:n), row of
      !> each entry, and the place of its value
      type(c_ptr) :: matrix_start, matrix_row, from
   end type supernodal_structure_type

   !> The same for Fortran, and where a factorization stands
   type :: progress_type
      integer(c_int64_t), pointer, contiguous :: column(:), first_row(:), first_number(:), row(:)
      integer(c_int64_t), pointer, contiguous :: matrix_start(:)
      integer(c_int32_t), pointer, contiguous :: matrix_row(:), from(:)
      !> Order, supernodes, and rows of the highest of them, which are columns of none more
      integer :: n = 0, n_supernodes = 0, most_rows = 0
      !> Rows that the processor takes at once
      integer(c_int32_t) :: at_once = 0
      !> Supernode of each column
      integer, allocatable :: supernode(:)
      !> First supernode of each list, the one after each, and the rows of each that are done
      integer, allocatable :: head(:), next(:), done(:)
   end type progress_type

   !> Memory of a thread
   type :: room_type
      !> Place in the supernode at hand of each row
      integer(c_int32_t), allocatable :: place(:)
      !> Places of the rows of an update
      integer(c_int32_t), allocatable :: target(:)
      !> One over the diagonal of a panel
      real(wp), allocatable :: over(:)
   end type room_type

   !> Supernodes of a run that leave something to supernodes behind it, in the order in which they came: a list
   !> by `next`
   type :: waiting_type
      integer :: first = nobody, last = nobody
   end type waiting_type

contains

   !> Nothing is done yet
   subroutine start_progress(structure, at, code)
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> Where the factorization stands
      type(progress_type), intent(out) :: at
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(out) :: code

      integer :: n, m, s, stat

      n = int(structure%n)
      m = int(structure%n_supernodes)
      at%n = n
      at%n_supernodes = m
      at%at_once = rows_at_once(most_at_once)
      call view(structure%column, m + 1_i8, at%column)
      call view(structure%first_row, m + 1_i8, at%first_row)
      call view(structure%first_number, m + 1_i8, at%first_number)
      call view(structure%row, at%first_row(m), at%row)
      call view(structure%matrix_start, n + 1_i8, at%matrix_start)
      call c_f_pointer(structure%matrix_row, at%matrix_row, [at%matrix_start(n)])
      at%matrix_row(0:) => at%matrix_row
      call c_f_pointer(structure%from, at%from, [at%matrix_start(n)])
      at%from(0:) => at%from
      at%most_rows = int(maxval([0_i8, at%first_row(1:) - at%first_row(:m - 1)]))
      call let_fail(.true.)
      allocate (at%supernode(0:n), at%head(0:m), at%next(0:m), at%done(0:m), stat=stat)
      call let_fail(.false.)
      code = merge(0_c_int32_t, 1_c_int32_t, stat == 0)
      if (code /= 0) return
      do s = 0, m - 1
         at%supernode(at%column(s):at%column(s + 1) - 1) = s
      end do
      at%head = nobody

   contains

      !> A view that counts from zero
      subroutine view(address, length, array)
         !> Where the numbers are, and how many
         type(c_ptr), intent(in) :: address
         integer(i8), intent(in) :: length
         !> The view
         integer(c_int64_t), pointer, contiguous, intent(out) :: array(:)

         call c_f_pointer(address, array, [length])
         array(0:) => array
      end subroutine view

   end subroutine start_progress

   !> Allocate the memory of a thread, once
   subroutine make_room(at, room, code)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> The memory
      type(room_type), intent(inout) :: room
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(out) :: code

      integer :: stat

      code = 0
      if (allocated(room%over)) return
      call let_fail(.true.)
      allocate (room%place(0:at%n), room%target(0:at%most_rows), room%over(0:at%most_rows), stat=stat)
      call let_fail(.false.)
      code = merge(0_c_int32_t, 1_c_int32_t, stat == 0)
   end subroutine make_room

   !> Factor the panels of a run of supernodes, which take nothing from supernodes outside it
   subroutine factor_run(at, first, last, value, l, room, waiting, failed)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> First and last supernode
      integer, intent(in) :: first, last
      !> Values of the matrix
      real(wp), intent(in) :: value(0:*)
      !> The factor, panel by panel
      real(wp), intent(inout) :: l(0:*)
      !> Memory of the thread
      type(room_type), intent(inout) :: room
      !> What the run leaves to supernodes behind it
      type(waiting_type), intent(inout) :: waiting
      !> Column whose pivot is not positive; not changed if there is none
      integer(c_int64_t), intent(inout) :: failed

      integer :: s, d, following, columns, height, width, info

      do s = first, last
         width = int(at%column(s + 1) - at%column(s))
         height = int(at%first_row(s + 1) - at%first_row(s))
         associate (panel => l(at%first_number(s):at%first_number(s + 1) - 1))
            call find_places(at, s, room%place)
            call panel_load(0, height, height, width, at%matrix_start(at%column(s):), at%matrix_row, at%from, value, &
                            room%place, panel)
            d = at%head(s)
            do while (d >= 0)
               following = at%next(d)
               columns = columns_in(at, s, d)
               call subtract_update(at, d, columns, room%place, room, 0, height, l(at%first_number(d)), height, panel)
               call pass_on(d, at%done(d) + columns)
               d = following
            end do
            info = panel_triangle(at%at_once, 0, width, height, panel, room%over)
            if (info /= 0) then
               failed = at%column(s) + info - 1
               return
            end if
            call panel_below(at%at_once, height - width, 0, width, height, panel, room%over, l(at%first_number(s) + width))
            call pass_on(s, width)
         end associate
      end do

   contains

      !> Hand a supernode on to the one that holds its next row
      subroutine pass_on(d, done)
         !> The supernode, and the rows of it that are done
         integer, intent(in) :: d, done

         at%done(d) = done
         if (next_owner(at, d) == nobody) return
         if (next_owner(at, d) <= last) then
            call enlist(at, d)
         else
            at%next(d) = nobody
            if (waiting%last >= 0) at%next(waiting%last) = d
            if (waiting%first < 0) waiting%first = d
            waiting%last = d
         end if
      end subroutine pass_on

   end subroutine factor_run

   !> Place in a panel of each of its rows
   subroutine find_places(at, s, place)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> The supernode
      integer, intent(in) :: s
      !> Takes the places, shape (0:n)
      integer, intent(inout) :: place(0:)

      integer :: i

      do i = 0, int(at%first_row(s + 1) - at%first_row(s)) - 1
         place(at%row(at%first_row(s) + i)) = i
      end do
   end subroutine find_places

   !> Subtract what a supernode leaves to some rows of a panel
   subroutine subtract_update(at, d, columns, place, room, from, to, before, height, panel)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> The supernode that leaves it, and its columns in the panel
      integer, intent(in) :: d, columns
      !> Place in the panel of each of its rows
      integer, intent(in) :: place(0:)
      !> Memory of the thread
      type(room_type), intent(inout) :: room
      !> First row of the panel, and up to which
      integer, intent(in) :: from, to
      !> Panel of the supernode that leaves it
      real(wp), intent(in) :: before(0:*)
      !> Rows of the panel
      integer, intent(in) :: height
      !> The panel
      real(wp), intent(inout) :: panel(0:height - 1, 0:*)

      integer :: depth, rows, skip, low, high, i

      depth = int(at%first_row(d + 1) - at%first_row(d))
      skip = at%done(d)
      rows = depth - skip
      associate (row => at%row(at%first_row(d) + skip:), target => room%target)
         if (place(row(1)) >= to .or. place(row(rows)) < from) return
         do i = 0, rows - 1
            target(i) = place(row(1 + i))
         end do
         low = 0
         high = rows
         if (from > 0) low = count(target(:rows - 1) < from)
         if (to < height) high = count(target(:rows - 1) < to)
         if (low < high) call panel_take(at%at_once, low, high, min(columns, high), &
            int(at%column(d + 1) - at%column(d)), depth, before(skip), target, height, panel)
      end associate
   end subroutine subtract_update

   !> Columns of a supernode's update in the panel of another
   pure integer function columns_in(at, s, d)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> The supernode with the panel, and the one before it
      integer, intent(in) :: s, d

      integer :: rows

      rows = int(at%first_row(d + 1) - at%first_row(d)) - at%done(d)
      columns_in = 0
      do while (columns_in < rows)
         if (at%row(at%first_row(d) + at%done(d) + columns_in) >= at%column(s + 1)) exit
         columns_in = columns_in + 1
      end do
   end function columns_in

   !> The supernode that holds the next row of one; nobody if all are done
   pure integer function next_owner(at, d)
      !> Where the factorization stands
      type(progress_type), intent(in) :: at
      !> The supernode
      integer, intent(in) :: d

      next_owner = nobody
      if (at%first_row(d) + at%done(d) < at%first_row(d + 1)) &
         next_owner = at%supernode(at%row(at%first_row(d) + at%done(d)))
   end function next_owner

   !> Put a supernode into the list of the one that holds its next row
   subroutine enlist(at, d)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> The supernode
      integer, intent(in) :: d

      associate (head => at%head(next_owner(at, d)))
         at%next(d) = head
         head = d
      end associate
   end subroutine enlist

end module axijoint_solver_supernodal
