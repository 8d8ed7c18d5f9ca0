!> Where stresses are infinite: corners, ends of supports and of materials, edges of stiff joints, the axis of orthotropic solids.
!> There an error in per cent means nothing; what can be said is the exponent
module axijoint_analysis_fine_singular_places
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, find_edge
   use axijoint_analysis_fine_wedges, only : sector_type, wedges_type, divide
   use axijoint_base_kinds, only : wp, pi
   use axijoint_element_axis_exponent, only : axis_exponent
   use axijoint_element_wedge, only : wedge_exponent
   use axijoint_fe_mode, only : mode_type
   use axijoint_fe_shape, only : n_corners
   use axijoint_model_joint_sides, only : elements_beside, moduli_beside
   use axijoint_model_material, only : elasticity
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type, can_yield_at, on_axis
   use axijoint_model_modes, only : used_modes
   implicit none
   private
   public :: singular_place_type, find_singular_places, judged_points, decide_what_is_judged

   !> Stresses that grow more slowly than this are not called infinite
   real(wp), parameter :: slow = -0.05_wp
   !> Joint stresses are judged farther from such a place than this part of the joints' length, and than the radius there
   real(wp), parameter :: reach = 0.1_wp
   !> Joints at least as stiff beside the bodies, k/E times that distance, hold them together as
   !> seen from there: their stress grows as if they were bonded, until as near as E/k
   real(wp), parameter :: bonding = 1.0_wp - 1.0e-9_wp  ! rounding, of units, does not decide

   !> A place
   type :: singular_place_type
      !> Node
      integer :: node = 0
      !> Stresses go like the distance to this power; -1 < exponent < 0
      real(wp) :: exponent = 0.0_wp
      !> Joint stresses that are nearer are not judged; zero if they are not infinite there [length]
      real(wp) :: distance = 0.0_wp
   end type singular_place_type

   !> Sectors of all corners: those of a node are listed from start(node) to start(node + 1) - 1
   type :: corners_type
      integer, allocatable :: start(:)
      type(sector_type), allocatable :: sectors(:)
   end type corners_type

   !> Joints at the nodes
   type :: joint_places_type
      !> The first of the nodes that joints hold together at one place; the node itself without
      !> joints
      integer, allocatable :: together(:)
      !> Whether a joint that cannot open, or the solid before the tip of a slit, holds the node
      logical, allocatable :: holds(:)
      !> Largest stiffness k/E of the joints there, and length of the line of joints; zero without
      !> joints
      real(wp), allocatable :: stiffness(:), length(:)
   end type joint_places_type

