!> State of bodies that yield on all planes
module axijoint_plastic_field
   use axijoint_assembly_equations, only : equations_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : elastic_strain
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_planes, only : planes_type, new_planes, synthesize, plane_weights
   use axijoint_model_modes, only : greatest_divisor
   use axijoint_plastic_bodies, only : bodies_type
   use axijoint_plastic_elastic, only : n_unknowns
   implicit none
   private
   public :: body_field_type, body_load_type, body_planes, new_body_field, no_body_load, commit, &
      odd_components

   !> Components that are odd in theta in a symmetric mode: r-theta and z-theta
   logical, parameter :: odd_components(6) = [.false., .false., .false., .false., .true., .true.]

   !> An increment that changes displacements by less than this part of them holds them
   real(wp), parameter :: still = 1.0e-9_wp

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
      !> Unknown displacements of all modes; those at the last increment in equilibrium, and what the
      !> last that moved anything changed of them
      real(wp), allocatable :: unknowns(:), begun(:), moved(:)
      !> Forces on the unknowns at the last increment in equilibrium, and what the last that moved
      !> anything changed of them
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
      !> The same per volume, in the steps of the increment that is at work, or of the last that had
      !> any in equilibrium, shape (points, planes) [stress]; whether the next step is the first of
      !> an increment
      real(wp), allocatable :: dissipation(:, :)
      logical :: begins = .true.
      !> Whether steps go down the potential by limited-memory BFGS, as the job's method found one without equilibrium
      logical :: goes_down = .false.
   end type body_field_type

contains

   !> Planes for bodies: 2 M + 1 from 0 to pi unless said, M the highest harmonic there is. M + 2 are almost singular, so where
   !> that is 1, or the only one (all repeats g times round the circle), there are five on each half of what repeats
   pure function body_planes(modes, n) result(planes)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Number of planes; as usual if absent or 0
      integer, intent(in), optional :: n
      !> The planes
      type(planes_type) :: planes

      integer :: number, g, k

      g = 0
      do k = 1, size(modes)
         g = greatest_divisor(g, modes(k)%harmonic)
      end do
      number = 2*max(2, 2*g, maxval(modes%harmonic)) + 1
      if (present(n)) then
         if (n > 0) number = n
      end if
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
         allocate (field%gained(n, n_planes), field%dissipation(n, n_planes), source=0.0_wp)
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

      call dissipate(bodies, planes, field)
      do i = 1, size(field%on)
         associate (p => field%on(i))
            field%taken(:, p, :) = field%excess(:, i, :)
            field%gained(p, :) = field%gained(p, :) + field%growth(i, :)
            field%marked(p) = field%marked(p) .or. any(abs(field%excess(:, i, :)) > 0.0_wp)
         end associate
      end do
      field%force_before = field%force
      field%elastic_before = field%elastic
      if (any(abs(field%unknowns - field%begun) > still*maxval(abs(field%unknowns)))) then
         field%moved = field%unknowns - field%begun
         field%pushed = load%right - field%right
      end if
      field%begun = field%unknowns
      field%right = load%right
   end subroutine commit

   !> Add the work of the stress on the plastic strain of a step, by the mean of the stresses at its
   !> ends: what is hardened by it is in it, too
   subroutine dissipate(bodies, planes, field)
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> The planes
      type(planes_type), intent(in) :: planes
      !> The state, evaluated, not committed
      type(body_field_type), intent(inout) :: field

      real(wp), allocatable :: before(:, :, :), weight(:)
      real(wp) :: work
      integer :: i, j

      if (field%begins) field%dissipation = 0.0_wp
      field%begins = .false.
      before = synthesize(planes, field%elastic_before(:, field%on, :))
      weight = plane_weights(planes)
      do j = 1, size(weight)
         do i = 1, size(field%on)
            associate (p => field%on(i))
               work = 0.5_wp*dot_product(before(:, i, j) - field%taken(:, p, j) + field%stress(:, i, j), &
                  elastic_strain(bodies%laws(p), field%excess(:, i, j) - field%taken(:, p, j)))
               field%dissipation(p, j) = field%dissipation(p, j) + work
               field%dissipated = field%dissipated + weight(j)*bodies%weight(p)*work
            end associate
         end do
      end do
   end subroutine dissipate

end module axijoint_plastic_field
