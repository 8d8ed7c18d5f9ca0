!> Thin walls, whose elements, longer than a wall is thick, move each other along it
module axijoint_analysis_fine_walls
   use axijoint_base_kinds, only : wp
   use axijoint_base_union_find, only : unite, find_roots
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_mesh, only : mesh_type, n_elements
   use axijoint_model_neighbours, only : neighbours_type, new_neighbours, element_at_edge
   implicit none
   private
   public :: walls_type, find_walls, long_sides, is_slender, most_across, longest_seen, longest_by_stress

   !> An element longer than this times its width is strongly coupled to its neighbours across its
   !> long sides
   real(wp), parameter :: slender = 2.0_wp*(1.0_wp + 1.0e-9_wp)  ! rounding, of units, does not decide
   !> A wall of elements longer than this times sqrt(r t), the length over which a tube of radius r bends where it is
   !> loaded or held, or than this times its thickness t, is strongly coupled along itself: what bends it within an element
   !> moves its neighbours. With lines across it alone estimates were up to 4 times too small from 1.2 sqrt(r t) on at
   !> t = r/300, 10 times from 0.6 on at r/3000: from 20 t on, with triangles from 15 t on
   real(wp), parameter :: bending = 2.0_wp, long_beside_wall = 10.0_wp
   !> Elements of a wall longer than this times sqrt(r t) see next to nothing of how it bends at its edges, and those half as long
   !> no more: at rims that are bent errors were up to 1.5 times their estimates at 6, 2 to 3 at 8, 13 to 40 at 20
   real(wp), parameter :: longest_seen = 6.0_wp
   !> Of how stress changes there elements longer than this times sqrt(r t) see a part: its errors at rims that are bent were 1.2 to 1.4
   !> times their estimates at 0.38, up to 2.2 at 0.76, 2.4 to 3.9 at 0.9 to 1.6
   real(wp), parameter :: longest_by_stress = 0.6_wp
   !> A wall as thick as more than this part of its radius bends as a whole, not round its circle
   real(wp), parameter :: shell = 0.5_wp
   !> Elements from one surface of such a wall to the other at most, of which two triangles are one: more make its block wide
   integer, parameter :: most_across = 4

   !> The walls of a mesh
   type :: walls_type
      !> Elements from one surface to the other, of which two triangles are one, of each wall that is solved as a whole; zero for
      !> elements that are in none. Shape (elements)
      real(wp), allocatable :: across(:)
      !> Whether there are walls that have more across: what bends them is seen in part; and whether there are walls with elements
      !> at their edges so long that these see nothing of how the edges bend
      logical :: bends_unseen = .false., edges_unseen = .false.
      !> Whether they are so long that they see a part of how stress changes there
      logical :: stress_in_part = .false.
   end type walls_type

