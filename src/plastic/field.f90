!> State of bodies that yield on all planes, and what it leaves out of balance
module axijoint_plastic_field
   use axijoint_assembly_equations, only : equations_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : elastic_strain
   use axijoint_element_yield_stress, only : admit_solid, admit_stress, holds_for_sure, &
      root_j2
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_planes, only : planes_type, new_planes, synthesize, analyse, plane_weights
   use axijoint_plastic_bodies, only : bodies_type, elastic_stress, add_stress_force
   use axijoint_plastic_elastic, only : n_unknowns, to_vector, to_nodes, stiff_force
   implicit none
   private
   public :: body_field_type, body_load_type, body_planes, new_body_field, no_body_load, evaluate, &
      linearize, &
      yielding_force, elastic_force, excess_force, commit

   !> Components that are odd in theta in a symmetric mode: r-theta and z-theta
   logical, parameter :: odd_components(6) = [.false., .false., .false., .false., .true., .true.]

   !> Points times planes from which on the laws are worth threads
   integer, parameter :: worth_threads = 500

   !> Loads
   type :: body_load_type
      !> Forces on the unknowns of all modes
      real(wp), allocatable :: right(:)
      !> Displacements of held components, shape (3, nodes, modes); not allocated if there are none
      real(wp), allocatable :: held(:, :, :)
      !> Stress without strain, amplitudes, shape (6, points, modes)
      real(wp), allocatable :: initial(:, :, :)
   end type body_load_type

   !> The state
   type :: body_field_type
      !> Unknown displacements of all modes; those at the last increment in equilibrium, and what it
      !> changed of them
      real(wp), allocatable :: unknowns(:), begun(:), moved(:)
      !> Forces on the unknowns at the last increment in equilibrium, and what it changed of them
      real(wp), allocatable :: right(:), pushed(:)
      !> Elastic stress that plastic strain has taken, and plastic strain that has hardened, both at
      !> the last increment in equilibrium, shapes (6, points, planes) and (points, planes)
      real(wp), allocatable :: taken(:, :, :), gained(:, :)
      !> Whether a point has yielded in an increment in equilibrium
      logical, allocatable :: marked(:)
      !> Points that planes are needed for now: others cannot yield
      integer, allocatable :: on(:)
      !> Stress, elastic stress less stress, and growth of plastic strain that hardens at these
      !> points, shapes (6, on, planes) and (on, planes)
      real(wp), allocatable :: stress(:, :, :), excess(:, :, :), growth(:, :)
      !> Which points yield on any plane now, shape (points)
      logical, allocatable :: yields(:)
      !> Their places among all, and derivatives of their excess by the elastic stress, shape
      !> (6, 6, active, planes); up to date after `linearize`
      integer, allocatable :: active(:)
      real(wp), allocatable :: slope(:, :, :, :)
      !> Amplitudes of the elastic stress, of the excess, and of the excess that the displacements of
      !> an equilibrium follow from, shape (6, points, modes)
      real(wp), allocatable :: elastic(:, :, :), amplitude(:, :, :), carried(:, :, :)
      !> Forces of the bodies on components, held ones too, now and at the last increment in
      !> equilibrium, shape (3, nodes, modes)
      real(wp), allocatable :: force(:, :, :), force_before(:, :, :)
      !> Amplitudes of the elastic stress there, shape (6, points, modes)
      real(wp), allocatable :: elastic_before(:, :, :)
      !> What residuals were held against there
      real(wp) :: scale = 0.0_wp
      !> Work that plastic strain has dissipated up to there [force length]
      real(wp) :: dissipated = 0.0_wp
   end type body_field_type

