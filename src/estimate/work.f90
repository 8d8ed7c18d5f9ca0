!> What a run has to do, counted before anything is solved: one number for each term of its time
module axijoint_estimate_work
   use axijoint_analysis_core_footprint, only : fine_nodes_of => fine_nodes, blocks_of
   use axijoint_analysis_core_structure, only : structure_type, reuses_factors
   use axijoint_assembly_equations, only : planned_seconds, condensing_operations
   use axijoint_base_kinds, only : wp, i8
   use axijoint_estimate_body_work, only : body_work
   use axijoint_estimate_joint_work, only : joint_work
   use axijoint_estimate_terms, only : n_terms, shape_products, fine_nodes, factoring, inverse, &
      block_entries, solved_entries, node_modes, fine_blocks, stress_modes, row_stresses, &
      formed_entries
   use axijoint_fe_reference, only : reference_type
   use axijoint_joints_pairs, only : pairs_type, new_pairs
   use axijoint_model_mesh, only : n_nodes, element_references
   use axijoint_model_model, only : model_type, n_shown, bodies_yield, can_yield, can_yield_at
   implicit none
   private
   public :: structure_work, state_work, row_work, n_points

   !> Solutions of a mode: displacements with one refinement, condition of the matrix; with joints
   !> that yield those of the corrections and of what estimates of errors change; or displacements
   !> alone, and the product by which they need no refinement
   real(wp), parameter :: linear_solutions = 3.0_wp, yielding_solutions = 10.0_wp, &
      unjudged_solutions = 1.5_wp
   !> Steps down on the fine level, each with a solution on the mesh
   real(wp), parameter :: steps_down = 3.0_wp
   !> Loads, displacements, reactions, smoothed stresses of the nodes: of the end with estimates of
   !> errors and without, of the end of a row, of an increment that is shown, of any other, as multiples
   !> of one
   real(wp), parameter :: nodes_judged = 4.0_wp, nodes_last = 0.5_wp, nodes_of_row = 0.15_wp, &
      nodes_shown = 1.0_wp, nodes_loaded = 0.3_wp
   !> Stresses of the end with estimates of errors, as multiples of those of an increment
   real(wp), parameter :: points_judged = 2.0_wp
   !> Angles at which a row of a study looks for its largest stress
   integer, parameter :: row_angles = 24

contains

   !> Work of assembling, factoring and condensing; reading and ordering are measured
   function structure_work(model, structure, product_rate) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> Rate of large matrix products [operations/second]
      real(wp), intent(in) :: product_rate
      !> Counts of all terms
      real(wp) :: work(n_terms)

      type(reference_type), allocatable :: references(:)
      type(pairs_type) :: pairs
      integer :: s

      work = 0.0_wp
      references = element_references(model%mesh)
      associate (mesh => model%mesh)
         work(shape_products) = merge(5.0_wp, 1.0_wp, structure%estimated)*sum(real(mesh%element_size, wp)**2 &
            *references(mesh%element_kind)%n_points)  ! four elements of the fine level in each
         if (structure%estimated) work(fine_nodes) = sum(fine_nodes_of(mesh%element_size))
      end associate
      associate (equations => structure%equations)
         work(factoring) = planned_seconds(equations, reuses_factors(model), product_rate) &
            *n_factorings(model, structure)
         do s = 1, size(equations%systems)
            associate (class => equations%classes(equations%systems(s)%class))
               work(formed_entries) = work(formed_entries) + size(class%pattern%column, kind=i8) &
                  *n_factorings(model, structure)
            end associate
         end do
         pairs = new_pairs(pack(structure%joint_points, can_yield_at(model, structure%joint_points%material)))
         if (size(pairs%nodes, 2) == 0) return
         work(inverse) = condensing_operations(equations, pairs%nodes)
         work(block_entries) = size(equations%systems)*(3.0_wp*size(pairs%nodes, 2))**2
      end associate
   end function structure_work

   !> How often each factor is made: those that memory does not keep are made for each load step,
   !> for the flexibilities and for each solution after that
   pure real(wp) function n_factorings(model, structure) result(n)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure

      n = 1.0_wp
      if (.not. reuses_factors(model)) return
      associate (equations => structure%equations)
         n = n + (1.0_wp - real(equations%n_kept, wp)/max(1, size(equations%systems))) &
            *(size(model%combinations)*(2.0_wp + n_shown(model)) &
              + merge(size(model%increments), 0, can_yield(model)))
      end associate
   end function n_factorings

   !> Work of one combination once the structure is there
   function state_work(model, structure, iterations, judged, run) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> Iterations of all increments
      real(wp), intent(in) :: iterations
      !> Whether errors are estimated; whether it is of a run, not a row of a study
      logical, intent(in) :: judged, run
      !> Counts of all terms
      real(wp) :: work(n_terms)

      real(wp) :: solutions, shown, entries
      logical :: estimates
      integer :: k

      work = 0.0_wp
      estimates = judged .and. .not. bodies_yield(model)
      shown = n_shown(model)
      solutions = linear_solutions + 2.0_wp*shown
      if (can_yield(model)) then
         solutions = merge(yielding_solutions, unjudged_solutions, estimates) + 2.0_wp*shown &
            + size(model%increments)
         work = joint_work(model, structure, iterations, estimates)
      end if
      if (bodies_yield(model)) work = work + body_work(model, structure, iterations, judged)
      entries = 0.0_wp
      associate (equations => structure%equations)
         do k = 1, size(structure%modes)
            entries = entries + real(equations%plans(equations%systems(equations%system(k))%class) &
               %solver%factor_entries, wp)
         end do
      end associate
      associate (mesh => model%mesh, modes => real(size(structure%modes), wp))
         work(solved_entries) = work(solved_entries) + entries*(solutions + merge(steps_down, 0.0_wp, estimates))
         work(node_modes) = n_nodes(mesh)*modes*( &
            merge(nodes_judged, merge(nodes_last, nodes_of_row, judged .or. run), estimates) &
            + nodes_shown*shown + nodes_loaded*(size(model%increments) - 1))
         if (estimates) work(fine_blocks) = modes*sum(fine_nodes_of(mesh%element_size) &
                                                      *blocks_of(mesh%element_size))
         work(stress_modes) = shape_values(model)*modes*(merge(points_judged, 1.0_wp, estimates) &
                                                         + shown)
      end associate
   end function state_work

   !> What a row of a study does besides: the fields of all increments, and quantities of them
   function row_work(model, structure) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> Counts of all terms
      real(wp) :: work(n_terms)

      associate (increments => real(size(model%increments), wp), &
                 modes => size(structure%modes))
         work = 0.0_wp
         work(stress_modes) = shape_values(model)*modes*(increments - 1.0_wp - n_shown(model))
         work(row_stresses) = n_points(model)*modes*row_angles*increments
      end associate
   end function row_work

   !> Shape functions at the Gauss points of all elements
   pure real(wp) function shape_values(model)
      !> The job
      type(model_type), intent(in) :: model

      type(reference_type), allocatable :: references(:)

      references = element_references(model%mesh)
      shape_values = sum(real(references(model%mesh%element_kind)%n_points, wp) &
                         *model%mesh%element_size)
   end function shape_values

   !> Gauss points of all elements
   pure real(wp) function n_points(model)
      !> The job
      type(model_type), intent(in) :: model

      type(reference_type), allocatable :: references(:)

      references = element_references(model%mesh)
      n_points = sum(real(references(model%mesh%element_kind)%n_points, wp))
   end function n_points

end module axijoint_estimate_work
