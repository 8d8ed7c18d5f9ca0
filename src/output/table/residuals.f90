!> What the iterations left out of balance, part by part and harmonic by harmonic: in the listing,
!> the summary, the HDF5 file
module axijoint_output_table_residuals
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_fe_mode, only : mode_name
   use axijoint_joints_residual, only : residual_record_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_json, only : json_number, json_string
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_residuals, write_residual_arrays, residuals_json

   !> Increment, and a node
   character(len=*), parameter :: format_increment = '(i12)', format_node = '(i10)'
   !> Columns of reals
   integer, parameter :: wide = 15

contains

   !> Tables of the listing: the largest ratio of every step, and all of the last
   subroutine write_residuals(file, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      character(len=12) :: number
      integer :: i

      if (size(results%residuals) == 0) return
      call write_result_heading(file, "FORCES OUT OF BALANCE", results%converged)
      call file%put("  (of the whole: over the loads; of a part in a harmonic: over what its "// &
         "joints would carry")
      call file%put("  of the increment if they held, all harmonics together where the "// &
         "increment has no load)")
      call file%put("   increment    load factor       of whole of largest part   part with "// &
         "node, harmonic")
      do i = 1, size(results%residuals)
         associate (record => results%residuals(i))
            write (number, format_increment) record%increment
            call file%put(number//columns([record%load_factor, record%whole, largest(record)], &
               wide)//"   "// &
               place_text(results, record))
         end associate
      end do
      call write_last(file, results, results%residuals(size(results%residuals)))
   end subroutine write_residuals

   !> All ratios of the last step, one line a harmonic
   subroutine write_last(file, results, record)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results
      !> The step
      type(residual_record_type), intent(in) :: record

      !> Parts that fit a line
      integer, parameter :: most = 6
      character(len=:), allocatable :: text
      character(len=wide) :: head
      integer :: first, i, k, last

      do first = 1, size(record%ratio, 1), most
         last = min(first + most - 1, size(record%ratio, 1))
         call file%put("")
         text = "  last step: part with node"
         do i = first, last
            write (head, '(i15)') results%residual_part_node(i)
            text = text//head
         end do
         call file%put(text)
         do k = 1, size(record%ratio, 2)
            text = "  "//mode_name(results%modes(k))
            text = text//repeat(" ", max(1, 27 - len(text)))
            call file%put(text//columns(record%ratio(first:last, k), wide))
         end do
      end do
   end subroutine write_last

   !> The same in the HDF5 file
   subroutine write_residual_arrays(file, results)
      !> The file, in which the group of the convergence is
      class(hdf5_file_type), intent(inout) :: file
      !> Results
      type(results_type), intent(in) :: results

      real(wp), allocatable :: ratio(:, :, :)
      integer :: i, n

      n = size(results%residuals)
      allocate (ratio(size(results%residual_part_node), size(results%modes), n))
      do i = 1, n
         ratio(:, :, i) = results%residuals(i)%ratio
      end do
      call file%write("/convergence/step_increment", (results%residuals%increment), &
         "Increment of a load step; (load step)")
      call file%write("/convergence/step_load_factor", (results%residuals%load_factor), &
         "Load factor after it; (load step)")
      call file%write("/convergence/step_residual", (results%residuals%whole), &
         "Forces out of balance at its end over the loads (Eq. 17); (load step)")
      call file%write("/convergence/part_residual", ratio, &
         "Forces out of balance over those of the joints in the increment; (part, mode, load step)")
      call file%write("/convergence/part_node", (results%residual_part_node), &
         "A node of each part with joints; (part)")
   end subroutine write_residual_arrays

   !> The largest ratio of every step in the summary
   pure function residuals_json(results) result(json)
      !> Results
      type(results_type), intent(in) :: results
      !> A JSON array
      character(len=:), allocatable :: json

      integer :: place(2), i

      json = "["
      do i = 1, size(results%residuals)
         associate (record => results%residuals(i))
            if (i > 1) json = json//", "
            json = json//'{"increment": '//to_text(record%increment)//', "load_factor": '// &
               json_number(record%load_factor)//', "whole": '//json_number(record%whole)// &
               ', "largest_part": '//json_number(largest(record))
            if (largest(record) > 0.0_wp) then
               place = maxloc(record%ratio)
               json = json//', "node": '//to_text(results%residual_part_node(place(1)))// &
                  ', "harmonic": '// &
                  to_text(results%modes(place(2))%harmonic)//', "mode": '// &
                  json_string(mode_name(results%modes(place(2))))
            else
               json = json//', "node": null, "harmonic": null, "mode": null'
            end if
            json = json//'}'
         end associate
      end do
      json = json//"]"
   end function residuals_json

   !> The largest ratio of all parts and harmonics
   pure real(wp) function largest(record)
      !> A step
      type(residual_record_type), intent(in) :: record

      largest = 0.0_wp
      if (size(record%ratio) > 0) largest = maxval(record%ratio)
   end function largest

   !> Where it is
   pure function place_text(results, record) result(text)
      !> Results
      type(results_type), intent(in) :: results
      !> A step
      type(residual_record_type), intent(in) :: record
      !> A node of the part, and the harmonic
      character(len=:), allocatable :: text

      character(len=10) :: number
      integer :: place(2)

      text = ""
      if (.not. largest(record) > 0.0_wp) return
      place = maxloc(record%ratio)
      write (number, format_node) results%residual_part_node(place(1))
      text = number//", "//mode_name(results%modes(place(2)))
   end function place_text

end module axijoint_output_table_residuals
