!> Forces on nodal circles that follow each other along a face: tractions that some other program,
!> or the user, has put on the nodes. On a finer mesh they are tractions again
module axijoint_analysis_fine_line_loads
   use axijoint_analysis_fine_mesh, only : fine_mesh_type, n_on
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_fe_mode, only : same_mode
   use axijoint_fe_quadrature, only : gauss_rule
   use axijoint_fe_shape, only : shape_line
   use axijoint_model_load, only : edge_load_type, ring_load_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: spread_line_loads

   !> Edges that meet at a smaller cosine of the angle between them have a corner, where tractions
   !> jump
   real(wp), parameter :: straight = 0.9_wp
   !> Tolerance of the tractions, most steps to them, and rounds over the values at corners, each of
   !> which halves their error at least
   real(wp), parameter :: tolerance = 1.0e-12_wp
   integer, parameter :: most_steps = 200, n_rounds = 30

   !> An edge all of whose nodes are loaded
   type :: loaded_edge_type
      !> Its nodes, first, last and middle or 0
      integer :: n = 0, nodes(3) = 0
      !> Numbers of the tractions at its nodes
      integer :: value(3) = 0
      !> Integral of the products of its shape functions, r ds
      real(wp) :: mass(3, 3) = 0.0_wp
   end type loaded_edge_type

