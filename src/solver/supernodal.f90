!> Numbers of a supernodal Cholesky factor, whose structure CHOLMOD has found
!>
!> Left-looking: each supernode gathers the matrix and what the supernodes before it leave, which
!> wait in the list of the supernode that holds their next row (Ng and Peyton, SIAM J. Sci. Comput.
!> 14, 1993). CHOLMOD does the same, with its loops shared among threads; for a thread that
!> works on a harmonic of its own the calls that this takes are time lost. All that counts starts
!> from zero, as there.
module axijoint_solver_supernodal
   use, intrinsic :: iso_c_binding, only : c_ptr, c_f_pointer, c_double, c_int32_t, c_int64_t
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : let_fail
   use axijoint_linalg_lapack, only : dgemm, dpotrf, dsyrk, dtrsm
   implicit none
   private
   public :: supernodal_structure_type, supernodal_factorize

   !> Updates of so few columns are formed as a whole, not only their triangle
   integer, parameter :: few_columns = 32
   !> Larger updates are formed in parts, which stay in the cache
   integer, parameter :: largest_update = 131072

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
      integer(c_int64_t), pointer, contiguous :: matrix_start(:), matrix_row(:)
      integer(c_int32_t), pointer, contiguous :: from(:)
      !> Supernode of each column
      integer, allocatable :: supernode(:)
      !> Place in the supernode at hand of each of its rows
      integer, allocatable :: place(:)
      !> First supernode of each list, the one after each, and the rows of each that are done
      integer, allocatable :: head(:), next(:), done(:)
      !> Places of the rows of an update, and the update
      integer, allocatable :: target(:)
      real(wp), allocatable :: update(:)
   end type progress_type

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
      integer :: s, d, following, height, width, info

      failed = -1
      call start_progress(structure, at, code)
      if (code /= 0) return
      do s = 0, int(structure%n_supernodes) - 1
         associate (panel => l(at%first_number(s):at%first_number(s + 1) - 1))
            width = int(at%column(s + 1) - at%column(s))
            height = int(at%first_row(s + 1) - at%first_row(s))
            call load_panel(at, s, value, height, panel)
            d = at%head(s)
            do while (d >= 0)
               following = at%next(d)
               call subtract_update(at, s, d, l(at%first_number(d)), height, panel)
               d = following
            end do
            call dpotrf('L', width, panel, height, info)
            if (info /= 0) then
               failed = at%column(s) + info - 1
               return
            end if
            if (height == width) cycle
            call dtrsm('R', 'L', 'T', 'N', height - width, width, 1.0_wp, panel, height, &
                       l(at%first_number(s) + width), height)
            call enlist(at, s, width)
         end associate
      end do
   end subroutine supernodal_factorize

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
      call view(structure%column, m + 1_i8, at%column)
      call view(structure%first_row, m + 1_i8, at%first_row)
      call view(structure%first_number, m + 1_i8, at%first_number)
      call view(structure%row, at%first_row(m), at%row)
      call view(structure%matrix_start, n + 1_i8, at%matrix_start)
      call view(structure%matrix_row, at%matrix_start(n), at%matrix_row)
      call c_f_pointer(structure%from, at%from, [at%matrix_start(n)])
      at%from(0:) => at%from
      call let_fail(.true.)
      allocate (at%supernode(0:n), at%place(0:n), at%head(0:m), at%next(0:m), at%done(0:m), &
                at%target(0:n), stat=stat)
      call let_fail(.false.)
      if (stat == 0) then
         m = int(maxval([0_i8, at%first_row(1:) - at%first_row(:m - 1)]))
         call let_fail(.true.)
         allocate (at%update(0:max(largest_update, few_columns*m) - 1), stat=stat)
         call let_fail(.false.)
      end if
      code = merge(0_c_int32_t, 1_c_int32_t, stat == 0)
      if (code /= 0) return
      do s = 0, int(structure%n_supernodes) - 1
         at%supernode(at%column(s):at%column(s + 1) - 1) = s
      end do
      at%head = -1

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

   !> Put the columns of the matrix into the panel of a supernode
   subroutine load_panel(at, s, value, height, panel)
      !> Where the factorization stands; takes the places of the rows
      type(progress_type), intent(inout) :: at
      !> The supernode
      integer, intent(in) :: s
      !> Values of the matrix
      real(wp), intent(in) :: value(0:*)
      !> Rows of the panel
      integer, intent(in) :: height
      !> The panel
      real(wp), intent(inout) :: panel(0:height - 1, 0:*)

      integer :: i, j
      integer(i8) :: k

      do i = 0, height - 1
         at%place(at%row(at%first_row(s) + i)) = i
      end do
      do j = 0, int(at%column(s + 1) - at%column(s)) - 1
         panel(:, j) = 0.0_wp
         do k = at%matrix_start(at%column(s) + j), at%matrix_start(at%column(s) + j + 1) - 1
            panel(at%place(at%matrix_row(k)), j) = value(at%from(k))
         end do
      end do
   end subroutine load_panel

   !> Subtract what a supernode before it leaves to a panel, and hand that supernode on
   subroutine subtract_update(at, s, d, before, height, panel)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> The supernode, and one in its list
      integer, intent(in) :: s, d
      !> Panel of the latter
      real(wp), intent(in) :: before(0:*)
      !> Rows of the panel
      integer, intent(in) :: height
      !> The panel
      real(wp), intent(inout) :: panel(0:height - 1, 0:*)

      integer :: depth, rows, columns, skip, rank, first, last, i, j

      depth = int(at%first_row(d + 1) - at%first_row(d))
      rank = int(at%column(d + 1) - at%column(d))
      skip = at%done(d)
      rows = depth - skip
      associate (row => at%row(at%first_row(d) + skip:), target => at%target)
         columns = 0
         do i = 0, rows - 1
            if (row(1 + i) < at%column(s + 1)) columns = i + 1
            target(i) = at%place(row(1 + i))
         end do
         if (target(rows - 1) - target(0) == rows - 1) then  ! neighbouring rows need no gathering
            call add_product(0, columns, -1.0_wp, 1.0_wp, height, panel(target(0), target(0)))
         else
            last = 0
            do while (last < columns)
               first = last
               last = min(columns, first + max(few_columns, largest_update/(rows - first)))
               call add_product(first, last, 1.0_wp, 0.0_wp, rows - first, at%update)
               do j = first, last - 1
                  do i = j, rows - 1
                     panel(target(i), target(j)) = panel(target(i), target(j)) &
                        - at%update(i - first + (j - first)*(rows - first))
                  end do
               end do
            end do
         end if
      end associate
      if (columns < rows) call enlist(at, d, skip + columns)

   contains

      !> c = alpha b b^T + beta c for some columns, the lower triangle of them and all below
      subroutine add_product(first, last, alpha, beta, stride, c)
         !> Columns before them, and up to them
         integer, intent(in) :: first, last
         !> Factors
         real(wp), intent(in) :: alpha, beta
         !> Rows between columns of c
         integer, intent(in) :: stride
         !> The sum
         real(wp), intent(inout) :: c(0:*)

         integer :: n

         n = last - first
         if (n <= few_columns .and. .not. beta > 0.0_wp) then
            call dgemm('N', 'T', rows - first, n, rank, alpha, before(skip + first), depth, &
                       before(skip + first), depth, beta, c, stride)
            return
         end if
         call dsyrk('L', 'N', n, rank, alpha, before(skip + first), depth, beta, c, stride)
         if (rows == last) return
         call dgemm('N', 'T', rows - last, n, rank, alpha, before(skip + last), depth, &
                    before(skip + first), depth, beta, c(n), stride)
      end subroutine add_product

   end subroutine subtract_update

   !> Put a supernode into the list of the one that holds its next row
   subroutine enlist(at, d, done)
      !> Where the factorization stands
      type(progress_type), intent(inout) :: at
      !> The supernode, and the rows of it that are done
      integer, intent(in) :: d, done

      integer :: s

      s = at%supernode(at%row(at%first_row(d) + done))
      at%done(d) = done
      at%next(d) = at%head(s)
      at%head(s) = d
   end subroutine enlist

end module axijoint_solver_supernodal
