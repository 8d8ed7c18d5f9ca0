!> Memory that a run takes at its peak
module axijoint_estimate_peak
   use axijoint_analysis_core_footprint, only : footprint_type, data_footprint, program_bytes
   use axijoint_analysis_core_structure, only : structure_type, plan_structure
   use axijoint_analysis_error_plastic_errors, only : turns_back
   use axijoint_analysis_error_plastic_variants, only : take_more_harmonics, take_fewer_harmonics, &
      mesh_harmonics
   use axijoint_analysis_fine_mesh, only : fine_mesh_type
   use axijoint_analysis_fine_whole_model, only : new_whole_model
   use axijoint_assembly_factors, only : standing_bytes, parts_bytes, kept_bytes, passing_bytes
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : i8
   use axijoint_base_progress, only : progress_type
   use axijoint_estimate_arrays, only : series_bytes
   use axijoint_estimate_volume, only : swept_numbers
   use axijoint_model_mesh, only : n_elements, n_joints
   use axijoint_model_model, only : model_type, can_yield, bodies_yield
   use axijoint_model_modes, only : highest_loaded
   implicit none
   private
   public :: peak_bytes

   !> What a cut takes besides its elements [byte]; measured
   integer(i8), parameter :: plane_bytes = 3000_i8
   !> What iterations of joints load of the program; what the libraries of the output add for swept bodies and
   !> joints, parts of which are in memory, and for each number of these bodies [byte]; measured
   integer(i8), parameter :: yielding_bytes = 300000_i8, swept_bytes = 4500000_i8, &
      swept_joint_bytes = 3500000_i8, swept_number_bytes = 8_i8

contains

   !> Bytes at the peak
   function peak_bytes(model, structure, at_start) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> What program and libraries take when they start
      integer(i8), intent(in) :: at_start
      !> The bytes
      integer(i8) :: bytes

      type(footprint_type) :: others

      associate (equations => structure%equations)
         others = data_footprint(model, size(structure%modes), size(equations%systems), &
                                 structure%joint_points, structure%estimated)
         bytes = at_start + program_bytes + equations%solver%library_bytes + others%mesh + &
            standing_bytes(equations) + parts_bytes(equations) &
            + kept_bytes(equations) + others%joints + others%bodies + others%fine + cut_bytes(model) &
            + nint(series_bytes(model, size(structure%modes)), i8) &
            + max(solving_bytes(structure, others), others%loads + others%stresses + line_bytes(model) &
                  + max(sweep_bytes(model, structure), judging_bytes(model)))
      end associate
      if (can_yield(model)) bytes = bytes + yielding_bytes
   end function peak_bytes

   !> What the cuts hold: points of their sections, and the elements that they pass through with what loads leave in these, on a
   !> mesh about as high as wide
   pure integer(i8) function cut_bytes(model) result(bytes)
      !> The job
      type(model_type), intent(in) :: model

      associate (crossed => nint(sqrt(real(n_elements(model%mesh)))))
         bytes = size(model%cuts)*(plane_bytes + crossed*(8_i8 + 48_i8*size(model%body_loads)))
      end associate
   end function cut_bytes

   !> Values on the sections of an increment, which are there twice
   pure integer(i8) function line_bytes(model) result(bytes)
      !> The job
      type(model_type), intent(in) :: model

      integer :: k

      bytes = 0
      do k = 1, size(model%lines)
         bytes = max(bytes, 2*48_i8*size(model%lines(k)%points)*size(model%lines(k)%angles))
      end do
   end function line_bytes

   !> What comes and goes while the equations are solved
   pure integer(i8) function solving_bytes(structure, others) result(bytes)
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> What stands beside its equations
      type(footprint_type), intent(in) :: others

      associate (equations => structure%equations)
         bytes = max(passing_bytes(equations) + others%loads + others%joint_states + others%fine_work*equations%n_workers, &
                     others%joint_work*equations%n_workers, others%body_work)
      end associate
   end function solving_bytes

   !> What the estimates of errors of bodies that yield take: the larger of the structure with more
   !> harmonics and the one on the finer mesh. Neither is made where it does not fit
   integer(i8) function judging_bytes(model) result(bytes)
      !> The job
      type(model_type), intent(in) :: model

      type(model_type) :: other, finer
      type(fine_mesh_type) :: mesh
      integer :: few, second

      bytes = 0
      if (.not. bodies_yield(model)) return
      if (turns_back(model, model%combinations(1))) return
      if (highest_loaded(model) > 0) then
         call take_more_harmonics(model, other)
         bytes = whole_bytes(other)
      end if
      call mesh_harmonics(model, .not. can_yield(model), few, second)
      call take_fewer_harmonics(model, few, other)
      call new_whole_model(other, mesh, finer)
      bytes = max(bytes, whole_bytes(finer))
   end function judging_bytes

   !> A structure of its own, with the state of its bodies in one step
   integer(i8) function whole_bytes(model) result(bytes)
      !> The job
      type(model_type), intent(in) :: model

      type(structure_type) :: structure
      type(footprint_type) :: others
      type(progress_type) :: silent
      type(error_type), allocatable :: error

      bytes = 0
      structure%estimated = .false.
      call plan_structure(model, structure, silent, error)
      if (allocated(error)) return  ! does not fit
      associate (equations => structure%equations)
         others = data_footprint(model, size(structure%modes), size(equations%systems), &
                                 structure%joint_points, structure%estimated)
         bytes = others%mesh + standing_bytes(equations) + parts_bytes(equations) &
            + kept_bytes(equations) + others%joints + others%bodies + others%loads &
            + solving_bytes(structure, others)
      end associate
   end function whole_bytes

   !> What writing swept bodies and joints takes
   pure integer(i8) function sweep_bytes(model, structure) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure

      bytes = 0
      if (.not. model%sweep%wanted) return
      bytes = swept_bytes + nint(swept_number_bytes*swept_numbers(model, structure%modes), i8)
      if (n_joints(model%mesh) > 0) bytes = bytes + swept_joint_bytes
   end function sweep_bytes

end module axijoint_estimate_peak
