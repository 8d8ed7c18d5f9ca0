!> Displacements and stresses at points of lines
module axijoint_output_file_line_values
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_totals, only : circle_type, new_circle, total_displacement, total_stress
   use axijoint_base_kinds, only : wp
   use axijoint_fe_shape, only : shape_element
   use axijoint_model_mesh, only : max_element_nodes
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : line_type, line_point_type
   implicit none
   private
   public :: line_displacement, line_stress, line_displacements, line_stresses

contains

   !> Total displacements u, v, w at the points of a line: the shape functions of the
   !> element that each point is in
   pure function line_displacement(model, results, line, angle) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> The line
      type(line_type), intent(in) :: line
      !> theta [radian]
      real(wp), intent(in) :: angle
      !> The displacements, shape (3, points)
      real(wp) :: total(3, size(line%points))

      total = reshape(displacements_at(model, results, line, [angle]), shape(total))
   end function line_displacement

   !> Total stresses at the points of a line: the stresses at the nodes, within the
   !> material of the element that each point is in, by its shape functions
   pure function line_stress(model, results, line, angle) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> The line
      type(line_type), intent(in) :: line
      !> theta [radian]
      real(wp), intent(in) :: angle
      !> The stresses, shape (6, points)
      real(wp) :: total(6, size(line%points))

      total = reshape(stresses_at(model, results, line, [angle]), shape(total))
   end function line_stress

   !> Total displacements at all angles of a line
   pure function line_displacements(model, results, line) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> The line
      type(line_type), intent(in) :: line
      !> The displacements, shape (3, points, angles)
      real(wp), allocatable :: total(:, :, :)

      total = displacements_at(model, results, line, line%angles)
   end function line_displacements

   !> Total stresses at all angles of a line
   pure function line_stresses(model, results, line) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> The line
      type(line_type), intent(in) :: line
      !> The stresses, shape (6, points, angles)
      real(wp), allocatable :: total(:, :, :)

      total = stresses_at(model, results, line, line%angles)
   end function line_stresses

   !> Total displacements at some angles
   pure function displacements_at(model, results, line, angles) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> The line
      type(line_type), intent(in) :: line
      !> theta [radian]
      real(wp), intent(in) :: angles(:)
      !> The displacements, shape (3, points, angles)
      real(wp), allocatable :: total(:, :, :)

      type(circle_type) :: circles(size(angles))
      real(wp) :: shape(max_element_nodes), amplitude(3, size(results%modes))
      integer :: i, k, n

      circles = [(new_circle(results%modes, angles(i)), i=1, size(angles))]
      allocate (total(3, size(line%points), size(angles)))
      do k = 1, size(line%points)
         associate (point => line%points(k))
            call shape_at(model, point, shape, n)
            amplitude = 0.0_wp
            do i = 1, n
               amplitude = amplitude &
                  + shape(i)*results%displacement(:, model%mesh%element_nodes(i, point%element), :)
            end do
         end associate
         do i = 1, size(angles)
            total(:, k, i) = total_displacement(amplitude, circles(i))
         end do
      end do
   end function displacements_at

   !> Total stresses at some angles
   pure function stresses_at(model, results, line, angles) result(total)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      class(fields_type), intent(in) :: results
      !> The line
      type(line_type), intent(in) :: line
      !> theta [radian]
      real(wp), intent(in) :: angles(:)
      !> The stresses, shape (6, points, angles)
      real(wp), allocatable :: total(:, :, :)

      type(circle_type) :: circles(size(angles))
      real(wp) :: shape(max_element_nodes), amplitude(6, size(results%modes))
      integer :: i, k, n

      circles = [(new_circle(results%modes, angles(i)), i=1, size(angles))]
      allocate (total(6, size(line%points), size(angles)))
      do k = 1, size(line%points)
         associate (point => line%points(k))
            call shape_at(model, point, shape, n)
            amplitude = 0.0_wp
            do i = 1, n
               amplitude = amplitude &
                  + shape(i)*results%nodal%amplitude(:, results%nodal%value_of(i, point%element), :)
            end do
         end associate
         do i = 1, size(angles)
            total(:, k, i) = total_stress(amplitude, circles(i))
         end do
      end do
   end function stresses_at

   !> Shape functions at a point
   pure subroutine shape_at(model, point, shape, n)
      !> The job
      type(model_type), intent(in) :: model
      !> The point
      type(line_point_type), intent(in) :: point
      !> Shape functions, the first n of which are in use
      real(wp), intent(out) :: shape(max_element_nodes)
      !> Nodes of the element
      integer, intent(out) :: n

      real(wp) :: derivative(2, max_element_nodes)

      shape = 0.0_wp
      n = model%mesh%element_size(point%element)
      call shape_element(n, point%natural(1), point%natural(2), shape(:n), derivative(:, :n))
   end subroutine shape_at

end module axijoint_output_file_line_values
