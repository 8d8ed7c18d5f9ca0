!> The inverse of a matrix restricted to some equations, by its supernodal Cholesky factor, whatever the order
!>
!> With unit loads E on the equations it is (L^-1 E)^T (L^-1 E). A load is felt only from its supernode to the root of
!> the elimination tree: going up the tree, each supernode takes what those below leave on its rows, for the loads of its
!> subtree alone, which are neighbours in a postordered tree, eliminates its own unknowns, and adds the product of what it
!> found. Nothing takes the cube of the equations' number unless separators grow as it does.
module axijoint_solver_supernodal_inverse
   use, intrinsic :: iso_c_binding, only : c_f_pointer, c_double, c_int32_t, c_int64_t
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_last_words, only : let_fail
   use axijoint_linalg_lapack, only : dgemm, dsyrk, dtrsm
   use axijoint_solver_supernodal, only : supernodal_structure_type
   implicit none
   private
   public :: supernodal_inverse, supernodal_inverse_operations

   !> Ends a list
   integer, parameter :: nobody = 0

   !> The elimination tree of the supernodes, and the loads below each
   type :: tree_type
      integer(c_int64_t), pointer, contiguous :: column(:), first_row(:), first_number(:), row(:)
      !> Parent of each supernode; `nobody` of a root
      integer, allocatable :: parent(:)
      !> First and last load in the subtree of each supernode, and the first of its own
      integer, allocatable :: first(:), last(:), own(:)
   end type tree_type

   !> What the loads of a subtree leave on the rows of its root
   type :: left_type
      real(wp), allocatable :: x(:, :)
   end type left_type

contains

   !> The inverse at some equations
   subroutine supernodal_inverse(structure, l, n_loads, place, inverse, code) bind(c, name='axijoint_supernodal_inverse')
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> The factor, panel by panel
      real(c_double), intent(in) :: l(0:*)
      !> Equations, and their places in the order of the factor, ascending, counted from zero
      integer(c_int64_t), value :: n_loads
      integer(c_int64_t), intent(in) :: place(n_loads)
      !> Lower triangle of the inverse at these
      real(c_double), intent(inout) :: inverse(n_loads, n_loads)
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(out) :: code

      type(tree_type) :: tree
      type(left_type), allocatable :: left(:)
      integer, allocatable :: head(:), next(:), position(:)
      integer :: s, stat

      call let_fail(.true.)
      call new_tree(structure, place, tree, stat)
      if (stat == 0) allocate (left(structure%n_supernodes), head(structure%n_supernodes), &
         next(structure%n_supernodes), position(0:structure%n - 1), stat=stat)
      call let_fail(.false.)
      code = merge(0_c_int32_t, 1_c_int32_t, stat == 0)
      if (code /= 0) return
      inverse = 0.0_wp
      head = nobody
      do s = 1, size(head)
         if (tree%last(s) < tree%first(s)) cycle  ! no loads below
         call take_loads(tree, s, place, position, head, next, left, stat)
         if (stat /= 0) then
            code = 1
            return
         end if
         call eliminate(int(tree%first_row(s + 1) - tree%first_row(s)), int(tree%column(s + 1) - tree%column(s)), &
            tree%last(s) - tree%first(s) + 1, l(tree%first_number(s)), left(s)%x, int(n_loads), &
            inverse(tree%first(s), tree%first(s)))
         associate (parent => tree%parent(s))
            if (parent == nobody) then
               deallocate (left(s)%x)
            else
               next(s) = head(parent)
               head(parent) = s
            end if
         end associate
      end do
   end subroutine supernodal_inverse

   !> Operations that this takes
   subroutine supernodal_inverse_operations(structure, n_loads, place, operations, code) &
      bind(c, name='axijoint_supernodal_inverse_operations')
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> Equations, and their places in the order of the factor, ascending, counted from zero
      integer(c_int64_t), value :: n_loads
      integer(c_int64_t), intent(in) :: place(n_loads)
      !> The operations
      real(c_double), intent(out) :: operations
      !> 0; 1 if there is no memory
      integer(c_int32_t), intent(out) :: code

      type(tree_type) :: tree
      real(wp) :: height, width, loads
      integer :: s, stat

      operations = 0.0_wp
      call let_fail(.true.)
      call new_tree(structure, place, tree, stat)
      call let_fail(.false.)
      code = merge(0_c_int32_t, 1_c_int32_t, stat == 0)
      if (code /= 0) return
      do s = 1, size(tree%parent)
         loads = tree%last(s) - tree%first(s) + 1
         height = tree%first_row(s + 1) - tree%first_row(s)
         width = tree%column(s + 1) - tree%column(s)
         operations = operations + width*loads*(2.0_wp*height - width + loads)
      end do
   end subroutine supernodal_inverse_operations

   !> The tree, and the loads of its subtrees
   subroutine new_tree(structure, place, tree, stat)
      !> Structure of the factor
      type(supernodal_structure_type), intent(in) :: structure
      !> Places of the loads, ascending, counted from zero
      integer(c_int64_t), intent(in) :: place(:)
      !> The tree
      type(tree_type), intent(out) :: tree
      !> Not 0 if there is no memory
      integer, intent(out) :: stat

      integer, allocatable :: supernode(:)
      integer :: n, s
      integer(i8) :: below

      n = int(structure%n_supernodes)
      call c_f_pointer(structure%column, tree%column, [n + 1])
      call c_f_pointer(structure%first_row, tree%first_row, [n + 1])
      call c_f_pointer(structure%first_number, tree%first_number, [n + 1])
      call c_f_pointer(structure%row, tree%row, [tree%first_row(n + 1)])
      allocate (tree%parent(n), tree%first(n), tree%last(n), tree%own(n), supernode(0:structure%n - 1), stat=stat)
      if (stat /= 0) return
      tree%last = 0
      do s = 1, n
         supernode(tree%column(s):tree%column(s + 1) - 1) = s
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
         tree%parent(s) = supernode(tree%row(below + 1))
         tree%first(tree%parent(s)) = min(tree%first(tree%parent(s)), tree%first(s))
      end do
   end subroutine new_tree

   !> Loads of a subtree on the rows of its root: unit loads on its own unknowns, and what its children leave
   subroutine take_loads(tree, s, place, position, head, next, left, stat)
      !> The tree
      type(tree_type), intent(in) :: tree
      !> The root
      integer, intent(in) :: s
      !> Places of the loads, ascending, counted from zero
      integer(c_int64_t), intent(in) :: place(:)
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
         left(s)%x(place(j) - tree%column(s) + 1, j) = 1.0_wp
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
   subroutine eliminate(height, width, n_loads, panel, x, stride, inverse)
      !> Rows, columns, loads
      integer, intent(in) :: height, width, n_loads
      !> The panel, its first rows a lower triangle
      real(wp), intent(in) :: panel(height, width)
      !> The loads; then, in the rows below the triangle, what they leave there
      real(wp), intent(inout) :: x(height, n_loads)
      !> Distance of columns of the inverse
      integer, intent(in) :: stride
      !> Lower triangle of the inverse from the first of the loads on
      real(wp), intent(inout) :: inverse(stride, *)

      call dtrsm('L', 'L', 'N', 'N', width, n_loads, 1.0_wp, panel, height, x, height)
      if (height > width) call dgemm('N', 'N', height - width, n_loads, width, -1.0_wp, panel(width + 1, 1), height, x, height, &
         1.0_wp, x(width + 1, 1), height)
      call dsyrk('L', 'T', n_loads, width, 1.0_wp, x, height, 1.0_wp, inverse, stride)
   end subroutine eliminate

end module axijoint_solver_supernodal_inverse
