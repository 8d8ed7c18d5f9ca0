!> Everything that a deck says about a job
module axijoint_model_model
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : no_limit
   use axijoint_base_team, only : team_type
   use axijoint_element_joint_law, only : law_elastic
   use axijoint_element_yield_law, only : yield_none
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_interface, only : interface_type
   use axijoint_model_load, only : edge_load_type, ring_load_type, body_load_type, &
      thermal_load_type, prescribed_type, initial_stress_type, edge_support_type, &
      load_case_type, combination_type, increment_type, truncation_type, left_out_type
   use axijoint_model_material, only : solid_material_type, joint_material_type
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_request, only : line_type, point_type, keep_type, keep_names, cut_type, &
      print_type, supported_face_type, sweep_type, &
      error_goal_type, is_kept, keep_stress, keep_series
   use axijoint_model_restraint, only : restraint_type, acts_in
   use axijoint_model_strips, only : grid_type
   use axijoint_solver_entry, only : solver_entry_type
   implicit none
   private
   public :: model_type, is_shown, n_shown, shows_stress, held_components, held_at, can_yield, can_yield_at, &
      bodies_yield, on_axis, left_out_harmonics
   public :: method_newton, method_total, method_anderson, method_transfer, method_names
   public :: body_anderson, body_newton, body_lbfgs, body_transfer, body_method_names

   !> How joints are brought to equilibrium: Newton's method; the paper's loop on
   !> total jumps; the same with Anderson acceleration; the paper's loop itself,
   !> stress accumulated
   integer, parameter :: method_newton = 1, method_total = 2, method_anderson = 3, &
      method_transfer = 4
   !> Their names
   character(len=8), parameter :: method_names(4) = [character(len=8) :: &
      'NEWTON', 'TOTAL', 'ANDERSON', 'TRANSFER']
   !> How bodies that yield are brought to equilibrium: Anderson's mix; Newton's method, and the mix
   !> where it gets no further; limited-memory BFGS; the classical initial-stress loop
   integer, parameter :: body_anderson = 1, body_newton = 2, body_lbfgs = 3, body_transfer = 4
   !> Their names
   character(len=8), parameter :: body_method_names(4) = [character(len=8) :: &
      'ANDERSON', 'NEWTON', 'LBFGS', 'TRANSFER']

   !> A job
   type :: model_type
      !> Title card
      character(len=:), allocatable :: title
      !> Nodes, elements, joints
      type(mesh_type) :: mesh
      !> Materials of the solids
      type(solid_material_type), allocatable :: materials(:)
      !> Materials of the joints
      type(joint_material_type), allocatable :: joint_materials(:)
      !> Interfaces, in the order of their cards
      type(interface_type), allocatable :: interfaces(:)
      !> Fixed components u, v, w of each node in every mode, shape (3, nodes);
      !> a component that is prescribed anywhere is one of them
      logical, allocatable :: fixed(:, :)
      !> Components that are held in some modes only
      type(restraint_type), allocatable :: restraints(:)
      !> Nodes that the program holds in torsion alone, by one of `restraints`: of all that may turn about the axis together and
      !> that nothing turns, one each
      integer, allocatable :: turning(:)
      !> Those of `fixed` that cards of nodes hold, and hold in every mode because nothing else was
      !> said, shape (3, nodes)
      logical, allocatable :: held_by_default(:, :)
      !> Tractions on edges
      type(edge_load_type), allocatable :: edge_loads(:)
      !> Loads on nodal circles
      type(ring_load_type), allocatable :: ring_loads(:)
      !> Forces on the mass of the solids
      type(body_load_type), allocatable :: body_loads(:)
      !> Temperatures
      type(thermal_load_type), allocatable :: thermal_loads(:)
      !> Displacements that are not zero
      type(prescribed_type), allocatable :: prescribed(:)
      !> In-situ stresses
      type(initial_stress_type), allocatable :: initial_stresses(:)
      !> Springs to the ground
      type(edge_support_type), allocatable :: edge_supports(:)
      !> Load cases, at least one
      type(load_case_type), allocatable :: load_cases(:)
      !> Combinations of the load cases, at least one
      type(combination_type), allocatable :: combinations(:)
      !> What the harmonics leave of the loads, one entry a load that is given
      !> as a function of theta
      type(truncation_type), allocatable :: truncations(:)
      !> Harmonics up to M that are not in use, though loads have a part in them
      type(left_out_type), allocatable :: left_out(:)
      !> Load increments, at least one
      type(increment_type), allocatable :: increments(:)
      !> Highest harmonic M
      integer :: max_harmonic = 0
      !> Harmonics in use, ascending, each up to M
      integer, allocatable :: harmonics(:)
      !> Number of planes theta from 0 to pi on which the joint law is checked
      integer :: n_planes = 0
      !> How joints are brought to equilibrium, one of the `method_` parameters
      integer :: method = method_newton
      !> How bodies that yield are, one of the `body_` parameters
      integer :: body_method = body_anderson
      !> Planes from 0 to pi on which the criteria of these are checked; 0 if the program decides
      integer :: n_body_planes = 0
      !> Solver; if there is none, the choice is the program's
      type(solver_entry_type), allocatable :: solver
      !> Bytes that the process may take; more than there are if the user gave no limit
      integer(i8) :: memory_limit = no_limit
      !> Processes that share the work; this one alone if there is none
      class(team_type), allocatable :: team
      !> Angles at which totals are listed [radian]
      real(wp), allocatable :: output_angles(:)
      !> Lines along which results are listed
      type(line_type), allocatable :: lines(:)
      !> Points whose displacements are followed
      type(point_type), allocatable :: points(:)
      !> Of which increments what is kept, in the order of `keep_names`
      type(keep_type) :: keep(size(keep_names))
      !> Rows of long tables of the listing that are wanted, as the deck says
      type(print_type), allocatable :: print(:)
      !> Whether a listing in an old layout is wanted, too, and what it shows of each increment,
      !> NOUTP; all if not allocated
      logical :: old_listing = .false.
      integer, allocatable :: old_output(:)
      !> Cuts whose resultants are listed
      type(cut_type), allocatable :: cuts(:)
      !> Range of theta that the bodies are swept through
      type(sweep_type) :: sweep
      !> The error that the job may have
      type(error_goal_type) :: error_goal
      !> Strips of the blocks that the mesh is of, if it may be refined for that; not allocated if
      !> blocks that meet are divided differently
      type(grid_type), allocatable :: grid
      !> Faces whose reactions are listed
      type(supported_face_type), allocatable :: supported_faces(:)
   end type model_type