contains

   !> Find the walls of a mesh: from one surface of a body to the other, along long sides, there are slender elements only, and these
   !> are longer than it is thick; in bodies with such elements that couple it along itself
   function find_walls(mesh) result(walls)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Its walls
      type(walls_type) :: walls

      type(neighbours_type) :: neighbours
      integer, dimension(n_elements(mesh)) :: root, surfaces, halves
      real(wp), dimension(n_elements(mesh)) :: thickness, length, radius
      logical :: long(4, n_elements(mesh)), wall(n_elements(mesh)), bends(n_elements(mesh))
      integer :: k, side, i, other

      allocate (walls%across(n_elements(mesh)), source=0.0_wp)
      if (.not. any([(may_be_wall(mesh, k), k=1, n_elements(mesh))])) return
      neighbours = new_neighbours(mesh)
      root = [(k, k=1, size(root))]
      do k = 1, size(root)
         long(:, k) = long_sides(mesh, k)
      end do
      surfaces = 0
      do k = 1, size(root)
         associate (nodes => mesh%element_nodes(:, k), corners => n_corners(mesh%element_size(k)))
            do side = 1, corners
               if (.not. long(side, k)) cycle
               other = element_at_edge(mesh, neighbours, nodes(side), nodes(mod(side, corners) + 1), k)
               if (other > 0) call unite(root, k, other)
               if (other == 0) surfaces(k) = surfaces(k) + 1
            end do
         end associate
      end do
      call find_roots(root)
      halves = 0
      thickness = 0.0_wp
      radius = 0.0_wp
      length = huge(1.0_wp)
      do k = 1, size(root)
         i = root(k)
         if (.not. any(long(:, k))) then
            length(i) = 0.0_wp
            cycle
         end if
         associate (n => n_corners(mesh%element_size(k)), sides => side_lengths(mesh, k))
            thickness(i) = thickness(i) + minval(sides(:n))*merge(0.5_wp, 1.0_wp, n == 3)
            length(i) = min(length(i), maxval(sides(:n)))
            radius(i) = max(radius(i), maxval(mesh%coordinates(1, mesh%element_nodes(:n, k))))
            if (i /= k) surfaces(i) = surfaces(i) + surfaces(k)
            halves(i) = halves(i) + n - 2
         end associate
      end do
      do k = 1, size(root)
         i = root(k)
         wall(k) = surfaces(i) == 2 .and. length(i) > slender*thickness(i)
         bends(k) = wall(k) .and. length(i) > longest_free(radius(i), thickness(i))
         walls%bends_unseen = walls%bends_unseen .or. (bends(k) .and. halves(i) > 2*most_across)
         if (wall(k) .and. halves(i) <= 2*most_across) walls%across(k) = 0.5_wp*halves(i)
      end do
      do k = 1, size(root)
         i = root(k)
         if (.not. wall(k) .or. walls%edges_unseen .or. thickness(i) > shell*radius(i)) cycle
         associate (of_bending => steepness(mesh, k)*length(i)**2/(radius(i)*thickness(i)))
            if (of_bending <= longest_by_stress**2) cycle
            if (.not. is_at_edge(k)) cycle
            walls%stress_in_part = .true.
            walls%edges_unseen = of_bending > longest_seen**2
         end associate
      end do
      do i = 1, maxval(mesh%element_body)
         if (.not. any(bends .and. walls%across > 0.0_wp .and. mesh%element_body == i)) &
            where (mesh%element_body == i) walls%across = 0.0_wp
      end do

   contains

      !> Whether an element is the last of its wall
      pure logical function is_at_edge(k)
         !> The element
         integer, intent(in) :: k

         integer :: beyond, side

         is_at_edge = .false.
         associate (nodes => mesh%element_nodes(:, k), corners => n_corners(mesh%element_size(k)))
            do side = 1, corners
               if (long(side, k)) cycle
               beyond = element_at_edge(mesh, neighbours, nodes(side), nodes(mod(side, corners) + 1), k)
               if (beyond == 0) is_at_edge = .true.
               if (beyond > 0) is_at_edge = is_at_edge .or. .not. wall(beyond)
            end do
         end associate
      end function is_at_edge

   end function find_walls

   !> Rise of a wall over its length: the radius that it bends by is that of its circle over this. None of a plate
   pure real(wp) function steepness(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> An element of the wall
      integer, intent(in) :: element

      real(wp) :: along(2)
      integer :: n, side

      n = n_corners(mesh%element_size(element))
      associate (x => mesh%coordinates(:, mesh%element_nodes(:n, element)), sides => side_lengths(mesh, element))
         side = maxloc(sides(:n), 1)
         along = x(:, mod(side, n) + 1) - x(:, side)
         steepness = abs(along(2))/norm2(along)
      end associate
   end function steepness

   !> Length of the elements of a wall from which on they couple it along itself
   pure real(wp) function longest_free(radius, thickness)
      !> Of the wall
      real(wp), intent(in) :: radius, thickness

      longest_free = min(long_beside_wall*thickness, bending*sqrt(radius*thickness))
   end function longest_free

   !> Which sides of an element are long ones; none if it is not slender
   pure function long_sides(mesh, element) result(long)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> Whether a side is long
      logical :: long(4)

      real(wp) :: length(4)

      associate (n => n_corners(mesh%element_size(element)))
         length = side_lengths(mesh, element)
         long = .false.
         long(:n) = length(:n) > slender*minval(length(:n))
      end associate
   end function long_sides

   !> Lengths of the sides of an element, of four sides the means of opposite ones
   pure function side_lengths(mesh, element) result(length)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> Lengths; that of a fourth side of a triangle is zero
      real(wp) :: length(4)

      integer :: i, n

      n = n_corners(mesh%element_size(element))
      length = 0.0_wp
      associate (x => mesh%coordinates(:, mesh%element_nodes(:n, element)))
         length(:n) = [(norm2(x(:, mod(i, n) + 1) - x(:, i)), i=1, n)]
      end associate
      if (n == 3) return
      length(1::2) = 0.5_wp*sum(length(1::2))
      length(2::2) = 0.5_wp*sum(length(2::2))
   end function side_lengths

   !> Whether an element is strongly coupled to its neighbours across its long sides
   pure logical function is_slender(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element

      is_slender = any(long_sides(mesh, element))
   end function is_slender

   !> Whether an element is so long that it may be part of a wall that it couples along itself
   pure logical function may_be_wall(mesh, element)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element

      associate (n => n_corners(mesh%element_size(element)), sides => side_lengths(mesh, element))
         associate (r => mesh%coordinates(1, mesh%element_nodes(:n, element)), narrow => minval(sides(:n)))
            may_be_wall = maxval(sides) > max(slender*narrow, longest_free(maxval(r), narrow))
         end associate
      end associate
   end function may_be_wall

end module axijoint_analysis_fine_walls
