!> Unknowns: which displacement component is which equation
module axijoint_assembly_dofs
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, is_torsion
   implicit none
   private
   public :: dofs_type, new_dofs, first_equation, gather, expand, collect, forces_between, kinematic_class
   public :: component_name

   !> Names of the components u, v, w
   character(len=*), parameter :: component_name(3) = ['u (r)    ', 'v (z)    ', 'w (theta)']

   !> Equations in one class of modes
   type :: dofs_type
      !> Number of equations
      integer :: n_equations = 0
      !> Equation of each component, shape (3, nodes); zero where there is none
      integer, allocatable :: equation(:, :)
      !> The component is this factor times the unknown of its equation
      real(wp), allocatable :: factor(:, :)
   end type dofs_type

contains

   !> Modes of one kinematic class have the same components: torsion has w only, the
   !> symmetric harmonic 0 no w; from 1 on, all have u, v, w, but on the axis 1
   !> and the rest differ
   elemental integer function kinematic_class(mode, touches_axis)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Whether the mesh has nodes at r = 0
      logical, intent(in) :: touches_axis

      kinematic_class = min(mode%harmonic, merge(2, 1, touches_axis))
      if (is_torsion(mode)) kinematic_class = -1
   end function kinematic_class

   !> Number the unknowns. At the pole r = 0 the displacement must be the same
   !> from all sides: m = 0: u = w = 0; m = 1: v = 0, w = -u; m >= 2: all zero
   subroutine new_dofs(dofs, mode, on_axis, fixed, order)
      !> The unknowns
      type(dofs_type), intent(out) :: dofs
      !> Any mode of the class
      type(mode_type), intent(in) :: mode
      !> Nodes at r = 0, shape (nodes)
      logical, intent(in) :: on_axis(:)
      !> Components that supports hold, shape (3, nodes)
      logical, intent(in) :: fixed(:, :)
      !> order(k) is the k-th node to be numbered
      integer, intent(in) :: order(:)

      logical :: free(3)
      integer :: k, node, i

      allocate (dofs%equation(3, size(order)), source=0)
      allocate (dofs%factor(3, size(order)), source=1.0_wp)
      do k = 1, size(order)
         node = order(k)
         free = .not. fixed(:, node)
         if (is_torsion(mode)) then
            free(1:2) = .false.
         else if (mode%harmonic == 0) then
            free(3) = .false.
         end if
         if (on_axis(node)) then
            select case (mode%harmonic)
            case (0)
               free([1, 3]) = .false.
            case (1)  ! w follows u, and is held with it
               free = [free(1) .and. free(3), .false., .false.]
            case default
               free = .false.
            end select
         end if
         do i = 1, 3
            if (.not. free(i)) cycle
            dofs%n_equations = dofs%n_equations + 1
            dofs%equation(i, node) = dofs%n_equations
         end do
         if (on_axis(node) .and. mode%harmonic == 1) then
            dofs%equation(3, node) = dofs%equation(1, node)
            dofs%factor(3, node) = -1.0_wp
         end if
      end do
   end subroutine new_dofs

   !> First equation of a node; zero if it has none
   pure integer function first_equation(equation)
      !> Equations of its components
      integer, intent(in) :: equation(3)

      first_equation = minval(equation, mask=equation > 0)
      if (all(equation == 0)) first_equation = 0
   end function first_equation

   !> Generalized forces of the equations from those of the components
   pure function gather(dofs, nodal) result(vector)
      !> The unknowns
      type(dofs_type), intent(in) :: dofs
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: nodal(:, :)
      !> Forces on equations, shape (n_equations)
      real(wp) :: vector(dofs%n_equations)

      integer :: node, i

      vector = 0.0_wp
      do node = 1, size(nodal, 2)
         do i = 1, 3
            associate (e => dofs%equation(i, node))
               if (e > 0) vector(e) = vector(e) + dofs%factor(i, node)*nodal(i, node)
            end associate
         end do
      end do
   end function gather

   !> Displacement components from the unknowns
   pure function expand(dofs, vector) result(nodal)
      !> The unknowns
      type(dofs_type), intent(in) :: dofs
      !> Values of the unknowns, shape (n_equations)
      real(wp), intent(in) :: vector(:)
      !> Components, shape (3, nodes); zero where there is no equation
      real(wp) :: nodal(3, size(dofs%equation, 2))

      integer :: node, i

      nodal = 0.0_wp
      do node = 1, size(nodal, 2)
         do i = 1, 3
            associate (e => dofs%equation(i, node))
               if (e > 0) nodal(i, node) = dofs%factor(i, node)*vector(e)
            end associate
         end do
      end do
   end function expand

   !> Values of the unknowns from displacement components
   pure function collect(dofs, nodal) result(vector)
      !> The unknowns
      type(dofs_type), intent(in) :: dofs
      !> Components, shape (3, nodes)
      real(wp), intent(in) :: nodal(:, :)
      !> Values, shape (n_equations)
      real(wp) :: vector(dofs%n_equations)

      integer :: node, i

      do node = 1, size(nodal, 2)
         do i = 1, 3
            associate (e => dofs%equation(i, node))
               if (e > 0) vector(e) = dofs%factor(i, node)*nodal(i, node)
            end associate
         end do
      end do
   end function collect

   !> Unit forces between nodes, on the second and against the first: on which equations they act, and by how much
   pure subroutine forces_between(dofs, pairs, equation, factor)
      !> The unknowns
      type(dofs_type), intent(in) :: dofs
      !> Both nodes of each pair, shape (2, pairs)
      integer, intent(in) :: pairs(:, :)
      !> Their equations, of which the mode has some, for all pairs along r, z, theta, shape (2, 3 pairs). Where there is none, it is
      !> any, and its factor is zero
      integer, allocatable, intent(out) :: equation(:, :)
      !> The factors, same shape
      real(wp), allocatable, intent(out) :: factor(:, :)

      !> What acts on the first and on the second node
      real(wp), parameter :: acting(2) = [-1.0_wp, 1.0_wp]
      integer :: i, k, n

      n = size(pairs, 2)
      allocate (equation(2, 3*n))
      allocate (factor(2, 3*n), source=0.0_wp)
      do i = 1, 3
         do k = 1, n
            associate (e => equation(:, (i - 1)*n + k))
               e = dofs%equation(i, pairs(:, k))
               where (e > 0) factor(:, (i - 1)*n + k) = acting*dofs%factor(i, pairs(:, k))
               where (e == 0) e = max(1, maxval(e))  ! with the other one, if that has an equation
            end associate
         end do
      end do
   end subroutine forces_between

end module axijoint_assembly_dofs
