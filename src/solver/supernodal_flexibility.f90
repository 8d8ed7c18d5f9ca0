!> The flexibility of a matrix under loads on one or two equations, by its supernodal Cholesky factor, whatever the order
!>
!> With the loads E it is (L^-1 E)^T (L^-1 E). A load is felt only from the supernode of its first equation to the root of
!> the elimination tree: going up the tree, each supernode takes what those below leave on its rows, for the loads of its
!> subtree alone, which are neighbours in a postordered tree, eliminates its own unknowns, and adds the product of what it
!> found. Two equations that the matrix couples lie one above the other in the tree, and the load acts on the second where
!> that is met. Nothing takes the cube of the loads' number unless separators grow as it does.
module axijoint_solver_supernodal_flexibility
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_double, c_int32_t, c_int64_t
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : let_fail
   use axijoint_linalg_lapack, only : dgemm, dtrsm
   use axijoint_linalg_symmetric_half, only : add_squares
   use axijoint_solver_supernodal, only : supernodal_structure_type
   implicit none
   private
   public :: supernodal_flexibility, supernodal_flexibility_operations

   !> Ends a list
   integer, parameter :: nobody = 0

   !> The elimination tree of the supernodes, and the loads below each
   type :: tree_type
      integer(c_int64_t), pointer, contiguous :: column(:), first_row(:), first_number(:), row(:)
      !> Parent of each supernode; `nobody` of a root
      integer, allocatable :: parent(:)
      !> First and last load in the subtree of each supernode, and the first of its own
      integer, allocatable :: first(:), last(:), own(:)
      !> Supernode of each equation, counted from zero
      integer, allocatable :: supernode(:)
      !> Loads whose second equation each supernode has: the first of them, and the one after each
      integer, allocatable :: second(:), after(:)
   end type tree_type

   !> What the loads of a subtree leave on the rows of its root
   type :: left_type
      real(wp), allocatable :: x(:, :)
   end type left_type