contains

   !> Components that supports hold in a mode
   pure function held_components(model, mode) result(held)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Whether u, v, w are held, shape (3, nodes)
      logical, allocatable :: held(:, :)

      integer :: k

      held = model%fixed
      if (.not. allocated(model%restraints)) return
      do k = 1, size(model%restraints)
         if (acts_in(model%restraints(k), mode)) held = held .or. model%restraints(k)%held
      end do
   end function held_components

   !> Components of a node that supports hold in a mode
   pure function held_at(model, mode, node) result(held)
      !> The job
      type(model_type), intent(in) :: model
      !> The mode
      type(mode_type), intent(in) :: mode
      !> The node
      integer, intent(in) :: node
      !> Whether u, v, w are held
      logical :: held(3)

      integer :: k

      held = model%fixed(:, node)
      if (.not. allocated(model%restraints)) return
      do k = 1, size(model%restraints)
         if (acts_in(model%restraints(k), mode)) held = held .or. model%restraints(k)%held(:, node)
      end do
   end function held_at

   !> Whether any joint can open or slip, so that the job needs iterations
   pure logical function can_yield(model)
      !> The job
      type(model_type), intent(in) :: model

      can_yield = any(can_yield_at(model, model%mesh%joint_material))
   end function can_yield

   !> Whether a joint can open or slip
   elemental logical function can_yield_at(model, material)
      !> The job
      type(model_type), intent(in) :: model
      !> Its material (index)
      integer, intent(in) :: material

      can_yield_at = model%joint_materials(material)%law%kind /= law_elastic
   end function can_yield_at

   !> Whether any solid can yield
   pure logical function bodies_yield(model)
      !> The job
      type(model_type), intent(in) :: model

      bodies_yield = any(model%materials(model%mesh%element_material)%yield%criterion &
                         /= yield_none)
   end function bodies_yield

   !> Which nodes lie on the axis of revolution
   pure function on_axis(mesh)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> True where r = 0, shape (nodes)
      logical :: on_axis(size(mesh%node_label))

      on_axis = .not. mesh%coordinates(1, :) > 0.0_wp
   end function on_axis

   !> Whether a file shows fields of an increment before the last
   elemental logical function is_shown(model, increment, last)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of the increment, and of the last
      integer, intent(in) :: increment, last

      is_shown = any(is_kept(model%keep, increment, last)) .or. model%sweep%wanted .or. model%old_listing
   end function is_shown

   !> Increments before the last whose fields files show
   pure integer function n_shown(model)
      !> The job
      type(model_type), intent(in) :: model

      integer :: i

      n_shown = count([(is_shown(model, i, size(model%increments)), i=1, size(model%increments) - 1)])
   end function n_shown

   !> Whether a file shows stresses of an increment at nodes, or between these in sections
   elemental logical function shows_stress(model, increment, last)
      !> The job
      type(model_type), intent(in) :: model
      !> The increment, and the last
      integer, intent(in) :: increment, last

      shows_stress = is_kept(model%keep(keep_stress), increment, last) .or. model%sweep%wanted .or. model%old_listing
      if (size(model%lines) > 0) shows_stress = shows_stress .or. is_kept(model%keep(keep_series), increment, last)
   end function shows_stress

   !> Harmonics that are not in use, though loads of some load cases have a part in them
   pure function left_out_harmonics(model, acts) result(harmonics)
      !> The job
      type(model_type), intent(in) :: model
      !> Which load cases count, shape (cases)
      logical, intent(in) :: acts(:)
      !> The harmonics, ascending, each once
      integer, allocatable :: harmonics(:)

      integer :: m

      harmonics = pack([(m, m=0, model%max_harmonic)], &
                       [(any(model%left_out%harmonic == m .and. acts(model%left_out%case)), m=0, model%max_harmonic)])
   end function left_out_harmonics

end module axijoint_model_model