contains

   !> Divide the forces on nodal circles into tractions on outer edges and what is left to single
   !> nodes
   subroutine spread_line_loads(model, fine, edge_loads, ring_loads)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Tractions on edges of its mesh
      type(edge_load_type), allocatable, intent(out) :: edge_loads(:)
      !> Forces on single nodes
      type(ring_load_type), allocatable, intent(out) :: ring_loads(:)

      logical :: done(size(model%ring_loads)), loaded(n_nodes(model%mesh))
      real(wp) :: force(3, n_nodes(model%mesh))
      integer :: first, k

      allocate (edge_loads(0), ring_loads(0))
      done = .false.
      do first = 1, size(done)
         if (done(first)) cycle
         force = 0.0_wp
         loaded = .false.
         do k = first, size(done)
            associate (load => model%ring_loads(k), other => model%ring_loads(first))
               if (load%case /= other%case .or. .not. same_mode(load%mode, other%mode)) cycle
               force(:, load%node) = force(:, load%node) + load%force
               loaded(load%node) = .true.
               done(k) = .true.
            end associate
         end do
         call spread(model, fine, model%ring_loads(first), loaded, force, edge_loads, ring_loads)
      end do
   end subroutine spread_line_loads

   !> The same for the forces of one mode and load case
   subroutine spread(model, fine, like, loaded, force, edge_loads, ring_loads)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> One of the forces
      type(ring_load_type), intent(in) :: like
      !> Whether a node is loaded
      logical, intent(in) :: loaded(:)
      !> The forces, shape (3, nodes)
      real(wp), intent(inout) :: force(:, :)
      !> Tractions and forces, to be continued
      type(edge_load_type), allocatable, intent(inout) :: edge_loads(:)
      type(ring_load_type), allocatable, intent(inout) :: ring_loads(:)

      type(loaded_edge_type), allocatable :: edges(:)
      type(edge_load_type) :: load
      real(wp), allocatable :: traction(:, :)
      logical, allocatable :: at_corner(:)
      integer :: k

      edges = loaded_edges(model, fine, loaded)
      call number_values(model, loaded, edges, at_corner)
      call find_traction(edges, at_corner, force/circle_integral(like%mode%harmonic), traction)
      do k = 1, size(edges)
         associate (n => edges(k)%n, nodes => edges(k)%nodes(:edges(k)%n))
            load = edge_load_type(mode=like%mode, case=like%case, nodes=edges(k)%nodes)
            load%traction(:, :n) = traction(:, edges(k)%value(:n))
            edge_loads = [edge_loads, load]
            force(:, nodes) = force(:, nodes) - circle_integral(like%mode%harmonic) &
                              *matmul(load%traction(:, :n), edges(k)%mass(:n, :n))
         end associate
      end do
      do k = 1, size(loaded)
         if (loaded(k)) &
            ring_loads = [ring_loads, ring_load_type(like%mode, like%case, k, force(:, k))]
      end do
   end subroutine spread

   !> Outer edges all of whose nodes are loaded, and those that go on from them to a node that is
   !> held and so needs no force; edges on the axis have no area
   function loaded_edges(model, fine, loaded) result(edges)
      !> The job
      type(model_type), intent(in) :: model
      !> Edges of its mesh
      type(fine_mesh_type), intent(in) :: fine
      !> Whether a node is loaded
      logical, intent(in) :: loaded(:)
      !> The edges
      type(loaded_edge_type), allocatable :: edges(:)

      logical :: in_line(size(loaded)), held(size(loaded))
      logical, dimension(size(fine%edges)) :: outer, wanted
      integer :: k

      held = any(model%fixed, 1) .and. .not. loaded
      in_line = .false.
      do k = 1, size(fine%edges)
         associate (nodes => fine%edges(k)%nodes(:n_on(fine%edges(k))))
            outer(k) = fine%edges(k)%elements(2) == 0 .and. &
               any(model%mesh%coordinates(1, nodes) > 0.0_wp)
            wanted(k) = outer(k) .and. all(loaded(nodes))
            if (wanted(k)) in_line(nodes) = .true.
         end associate
      end do
      do k = 1, size(fine%edges)
         associate (nodes => fine%edges(k)%nodes(:n_on(fine%edges(k))))
            if (outer(k) .and. any(in_line(nodes(:2)))) then
               wanted(k) = all(loaded(nodes) .or. held(nodes))
            end if
         end associate
      end do
      edges = [(new_loaded_edge(model, fine%edges(k)%nodes), k=1, size(wanted))]
      edges = pack(edges, wanted)
   end function loaded_edges

   !> A loaded edge
   function new_loaded_edge(model, nodes) result(edge)
      !> The job
      type(model_type), intent(in) :: model
      !> Its nodes
      integer, intent(in) :: nodes(3)
      !> The edge
      type(loaded_edge_type) :: edge

      real(wp) :: x(3), w(3), shape(3), derivative(3), weight
      integer :: i, j, n

      n = count(nodes > 0)
      edge = loaded_edge_type(n=n, nodes=nodes)
      call gauss_rule(3, x, w)
      associate (place => model%mesh%coordinates(:, nodes(:n)))
         do i = 1, 3
            call shape_line(n, x(i), shape(:n), derivative(:n))
            weight = w(i)*dot_product(place(1, :), shape(:n))*norm2(matmul(place, derivative(:n)))
            do j = 1, n
               edge%mass(:n, j) = edge%mass(:n, j) + weight*shape(:n)*shape(j)
            end do
         end do
      end associate
   end function new_loaded_edge

   !> Number the tractions: edges share that of a node, but at a corner, at a node that is held and
   !> on the axis, where the components of a force are one, each has its own
   subroutine number_values(model, loaded, edges, at_corner)
      !> The job
      type(model_type), intent(in) :: model
      !> Whether the force of a node is known
      logical, intent(in) :: loaded(:)
      !> The edges
      type(loaded_edge_type), intent(inout) :: edges(:)
      !> Whether a traction is that of one side of a corner
      logical, allocatable, intent(out) :: at_corner(:)

      integer :: touch(2, n_nodes(model%mesh)), count(n_nodes(model%mesh)), &
         number(n_nodes(model%mesh))
      integer :: k, i, n
      logical :: corner

      touch = 0
      count = 0
      do k = 1, size(edges)
         do i = 1, 2
            associate (node => edges(k)%nodes(i))
               count(node) = count(node) + 1
               if (count(node) <= 2) touch(count(node), node) = k
            end associate
         end do
      end do
      number = 0
      n = 0
      allocate (at_corner(3*size(edges)), source=.false.)
      do k = 1, size(edges)
         do i = 1, edges(k)%n
            associate (node => edges(k)%nodes(i))
               corner = count(node) > 2 .or. .not. (loaded(node) &
                  .and. model%mesh%coordinates(1, node) > 0.0_wp)
               if (count(node) == 2) corner = abs(cosine(touch(1, node), touch(2, node))) < straight
               if (number(node) == 0 .or. corner) then
                  n = n + 1
                  number(node) = n
                  at_corner(n) = corner
               end if
               edges(k)%value(i) = number(node)
            end associate
         end do
      end do
      at_corner = at_corner(:n)

   contains

      !> Cosine of the angle between two edges
      pure real(wp) function cosine(a, b)
         !> The edges
         integer, intent(in) :: a, b

         associate (x => model%mesh%coordinates)
            associate (s => x(:, edges(a)%nodes(2)) - x(:, edges(a)%nodes(1)), &
                       t => x(:, edges(b)%nodes(2)) - x(:, edges(b)%nodes(1)))
               cosine = dot_product(s, t)/(norm2(s)*norm2(t))
            end associate
         end associate
      end function cosine

   end subroutine number_values

   !> The tractions whose nodal forces are given. On the sides of a corner, whose force has one
   !> number, the tractions are those that follow from their course along the edge
   subroutine find_traction(edges, at_corner, force, traction)
      !> The edges
      type(loaded_edge_type), intent(in) :: edges(:)
      !> Whether a traction is that of one side of a corner
      logical, intent(in) :: at_corner(:)
      !> Forces on nodes over c_m, shape (3, nodes); what is not on the edges does not count
      real(wp), intent(in) :: force(:, :)
      !> The tractions, shape (3, values)
      real(wp), allocatable, intent(out) :: traction(:, :)

      real(wp), allocatable :: right(:, :)
      integer :: k, i, round

      allocate (traction(3, size(at_corner)), source=0.0_wp)
      allocate (right(3, size(at_corner)), source=0.0_wp)
      do k = 1, size(edges)
         do i = 1, edges(k)%n
            right(:, edges(k)%value(i)) = force(:, edges(k)%nodes(i))
         end do
      end do
      do round = 1, merge(n_rounds, 1, any(at_corner))
         call solve_masses(edges, at_corner, right, traction)
         do k = 1, size(edges)
            do i = 1, 2
               associate (value => edges(k)%value(i))  ! half the way: whole ones would swing
                  if (at_corner(value)) &
                     traction(:, value) = 0.5_wp*(traction(:, value) + from_course(k, i))
               end associate
            end do
         end do
      end do

   contains

      !> Traction at an end of an edge from those that follow, a straight line or a parabola, as far
      !> as the next edge goes on from this one
      function from_course(edge, end) result(value)
         !> The edge, and its end
         integer, intent(in) :: edge, end
         !> The traction
         real(wp) :: value(3)

         integer :: next

         associate (t => traction, own => edges(edge)%value, other => edges(edge)%value(3 - end))
            do next = 1, size(edges)
               if (next /= edge .and. any(edges(next)%value(:2) == other)) exit
            end do
            value = t(:, other)
            if (next > size(edges)) then
               if (edges(edge)%n == 3) value = 2.0_wp*t(:, own(3)) - t(:, other)
            else if (edges(edge)%n == 3) then
               value = 3.0_wp*(t(:, own(3)) - t(:, other)) + t(:, edges(next)%value(3))
            else
               value = 2.0_wp*t(:, other) - t(:, sum(edges(next)%value(:2)) - other)
            end if
         end associate
      end function from_course

   end subroutine find_traction

   !> Tractions that are not on corners, from the forces of their nodes, by conjugate gradients
   subroutine solve_masses(edges, fixed, right, traction)
      !> The edges
      type(loaded_edge_type), intent(in) :: edges(:)
      !> Whether a traction is given
      logical, intent(in) :: fixed(:)
      !> Forces over c_m, shape (3, values)
      real(wp), intent(in) :: right(:, :)
      !> The tractions, same shape
      real(wp), intent(inout) :: traction(:, :)

      real(wp), dimension(3, size(fixed)) :: r, p, q, diagonal
      real(wp) :: rz, before, goal
      integer :: k, i, step

      diagonal = 0.0_wp
      do k = 1, size(edges)
         do i = 1, edges(k)%n
            diagonal(:, edges(k)%value(i)) = diagonal(:, edges(k)%value(i)) + edges(k)%mass(i, i)
         end do
      end do
      r = right - product_of(traction)
      r(:, pack([(k, k=1, size(fixed))], fixed)) = 0.0_wp
      p = 0.0_wp
      before = 1.0_wp
      goal = tolerance**2*sum(right**2/diagonal)
      do step = 1, most_steps
         rz = sum(r**2/diagonal)
         if (rz <= goal) exit
         p = r/diagonal + rz/before*p
         before = rz
         q = product_of(p)
         q(:, pack([(k, k=1, size(fixed))], fixed)) = 0.0_wp
         traction = traction + rz/sum(p*q)*p
         r = r - rz/sum(p*q)*q
      end do

   contains

      !> Forces of tractions
      function product_of(values) result(forces)
         !> Tractions
         real(wp), intent(in) :: values(:, :)
         !> Forces, same shape
         real(wp) :: forces(3, size(values, 2))

         integer :: k

         forces = 0.0_wp
         do k = 1, size(edges)
            associate (n => edges(k)%n, value => edges(k)%value(:edges(k)%n))
               forces(:, value) = forces(:, value) + matmul(values(:, value), edges(k)%mass(:n, :n))
            end associate
         end do
      end function product_of

   end subroutine solve_masses

end module axijoint_analysis_fine_line_loads
