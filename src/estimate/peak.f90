!> Memory that a run takes at its peak
module axijoint_estimate_peak
   use axijoint_analysis_core_footprint, only : footprint_type, data_footprint
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_factors, only : standing_bytes, parts_bytes, kept_bytes, passing_bytes
   use axijoint_base_kinds, only : i8
   use axijoint_estimate_volume, only : swept_numbers
   use axijoint_model_mesh, only : n_joints
   use axijoint_model_model, only : model_type, can_yield
   implicit none
   private
   public :: peak_bytes

   !> Program and libraries without any data while it solves; what iterations of joints load of it;
   !> what the libraries of the output add once they are used, for swept bodies and joints, parts of
   !> which are compressed in memory, and for each number of these bodies [byte]; measured
   integer(i8), parameter :: program_bytes = 19000000_i8, yielding_bytes = 1700000_i8
   integer(i8), parameter :: output_bytes = 5500000_i8, swept_bytes = 8000000_i8, &
      swept_joint_bytes = 5000000_i8, swept_number_bytes = 8_i8

contains

   !> Bytes at the peak
   function peak_bytes(model, structure) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> The structure, planned
      type(structure_type), intent(in) :: structure
      !> The bytes
      integer(i8) :: bytes

      type(footprint_type) :: others

      associate (equations => structure%equations)
         others = data_footprint(model, size(structure%modes), size(equations%systems), &
                                 structure%joint_points)
         bytes = program_bytes + equations%solver%library_bytes + others%mesh + &
            standing_bytes(equations) + parts_bytes(equations) &
            + kept_bytes(equations) + others%joints + others%bodies + others%fine &
            + max(passing_bytes(equations) + others%loads + others%fine_work*equations%n_workers, &
                  others%joint_work*equations%n_workers, others%body_work, &
                  output_bytes + sweep_bytes(model, structure) + others%loads &
                  + others%stresses)
      end associate
      if (can_yield(model)) bytes = bytes + yielding_bytes
   end function peak_bytes

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
