!> Tables of the listing along lines and on cuts
module axijoint_output_listing_sections
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_series, only : series_type
   use axijoint_analysis_core_totals, only : circle_type, new_circle, total_displacement
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_model_locate, only : line_position
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : line_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_result_heading
   use axijoint_output_file_line_values, only : line_displacement, line_stress
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_sections, write_cuts, write_named_points

   !> Number of a point; body and material; number of a cut; its body
   character(len=*), parameter :: format_point = '(i8)', format_solid = '(2i6)', &
      format_cut = '(i8)', format_body = '(i6)', format_increment = '(i10)'
   !> Columns of coordinates, displacements, stresses, resultants
   integer, parameter :: narrow = 12, wide = 15, middle = 14

contains

   !> Displacements and stresses along all lines, sums of all modes
   subroutine write_sections(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      real(wp), allocatable :: values(:, :)
      integer :: k, i

      do k = 1, size(model%lines)
         associate (line => model%lines(k))
            do i = 1, size(line%angles)
               values = line_displacement(model, results, line, line%angles(i))
               call write_result_heading(file, "DISPLACEMENTS ON "//title(line, i), &
                  results%converged)
               call file%put("   point           r           z  body  mat.              u"// &
                  "              v              w")
               call write_points(file, model, line, values, wide)
            end do
            do i = 1, size(line%angles)
               values = line_stress(model, results, line, line%angles(i))
               call write_result_heading(file, "STRESSES ON "//title(line, i), results%converged)
               call file%put("   point           r           z  body  mat.       sigma_r"// &
                  "       sigma_z   sigma_theta        tau_rz    tau_rtheta    tau_ztheta")
               call write_points(file, model, line, values, middle)
            end do
         end associate
      end do
   end subroutine write_sections

   !> Name of a line and an angle: "SECTION 1, theta = 0 degrees"
   pure function title(line, i) result(text)
      !> The line
      type(line_type), intent(in) :: line
      !> Which of its angles
      integer, intent(in) :: i
      !> The name
      character(len=:), allocatable :: text

      text = "SECTION "//to_text(line%label)//", theta = "//to_text(line%angles(i)/degree)// &
         " degrees"
   end function title

   !> Displacements of the named points, sums of all modes, of each increment
   subroutine write_named_points(file, model, results, series)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> What is followed from increment to increment
      type(series_type), intent(in) :: series

      type(circle_type) :: circle
      character(len=10) :: increment
      integer :: p, i, k

      do p = 1, size(model%points)
         associate (point => model%points(p))
            do k = 1, size(model%output_angles)
               circle = new_circle(results%modes, model%output_angles(k))
               call write_result_heading(file, "POINT "//to_text(point%label)//", "//trim(point%name)//", theta = "// &
                  to_text(circle%angle/degree)//" degrees", results%converged)
               call file%put("  at r = "//to_text(point%position(1))//", z = "//to_text(point%position(2)))
               call file%put(" increment    load factor              u              v              w")
               do i = 1, series%n
                  write (increment, format_increment) series%increment(i)
                  call file%put(increment//columns([series%load_factor(i), &
                     total_displacement(series%points(:, p, :, i), circle)], wide))
               end do
            end do
         end associate
      end do
   end subroutine write_named_points

   !> One row for each point and each solid that it is in
   subroutine write_points(file, model, line, values, width)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> The line
      type(line_type), intent(in) :: line
      !> Values at its points in elements, shape (components, points)
      real(wp), intent(in) :: values(:, :)
      !> Columns of a value
      integer, intent(in) :: width

      character(len=8) :: number
      character(len=12) :: solid
      integer :: k, i

      i = 1
      do k = 1, line%n_points
         write (number, format_point) k
         if (.not. holds(i, k)) call file%put(number//columns(line_position(line, k), narrow)//"  outside the mesh")
         do while (holds(i, k))
            associate (point => line%points(i))
               write (solid, format_solid) model%mesh%element_body(point%element), &
                  model%materials(model%mesh%element_material(point%element))%label
               call file%put(number//columns(point%position, narrow)//solid//columns(values(:, i), width))
            end associate
            i = i + 1
         end do
      end do

   contains

      !> Whether the i-th point in elements is the k-th of the line
      pure logical function holds(i, k)
         !> The numbers
         integer, intent(in) :: i, k

         holds = i <= size(line%points)
         if (holds) holds = line%points(i)%number == k
      end function holds

   end subroutine write_points

   !> Resultants of the stresses on all cuts
   subroutine write_cuts(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=8) :: label
      character(len=6) :: body
      integer :: k

      if (size(model%cuts) == 0) return
      call write_result_heading(file, "RESULTANTS ON CUTS z = const (of the part above on the "// &
         "part "// &
         "below; moments about r = 0 at the cut)", results%converged)
      call file%put("     cut           z  body    axial force     shear at 0    shear at 90"// &
         "    moment at 0   moment at 90         torque")
      do k = 1, size(model%cuts)
         associate (cut => model%cuts(k))
            write (label, format_cut) cut%label
            body = "   all"
            if (cut%body > 0) write (body, format_body) cut%body
            call file%put(label//columns([cut%z], narrow)//body// &
               columns(results%cut_resultants([1, 2, 5, 3, 6, 4], k), wide))
         end associate
      end do
   end subroutine write_cuts

end module axijoint_output_listing_sections