contains

   !> Find the places
   function find_singular_places(model, fine) result(places)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> The places
      type(singular_place_type), allocatable :: places(:)

      type(corners_type) :: corners
      type(joint_places_type) :: joints
      type(wedges_type) :: wedges
      real(wp), allocatable :: exponents(:)
      real(wp) :: exponent(n_nodes(model%mesh)), distance
      integer :: node, k

      allocate (places(0))
      call look_at_joints(model, joints)
      corners = corners_of(model, fine, joints)
      do node = 1, n_nodes(model%mesh)
         call find_wedges(model, fine, corners, joints, node, wedges)
      end do
      allocate (exponents(wedges%n))
      !$omp parallel do schedule(dynamic)
      do k = 1, wedges%n
         exponents(k) = wedge_exponent(wedges%different(k)) - 1.0_wp
      end do
      !$omp end parallel do
      exponent = 0.0_wp
      do k = 1, wedges%n_tips
         associate (least => exponent(wedges%tip(1, k)))
            least = min(least, exponents(wedges%tip(2, k)))
         end associate
      end do
      call look_at_axis(model, exponent)
      do node = 1, n_nodes(model%mesh)
         if (.not. exponent(node) < slow) cycle
         distance = 0.0_wp
         if (hold_together(joints, node)) distance = min(reach*joints%length(node), model%mesh%coordinates(1, node))
         places = [places, singular_place_type(node, exponent(node), distance)]
      end do
   end function find_singular_places

   !> Look at the nodes on the axis, where solids with three moduli may have infinite stresses in some harmonics
   subroutine look_at_axis(model, exponent)
      !> The job
      type(model_type), intent(in) :: model
      !> Exponents of stresses at the nodes
      real(wp), intent(inout) :: exponent(:)

      type(mode_type), allocatable :: modes(:)
      real(wp) :: of_material(size(model%materials))
      logical, allocatable :: pole(:)
      integer :: k, j, element, node, i

      if (.not. any(model%materials%orthotropic)) return
      modes = used_modes(model)
      of_material = 0.0_wp
      do k = 1, size(of_material)
         if (.not. model%materials(k)%orthotropic) cycle
         of_material(k) = minval([(axis_exponent(elasticity(model%materials(k)), modes(j)%harmonic), j=1, size(modes))]) - 1.0_wp
      end do
      if (.not. any(of_material < slow)) return
      pole = on_axis(model%mesh)
      do element = 1, n_elements(model%mesh)
         do i = 1, n_corners(model%mesh%element_size(element))
            node = model%mesh%element_nodes(i, element)
            if (pole(node)) exponent(node) = min(exponent(node), of_material(model%mesh%element_material(element)))
         end do
      end do
   end subroutine look_at_axis

   !> Whether there can be singular places so near to which joint stresses are not judged: joints that hold bodies together
   logical function decide_what_is_judged(model) result(decide)
      !> The job
      type(model_type), intent(in) :: model

      type(joint_places_type) :: joints
      integer :: node

      call look_at_joints(model, joints)
      decide = any(hold_together(joints, [(node, node=1, n_nodes(model%mesh))]))
   end function decide_what_is_judged

   !> Find the wedges at a node; none on the axis, or if another node tells of the place
   subroutine find_wedges(model, fine, corners, joints, node, wedges)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Sectors of all corners
      type(corners_type), intent(in) :: corners
      !> Joints at the nodes
      type(joint_places_type), intent(in) :: joints
      !> The node
      integer, intent(in) :: node
      !> Takes the wedges
      type(wedges_type), intent(inout) :: wedges

      type(sector_type), allocatable :: sectors(:)

      if (.not. model%mesh%coordinates(1, node) > 0.0_wp) return
      if (.not. hold_together(joints, node)) then
         call divide(model, fine, corners%sectors(corners%start(node):corners%start(node + 1) - 1), node, &
            open=.true., wedges=wedges)
      ! others are told with the first node of the place
      else if (joints%together(node) == node) then
         sectors = sectors_at(corners, joints%together, node)
         call divide(model, fine, sectors, node, open=.false., wedges=wedges)
         ! where other joints hold, they have an edge where one opens
         if (any(joints%holds .and. joints%together == node)) &
            call divide(model, fine, sectors, node, open=.true., wedges=wedges)
      end if
   end subroutine find_wedges

   !> Whether joints hold the bodies together at a node, as seen from a little farther away
   elemental logical function hold_together(joints, node)
      !> Joints at the nodes
      type(joint_places_type), intent(in) :: joints
      !> The node
      integer, intent(in) :: node

      hold_together = joints%stiffness(node)*reach*joints%length(node) >= bonding
   end function hold_together

   !> Sectors of all nodes that are together
   function sectors_at(corners, together, node) result(sectors)
      !> Sectors of all corners
      type(corners_type), intent(in) :: corners
      !> First of the nodes that a node is together with
      integer, intent(in) :: together(:)
      !> The first
      integer, intent(in) :: node
      !> The sectors
      type(sector_type), allocatable :: sectors(:)

      integer :: k

      allocate (sectors(0))
      do k = node, size(together)
         if (together(k) == node) &
            sectors = [sectors, corners%sectors(corners%start(k):corners%start(k + 1) - 1)]
      end do
   end function sectors_at

   !> Sectors at the corners of all elements
   function corners_of(model, fine, joints) result(corners)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Joints at the nodes
      type(joint_places_type), intent(in) :: joints
      !> The sectors
      type(corners_type) :: corners

      integer, allocatable :: next(:)
      integer :: element, i, n, node, k
      logical :: opens(size(fine%edges))

      opens = is_outer(model%mesh, fine)
      do k = 1, n_joints(model%mesh)
         associate (nodes => model%mesh%joint_nodes(:, k))
            opens([find_edge(fine, nodes(1), nodes(2)), find_edge(fine, nodes(4), nodes(3))]) = &
               .false.
            ! soft ones count as open: at the tip of a slit both sides share the node
            if (.not. can_yield_at(model, model%mesh%joint_material(k)) .and. &
                hold_together(joints, nodes(1))) cycle
            opens([find_edge(fine, nodes(1), nodes(2)), find_edge(fine, nodes(4), nodes(3))]) = &
               .true.
         end associate
      end do
      associate (mesh => model%mesh)
      allocate (corners%start(n_nodes(mesh) + 1), source=0)
      do element = 1, n_elements(mesh)
         do i = 1, n_corners(mesh%element_size(element))
            node = mesh%element_nodes(i, element)
            corners%start(node + 1) = corners%start(node + 1) + 1
         end do
      end do
      corners%start(1) = 1
      do node = 1, n_nodes(mesh)
         corners%start(node + 1) = corners%start(node + 1) + corners%start(node)
      end do
      next = corners%start
      allocate (corners%sectors(corners%start(node) - 1))
      do element = 1, n_elements(mesh)
         n = n_corners(mesh%element_size(element))
         do i = 1, n
            node = mesh%element_nodes(i, element)
            corners%sectors(next(node)) = new_sector(mesh, element, i, n)
            corners%sectors(next(node))%opens = &
               opens(fine%element_edges([i, mod(i + n - 2, n) + 1], element))
            next(node) = next(node) + 1
         end do
      end do
      end associate
   end function corners_of

   !> Which edges belong to one element alone: without a joint, bodies that are bonded beside them
   !> gape there
   pure function is_outer(mesh, fine) result(outer)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Its edges
      type(fine_mesh_type), intent(in) :: fine
      !> Shape (edges)
      logical :: outer(size(fine%edges))

      integer :: n_elements_at(size(fine%edges)), element, side

      n_elements_at = 0
      do element = 1, n_elements(mesh)
         do side = 1, n_corners(mesh%element_size(element))
            associate (n => n_elements_at(fine%element_edges(side, element)))
               n = n + 1
            end associate
         end do
      end do
      outer = n_elements_at == 1
   end function is_outer

   !> The sector at a corner of an element
   pure function new_sector(mesh, element, i, n) result(sector)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The element, the corner, and the number of its corners
      integer, intent(in) :: element, i, n
      !> The sector
      type(sector_type) :: sector

      integer :: node, side(2), k
      real(wp) :: angle(2), way(2)

      node = mesh%element_nodes(i, element)
      sector%node = node
      sector%element = element
      side = [i, mod(i + n - 2, n) + 1]  ! the sides that begin and end here
      sector%ends = mesh%element_nodes([mod(i, n) + 1, side(2)], element)
      do k = 1, 2
         way = mesh%coordinates(:, sector%ends(k)) - mesh%coordinates(:, node)
         if (mesh%element_size(element) > 4) then  ! tangent of the parabola through the middle
            way = 4.0_wp*(mesh%coordinates(:, mesh%element_nodes(n + side(k), element)) - &
               mesh%coordinates(:, node)) - way
         end if
         angle(k) = atan2(way(2), way(1))
      end do
      sector%from = angle(1)
      sector%to = angle(1) + modulo(angle(2) - angle(1), 2.0_wp*pi)
   end function new_sector

   !> Find the joints at the nodes
   subroutine look_at_joints(model, joints)
      !> The job
      type(model_type), intent(in) :: model
      !> Takes what was found
      type(joint_places_type), intent(out) :: joints

      real(wp) :: h
      integer :: line(n_nodes(model%mesh)), k, i

      line = [(k, k=1, size(line))]
      joints%together = line
      allocate (joints%holds(size(line)), source=.false.)
      allocate (joints%stiffness(size(line)), joints%length(size(line)), source=0.0_wp)
      associate (mesh => model%mesh, modulus => moduli_beside(model, elements_beside(model%mesh)), n => n_joints(model%mesh))
         call unite(reshape(mesh%joint_nodes(:4, :), [4, n]), line)
         call unite(reshape(mesh%joint_nodes([1, 4, 2, 3], :), [2, 2*n]), joints%together)
         do k = 1, n
            associate (nodes => mesh%joint_nodes(:4, k), &
               law => model%joint_materials(mesh%joint_material(k))%law)
               if (.not. can_yield_at(model, mesh%joint_material(k))) joints%holds(nodes) = .true.
               if (nodes(1) == nodes(4)) joints%holds(nodes(1)) = .true.
               if (nodes(2) == nodes(3)) joints%holds(nodes(2)) = .true.
               h = norm2(mesh%coordinates(:, nodes(2)) - mesh%coordinates(:, nodes(1)))
               joints%length(line(nodes(1))) = joints%length(line(nodes(1))) + h
               do i = 1, 2
                  associate (stiffness => joints%stiffness(joints%together(nodes(i))))
                     stiffness = max(stiffness, &
                        maxval(law%stiffness/modulus(:, k)))
                  end associate
               end do
            end associate
         end do
      end associate
      joints%length = joints%length(line)
      joints%stiffness = joints%stiffness(joints%together)
   end subroutine look_at_joints

   !> Number nodes by the first of those that are in one set with them
   pure subroutine unite(sets, first)
      !> Nodes of each set, shape (any, sets)
      integer, intent(in) :: sets(:, :)
      !> The first node that is together with a node
      integer, intent(inout) :: first(:)

      integer :: k
      logical :: moved

      moved = .true.
      do while (moved)
         moved = .false.
         do k = 1, size(sets, 2)
            moved = moved .or. any(first(sets(:, k)) /= minval(first(sets(:, k))))
            first(sets(:, k)) = minval(first(sets(:, k)))
         end do
      end do
   end subroutine unite

   !> Whether joint stresses at points are judged: those that are far enough from singular places;
   !> all, if none is
   function judged_points(mesh, places, positions) result(judged)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The places
      type(singular_place_type), intent(in) :: places(:)
      !> r and z of the points, shape (2, points)
      real(wp), intent(in) :: positions(:, :)
      !> Shape (points)
      logical :: judged(size(positions, 2))

      real(wp), parameter :: rounding = 1.0e-9_wp  ! of units, does not decide
      integer :: k, i

      judged = .true.
      do k = 1, size(places)
         do i = 1, size(judged)
            judged(i) = judged(i) .and. norm2(positions(:, i) - &
               mesh%coordinates(:, places(k)%node)) >= (1.0_wp - rounding)*places(k)%distance
         end do
      end do
      if (.not. any(judged)) judged = .true.
   end function judged_points

end module axijoint_analysis_fine_singular_places
