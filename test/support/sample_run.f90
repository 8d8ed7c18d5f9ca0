!> A small job with made-up results that no two numbers of which are equal
module axijoint_test_sample_run
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, pi
   use axijoint_deck_text_source, only : source_type, add_file, add_card
   use axijoint_element_joint_law, only : state_stick, state_slip, state_open
   use axijoint_fe_element_kind, only : kind_choice_type
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_residual, only : residual_record_type
   use axijoint_model_mesh, only : set_kinds
   use axijoint_model_model, only : model_type
   use axijoint_solver_entry, only : solver_entry_type
   use axijoint_solver_registry, only : known_solvers
   use axijoint_test_scenes, only : new_scene
   implicit none
   private
   public :: sample_model, sample_results, sample_source

   !> Nodes, Gauss points, joint points, planes of the sample
   integer, parameter :: n_nodes = 4, n_points = 4, n_joint_points = 2, n_planes = 3
   !> Its harmonics
   integer, parameter :: harmonics(2) = [0, 1]

contains

   !> One 4-node element, its last two nodes fixed
   function sample_model() result(model)
      !> The model
      type(model_type) :: model

      model = new_scene(2.0e4_wp, 0.2_wp, 1)
      model%title = 'A "sample" of results'
      model%n_planes = n_planes
      associate (mesh => model%mesh)
         mesh%coordinates = reshape([1.0_wp, 0.0_wp, 2.0_wp, 0.0_wp, 2.0_wp, 3.0_wp, 1.0_wp, &
            3.0_wp], [2, n_nodes])
         mesh%node_label = [10, 20, 30, 40]
         mesh%element_label = [5]
         mesh%element_material = [1]
         mesh%element_body = [1]
         mesh%element_size = [4]
         call set_kinds(mesh, kind_choice_type())
         mesh%element_nodes = reshape([1, 2, 3, 4, 0, 0, 0, 0, 0], [9, 1])
         mesh%joint_label = [7]
         mesh%joint_material = [1]
         mesh%joint_size = [4]
         mesh%joint_nodes = reshape([1, 2, 3, 4, 0, 0], [6, 1])
         mesh%joint_interface = [0]
      end associate
      model%fixed = reshape([.false., .false., .false., .false., .false., .false., .true., &
         .true., .true., .true., .true., .true.], [3, n_nodes])
   end function sample_model

   !> Results of the sample
   function sample_results(converged) result(results)
      !> Whether they are in equilibrium
      logical, intent(in) :: converged
      !> The results
      type(results_type) :: results

      type(solver_entry_type), allocatable :: solvers(:)
      integer :: k

      results%converged = converged
      results%modes = [mode_type(harmonics(1)), mode_type(harmonics(2))]
      allocate (results%orderings(0), results%remarks(0))
      results%part_node = [1]
      results%part_unbalance = reshape([(0.0_wp, k=1, 6)], [6, 1])
      solvers = known_solvers()
      results%solver = solvers(1)
      allocate (results%cut_resultants(6, 0), results%cut_motion(6, 0), results%face_reactions(6, 0))
      results%joint_resultants = reshape(numbers(6, 2.0_wp), [6, 1])
      allocate (results%solves(2), results%path(3), results%states(1))
      results%states(1)%case_factor = [1.0_wp]
      results%solves%mode%harmonic = harmonics
      results%solves%n_equations = [4, 6]
      results%path%increment = 1
      results%path%iteration = [1, 2, 3]
      results%path%ratio = [0.5_wp, 0.25_wp, 0.125_wp]
      results%path%load_factor = 1.0_wp
      results%residuals = [residual_record_type(increment=1, load_factor=1.0_wp, whole=0.125_wp, &
                                                ratio=reshape([0.25_wp, 0.5_wp], [1, 2]))]
      results%residual_part_node = [1]
      results%displacement = reshape(numbers(3*n_nodes*2, 1.0e-3_wp), [3, n_nodes, 2])
      results%reaction = reshape(numbers(3*n_nodes*2, -0.5_wp), [3, n_nodes, 2])
      allocate (results%acting, results%taken, source=results%reaction)
      results%point_element = [(1, k=1, n_points)]
      results%point_position = reshape(numbers(2*n_points, 0.1_wp), [2, n_points])
      results%stress = reshape(numbers(6*n_points*2, 7.0_wp), [6, n_points, 2])
      results%nodal%node = [(k, k=1, n_nodes)]
      results%nodal%material = [(1, k=1, n_nodes)]
      results%nodal%value_of = reshape([1, 2, 3, 4, 0, 0, 0, 0, 0], [9, 1])
      results%nodal%amplitude = reshape(numbers(6*n_nodes*2, 11.0_wp), [6, n_nodes, 2])
      results%discretization%error_energy = [0.01_wp, 0.02_wp]
      results%discretization%energy = [1.0_wp, 2.0_wp]
      results%discretization%mode_relative = [0.1_wp, 0.1_wp]
      results%discretization%element = [0.01_wp]
      results%plane_angles = [0.0_wp, 0.5_wp*pi, pi]
      results%joint_point_joint = [1, 1]
      results%joint_point_position = reshape(numbers(2*n_joint_points, 0.3_wp), &
         [2, n_joint_points])
      results%joint_jump = reshape(numbers(3*n_joint_points*n_planes, 1.0e-4_wp), &
         [3, n_joint_points, n_planes])
      results%joint_stress = reshape(numbers(3*n_joint_points*n_planes, -2.0_wp), &
         [3, n_joint_points, n_planes])
      results%joint_state = reshape([state_stick, state_stick, state_stick, state_slip, &
         state_slip, state_open], [n_joint_points, n_planes])
      results%residual_ratio = 0.125_wp
      results%tolerance = merge(0.2_wp, 0.01_wp, converged)
   end function sample_results

   !> Cards of the sample, the second in an included file
   function sample_source() result(source)
      !> The cards
      type(source_type) :: source

      character(len=:), allocatable :: bytes

      bytes = 'TITLE'//new_line('a')
      call add_file(source, 'sample.dat', bytes, 0)
      bytes = '! in the included file'
      call add_file(source, 'part.inc', bytes, 1)
      call add_card(source, 1, 1, 1, 5)
      call add_card(source, 2, 1, 1, 22)
   end function sample_source

   !> 1, 2, 3, ... times a factor
   pure function numbers(n, factor)
      !> How many
      integer, intent(in) :: n
      !> The first
      real(wp), intent(in) :: factor
      !> The numbers
      real(wp) :: numbers(n)

      integer :: i

      numbers = [(factor*real(i, wp), i=1, n)]
   end function numbers

end module axijoint_test_sample_run
