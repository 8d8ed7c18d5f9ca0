!> What iterations of bodies that yield have to do
module axijoint_estimate_body_work
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_analysis_error_plastic_errors, only : turns_back
   use axijoint_analysis_error_plastic_variants, only : mesh_harmonics
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : yield_none
   use axijoint_estimate_terms, only : n_terms, body_laws, body_stresses, solved_entries, sums
   use axijoint_fe_reference, only : reference_type
   use axijoint_joints_planes, only : planes_type
   use axijoint_model_mesh, only : element_references
   use axijoint_model_model, only : model_type, can_yield
   use axijoint_plastic_field, only : body_planes
   implicit none
   private
   public :: body_work, n_body_points

   !> Share of the points that planes are needed for, which the loads decide
   real(wp), parameter :: on_planes = 0.4_wp
   !> Elastic solutions of an iteration; beside joints each goes with one of theirs
   real(wp), parameter :: alone = 1.0_wp, beside_joints = 2.0_wp
   !> Stress, forces of the stress and of the excess of an iterate
   real(wp), parameter :: passes = 3.0_wp
   !> Iterations of each state that errors are estimated by, found in one step; set by a pile in clay
   real(wp), parameter :: state_iterations = 60.0_wp
   !> Components of stress, summed on planes and back
   real(wp), parameter :: sums_a_point = 12.0_wp

contains

   !> Work of the iterations
   function body_work(model, structure, iterations, judged) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> Iterations of all increments
      real(wp), intent(in) :: iterations
      !> Whether errors are estimated
      logical, intent(in) :: judged
      !> Counts of all terms
      real(wp) :: work(n_terms)

      type(reference_type), allocatable :: references(:)
      type(planes_type) :: planes
      real(wp) :: points, shapes, modes, on, entries, solved, judging(2)
      integer :: k

      work = 0.0_wp
      references = element_references(model%mesh)
      planes = body_planes(structure%modes, model%n_body_planes)
      modes = size(structure%modes)
      points = n_body_points(model)
      associate (mesh => model%mesh)
         shapes = sum(real(references(mesh%element_kind)%n_points, wp)*mesh%element_size, &
                      mask=yields(model))
      end associate
      entries = 0.0_wp
      associate (equations => structure%equations)
         do k = 1, size(structure%modes)
            entries = entries + real(equations%plans(equations%systems(equations%system(k))%class) &
               %solver%factor_entries, wp)
         end do
      end associate
      on = on_planes*points*size(planes%angle)
      judging = 0.0_wp
      if (judged .and. .not. turns_back(model, model%combinations(1))) &
         judging = state_iterations*judging_work(model)
      solved = iterations*merge(beside_joints, alone, can_yield(model))
      work(solved_entries) = (solved + judging(1))*entries
      work(body_stresses) = (iterations + judging(1))*passes*shapes*modes
      work(body_laws) = (iterations + judging(2))*on
      work(sums) = (iterations + 2.0_wp*judging(2))*sums_a_point*on*modes
   end function body_work

   !> Work of an iteration of all states that errors are estimated by, in iterations of the job: the
   !> same state, on twice the planes, with twice the harmonics on these, with few harmonics, and with
   !> these on four times the elements
   pure function judging_work(model) result(work)
      !> The job
      type(model_type), intent(in) :: model
      !> In solutions and stresses, and in laws
      real(wp) :: work(2)

      real(wp) :: share
      integer :: few, other

      call mesh_harmonics(model, .not. can_yield(model), few, other)
      share = real(few + 1, wp)/(model%max_harmonic + 1)
      work = [1.0_wp + 1.0_wp + 2.0_wp + 5.0_wp*share, 1.0_wp + 2.0_wp + 2.0_wp + 5.0_wp*share]
   end function judging_work

   !> Gauss points of the bodies that yield
   pure integer function n_body_points(model) result(n)
      !> The job
      type(model_type), intent(in) :: model

      type(reference_type), allocatable :: references(:)

      references = element_references(model%mesh)
      n = sum(references(model%mesh%element_kind)%n_points, mask=yields(model))
   end function n_body_points

   !> Elements that yield
   pure function yields(model)
      !> The job
      type(model_type), intent(in) :: model
      !> Shape (elements)
      logical, allocatable :: yields(:)

      yields = model%materials(model%mesh%element_material)%yield%criterion /= yield_none
   end function yields

end module axijoint_estimate_body_work
