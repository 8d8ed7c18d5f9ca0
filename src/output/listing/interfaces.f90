!> What goes through the interfaces of a job, and how much of their area does it
module axijoint_output_listing_interfaces
   use axijoint_analysis_core_fields, only : n_resultants, lateral, moment, lateral_90, moment_90
   use axijoint_analysis_core_joint_resultants, only : joint_height
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, pi
   use axijoint_element_joint_law, only : state_stick, state_slip, state_open
   use axijoint_model_interface, only : interface_name, name_length
   use axijoint_model_joint_points, only : model_joint_point_type, new_joint_points
   use axijoint_model_model, only : model_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_interface_resultants

   !> Columns of a value
   integer, parameter :: wide = 15

contains

   !> Resultants of all interfaces, and of joints that belong to none, with the shares of their area that stick, slip and are open
   subroutine write_interface_resultants(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      type(model_joint_point_type), allocatable :: points(:)

      if (size(model%mesh%joint_label) == 0) return
      points = new_joint_points(model)
      call write_result_heading(file, "RESULTANTS OF INTERFACES (of the body at side 4-3 of joints on that at side 1-2; "// &
         "moments about the origin)", results%converged)
      call file%put("  interface               axial force     force at 0    force at 90    moment at 0   moment at 90"// &
         "         torque")
      call write_lines(.true.)
      call file%put("  interface                      area   stick    slip    open  (shares of the area)")
      call write_lines(.false.)

   contains

      !> A line of each
      subroutine write_lines(forces)
         !> What they tell: forces or areas
         logical, intent(in) :: forces

         integer :: k

         do k = 1, size(model%interfaces)
            call write_line(interface_name(model%interfaces, k), model%mesh%joint_interface == k, forces)
         end do
         call write_line("joints of JOINTS", model%mesh%joint_interface == 0, forces)
      end subroutine write_lines

      !> A line of some joints; none if there are none
      subroutine write_line(name, chosen, forces)
         !> Their name
         character(len=*), intent(in) :: name
         !> Whether a joint is one of them, and what the line tells: forces or areas
         logical, intent(in) :: chosen(:), forces

         character(len=name_length) :: label
         character(len=24) :: shares
         real(wp) :: area(0:2)

         if (.not. any(chosen)) return
         label = name
         if (forces) then
            call file%put("  "//label//columns(sum_of(model, results, chosen), wide))
            return
         end if
         area = areas_of(points, chosen, results)
         write (shares, "(3f8.3)") area([state_stick, state_slip, state_open])/sum(area)
         call file%put("  "//label//columns([sum(area)], wide)//shares)
      end subroutine write_line

   end subroutine write_interface_resultants

   !> Sum of the resultants of joints, moments about the origin
   pure function sum_of(model, results, chosen) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> Whether a joint counts
      logical, intent(in) :: chosen(:)
      !> Axial force, forces at 0 and 90 degrees, moments at 0 and 90 degrees, torque
      real(wp) :: total(n_resultants)

      real(wp) :: one(n_resultants)
      integer :: j

      total = 0.0_wp
      do j = 1, size(chosen)
         if (.not. chosen(j)) cycle
         one = results%joint_resultants(:, j)
         associate (z => joint_height(model%mesh, j))
            one(moment) = one(moment) - z*one(lateral)
            one(moment_90) = one(moment_90) - z*one(lateral_90)
         end associate
         total = total + one([1, 2, 5, 3, 6, 4])
      end do
   end function sum_of

   !> Areas of joints that stick, slip and are open, all round the circle: of a point on a plane as far as half way to the next
   pure function areas_of(points, chosen, results) result(area)
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Whether a joint counts
      logical, intent(in) :: chosen(:)
      !> Results
      type(results_type), intent(in) :: results
      !> Shape (states) [length^2]
      real(wp) :: area(0:2)

      real(wp) :: part(size(results%plane_angles))
      integer :: i, k

      part = 1.0_wp
      if (size(part) > 1 .and. maxval(results%plane_angles) < 1.0001_wp*pi) part([1, size(part)]) = 0.5_wp  ! mirrored
      part = part/sum(part)
      area = 0.0_wp
      do k = 1, size(points)
         if (.not. chosen(points(k)%joint)) cycle
         do i = 1, size(part)
            associate (state => results%joint_state(k, i))
               area(state) = area(state) + 2.0_wp*pi*points(k)%weight*part(i)
            end associate
         end do
      end do
   end function areas_of

end module axijoint_output_listing_interfaces
