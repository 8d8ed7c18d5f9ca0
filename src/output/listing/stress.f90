!> Tables of the listing that show stresses of the solids and of the joints
module axijoint_output_listing_stress
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_totals, only : circle_type, peak_type, new_circle, total_stress, extremes_round
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_element_joint_law, only : state_stick, state_slip, state_open
   use axijoint_model_interface, only : interface_name
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : print_stresses, print_nodal, print_states
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_row, only : row_type
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_listing_choice, only : chosen_places, none_asked
   use axijoint_output_listing_extremes, only : extremes_type, begin_table
   implicit none
   private
   public :: write_stresses, write_extremes_round, write_nodal_stresses, write_joint_results

   !> Columns of the number of an entry, of a point in it, and of a material
   integer, parameter :: label = 10, point_label = 3, material_label = 6
   !> Angle in degrees
   character(len=*), parameter :: format_angle = '(f8.3)'
   !> Columns of coordinates, joint results, solid stresses
   integer, parameter :: narrow = 12, middle = 13, wide = 14
   !> Names of stresses of solids; of stresses and relative displacements of joints
   character(len=11), parameter :: stress_names(6) = [character(len=11) :: "sigma_r", "sigma_z", &
      "sigma_theta", "tau_rz", "tau_rtheta", "tau_ztheta"]
   character(len=9), parameter :: joint_names(6) = [character(len=9) :: "tau_xi", "sigma", &
      "tau_theta", "d_xi", "d_eta", "d_theta"]
   !> Heading of coordinates and stresses
   character(len=*), parameter :: stress_header = "           r           z       sigma_r"// &
      "       sigma_z   sigma_theta        tau_rz    tau_rtheta    tau_ztheta"

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
      type(extremes_type) :: extremes
      type(row_type) :: row
      logical :: listed(size(results%point_element))
      real(wp) :: stress(6)
      integer :: i, point, local, element

      if (none_asked(model, print_stresses)) return
      listed = chosen_places(model, results, print_stresses)
      do i = 1, size(model%output_angles)
         circle = new_circle(results%modes, model%output_angles(i))
         call begin_table(file, "TOTAL STRESSES AT GAUSS POINTS, theta = "// &
            to_text(circle%angle/degree)//" degrees", "   element pt"//stress_header, &
            results%converged, listed, stress_names, extremes)
         local = 0
         do point = 1, size(listed)
            local = next_local(results%point_element, point, local)
            element = model%mesh%element_label(results%point_element(point))
            stress = total_stress(results%stress(:, point, :), circle)
            call extremes%note(element, results%point_position(:, point), stress)
            if (.not. listed(point)) cycle
            call row%begin()
            call row%integers([element], label)
            call row%integers([local], point_label)
            call row%reals(results%point_position(:, point), narrow)
            call row%reals(stress, wide)
            call row%put(file)
         end do
         call extremes%write(file, count(listed), "element")
      end do
   end subroutine write_stresses

   !> The least and the largest of each stress at the Gauss points round the circle, which angles of the deck may miss
   subroutine write_extremes_round(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      type(peak_type) :: extremes(2)
      character(len=:), allocatable :: line
      character(len=10) :: number
      character(len=9) :: angle
      integer :: c, k

      if (none_asked(model, print_stresses) .or. all(results%modes%harmonic == 0)) return
      call write_result_heading(file, "EXTREMES OF TOTAL STRESSES AT GAUSS POINTS ROUND THE CIRCLE", results%converged)
      call file%put("  column               least   element           r           z    theta"// &
         "        largest   element           r           z    theta")
      do c = 1, size(stress_names)
         call extremes_round(results%modes, results%stress(c, :, :), c > 4, extremes)
         line = "  "//stress_names(c)
         do k = 1, 2
            if (extremes(k)%place == 0) return
            write (number, "(i10)") model%mesh%element_label(results%point_element(extremes(k)%place))
            write (angle, "(f9.3)") extremes(k)%angle/degree
            line = line//columns([extremes(k)%value], wide + 1)//number// &
                   columns(results%point_position(:, extremes(k)%place), narrow)//angle
         end do
         call file%put(line)
      end do
   end subroutine write_extremes_round

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
      type(extremes_type) :: extremes
      type(row_type) :: row
      logical :: listed(size(results%nodal%node))
      real(wp) :: stress(6)
      integer :: i, k

      if (none_asked(model, print_nodal)) return
      listed = chosen_places(model, results, print_nodal)
      do i = 1, size(model%output_angles)
         circle = new_circle(results%modes, model%output_angles(i))
         call begin_table(file, "TOTAL STRESSES AT NODES, theta = "// &
            to_text(circle%angle/degree)//" degrees", "      node  mat."//stress_header, &
            results%converged, listed, stress_names, extremes)
         do k = 1, size(listed)
            associate (node => results%nodal%node(k))
               stress = total_stress(results%nodal%amplitude(:, k, :), circle)
               call extremes%note(model%mesh%node_label(node), &
                  model%mesh%coordinates(:, node), stress)
               if (.not. listed(k)) cycle
               call row%begin()
               call row%integers([model%mesh%node_label(node)], label)
               call row%integers([model%materials(results%nodal%material(k))%label], material_label)
               call row%reals(model%mesh%coordinates(:, node), narrow)
               call row%reals(stress, wide)
               call row%put(file)
            end associate
         end do
         call extremes%write(file, count(listed), "node")
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

      type(extremes_type) :: extremes
      type(row_type) :: row
      character(len=8) :: angles(size(results%plane_angles))
      logical :: listed(size(results%joint_point_joint))
      real(wp) :: values(6)
      integer :: point, plane, local, joint, last, place

      if (size(listed) == 0 .or. none_asked(model, print_states)) return
      listed = chosen_places(model, results, print_states, size(results%plane_angles))
      call begin_table(file, "JOINT STRESSES, RELATIVE DISPLACEMENTS AND STATES ON PLANES", &
         "     joint pt           r           z   theta       tau_xi        sigma"// &
         "    tau_theta         d_xi        d_eta      d_theta state", &
         results%converged, listed, joint_names, extremes, on_planes=.true.)
      write (angles, format_angle) results%plane_angles/degree
      local = 0
      last = 0
      do point = 1, size(listed)
         local = next_local(results%joint_point_joint, point, local)
         joint = model%mesh%joint_label(results%joint_point_joint(point))
         if (listed(point)) call write_new_interface(file, model, results%joint_point_joint, &
            point, last)
         call row%begin()
         call row%integers([joint], label)
         call row%integers([local], point_label)
         call row%reals(results%joint_point_position(:, point), narrow)
         place = row%length()
         do plane = 1, size(results%plane_angles)
            values = [results%joint_stress(:, point, plane), results%joint_jump(:, point, plane)]
            call extremes%note(joint, results%joint_point_position(:, point), values, &
               results%plane_angles(plane))
            if (.not. listed(point)) cycle
            call row%cut(place)
            call row%words(angles(plane))
            call row%reals(values, middle)
            call row%words(" "//state_name(results%joint_state(point, plane)))
            call row%put(file)
         end do
         if (listed(point)) last = point
      end do
      call extremes%write(file, count(listed)*size(results%plane_angles), "joint")
   end subroutine write_joint_results

   !> The name of the interface where the joints of another one begin
   subroutine write_new_interface(file, model, joints, point, last)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Joint of each point
      integer, intent(in) :: joints(:)
      !> The point, and the one that was listed before; 0 if none was
      integer, intent(in) :: point, last

      associate (interface => model%mesh%joint_interface)
         if (last > 0) then
            if (interface(joints(point)) == interface(joints(last))) return
         end if
         if (interface(joints(point)) == 0) then
            if (last > 0) call file%put("interface: none")
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
