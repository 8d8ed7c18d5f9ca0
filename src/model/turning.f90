!> Parts that may turn about the axis, and that no load turns
!>
!> Where joints or bodies yield under loads of the antisymmetric family, torsion is among the modes, for what yields answers in
!> both families. The same loads turned to the symmetric one leave torsion out. That nothing keeps a body from turning must
!> make no difference then: no load turns it, and joints and stresses, which act on both sides alike, do not turn all that
!> they hold together. So one node of that is held, which carries nothing
module axijoint_model_turning
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, same_mode, family_antisymmetric
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type, held_components
   use axijoint_model_modes, only : used_modes, is_loaded
   use axijoint_model_restraint, only : restraint_type, hold_in
   implicit none
   private
   public :: hold_turning

   !> Torsion
   type(mode_type), parameter :: torsion = mode_type(0, family_antisymmetric)

contains

   !> Hold parts that may turn and that nothing turns, by one node each, unless that was done before
   subroutine hold_turning(model)
      !> The job, complete; takes the nodes, and a restraint of torsion
      type(model_type), intent(inout) :: model

      if (allocated(model%turning)) return
      allocate (model%turning(0))
      if (is_loaded(model, torsion) .or. .not. any(same_mode(used_modes(model), torsion))) return
      model%turning = turning_nodes(model)
      if (size(model%turning) == 0) return
      if (.not. allocated(model%restraints)) allocate (model%restraints(0))
      call hold_in(model%restraints, restraint_type(torsion%harmonic, torsion%harmonic, torsion%family), &
                   n_nodes(model%mesh), model%turning, [.false., .false., .true.])
   end subroutine hold_turning

   !> Of all that solids and joints hold together and nothing keeps from turning, the node farthest from the axis
   function turning_nodes(model) result(nodes)
      !> The job
      type(model_type), intent(in) :: model
      !> The nodes
      integer, allocatable :: nodes(:)

      logical, allocatable :: held(:, :)
      integer :: group(n_nodes(model%mesh)), farthest(n_nodes(model%mesh)), node, k
      logical :: kept(n_nodes(model%mesh))

      group = groups(model)
      kept = .false.
      held = held_components(model, torsion)
      farthest = 0
      associate (r => model%mesh%coordinates(1, :))
         do node = 1, size(group)
            associate (far => farthest(group(node)))
               if (held(3, node) .and. r(node) > 0.0_wp) kept(group(node)) = .true.
               if (far == 0) then
                  far = node
               else if (r(node) > r(far)) then
                  far = node
               end if
            end associate
         end do
         do k = 1, size(model%edge_supports)
            associate (support => model%edge_supports(k))
               if (support%stiffness(3) > 0.0_wp .and. any(r(support%nodes(:2)) > 0.0_wp)) &
                  kept(group(support%nodes(1))) = .true.
            end associate
         end do
      end associate
      nodes = pack(farthest, farthest > 0 .and. .not. kept)
   end function turning_nodes

   !> Groups of nodes that do not turn by themselves: solids hold them together, and joints with stiffness along theta
   function groups(model) result(group)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of the group of each node: a node of it
      integer :: group(n_nodes(model%mesh))

      integer :: k, i, node

      group = [(node, node=1, size(group))]
      associate (mesh => model%mesh)
         do k = 1, n_elements(mesh)
            do i = 2, mesh%element_size(k)
               call join(mesh%element_nodes(1, k), mesh%element_nodes(i, k))
            end do
         end do
         do k = 1, n_joints(mesh)
            if (.not. model%joint_materials(mesh%joint_material(k))%law%stiffness(3) > 0.0_wp) cycle
            associate (ends => mesh%joint_nodes([1, 3], k))  ! one of each side
               call join(ends(1), ends(2))
            end associate
         end do
      end associate
      do node = 1, size(group)
         group(node) = root(node)
      end do

   contains

      !> Join the groups of two nodes
      subroutine join(a, b)
         !> The nodes
         integer, intent(in) :: a, b

         integer :: of_a, of_b

         of_a = root(a)
         of_b = root(b)
         group(of_b) = of_a
      end subroutine join

      !> Number of a node's group as far as they are joined; halves the path there
      integer function root(start)
         !> The node
         integer, intent(in) :: start

         root = start
         do while (group(root) /= root)
            group(root) = group(group(root))
            root = group(root)
         end do
      end function root

   end function groups

end module axijoint_model_turning
