!> Where stresses along the lines of a deck are watched for their errors: at the nodes of the elements that the points of lines lie
!> in, on the mesh and on that of elements half as large
module axijoint_analysis_core_watched_lines
   use axijoint_analysis_core_nodal_stress, only : number_values
   use axijoint_analysis_core_fields, only : nodal_stress_type, peak_type
   use axijoint_analysis_core_totals, only : largest, of_component
   use axijoint_analysis_core_watched_stress, only : watch_type, new_watch
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_fe_shape, only : shape_element
   use axijoint_model_mesh, only : mesh_type, max_element_nodes, n_nodes
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : line_point_type
   implicit none
   private
   public :: watched_lines_type, new_watched_lines, largest_on_lines, amplitude_on_lines

   !> Judged points of one line
   type :: on_line_type
      !> Values at the nodes of the element of each, 0 beyond these, and the shape functions there, shape (max_element_nodes, judged
      !> points)
      integer, allocatable :: values(:, :)
      real(wp), allocatable :: shape(:, :)
      !> How many points of it lie in elements
      integer :: n_points = 0
   end type on_line_type

   !> Values along all lines
   type :: watched_lines_type
      !> What is watched of the mesh and of the fine mesh: the same values
      type(watch_type) :: coarse, fine
      !> Those of each line
      type(on_line_type), allocatable :: lines(:)
   end type watched_lines_type

contains

   !> Watch the stresses along lines; points of elements at a node where stresses are infinite are not judged
   function new_watched_lines(model, fine, singular) result(watched)
      !> The job
      type(model_type), intent(in) :: model
      !> The fine mesh; the nodes of the mesh are its first
      type(mesh_type), intent(in) :: fine
      !> Nodes where stresses are infinite
      integer, intent(in) :: singular(:)
      !> What is watched
      type(watched_lines_type) :: watched

      type(nodal_stress_type) :: nodal
      type(line_point_type), allocatable :: judged(:)
      integer, allocatable :: number(:)
      logical, allocatable :: wanted(:)
      logical :: infinite(n_nodes(model%mesh))
      integer :: k, p, v

      call number_values(model%mesh, nodal)
      infinite = .false.
      infinite(singular) = .true.
      allocate (wanted(size(nodal%node)), source=.false.)
      allocate (watched%lines(size(model%lines)))
      do k = 1, size(model%lines)
         associate (points => model%lines(k)%points, line => watched%lines(k))
            judged = pack(points, [(.not. any(infinite(nodes_of(points(p)%element))), p=1, size(points))])
            line%n_points = size(points)
            allocate (line%values(max_element_nodes, size(judged)), line%shape(max_element_nodes, size(judged)))
            do p = 1, size(judged)
               line%values(:, p) = nodal%value_of(:, judged(p)%element)
               line%shape(:, p) = shape_at(model%mesh, judged(p))
               wanted(pack(line%values(:, p), line%values(:, p) > 0)) = .true.
            end do
         end associate
      end do
      allocate (number(0:size(wanted)), source=0)
      number(pack([(v, v=1, size(wanted))], wanted)) = [(v, v=1, count(wanted))]
      do k = 1, size(watched%lines)
         do p = 1, size(watched%lines(k)%values, 2)
            watched%lines(k)%values(:, p) = number(watched%lines(k)%values(:, p))
         end do
      end do
      watched%coarse = new_watch(model%mesh, pack(nodal%node, wanted), pack(nodal%material, wanted))
      watched%fine = new_watch(fine, watched%coarse%node, watched%coarse%material)

   contains

      !> Nodes of an element
      pure function nodes_of(element) result(nodes)
         !> The element
         integer, intent(in) :: element
         !> The nodes
         integer, allocatable :: nodes(:)

         nodes = model%mesh%element_nodes(:model%mesh%element_size(element), element)
      end function nodes_of

   end function new_watched_lines

   !> Shape functions at a point
   pure function shape_at(mesh, point) result(shape)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The point
      type(line_point_type), intent(in) :: point
      !> Zero beyond the nodes of its element
      real(wp) :: shape(max_element_nodes)

      real(wp) :: derivative(2, max_element_nodes)
      integer :: n

      n = mesh%element_size(point%element)
      shape = 0.0_wp
      call shape_element(n, point%natural(1), point%natural(2), shape(:n), derivative(:, :n))
   end function shape_at

   !> Stresses at the judged points of a line
   pure function stress_at_points(line, values) result(stress)
      !> The line
      type(on_line_type), intent(in) :: line
      !> Amplitudes, shape (6, values, modes)
      real(wp), intent(in) :: values(:, :, :)
      !> Amplitudes, shape (6, judged points, modes)
      real(wp), allocatable :: stress(:, :, :)

      integer :: i, p

      allocate (stress(6, size(line%values, 2), size(values, 3)), source=0.0_wp)
      do p = 1, size(stress, 2)
         do i = 1, max_element_nodes
            if (line%values(i, p) == 0) cycle
            stress(:, p, :) = stress(:, p, :) + line%shape(i, p)*values(:, line%values(i, p), :)
         end do
      end do
   end function stress_at_points

   !> Largest of the six stresses along each line, anywhere round the circle
   pure function largest_on_lines(watched, modes, values) result(found)
      !> What is watched
      type(watched_lines_type), intent(in) :: watched
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes, shape (6, values, modes)
      real(wp), intent(in) :: values(:, :, :)
      !> Shape (lines) [stress]; negative where no point is judged
      real(wp) :: found(size(watched%lines))

      !> Two stresses that go with the radial displacement and one that goes with the circumferential one
      integer, parameter :: first(3) = [1, 2, 5], second(3) = [3, 4, 6]
      type(peak_type) :: peaks(2)
      real(wp), allocatable :: stress(:, :, :)
      integer :: k

      found = -1.0_wp
      do k = 1, size(watched%lines)
         stress = stress_at_points(watched%lines(k), values)
         if (size(stress, 2) == 0) cycle
         peaks = [largest(modes, stress(first, :, :), of_component), largest(modes, stress(second, :, :), of_component)]
         found(k) = max(0.0_wp, maxval(peaks%value))
      end do
   end function largest_on_lines

   !> Largest amplitude of each stress along each line in each mode
   pure function amplitude_on_lines(watched, values) result(found)
      !> What is watched
      type(watched_lines_type), intent(in) :: watched
      !> Amplitudes, shape (6, values, modes)
      real(wp), intent(in) :: values(:, :, :)
      !> Shape (modes, 6, lines) [stress]
      real(wp) :: found(size(values, 3), 6, size(watched%lines))

      real(wp), allocatable :: stress(:, :, :)
      integer :: i, j, k

      do k = 1, size(watched%lines)
         stress = stress_at_points(watched%lines(k), values)
         do j = 1, size(values, 3)
            found(j, :, k) = [(maxval([0.0_wp, abs(stress(i, :, j))]), i=1, 6)]
         end do
      end do
   end function amplitude_on_lines

end module axijoint_analysis_core_watched_lines
