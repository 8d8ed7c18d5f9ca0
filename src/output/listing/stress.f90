!> Tables of the listing that show stresses of the solids and of the joints
module axijoint_output_listing_stress
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : degree
   use axijoint_base_text, only : to_text
   use axijoint_element_joint_law, only : state_stick, state_slip, state_open
   use axijoint_model_interface, only : interface_name
   use axijoint_model_model, only : model_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_file_totals, only : circle_type, new_circle, total_stress
   implicit none
   private
   public :: write_stresses, write_nodal_stresses, write_joint_results

   !> Element or joint, and its point
   character(len=*), parameter :: format_point = '(i10, i3)'
   !> Node and material
   character(len=*), parameter :: format_node = '(i10, i6)'
   !> Angle in degrees
   character(len=*), parameter :: format_angle = '(f8.3)'
   !> Columns of coordinates, joint results, solid stresses
   integer, parameter :: narrow = 12, middle = 13, wide = 14

contains

   !> Stresses at the Gauss points of the solids, sums of all harmonics at the
   !> angles of the deck
   subroutine write_stresses(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      type(circle_type) :: circle
      character(len=13) :: label
      integer :: i, point, local

      do i = 1, size(model%output_angles)
         circle = new_circle(results%modes, model%output_angles(i))
         call write_result_heading(file, "TOTAL STRESSES AT GAUSS POINTS, theta = "// &
            to_text(circle%angle/degree)//" degrees", results%converged)
         call file%put("   element pt           r           z       sigma_r       sigma_z"// &
            "   sigma_theta        tau_rz    tau_rtheta    tau_ztheta")
         local = 0
         do point = 1, size(results%point_element)
            local = next_local(results%point_element, point, local)
            write (label, format_point) &
               model%mesh%element_label(results%point_element(point)), local
            call file%put(label//columns(results%point_position(:, point), narrow)// &
               columns(total_stress(results%stress(:, point, :), circle), wide))
         end do
      end do
   end subroutine write_stresses

   !> Stresses smoothed to the nodes, sums of all harmonics at the angles of the
   !> deck; a line for each material that a node touches
   subroutine write_nodal_stresses(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      type(circle_type) :: circle
      character(len=16) :: label
      integer :: i, k

      do i = 1, size(model%output_angles)
         circle = new_circle(results%modes, model%output_angles(i))
         call write_result_heading(file, "TOTAL STRESSES AT NODES, theta = "// &
            to_text(circle%angle/degree)//" degrees", results%converged)
         call file%put("      node  mat.           r           z       sigma_r       sigma_z"// &
            "   sigma_theta        tau_rz    tau_rtheta    tau_ztheta")
         do k = 1, size(results%nodal%node)
            associate (node => results%nodal%node(k))
               write (label, format_node) model%mesh%node_label(node), &
                  model%materials(results%nodal%material(k))%label
               call file%put(label//columns(model%mesh%coordinates(:, node), narrow)// &
                  columns(total_stress(results%nodal%amplitude(:, k, :), circle), wide))
            end associate
         end do
      end do
   end subroutine write_nodal_stresses

   !> Stresses, relative displacements and states of the joints on the planes
   subroutine write_joint_results(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=8) :: angle
      character(len=13) :: label
      integer :: point, plane, local

      if (size(results%joint_point_joint) == 0) return
      call write_result_heading(file, "JOINT STRESSES, RELATIVE DISPLACEMENTS AND STATES ON "// &
         "PLANES", results%converged)
      call file%put("     joint pt           r           z   theta       tau_xi        sigma"// &
         "    tau_theta         d_xi        d_eta      d_theta state")
      local = 0
      do point = 1, size(results%joint_point_joint)
         local = next_local(results%joint_point_joint, point, local)
         call write_new_interface(file, model, results%joint_point_joint, point)
         write (label, format_point) &
            model%mesh%joint_label(results%joint_point_joint(point)), local
         do plane = 1, size(results%plane_angles)
            write (angle, format_angle) results%plane_angles(plane)/degree
            call file%put(label//columns(results%joint_point_position(:, point), narrow)//angle// &
               columns([results%joint_stress(:, point, plane), &
               results%joint_jump(:, point, plane)], middle)//" "// &
               state_name(results%joint_state(point, plane)))
         end do
      end do
   end subroutine write_joint_results

   !> The name of the interface where the joints of another one begin
   subroutine write_new_interface(file, model, joints, point)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Joint of each point
      integer, intent(in) :: joints(:)
      !> The point
      integer, intent(in) :: point

      associate (interface => model%mesh%joint_interface)
         if (point > 1) then
            if (interface(joints(point)) == interface(joints(point - 1))) return
         end if
         if (interface(joints(point)) == 0) then
            if (point > 1) call file%put("interface: none")
         else
            call file%put("interface: "//interface_name(model%interfaces, &
                                                        interface(joints(point))))
         end if
      end associate
   end subroutine write_new_interface

   !> Number of a point within its element, from the number of the one before
   pure integer function next_local(owners, point, last)
      !> Element or joint of each point, ascending
      integer, intent(in) :: owners(:)
      !> The point
      integer, intent(in) :: point
      !> Number of the point before within its element; 0 at the beginning
      integer, intent(in) :: last

      next_local = 1
      if (point == 1) return
      if (owners(point) == owners(point - 1)) next_local = last + 1
   end function next_local

   !> Name of a joint state
   pure function state_name(state) result(name)
      !> One of the `state_` parameters
      integer, intent(in) :: state
      !> The name
      character(len=5) :: name

      name = "?"
      select case (state)
      case (state_stick)
         name = "stick"
      case (state_slip)
         name = "slip"
      case (state_open)
         name = "open"
      end select
   end function state_name

end module axijoint_output_listing_stress
