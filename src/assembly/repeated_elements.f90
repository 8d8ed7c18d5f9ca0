!> Elements that are alike: one that is shifted along the axis has the same stiffness. In a fine mesh two of the four
!> children of a rectangle are like the two below them, in an even one all along the axis are. Which element is
!> integrated for those that are like it does not depend on who asks
module axijoint_assembly_repeated_elements
   use axijoint_assembly_element_stiffness, only : integrands_type, element_blocks, max_blocks
   use axijoint_base_kinds, only : wp
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_elements
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: shapes_type, find_shapes, integrated_type, new_integrated, find_blocks

   !> Difference of coordinates that are alike, over the largest of the mesh: what rounding leaves of them
   real(wp), parameter :: rounding = 8.0_wp*epsilon(1.0_wp)
   !> Places of the table in which shapes are looked up, for every element: two shapes of one place find each other's
   !> trace and nothing else. What brings them to different places
   integer, parameter :: places_of_element = 4
   real(wp), parameter :: scatter = 12345.678_wp
   !> Most shapes whose blocks are kept, and elements of a mesh for one that is
   integer, parameter :: most_kept = 1024, a_share = 8

   !> Shapes of the elements of a mesh
   type :: shapes_type
      !> Number of the shape of each element, and the first element of each shape
      integer, allocatable :: number(:), first(:)
   end type shapes_type

   !> Blocks of the shapes that were asked for last
   type :: integrated_type
      !> Blocks as of `element/blocks`, shape (2, 3, 3, blocks, shapes)
      real(wp), allocatable :: blocks(:, :, :, :, :)
      !> Which shapes; 0 for none
      integer, allocatable, private :: shape(:)
   end type integrated_type

contains

   !> Find elements of the same kind, material and size that lie above each other
   pure subroutine find_shapes(mesh, shapes)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The shapes
      type(shapes_type), intent(out) :: shapes

      real(wp) :: x(2, max_element_nodes), extent
      integer, allocatable :: last(:)
      integer :: k, n, place

      extent = maxval(abs(mesh%coordinates))
      allocate (shapes%number(n_elements(mesh)), shapes%first(n_elements(mesh)))
      allocate (last(places_of_element*n_elements(mesh)), source=0)
      n = 0
      do k = 1, n_elements(mesh)
         x = from_first(mesh, k)
         place = table_place(size(last), x, extent, mesh%element_kind(k), mesh%element_material(k))
         associate (shape => last(place))
            if (shape > 0) then
               if (is_same(mesh, k, shapes%first(shape), x, rounding*extent)) then
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

   !> Place in the table of elements that lie so; that of others is another as a rule
   pure integer function table_place(n, x, extent, kind, material)
      !> Places of the table
      integer, intent(in) :: n
      !> Coordinates of the nodes, and the largest of the mesh
      real(wp), intent(in) :: x(2, max_element_nodes), extent
      !> Kind and material
      integer, intent(in) :: kind, material

      real(wp) :: lengths
      integer :: i

      lengths = 0.0_wp
      do i = 1, max_element_nodes
         lengths = lengths + i*(x(1, i) + 3.0_wp*x(2, i))
      end do
      table_place = 1 + modulo(int(n*modulo(scatter*lengths/extent, 1.0_wp)) + 37*kind + 101*material, n)
   end function table_place

   !> Coordinates of the nodes of an element, z from the first node on; zero beyond them
   pure function from_first(mesh, element) result(x)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Element
      integer, intent(in) :: element
      !> r and z
      real(wp) :: x(2, max_element_nodes)

      x = 0.0_wp
      associate (nodes => mesh%element_nodes(:mesh%element_size(element), element))
         x(:, :size(nodes)) = mesh%coordinates(:, nodes)
         x(2, :size(nodes)) = x(2, :size(nodes)) - mesh%coordinates(2, nodes(1))
      end associate
   end function from_first

   !> Whether two elements are alike
   pure logical function is_same(mesh, a, b, x, tolerance)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The elements
      integer, intent(in) :: a, b
      !> Coordinates of the first
      real(wp), intent(in) :: x(2, max_element_nodes)
      !> Difference of coordinates
      real(wp), intent(in) :: tolerance

      is_same = mesh%element_kind(a) == mesh%element_kind(b) .and. mesh%element_material(a) == mesh%element_material(b)
      if (is_same) is_same = all(abs(x - from_first(mesh, b)) <= tolerance)
   end function is_same

   !> Nothing is integrated so far
   subroutine new_integrated(shapes, integrated)
      !> The shapes
      type(shapes_type), intent(in) :: shapes
      !> Their blocks
      type(integrated_type), intent(out) :: integrated

      associate (n => 1 + min(most_kept, size(shapes%number)/a_share))
         allocate (integrated%shape(n), source=0)
         allocate (integrated%blocks(2, 3, 3, max_blocks, n))
      end associate
   end subroutine new_integrated

   !> Find the blocks of an element
   subroutine find_blocks(model, integrands, shapes, element, integrated, place)
      !> The job
      type(model_type), intent(in) :: model
      !> Its kinds of elements and kernels
      type(integrands_type), intent(in) :: integrands
      !> Shapes of its elements
      type(shapes_type), intent(in) :: shapes
      !> Element
      integer, intent(in) :: element
      !> Blocks of shapes
      type(integrated_type), intent(inout) :: integrated
      !> Where those of the element are among them
      integer, intent(out) :: place

      associate (shape => shapes%number(element))
         place = 1 + mod(shape - 1, size(integrated%shape))
         if (integrated%shape(place) == shape) return
         integrated%shape(place) = shape
         call element_blocks(model, integrands, shapes%first(shape), integrated%blocks(:, :, :, :, place))
      end associate
   end subroutine find_blocks

end module axijoint_assembly_repeated_elements
