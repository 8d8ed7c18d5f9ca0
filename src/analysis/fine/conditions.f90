!> Which components of the fine nodes may move in a class of modes, as on the coarse mesh
module axijoint_analysis_fine_conditions
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, n_on
   use axijoint_assembly_dofs, only : dofs_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, is_torsion
   implicit none
   private
   public :: conditions_type, new_conditions, hold, take_reactions

   !> Conditions, by the places of the nodes
   type :: conditions_type
      !> Whether a component is free, shape (3, nodes)
      logical, allocatable :: free(:, :)
      !> Whether w follows u: w = -u, on the axis in harmonic 1, shape (nodes)
      logical, allocatable :: tied(:)
      !> Nodes that are not free in all components
      integer, allocatable :: held(:)
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

      logical :: present(3), at_face(size(dofs%equation, 2)), tied(size(dofs%equation, 2))
      integer :: k, i

      present = [.not. is_torsion(mode), .not. is_torsion(mode), is_torsion(mode) &
         .or. mode%harmonic > 0]
      tied = dofs%equation(3, :) > 0 .and. dofs%equation(3, :) == dofs%equation(1, :)
      at_face = .false.
      do k = 1, size(fine%edges)
         if (fine%edges(k)%elements(2) == 0) at_face(fine%edges(k)%nodes(:2)) = .true.
      end do
      conditions%free = spread(present, 2, size(place))
      allocate (conditions%tied(size(place)), source=.false.)
      do k = 1, size(tied)
         conditions%free(:, place(k)) = dofs%equation(:, k) > 0 &
            .and. .not. [.false., .false., tied(k)]
         conditions%tied(place(k)) = tied(k)
      end do
      do k = 1, size(fine%edges)
         associate (edge => fine%edges(k), nodes => fine%edges(k)%nodes(:n_on(fine%edges(k))), &
            new => fine%edges(k)%new)
            do i = 1, n_on(edge) - 1
               conditions%tied(place(new(i))) = all(tied(nodes))
               if (n_on(edge) == 2 .and. edge%elements(2) > 0 .and. all(at_face(nodes))) cycle
               conditions%free(:, place(new(i))) = any(dofs%equation(:, nodes) > 0, 2) &
                  .and. .not. [.false., .false., all(tied(nodes))]
            end do
         end associate
      end do
      conditions%held = pack([(k, k=1, size(place))], conditions%tied .or. .not. all(conditions%free, 1))
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

end module axijoint_analysis_fine_conditions
