!> Cuts z = const: what they pass through, found once for all states of a job
module axijoint_analysis_core_cut_planes
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : lower_node, upper_node
   use axijoint_model_locate, only : element_reach
   use axijoint_model_mesh, only : mesh_type, n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : cut_type
   implicit none
   private
   public :: plane_type, new_planes_of_cuts, of_body, from_cut, is_above

   !> Nodes this near to a cut, over the extent of the mesh, are on it
   real(wp), parameter :: on_cut = 1.0e-9_wp

   !> A cut, and what of that which is cut it passes through
   type :: plane_type
      !> Where [length]
      real(wp) :: z = 0.0_wp
      !> Height over the cut above which a node is above it, and whether one at that height is, too [length]
      real(wp) :: least = 0.0_wp
      logical :: reached = .false.
      !> Elements of the body
      integer, allocatable :: crossed(:)
      !> Elements between nodes of the body, whosever they are
      integer, allocatable :: massive(:)
      !> Joints between what is cut and what is not, and whether it is their upper side that is cut
      integer, allocatable :: joints(:)
      logical, allocatable :: upper(:)
      !> Loads on edges that have resultants (index), springs (index)
      integer, allocatable :: edges(:), springs(:)
   end type plane_type

contains

   !> What the cuts of a job pass through
   function new_planes_of_cuts(model) result(planes)
      !> The job
      type(model_type), intent(in) :: model
      !> One a cut
      type(plane_type), allocatable :: planes(:)

      real(wp), allocatable :: reach(:, :)
      logical :: cut(n_nodes(model%mesh))
      real(wp) :: tolerance, top
      integer :: c, k

      allocate (planes(size(model%cuts)))
      if (size(planes) == 0) return
      associate (x => model%mesh%coordinates)
         tolerance = on_cut*maxval(maxval(x, 2) - minval(x, 2))
      end associate
      reach = element_reach(model%mesh)
      do c = 1, size(planes)
         associate (wanted => model%cuts(c))
            if (wanted%body /= model%cuts(max(1, c - 1))%body .or. c == 1) then
               cut = of_body(model%mesh, wanted%body)
               top = maxval(model%mesh%coordinates(2, :), mask=cut)
            end if
            planes(c) = new_plane(model, wanted, cut, top, tolerance, pack([(k, k=1, size(reach, 2))], &
               reach(1, :) - 2.0_wp*tolerance <= wanted%z .and. wanted%z <= reach(2, :) + 2.0_wp*tolerance))
         end associate
      end do
   end function new_planes_of_cuts

   !> Nodes of what is cut
   pure function of_body(mesh, body) result(cut)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The body; 0 for all
      integer, intent(in) :: body
      !> Shape (nodes)
      logical :: cut(n_nodes(mesh))

      integer :: element

      cut = .false.
      do element = 1, n_elements(mesh)
         if (body > 0 .and. mesh%element_body(element) /= body) cycle
         cut(mesh%element_nodes(:mesh%element_size(element), element)) = .true.
      end do
   end function of_body

   !> What a cut passes through. A node on the cut is below it: loads there act
   !> below; but at the top of what is cut they act above
   pure function new_plane(model, wanted, cut, top, tolerance, elements) result(plane)
      !> The job
      type(model_type), intent(in) :: model
      !> The cut
      type(cut_type), intent(in) :: wanted
      !> Nodes of what is cut, shape (nodes)
      logical, intent(in) :: cut(:)
      !> Largest z of these [length]
      real(wp), intent(in) :: top
      !> How near to the cut a node is on it [length]
      real(wp), intent(in) :: tolerance
      !> Elements that it can pass through
      integer, intent(in) :: elements(:)
      !> What it passes through
      type(plane_type) :: plane

      integer :: e, k

      plane%z = wanted%z
      plane%reached = .not. top - plane%z > tolerance
      plane%least = merge(-tolerance, tolerance, plane%reached)
      associate (mesh => model%mesh)
         plane%crossed = pack(elements, [( &
            (wanted%body == 0 .or. mesh%element_body(elements(e)) == wanted%body) &
            .and. differs(mesh%element_nodes(:mesh%element_size(elements(e)), elements(e))), e=1, size(elements))])
         plane%massive = pack(elements, [( &
            passes_through(mesh%element_nodes(:mesh%element_size(elements(e)), elements(e))), e=1, size(elements))])
      end associate
      associate (loads => model%edge_loads, springs => model%edge_supports)
         plane%edges = pack([(k, k=1, size(loads))], [( &
            loads(k)%mode%harmonic <= 1 .and. passes_through(loads(k)%nodes(:count(loads(k)%nodes > 0))), k=1, size(loads))])
         plane%springs = pack([(k, k=1, size(springs))], [( &
            passes_through(springs(k)%nodes(:count(springs(k)%nodes > 0))), k=1, size(springs))])
      end associate
      call find_joints()

   contains

      !> Whether the cut passes between some nodes that belong to what is cut
      pure logical function passes_through(nodes)
         !> The nodes
         integer, intent(in) :: nodes(:)

         passes_through = differs(nodes)
         if (passes_through) passes_through = all(cut(nodes))
      end function passes_through

      !> Whether some nodes are above the cut and others are not
      pure logical function differs(nodes)
         !> The nodes
         integer, intent(in) :: nodes(:)

         logical :: first
         integer :: i

         differs = .false.
         first = .false.
         do i = 1, size(nodes)
            associate (above => is_above(plane, model%mesh%coordinates(2, nodes(i)) - plane%z))
               if (i == 1) first = above
               differs = differs .or. (above .neqv. first)
            end associate
         end do
      end function differs

      !> Joints with one side in what is cut
      pure subroutine find_joints()
         logical, dimension(n_joints(model%mesh)) :: crossed, upper
         integer :: j

         do j = 1, n_joints(model%mesh)
            associate (nodes => model%mesh%joint_nodes(:, j), n => model%mesh%joint_size(j)/2)
               upper(j) = all(cut(nodes([4, 3])))
               crossed(j) = all(cut(nodes([1, 2]))) .neqv. upper(j)  ! else both sides cancel
               if (crossed(j)) crossed(j) = passes_through(nodes(merge(upper_node(:n), lower_node(:n), upper(j))))
            end associate
         end do
         plane%joints = pack([(j, j=1, size(crossed))], crossed)
         plane%upper = pack(upper, crossed)
      end subroutine find_joints

   end function new_plane

   !> r of some nodes and their height over a cut, shape (2, nodes)
   pure function from_cut(plane, mesh, nodes) result(position)
      !> The cut
      class(plane_type), intent(in) :: plane
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The nodes
      integer, intent(in) :: nodes(:)
      !> r and height [length]
      real(wp) :: position(2, size(nodes))

      position = mesh%coordinates(:, nodes)
      position(2, :) = position(2, :) - plane%z
   end function from_cut

   !> Whether a node at a height over a cut is above it
   elemental logical function is_above(plane, height)
      !> The cut
      class(plane_type), intent(in) :: plane
      !> Height [length]
      real(wp), intent(in) :: height

      is_above = height > plane%least .or. (plane%reached .and. height >= plane%least)
   end function is_above

end module axijoint_analysis_core_cut_planes
