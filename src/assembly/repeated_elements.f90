!> Elements that are alike: one that is shifted along the axis has the same stiffness. In a fine mesh two of the four
!> children of a rectangle are like the two below them, in an even one all along the axis are. Which element is
!> integrated for those that are like it does not depend on who asks
module axijoint_assembly_repeated_elements
   use axijoint_base_kinds, only : wp, i8
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_elements
   implicit none
   private
   public :: shapes_type, find_shapes, number_alike

   !> Difference of coordinates that are alike, over the largest of the mesh: what rounding leaves of them
   real(wp), parameter :: rounding = 8.0_wp*epsilon(1.0_wp)
   !> Places of the table in which shapes are looked up, for every element: two shapes of one place find each other's
   !> trace and nothing else. What brings them to different places
   integer, parameter :: places_of_element = 4
   real(wp), parameter :: scatter = 12345.678_wp

   !> Shapes of the elements of a mesh
   type :: shapes_type
      !> Number of the shape of each element, and the first element of each shape
      integer, allocatable :: number(:), first(:)
   end type shapes_type

contains

   !> Find elements of the same kind, material and size that lie above each other
   pure subroutine find_shapes(mesh, shapes)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The shapes
      type(shapes_type), intent(out) :: shapes

      real(wp) :: x(2, max_element_nodes), extent
      integer, allocatable :: last(:)
      integer :: k, n, place, n_own

      extent = maxval(abs(mesh%coordinates))
      allocate (shapes%number(n_elements(mesh)), shapes%first(n_elements(mesh)))
      allocate (last(places_of_element*n_elements(mesh)), source=0)
      n = 0
      do k = 1, n_elements(mesh)
         n_own = mesh%element_size(k)
         x(:, :n_own) = from_first(mesh, k, n_own)
         place = table_place(size(last), x(:, :n_own), extent, mesh%element_kind(k), mesh%element_material(k))
         associate (shape => last(place))
            if (shape > 0) then
               if (is_same(mesh, k, shapes%first(shape), x(:, :n_own), rounding*extent)) then
                  shapes%number(k) = shape
                  cycle
               end if
            end if
            n = n + 1
            shapes%number(k) = n
            shapes%first(n) = k
            shape = n
         end associate
      end do
      shapes%first = shapes%first(:n)
   end subroutine find_shapes

   !> Number of elements that have each one's shape, itself among them
   pure function number_alike(shapes) result(alike)
      !> Shapes of the elements
      type(shapes_type), intent(in) :: shapes
      !> Shape (elements)
      integer :: alike(size(shapes%number))

      integer :: of_shape(size(shapes%first)), k

      of_shape = 0
      do k = 1, size(alike)
         of_shape(shapes%number(k)) = of_shape(shapes%number(k)) + 1
      end do
      alike = of_shape(shapes%number)
   end function number_alike

   !> Place in the table of elements that lie so; that of others is another as a rule
   pure integer function table_place(n, x, extent, kind, material)
      !> Places of the table
      integer, intent(in) :: n
      !> Coordinates of the nodes, and the largest of the mesh
      real(wp), intent(in) :: x(:, :), extent
      !> Kind and material
      integer, intent(in) :: kind, material

      real(wp) :: lengths
      integer :: i

      lengths = 0.0_wp
      do i = 1, size(x, 2)
         lengths = lengths + i*(x(1, i) + 3.0_wp*x(2, i))
      end do
      lengths = scatter*lengths/extent
      table_place = 1 + modulo(int(n*(lengths - floor(lengths, i8))) + 37*kind + 101*material, n)
   end function table_place

   !> Coordinates of the nodes of an element, z from the first node on
   pure function from_first(mesh, element, n) result(x)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Element, and its number of nodes
      integer, intent(in) :: element, n
      !> r and z
      real(wp) :: x(2, n)

      real(wp) :: z
      integer :: i

      z = mesh%coordinates(2, mesh%element_nodes(1, element))
      do i = 1, n
         associate (node => mesh%element_nodes(i, element))
            x(1, i) = mesh%coordinates(1, node)
            x(2, i) = mesh%coordinates(2, node) - z
         end associate
      end do
   end function from_first

   !> Whether two elements are alike
   pure logical function is_same(mesh, a, b, x, tolerance)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The elements
      integer, intent(in) :: a, b
      !> Coordinates of the first
      real(wp), intent(in) :: x(:, :)
      !> Difference of coordinates
      real(wp), intent(in) :: tolerance

      is_same = mesh%element_kind(a) == mesh%element_kind(b) .and. mesh%element_material(a) == mesh%element_material(b)
      if (is_same) is_same = all(abs(x - from_first(mesh, b, size(x, 2))) <= tolerance)
   end function is_same

end module axijoint_assembly_repeated_elements