contains

   !> The flexibility under some loads
   subroutine supernodal_flexibility(structure, l, n_loads, place, factor, flexibility, code) &
      bind(c, name='axijoint_supernodal_flexibility')
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> The factor, panel by panel
      real(c_double), intent(in) :: l(0:*)
      !> Loads; places of their two equations in the order of the factor, counted from zero, the first ascending and none beyond
      !> the second; what acts on them
      integer(c_int64_t), value :: n_loads
      integer(c_int64_t), intent(in) :: place(2, n_loads)
      real(c_double), intent(in) :: factor(2, n_loads)
      !> The flexibility, zeros so far, half of which is kept
      real(c_double), intent(inout) :: flexibility(*)
      !> 0; 1 if there is no memory; 2 if two equations of a load do not lie one above the other
      integer(c_int32_t), intent(out) :: code

      type(tree_type) :: tree
      type(left_type), allocatable :: left(:)
      integer, allocatable :: head(:), next(:), position(:)
      integer :: s, stat

      call let_fail(.true.)
      call new_tree(structure, place(1, :), tree, stat)
      if (stat == 0) call find_second(place(2, :), tree, stat)
      if (stat == 0) allocate (left(structure%n_supernodes), head(structure%n_supernodes), &
         next(structure%n_supernodes), position(0:structure%n - 1), stat=stat)
      call let_fail(.false.)
      code = merge(0_c_int32_t, 1_c_int32_t, stat == 0)
      if (code == 0 .and. .not. are_above(tree, place)) code = 2
      if (code /= 0) return
      head = nobody
      do s = 1, size(head)
         if (tree%last(s) < tree%first(s)) cycle  ! no loads below
         call take_loads(tree, s, place, factor, position, head, next, left, stat)
         if (stat /= 0) then
            code = 1
            return
         end if
         call eliminate(int(tree%first_row(s + 1) - tree%first_row(s)), int(tree%column(s + 1) - tree%column(s)), &
            tree%last(s) - tree%first(s) + 1, l(tree%first_number(s)), left(s)%x, tree%first(s), int(n_loads), flexibility)
         associate (parent => tree%parent(s))
            if (parent == nobody) then
               deallocate (left(s)%x)
            else
               next(s) = head(parent)
               head(parent) = s
            end if
         end associate
      end do
   end subroutine supernodal_flexibility

   !> Operations that this takes
   subroutine supernodal_flexibility_operations(structure, n_loads, place, operations, code) &
      bind(c, name='axijoint_supernodal_flexibility_operations')
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> Loads, and places of their two equations as above
      integer(c_int64_t), value :: n_loads
      integer(c_int64_t), intent(in) :: place(2, n_loads)
      !> The operations
      real(c_double), intent(out) :: operations
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(out) :: code

      type(tree_type) :: tree
      real(wp) :: height, width, loads
      integer :: s, stat

      operations = 0.0_wp
      call let_fail(.true.)
      call new_tree(structure, place(1, :), tree, stat)
      call let_fail(.false.)
      code = merge(0_c_int32_t, 1_c_int32_t, stat == 0)
      if (code /= 0) return
      do s = 1, size(tree%parent)
         loads = tree%last(s) - tree%first(s) + 1
         height = tree%first_row(s + 1) - tree%first_row(s)
         width = tree%column(s + 1) - tree%column(s)
         operations = operations + width*loads*(2.0_wp*height - width + loads)
      end do
   end subroutine supernodal_flexibility_operations

   !> Where loads act a second time
   subroutine find_second(place, tree, stat)
      !> Places of the second equations, counted from zero
      integer(c_int64_t), intent(in) :: place(:)
      !> The tree
      type(tree_type), intent(inout) :: tree
      !> Not 0 if there is no memory
      integer, intent(out) :: stat

      integer :: j

      allocate (tree%second(size(tree%parent)), tree%after(size(place)), stat=stat)
      if (stat /= 0) return
      tree%second = nobody
      do j = 1, size(place)
         associate (second => tree%second(tree%supernode(place(j))))
            tree%after(j) = second
            second = j
         end associate
      end do
   end subroutine find_second

   !> Whether the second equation of each load lies on the way of the first to the root
   pure logical function are_above(tree, place)
      !> The tree
      type(tree_type), intent(in) :: tree
      !> Places of both equations, counted from zero
      integer(c_int64_t), intent(in) :: place(:, :)

      integer :: j

      are_above = .true.
      do j = 1, size(place, 2)
         associate (s => tree%supernode(place(2, j)))
            are_above = are_above .and. j >= tree%first(s) .and. j <= tree%last(s)
         end associate
      end do
   end function are_above

   !> The tree, and the loads of its subtrees
   subroutine new_tree(structure, place, tree, stat)
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> Places of the first equations of the loads, ascending, counted from zero
      integer(c_int64_t), intent(in) :: place(:)
      !> The tree
      type(tree_type), intent(out) :: tree
      !> Not 0 if there is no memory
      integer, intent(out) :: stat

      integer :: n, s
      integer(i8) :: below

      n = int(structure%n_supernodes)
      call c_f_pointer(structure%column, tree%column, [n + 1])
      call c_f_pointer(structure%first_row, tree%first_row, [n + 1])
      call c_f_pointer(structure%first_number, tree%first_number, [n + 1])
      call c_f_pointer(structure%row, tree%row, [tree%first_row(n + 1)])
      allocate (tree%parent(n), tree%first(n), tree%last(n), tree%own(n), tree%supernode(0:structure%n - 1), stat=stat)
      if (stat /= 0) return
      tree%last = 0
      do s = 1, n
         tree%supernode(tree%column(s):tree%column(s + 1) - 1) = s
         if (s > 1) tree%last(s) = tree%last(s - 1)
         do while (tree%last(s) < size(place))
            if (place(tree%last(s) + 1) >= tree%column(s + 1)) exit
            tree%last(s) = tree%last(s) + 1
         end do
         tree%own(s) = 1
         if (s > 1) tree%own(s) = tree%last(s - 1) + 1
      end do
      tree%first = tree%own
      do s = 1, n
         below = tree%first_row(s) + tree%column(s + 1) - tree%column(s)
         tree%parent(s) = nobody
         if (below == tree%first_row(s + 1)) cycle
         tree%parent(s) = tree%supernode(tree%row(below + 1))
         tree%first(tree%parent(s)) = min(tree%first(tree%parent(s)), tree%first(s))
      end do
   end subroutine new_tree

   !> Loads of a subtree on the rows of its root: those on its own unknowns, and what its children leave
   subroutine take_loads(tree, s, place, factor, position, head, next, left, stat)
      !> The tree
      type(tree_type), intent(in) :: tree
      !> The root
      integer, intent(in) :: s
      !> Places of both equations of the loads, counted from zero, and what acts on them
      integer(c_int64_t), intent(in) :: place(:, :)
      real(c_double), intent(in) :: factor(:, :)
      !> Place of each row among those of the root
      integer, intent(inout) :: position(0:)
      !> First child of each supernode that has loads, and the child after each
      integer, intent(in) :: head(:), next(:)
      !> What is left of the children, which is given up, and the loads of the root
      type(left_type), intent(inout) :: left(:)
      !> Not 0 if there is no memory
      integer, intent(out) :: stat

      integer(i8) :: from
      integer :: child, j, k, width, height

      height = int(tree%first_row(s + 1) - tree%first_row(s))
      call let_fail(.true.)
      allocate (left(s)%x(height, tree%first(s):tree%last(s)), stat=stat)
      call let_fail(.false.)
      if (stat /= 0) return
      do k = 1, height
         position(tree%row(tree%first_row(s) + k)) = k
      end do
      left(s)%x = 0.0_wp
      do j = tree%own(s), tree%last(s)
         left(s)%x(place(1, j) - tree%column(s) + 1, j) = factor(1, j)
      end do
      j = tree%second(s)
      do while (j /= nobody)
         associate (x => left(s)%x(place(2, j) - tree%column(s) + 1, j))
            x = x + factor(2, j)
         end associate
         j = tree%after(j)
      end do
      child = head(s)
      do while (child /= nobody)
         width = int(tree%column(child + 1) - tree%column(child))
         height = int(tree%first_row(child + 1) - tree%first_row(child))
         from = tree%first_row(child)
         do j = tree%first(child), tree%last(child)
            do k = width + 1, height
               associate (row => position(tree%row(from + k)))
                  left(s)%x(row, j) = left(s)%x(row, j) + left(child)%x(k, j)
               end associate
            end do
         end do
         deallocate (left(child)%x)
         child = next(child)
      end do
   end subroutine take_loads

   !> Eliminate the unknowns of a supernode from the loads of its subtree, and add the product of what they are
   subroutine eliminate(height, width, n_loads, panel, x, first, n, flexibility)
      !> Rows, columns, loads
      integer, intent(in) :: height, width, n_loads
      !> The panel, its first rows a lower triangle
      real(wp), intent(in) :: panel(height, width)
      !> The loads; then, in the rows below the triangle, what they leave there
      real(wp), intent(inout) :: x(height, n_loads)
      !> The first of them among all, and how many there are
      integer, intent(in) :: first, n
      !> The flexibility
      real(wp), intent(inout) :: flexibility(*)

      call dtrsm('L', 'L', 'N', 'N', width, n_loads, 1.0_wp, panel, height, x, height)
      if (height > width) call dgemm('N', 'N', height - width, n_loads, width, -1.0_wp, panel(width + 1, 1), height, x, height, &
         1.0_wp, x(width + 1, 1), height)
      call add_squares(n, flexibility, first, height, width, n_loads, x)
   end subroutine eliminate

end module axijoint_solver_supernodal_flexibility