contains

   !> Planes for bodies: 2 M + 1 from 0 to pi unless said. M + 2 are almost singular, so harmonics
   !> up to 1 take five
   pure function body_planes(modes, n) result(planes)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Number of planes
      integer, intent(in), optional :: n
      !> The planes
      type(planes_type) :: planes

      integer :: number

      number = 2*max(2, maxval(modes%harmonic)) + 1
      if (present(n)) number = n
      planes = new_planes(number, modes, odd=odd_components)
   end function body_planes

   !> Bodies without plastic strain
   pure function new_body_field(equations, bodies, planes) result(field)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The state
      type(body_field_type) :: field

      associate (n => size(bodies%laws), n_planes => size(planes%angle), &
                 n_modes => size(equations%modes), dofs => equations%classes(1)%dofs)
         allocate (field%unknowns(n_unknowns(equations)), source=0.0_wp)
         field%begun = field%unknowns
         field%moved = field%unknowns
         field%right = field%unknowns
         field%pushed = field%unknowns
         allocate (field%force(3, size(dofs%equation, 2), n_modes), source=0.0_wp)
         field%force_before = field%force
         allocate (field%taken(6, n, n_planes), field%amplitude(6, n, n_modes), source=0.0_wp)
         allocate (field%elastic, field%carried, field%elastic_before, source=field%amplitude)
         allocate (field%gained(n, n_planes), source=0.0_wp)
         allocate (field%marked(n), field%yields(n), source=.false.)
         allocate (field%on(0))
      end associate
   end function new_body_field

   !> No loads
   pure function no_body_load(equations, bodies) result(load)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The loads
      type(body_load_type) :: load

      allocate (load%right(n_unknowns(equations)), source=0.0_wp)
      allocate (load%initial(6, size(bodies%laws), size(equations%modes)), source=0.0_wp)
   end function no_body_load

   !> Let the laws admit the stress of the unknowns, and find what is out of balance then:
   !> r = f - K u + sum of c_m B^T q, where q = elastic stress - stress
   subroutine evaluate(equations, bodies, planes, load, field, residual)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The loads
      type(body_load_type), intent(in) :: load
      !> The state; stresses follow its unknowns
      type(body_field_type), intent(inout) :: field
      !> Forces on the unknowns out of balance
      real(wp), intent(out) :: residual(:)

      real(wp), allocatable :: displacement(:, :)
      logical, allocatable :: all_points(:)
      integer :: k

      allocate (all_points(size(bodies%laws)), source=.true.)
      do k = 1, size(equations%modes)
         displacement = to_nodes(equations, field%unknowns, k)
         if (allocated(load%held)) displacement = displacement + load%held(:, :, k)
         call elastic_stress(bodies, equations%modes(k)%harmonic, displacement, all_points, &
                             field%elastic(:, :, k))
      end do
      field%elastic = field%elastic + load%initial
      field%on = points_on_planes(bodies, equations%modes, field%elastic, &
         field%marked)
      call admit_on_planes(bodies, planes, field)
      residual = load%right - stiff_force(equations, field%unknowns) &
         + to_vector(equations, force_of(equations, bodies, field%amplitude, field%yields))
      field%force = force_of(equations, bodies, field%elastic - field%amplitude, all_points)
   end subroutine evaluate

   !> Points that may yield: those that have, and those where a bound of the sum of the harmonics
   !> reaches the criterion
   pure function points_on_planes(bodies, modes, elastic, marked) result(on)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Amplitudes of the elastic stress, shape (6, points, modes)
      real(wp), intent(in) :: elastic(:, :, :)
      !> Points that have yielded
      logical, intent(in) :: marked(:)
      !> Their places
      integer, allocatable :: on(:)

      real(wp) :: root, mean, even(6), uneven(6)
      logical :: may(size(marked))
      integer :: i, k

      do i = 1, size(marked)
         root = 0.0_wp
         mean = 0.0_wp
         do k = 1, size(modes)  ! even and odd components are largest at different angles
            even = merge(0.0_wp, elastic(:, i, k), odd_components)
            uneven = elastic(:, i, k) - even
            root = root + max(root_j2(even), root_j2(uneven))
            associate (p => sum(even(1:3))/3.0_wp)
               mean = mean + merge(p, abs(p), modes(k)%harmonic == 0)
            end associate
         end do
         may(i) = marked(i)
         if (.not. may(i)) may(i) = .not. holds_for_sure(bodies%laws(i), root, mean)
      end do
      on = pack([(i, i=1, size(marked))], may)
   end function points_on_planes

   !> Stress that is admitted on the planes
   subroutine admit_on_planes(bodies, planes, field)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The state, with its elastic stress
      type(body_field_type), intent(inout) :: field

      real(wp), allocatable :: total(:, :, :)
      integer :: n, i, j, p

      total = synthesize(planes, field%elastic(:, field%on, :))
      n = size(field%on)
      if (allocated(field%stress)) deallocate (field%stress, field%excess, field%growth)
      associate (n_planes => size(planes%angle))
         allocate (field%stress(6, n, n_planes), field%excess(6, n, n_planes), &
            field%growth(n, n_planes))
         !$omp parallel do schedule(static) private(j, p) if (n*n_planes > worth_threads)
         do i = 1, n
            p = field%on(i)
            do j = 1, n_planes
               call admit_stress(bodies%laws(p), field%gained(p, j), &
                  total(:, i, j) - field%taken(:, p, j), field%stress(:, i, j), field%growth(i, j))
               field%excess(:, i, j) = total(:, i, j) - field%stress(:, i, j)
            end do
         end do
         !$omp end parallel do
      end associate
      field%amplitude = 0.0_wp
      field%amplitude(:, field%on, :) = analyse(planes, field%excess)
      field%yields = .false.
      do i = 1, n
         field%yields(field%on(i)) = any(abs(field%excess(:, i, :)) > 0.0_wp)
      end do
   end subroutine admit_on_planes

   !> Find the derivatives of the excess where points yield: only Newton's method asks for them
   subroutine linearize(bodies, planes, field)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The state, evaluated
      type(body_field_type), intent(inout) :: field

      real(wp), allocatable :: total(:, :, :)
      real(wp) :: stress(6), growth
      integer :: i, j, p

      field%active = pack([(i, i=1, size(field%yields))], field%yields)
      total = synthesize(planes, field%elastic(:, field%active, :))
      if (allocated(field%slope)) deallocate (field%slope)
      associate (n => size(field%active), n_planes => size(planes%angle))
         allocate (field%slope(6, 6, n, n_planes))
         !$omp parallel do schedule(static) private(j, p, stress, growth) &
         !$omp if (n*n_planes > worth_threads)
         do i = 1, n
            p = field%active(i)
            do j = 1, n_planes
               call admit_solid(bodies%laws(p), field%gained(p, j), &
                  total(:, i, j) - field%taken(:, p, j), stress, field%slope(:, :, i, j), growth)
               field%slope(:, :, i, j) = identity() - field%slope(:, :, i, j)
            end do
         end do
         !$omp end parallel do
      end associate
   end subroutine linearize

   !> Unit matrix
   pure function identity() result(one)
      !> The matrix
      real(wp) :: one(6, 6)

      integer :: i

      one = 0.0_wp
      do i = 1, 6
         one(i, i) = 1.0_wp
      end do
   end function identity

   !> Forces that stress amplitudes of all modes give
   function force_of(equations, bodies, amplitude, present) result(force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Amplitudes, shape (6, points, modes)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> Points that have any
      logical, intent(in) :: present(:)
      !> On components, shape (3, nodes, modes)
      real(wp), allocatable :: force(:, :, :)

      integer :: k

      associate (dofs => equations%classes(1)%dofs)
         allocate (force(3, size(dofs%equation, 2), size(equations%modes)), source=0.0_wp)
      end associate
      do k = 1, size(equations%modes)
         call add_stress_force(bodies, equations%modes(k)%harmonic, amplitude(:, :, k), present, &
                               force(:, :, k))
      end do
   end function force_of

   !> Forces on the unknowns of all modes that amplitudes of excess stress give
   function excess_force(equations, bodies, amplitude) result(force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Amplitudes, shape (6, points, modes)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> The forces
      real(wp), allocatable :: force(:)

      logical :: present(size(amplitude, 2))

      present = any(any(abs(amplitude) > 0.0_wp, 3), 1)
      force = to_vector(equations, force_of(equations, bodies, amplitude, present))
   end function excess_force

   !> What a small displacement changes of the forces of the excess: the tangent of the structure is
   !> K less this
   subroutine yielding_force(equations, bodies, planes, field, direction, force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The state, linearized
      type(body_field_type), intent(in) :: field
      !> Unknowns of the displacement
      real(wp), intent(in) :: direction(:)
      !> The forces
      real(wp), intent(out) :: force(:)

      real(wp), allocatable :: amplitude(:, :, :), total(:, :, :), displacement(:, :)
      integer :: i, j, k

      allocate (amplitude, mold=field%amplitude)
      do k = 1, size(equations%modes)
         displacement = to_nodes(equations, direction, k)
         call elastic_stress(bodies, equations%modes(k)%harmonic, displacement, field%yields, &
                             amplitude(:, :, k))
      end do
      associate (points => field%active)
         total = synthesize(planes, amplitude(:, points, :))
         do j = 1, size(total, 3)
            do i = 1, size(points)
               total(:, i, j) = matmul(field%slope(:, :, i, j), total(:, i, j))
            end do
         end do
         amplitude(:, points, :) = analyse(planes, total)
      end associate
      force = to_vector(equations, force_of(equations, bodies, amplitude, field%yields))
   end subroutine yielding_force

   !> Forces on the unknowns of all modes that displacements would give if the bodies held
   function elastic_force(equations, bodies, displacement) result(force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Unknowns of the displacements
      real(wp), intent(in) :: displacement(:)
      !> The forces
      real(wp), allocatable :: force(:)

      real(wp), allocatable :: amplitude(:, :, :), nodal(:, :)
      logical, allocatable :: all_points(:)
      integer :: k

      allocate (amplitude(6, size(bodies%laws), size(equations%modes)))
      allocate (all_points(size(bodies%laws)), source=.true.)
      do k = 1, size(equations%modes)
         nodal = to_nodes(equations, displacement, k)
         call elastic_stress(bodies, equations%modes(k)%harmonic, nodal, all_points, &
                             amplitude(:, :, k))
      end do
      force = to_vector(equations, force_of(equations, bodies, amplitude, all_points))
   end function elastic_force

   !> Keep the plastic strain of an increment in equilibrium
   subroutine commit(bodies, planes, load, field)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The loads
      type(body_load_type), intent(in) :: load
      !> The state, evaluated
      type(body_field_type), intent(inout) :: field

      integer :: i

      field%dissipated = field%dissipated + dissipation(bodies, planes, field)
      do i = 1, size(field%on)
         associate (p => field%on(i))
            field%taken(:, p, :) = field%excess(:, i, :)
            field%gained(p, :) = field%gained(p, :) + field%growth(i, :)
            field%marked(p) = field%marked(p) .or. any(abs(field%excess(:, i, :)) > 0.0_wp)
         end associate
      end do
      field%force_before = field%force
      field%elastic_before = field%elastic
      field%moved = field%unknowns - field%begun
      field%begun = field%unknowns
      field%pushed = load%right - field%right
      field%right = load%right
   end subroutine commit

   !> Work of the stress on the plastic strain of an increment, by the mean of the stresses at its
   !> ends: what is hardened by it is in it, too
   real(wp) function dissipation(bodies, planes, field) result(work)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The state, evaluated, not committed
      type(body_field_type), intent(in) :: field

      real(wp), allocatable :: before(:, :, :), weight(:)
      integer :: i, j

      work = 0.0_wp
      before = synthesize(planes, field%elastic_before(:, field%on, :))
      weight = plane_weights(planes)
      do j = 1, size(weight)
         do i = 1, size(field%on)
            associate (p => field%on(i))
               work = work + weight(j)*bodies%weight(p)*0.5_wp*dot_product( &
                  before(:, i, j) - field%taken(:, p, j) + field%stress(:, i, j), &
                  elastic_strain(bodies%laws(p), field%excess(:, i, j) - field%taken(:, p, j)))
            end associate
         end do
      end do
   end function dissipation

end module axijoint_plastic_field
