!> What a state of bodies that yield leaves out of balance, and what small displacements change of it
module axijoint_plastic_residual
   use axijoint_assembly_equations, only : equations_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_stress, only : admit_solid, admit_stress, holds_for_sure, root_j2
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_planes, only : planes_type, synthesize, analyse
   use axijoint_plastic_bodies, only : bodies_type, elastic_stress, add_stress_force
   use axijoint_plastic_elastic, only : to_vector, to_nodes, stiff_force
   use axijoint_plastic_field, only : body_field_type, body_load_type, odd_components
   implicit none
   private
   public :: evaluate, linearize, yielding_force, elastic_force, excess_force

   !> Points times planes, or values, from which on the laws are worth threads
   integer, parameter :: worth_threads = 500

contains

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

      field%elastic = stress_of(equations, bodies, field%unknowns, load%held) + load%initial
      field%on = points_on_planes(bodies, equations%modes, field%elastic, &
         field%marked)
      call admit_on_planes(bodies, planes, field)
      residual = load%right - stiff_force(equations, field%unknowns) &
         + excess_force(equations, bodies, field%amplitude)
      field%force = force_of(equations, bodies, field%elastic - field%amplitude)
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

   !> Stress amplitudes of all modes that displacements would give if the bodies held
   function stress_of(equations, bodies, vector, held, wanted) result(stress)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Unknowns of the displacements
      real(wp), intent(in) :: vector(:)
      !> Displacements of held components, shape (3, nodes, modes); zero if absent
      real(wp), intent(in), optional :: held(:, :, :)
      !> Points whose stress is wanted; all if absent
      logical, intent(in), optional :: wanted(:)
      !> Shape (6, points, modes); zero where it is not wanted
      real(wp), allocatable :: stress(:, :, :)

      logical :: these(size(bodies%laws))
      real(wp), allocatable :: displacement(:, :)
      integer :: k

      these = .true.
      if (present(wanted)) these = wanted
      allocate (stress(6, size(bodies%laws), size(equations%modes)))
      !$omp parallel do schedule(dynamic) private(displacement) &
      !$omp if (size(stress) > worth_threads)
      do k = 1, size(equations%modes)
         displacement = to_nodes(equations, vector, k)
         if (present(held)) displacement = displacement + held(:, :, k)
         call elastic_stress(bodies, equations%modes(k)%harmonic, displacement, these, &
                             stress(:, :, k))
      end do
      !$omp end parallel do
   end function stress_of

   !> Forces that stress amplitudes of all modes give
   function force_of(equations, bodies, amplitude) result(force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The bodies
      type(bodies_type), intent(in) :: bodies
      !> Amplitudes, shape (6, points, modes)
      real(wp), intent(in) :: amplitude(:, :, :)
      !> On components, shape (3, nodes, modes)
      real(wp), allocatable :: force(:, :, :)

      logical :: present(size(amplitude, 2))
      integer :: k

      present = any(any(abs(amplitude) > 0.0_wp, 3), 1)
      associate (dofs => equations%classes(1)%dofs)
         allocate (force(3, size(dofs%equation, 2), size(equations%modes)), source=0.0_wp)
      end associate
      !$omp parallel do schedule(dynamic) if (size(amplitude) > worth_threads)
      do k = 1, size(equations%modes)
         call add_stress_force(bodies, equations%modes(k)%harmonic, amplitude(:, :, k), present, &
                               force(:, :, k))
      end do
      !$omp end parallel do
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

      force = to_vector(equations, force_of(equations, bodies, amplitude))
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

      real(wp), allocatable :: amplitude(:, :, :), total(:, :, :)
      integer :: i, j

      amplitude = stress_of(equations, bodies, direction, wanted=field%yields)
      associate (points => field%active)
         total = synthesize(planes, amplitude(:, points, :))
         do j = 1, size(total, 3)
            do i = 1, size(points)
               total(:, i, j) = matmul(field%slope(:, :, i, j), total(:, i, j))
            end do
         end do
         amplitude(:, points, :) = analyse(planes, total)
      end associate
      force = excess_force(equations, bodies, amplitude)
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

      force = to_vector(equations, force_of(equations, bodies, &
         stress_of(equations, bodies, displacement)))
   end function elastic_force

end module axijoint_plastic_residual
