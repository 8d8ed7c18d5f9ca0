!> Which components of the fine nodes may move in a class of modes, as on the coarse mesh
module axijoint_analysis_fine_conditions
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, n_on
   use axijoint_assembly_dofs, only : dofs_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, is_torsion
   implicit none
   private
   public :: conditions_type, new_conditions, hold, take_reactions, held_part

   !> Conditions, by the places of the nodes
   type :: conditions_type
      !> Whether a component is free, shape (3, nodes)
      logical, allocatable :: free(:, :)
      !> Whether w follows u: w = -u, on the axis in harmonic 1, shape (nodes)
      logical, allocatable :: tied(:)
      !> Nodes that are not free in all components
      integer, allocatable :: held(:)
      !> Nodes that are not free in a component that the modes have, or tied
      integer, allocatable :: bound(:)
   end type conditions_type

contains

   !> Conditions of a class. A new node of an edge is held if all nodes of the edge are; not by the
   !> two ends of an edge inside a body, as in a body that is one element thick between two faces
   subroutine new_conditions(fine, dofs, mode, place, conditions)
      !> The fine mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Unknowns of the coarse mesh
      type(dofs_type), intent(in) :: dofs
      !> A mode of the class
      type(mode_type), intent(in) :: mode
      !> Place of each fine node
      integer, intent(in) :: place(:)
      !> The conditions
      type(conditions_type), intent(out) :: conditions

      logical, dimension(size(dofs%equation, 2)) :: at_face, tied, whole
      logical :: present(3), all_tied
      integer :: k, i, component

      present = [.not. is_torsion(mode), .not. is_torsion(mode), is_torsion(mode) &
         .or. mode%harmonic > 0]
      allocate (conditions%free(3, size(place)))
      allocate (conditions%tied(size(place)), source=.false.)
      do component = 1, 3
         conditions%free(component, :) = present(component)
      end do
      do k = 1, size(tied)
         associate (equation => dofs%equation(:, k), free => conditions%free(:, place(k)))
            tied(k) = equation(3) > 0 .and. equation(3) == equation(1)
            free(1) = equation(1) > 0
            free(2) = equation(2) > 0
            free(3) = equation(3) > 0 .and. .not. tied(k)
            whole(k) = (free(1) .eqv. present(1)) .and. (free(2) .eqv. present(2)) .and. (free(3) .eqv. present(3))
         end associate
         conditions%tied(place(k)) = tied(k)
      end do
      at_face = .false.
      do k = 1, size(fine%edges)
         if (fine%edges(k)%elements(2) == 0) at_face(fine%edges(k)%nodes(:2)) = .true.
      end do
      do k = 1, size(fine%edges)
         associate (edge => fine%edges(k), n => n_on(fine%edges(k)))
            if (all(whole(edge%nodes(:n)))) cycle
            all_tied = all(tied(edge%nodes(:n)))
            do i = 1, n - 1
               conditions%tied(place(edge%new(i))) = all_tied
               if (n == 2 .and. edge%elements(2) > 0 .and. all(at_face(edge%nodes(:n)))) cycle
               conditions%free(:, place(edge%new(i))) = any(dofs%equation(:, edge%nodes(:n)) > 0, 2) &
                  .and. .not. [.false., .false., all_tied]
            end do
         end associate
      end do
      conditions%held = pack([(k, k=1, size(place))], conditions%tied .or. .not. (conditions%free(1, :) &
         .and. conditions%free(2, :) .and. conditions%free(3, :)))
      conditions%bound = pack([(k, k=1, size(place))], conditions%tied .or. (present(1) .neqv. conditions%free(1, :)) &
         .or. (present(2) .neqv. conditions%free(2, :)) .or. (present(3) .neqv. conditions%free(3, :)))
   end subroutine new_conditions

   !> Put displacements where the conditions hold them
   pure subroutine hold(conditions, displacement)
      !> The conditions
      type(conditions_type), intent(in) :: conditions
      !> Components, shape (3, nodes)
      real(wp), intent(inout) :: displacement(:, :)

      integer :: i

      do i = 1, size(conditions%held)
         associate (node => conditions%held(i))
            where (.not. conditions%free(:, node)) displacement(:, node) = 0.0_wp
            if (conditions%tied(node)) displacement(3, node) = -displacement(1, node)
         end associate
      end do
   end subroutine hold

   !> Take from forces what holds the components; where w follows u, all of the work is put on u
   pure subroutine take_reactions(conditions, force)
      !> The conditions
      type(conditions_type), intent(in) :: conditions
      !> Components, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)

      integer :: i

      do i = 1, size(conditions%held)
         associate (node => conditions%held(i))
            if (conditions%tied(node)) force(1, node) = force(1, node) - force(3, node)
            where (.not. conditions%free(:, node)) force(:, node) = 0.0_wp
         end associate
      end do
   end subroutine take_reactions

   !> What `take_reactions` takes from the forces on a node
   pure function held_part(conditions, place, force) result(held)
      !> The conditions
      type(conditions_type), intent(in) :: conditions
      !> Place of the node
      integer, intent(in) :: place
      !> Forces on it
      real(wp), intent(in) :: force(3)
      !> Those of them that hold it
      real(wp) :: held(3)

      held = merge(0.0_wp, force, conditions%free(:, place))
      if (conditions%tied(place)) held(1) = force(3)
   end function held_part

end module axijoint_analysis_fine_conditions
