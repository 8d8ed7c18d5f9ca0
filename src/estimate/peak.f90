!> Memory that a run takes at its peak
module axijoint_estimate_peak
   use axijoint_analysis_core_footprint, only : footprint_type, data_footprint
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_assembly_factors, only : standing_bytes, parts_bytes, kept_bytes, passing_bytes
   use axijoint_base_kinds, only : i8
   use axijoint_model_mesh, only : n_joints
   use axijoint_model_model, only : model_type, can_yield
   implicit none
   private
   public :: peak_bytes

   !> Program and libraries without any data while it solves; what iterations of joints load of it;
   !> what the libraries of the output add once they are used, and for each file of swept bodies or
   !> joints, of which parts are compressed in memory [byte]; measured
   integer(i8), parameter :: program_bytes = 19000000_i8, yielding_bytes = 1700000_i8
   integer(i8), parameter :: output_bytes = 5500000_i8, swept_bytes = 11000000_i8

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
            + kept_bytes(equations) + others%joints + others%fine &
            + max(passing_bytes(equations) + others%loads + others%fine_work*equations%n_workers, &
                  others%joint_work*equations%n_workers, &
                  output_bytes + swept_bytes*n_swept_files(model) + others%loads &
                  + others%stresses)
      end associate
      if (can_yield(model)) bytes = bytes + yielding_bytes
   end function peak_bytes

   !> Files of swept bodies and joints
   pure integer function n_swept_files(model) result(n)
      !> The job
      type(model_type), intent(in) :: model

      n = 0
      if (model%sweep%wanted) n = merge(2, 1, n_joints(model%mesh) > 0)
   end function n_swept_files

end module axijoint_estimate_peak
