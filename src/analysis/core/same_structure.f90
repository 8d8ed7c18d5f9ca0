!> Whether two jobs have one structure: the same unknowns, stiffness and joint points, so that what
!> was factored and condensed for one serves the other. Loads, strength and gaps of joints,
!> increments and what is asked of the results may differ
module axijoint_analysis_core_same_structure
   use axijoint_analysis_core_structure, only : structure_type, reuses_factors
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, same_mode
   use axijoint_model_load, only : edge_support_type
   use axijoint_model_material, only : solid_material_type, joint_material_type, elasticity
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_model, only : model_type, bodies_yield
   use axijoint_model_modes, only : used_modes
   use axijoint_model_restraint, only : restraint_type
   implicit none
   private
   public :: same_structure

   !> Whether two arrays have one extent and the same values
   interface same
      module procedure same_integers
      module procedure same_reals
      module procedure same_logicals
   end interface same

contains

   !> Whether a job has the structure that was built for another
   logical function same_structure(model, built_for, structure)
      !> The job
      type(model_type), intent(in) :: model
      !> The other
      type(model_type), intent(in) :: built_for
      !> Its structure
      type(structure_type), intent(in) :: structure

      type(mode_type), allocatable :: modes(:)

      same_structure = same_mesh(model%mesh, built_for%mesh) &
         .and. same_solids(model%materials, built_for%materials) &
         .and. same_joints(model%joint_materials, built_for%joint_materials) &
         .and. same_supports(model%edge_supports, built_for%edge_supports) &
         .and. same(reshape(model%fixed, [size(model%fixed)]), &
                    reshape(built_for%fixed, [size(built_for%fixed)])) &
         .and. same_restraints(model%restraints, built_for%restraints) &
         .and. (size(model%initial_stresses) > 0 .eqv. size(built_for%initial_stresses) > 0) &
         .and. model%n_planes == built_for%n_planes &
         .and. same_solver(model, built_for) &
         .and. model%memory_limit == built_for%memory_limit &
         .and. (reuses_factors(model) .eqv. reuses_factors(built_for)) &
         .and. (bodies_yield(model) .eqv. bodies_yield(built_for))  ! without estimates by a finer level
      if (.not. same_structure) return
      modes = used_modes(model)
      same_structure = size(modes) == size(structure%modes)
      if (same_structure) same_structure = all(same_mode(modes, structure%modes))
   end function same_structure

   !> Whether two meshes are the same; numbers that the user gave aside
   pure logical function same_mesh(a, b)
      !> The meshes
      type(mesh_type), intent(in) :: a, b

      integer :: k

      same_mesh = same(a%element_size, b%element_size) .and. same(a%joint_size, b%joint_size) &
         .and. same(a%node_label, b%node_label)
      if (.not. same_mesh) return
      same_mesh = same(reshape(a%coordinates, [size(a%coordinates)]), &
                       reshape(b%coordinates, [size(b%coordinates)])) &
         .and. same(reshape(a%element_nodes, [size(a%element_nodes)]), &
                    reshape(b%element_nodes, [size(b%element_nodes)])) &
         .and. same(reshape(a%joint_nodes, [size(a%joint_nodes)]), &
                    reshape(b%joint_nodes, [size(b%joint_nodes)])) &
         .and. same(a%element_material, b%element_material) &
         .and. same(a%element_body, b%element_body) .and. same(a%element_kind, b%element_kind) &
         .and. same(a%joint_material, b%joint_material) .and. size(a%kinds) == size(b%kinds)
      if (.not. same_mesh) return
      do k = 1, size(a%kinds)
         same_mesh = same_mesh .and. a%kinds(k)%n_nodes == b%kinds(k)%n_nodes &
            .and. a%kinds(k)%order == b%kinds(k)%order &
            .and. a%kinds(k)%formulation == b%kinds(k)%formulation
      end do
   end function same_mesh

   !> Whether solids are as stiff. Density and expansion are of the loads
   pure logical function same_solids(a, b)
      !> The materials
      type(solid_material_type), intent(in) :: a(:), b(:)

      integer :: k

      same_solids = size(a) == size(b)
      if (.not. same_solids) return
      do k = 1, size(a)
         same_solids = same_solids .and. (a(k)%orthotropic .eqv. b(k)%orthotropic) .and. &
            same([elasticity(a(k))], [elasticity(b(k))])
      end do
   end function same_solids

   !> Whether joints are as stiff, checked at the same points, and yield or not
   pure logical function same_joints(a, b)
      !> The materials
      type(joint_material_type), intent(in) :: a(:), b(:)

      integer :: k

      same_joints = size(a) == size(b)
      if (.not. same_joints) return
      do k = 1, size(a)
         same_joints = same_joints .and. a(k)%rule == b(k)%rule &
            .and. a(k)%law%kind == b(k)%law%kind &
            .and. same(a(k)%law%stiffness, b(k)%law%stiffness)
      end do
   end function same_joints

   !> Whether springs are the same
   pure logical function same_supports(a, b)
      !> The springs
      type(edge_support_type), intent(in) :: a(:), b(:)

      integer :: k

      same_supports = size(a) == size(b)
      if (.not. same_supports) return
      do k = 1, size(a)
         same_supports = same_supports .and. same(a(k)%nodes, b(k)%nodes) &
            .and. same(a(k)%stiffness, b(k)%stiffness)
      end do
   end function same_supports

   !> Whether the same components are held in some modes
   pure logical function same_restraints(a, b)
      !> The restraints; none if not allocated
      type(restraint_type), allocatable, intent(in) :: a(:), b(:)

      integer :: k

      same_restraints = allocated(a) .eqv. allocated(b)
      if (.not. (same_restraints .and. allocated(a))) return
      same_restraints = size(a) == size(b)
      if (.not. same_restraints) return
      do k = 1, size(a)
         same_restraints = same_restraints .and. a(k)%first == b(k)%first &
            .and. a(k)%last == b(k)%last .and. a(k)%family == b(k)%family
         if (.not. same_restraints) return
         same_restraints = same(reshape(a(k)%held, [size(a(k)%held)]), &
                                reshape(b(k)%held, [size(b(k)%held)]))
      end do
   end function same_restraints

   !> Whether the same solver is asked for
   pure logical function same_solver(a, b)
      !> The jobs
      type(model_type), intent(in) :: a, b

      same_solver = allocated(a%solver) .eqv. allocated(b%solver)
      if (same_solver .and. allocated(a%solver)) same_solver = a%solver%name == b%solver%name
   end function same_solver

   !> Two arrays of integers
   pure logical function same_integers(a, b)
      !> The arrays
      integer, intent(in) :: a(:), b(:)

      same_integers = size(a) == size(b)
      if (same_integers) same_integers = all(a == b)
   end function same_integers

   !> Two arrays of reals, to the last bit
   pure logical function same_reals(a, b)
      !> The arrays
      real(wp), intent(in) :: a(:), b(:)

      same_reals = size(a) == size(b)
      if (same_reals) same_reals = .not. any(abs(a - b) > 0.0_wp)
   end function same_reals

   !> Two arrays of logicals
   pure logical function same_logicals(a, b)
      !> The arrays
      logical, intent(in) :: a(:), b(:)

      same_logicals = size(a) == size(b)
      if (same_logicals) same_logicals = all(a .eqv. b)
   end function same_logicals

end module axijoint_analysis_core_same_structure
