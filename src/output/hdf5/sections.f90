!> Results along lines and on cuts in the HDF5 file
module axijoint_output_hdf5_sections
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_text, only : to_text
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : line_type
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_line_values, only : line_displacements, line_stresses
   implicit none
   private
   public :: write_section_groups, write_cut_group

contains

   !> A group for each line
   subroutine write_section_groups(file, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      integer :: k

      if (size(model%lines) == 0) return
      call file%group("/sections")
      do k = 1, size(model%lines)
         call write_section(file, model, results, model%lines(k), &
                            "/sections/"//to_text(model%lines(k)%label))
      end do
   end subroutine write_section_groups

   !> One line
   subroutine write_section(file, model, results, line, name)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> The line
      type(line_type), intent(in) :: line
      !> Its group
      character(len=*), intent(in) :: name

      integer :: i, n

      n = size(line%points)
      call file%group(name)
      call file%attribute(name, "points", line%n_points)
      call file%write(name//"/angles", line%angles, "theta; (angle) [radian]")
      call file%write(name//"/ends", reshape([line%first, line%last], [2, 2]), &
         "r and z of the first and of the last point; (2, 2) [length]")
      call file%write(name//"/point", (line%points%number), &
         "Number of the point along the section; (row). Points outside the mesh have no row, "// &
         "points where solids meet one for each")
      call file%write(name//"/position", reshape([(line%points(i)%position, i=1, n)], [2, n]), &
         "r and z; (2, row) [length]")
      call file%write(name//"/element", (line%points%element), "Element (index); (row)")
      call file%write(name//"/displacement", line_displacements(model, results, line), &
         "Totals u, v, w; (3, row, angle) [length]")
      call file%write(name//"/stress", line_stresses(model, results, line), &
         "Totals r, z, theta, rz, r-theta, z-theta; (6, row, angle) [stress]")
   end subroutine write_section

   !> All cuts
   subroutine write_cut_group(file, model, results)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      if (size(model%cuts) == 0) return
      call file%group("/cuts")
      call file%write("/cuts/label", (model%cuts%label), "Number in the deck; (cut)")
      call file%write("/cuts/z", (model%cuts%z), "z; (cut) [length]")
      call file%write("/cuts/body", (model%cuts%body), "Body, 0 for all; (cut)")
      call file%write("/cuts/resultants", results%cut_resultants, &
         "Axial force, shear along theta "// &
         "= 0, moment that lifts theta = 0, torque, shear and moment at 90 degrees: of the "// &
         "part "// &
         "above on the part below, moments about r = 0 at the cut; (6, cut)")
      call file%write("/cuts/motion", results%cut_motion, &
         "Motion of the section, in the order of the resultants: along z, along theta = 0, "// &
         "rotation that lifts theta = 0, about z, along 90 degrees, rotation that lifts them; "// &
         "(6, cut) [length, radian]")
   end subroutine write_cut_group

end module axijoint_output_hdf5_sections
