!> What bodies that yield show of a state: plastic strain and yield margin at the Gauss points
module axijoint_analysis_core_plastic_fields
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : elastic_strain
   use axijoint_element_yield_margin, only : yield_margin, bearing
   use axijoint_element_yield_stress, only : root_j2
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_planes, only : planes_type, synthesize, plane_weights
   use axijoint_joints_residual, only : ratio
   use axijoint_joints_states, only : plastic_state_type
   use axijoint_model_model, only : model_type
   use axijoint_plastic_bodies, only : bodies_type, new_bodies
   use axijoint_plastic_field, only : body_planes
   use axijoint_plastic_record, only : on_all_points
   implicit none
   private
   public :: plastic_fields_type, plastic_fields, plastic_work

   !> The fields; nothing is allocated if no body can yield
   type :: plastic_fields_type
      !> Amplitudes of the plastic strain at all Gauss points, r, z, theta, rz, r-theta, z-theta,
      !> shear strains as in engineering, shape (6, points, modes)
      real(wp), allocatable :: amplitude(:, :, :)
      !> Angles of the planes on which the criteria are looked at [radian]
      real(wp), allocatable :: angles(:)
      !> Share of the strength that is left, 1 without shear, 0 at yield; 1 where nothing yields;
      !> and equivalent plastic strain, sqrt(2/3 e:e), shape (points, planes)
      real(wp), allocatable :: margin(:, :), equivalent(:, :)
      !> What of the criterion bears, places in `bearing_names`, shape (points, planes)
      integer, allocatable :: bearing(:, :)
      !> Work that plastic strain has dissipated per volume in the increment, shape (points, planes)
      !> [stress]
      real(wp), allocatable :: dissipation(:, :)
      !> Weights of all Gauss points in an integral over r and z, r included; zero where nothing can
      !> yield
      real(wp), allocatable :: weight(:)
      !> Stress and plastic strain of the points of bodies that can yield, shape
      !> (6, points of these, planes), and weights of these points and planes in an integral over
      !> the bodies
      real(wp), allocatable :: stress(:, :, :), strain(:, :, :), point_weight(:), plane_weight(:)
      !> Places of these points among all Gauss points
      integer, allocatable :: place(:)
      !> By how much sums of the harmonics are beside that stress at most, by the root of J2 over the largest of points that have
      !> yielded
      real(wp) :: beside = 0.0_wp
   end type plastic_fields_type

contains

   !> Find the fields of a state
   function plastic_fields(model, modes, stress, state) result(fields)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Stress amplitudes at all Gauss points, shape (6, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> What plastic strain takes
      type(plastic_state_type), intent(in) :: state
      !> The fields
      type(plastic_fields_type) :: fields

      type(planes_type) :: planes
      type(bodies_type) :: bodies
      real(wp), allocatable :: elastic(:, :, :), gained(:, :)
      integer :: own(size(stress, 2)), i, j, k

      if (.not. allocated(state%place)) return
      planes = body_planes(modes, model%n_body_planes)
      call new_bodies(model, (model%materials%yield), bodies)
      fields%angles = planes%angle
      fields%plane_weight = plane_weights(planes)
      fields%point_weight = bodies%weight
      fields%place = bodies%place
      own = 0
      own(bodies%place) = [(i, i=1, size(bodies%place))]
      associate (n => size(bodies%laws), n_planes => size(planes%angle))
         elastic = stress + on_all_points(state%place, state%amplitude, size(stress, 2))
         fields%stress = synthesize(planes, elastic(:, bodies%place, :))
         allocate (fields%strain(6, n, n_planes), gained(n, n_planes), source=0.0_wp)
         allocate (fields%amplitude, source=0.0_wp*stress)
         allocate (fields%margin(size(stress, 2), n_planes), source=1.0_wp)
         allocate (fields%equivalent(size(stress, 2), n_planes), source=0.0_wp)
         allocate (fields%weight(size(stress, 2)), source=0.0_wp)
         fields%weight(bodies%place) = bodies%weight
         allocate (fields%dissipation(size(stress, 2), n_planes), source=0.0_wp)
         fields%dissipation(state%place, :) = state%dissipation
         allocate (fields%bearing(size(stress, 2), n_planes), source=0)
         do i = 1, size(state%place)
            associate (p => own(state%place(i)))
               fields%stress(:, p, :) = fields%stress(:, p, :) - state%taken(:, i, :)
               gained(p, :) = state%gained(i, :)
               do j = 1, n_planes
                  fields%strain(:, p, j) = elastic_strain(bodies%laws(p), state%taken(:, i, j))
               end do
               do k = 1, size(modes)
                  fields%amplitude(:, state%place(i), k) = elastic_strain(bodies%laws(p), &
                     state%amplitude(:, i, k))
               end do
            end associate
         end do
         do j = 1, n_planes
            do i = 1, n
               associate (place => bodies%place(i))
                  fields%margin(place, j) = yield_margin(bodies%laws(i), gained(i, j), &
                     fields%stress(:, i, j))
                  fields%bearing(place, j) = bearing(bodies%laws(i), gained(i, j), &
                     fields%stress(:, i, j))
                  fields%equivalent(place, j) = equivalent(fields%strain(:, i, j))
               end associate
            end do
         end do
      end associate
      if (size(state%place) > 0) fields%beside = ratio(largest_shear(state%taken - synthesize(planes, state%amplitude)), &
         largest_shear(fields%stress(:, own(state%place), :)))
   end function plastic_fields

   !> Largest root of J2 of some stresses
   pure real(wp) function largest_shear(stress) result(largest)
      !> Stresses, shape (6, points, planes)
      real(wp), intent(in) :: stress(:, :, :)

      integer :: i, j

      largest = 0.0_wp
      do j = 1, size(stress, 3)
         do i = 1, size(stress, 2)
            largest = max(largest, root_j2(stress(:, i, j)))
         end do
      end do
   end function largest_shear

   !> Equivalent strain sqrt(2/3 e:e): in uniaxial tension of what keeps its volume, its strain
   pure real(wp) function equivalent(strain)
      !> r, z, theta, rz, r-theta, z-theta, shear strains as in engineering
      real(wp), intent(in) :: strain(6)

      equivalent = sqrt(2.0_wp/3.0_wp*(sum(strain(1:3)**2) + 0.5_wp*sum(strain(4:6)**2)))
   end function equivalent

   !> Work of the stress on plastic strain from one state to the next, by the mean of both stresses
   pure real(wp) function plastic_work(before, now) result(work)
      !> The states; the first has no stress if nothing was allocated
      type(plastic_fields_type), intent(in) :: before, now

      real(wp) :: stress(6), strain(6)
      integer :: i, j

      work = 0.0_wp
      if (.not. allocated(now%strain)) return
      do j = 1, size(now%plane_weight)
         do i = 1, size(now%point_weight)
            stress = 0.5_wp*now%stress(:, i, j)
            strain = now%strain(:, i, j)
            if (allocated(before%strain)) then
               stress = stress + 0.5_wp*before%stress(:, i, j)
               strain = strain - before%strain(:, i, j)
            end if
            work = work + now%plane_weight(j)*now%point_weight(i)*dot_product(stress, strain)
         end do
      end do
   end function plastic_work

end module axijoint_analysis_core_plastic_fields
