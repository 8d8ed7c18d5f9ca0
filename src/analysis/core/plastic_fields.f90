!> What bodies that yield show of a state: plastic strain and yield margin at the Gauss points
module axijoint_analysis_core_plastic_fields
   use axijoint_base_kinds, only : wp
   use axijoint_element_yield_law, only : yield_law_type, elastic_strain, law_at, yield_none
   use axijoint_element_yield_margin, only : yield_margin
   use axijoint_fe_mode, only : mode_type
   use axijoint_joints_planes, only : planes_type, synthesize
   use axijoint_joints_states, only : plastic_state_type
   use axijoint_model_model, only : model_type
   use axijoint_plastic_field, only : body_planes
   use axijoint_plastic_record, only : on_all_points
   implicit none
   private
   public :: plastic_fields_type, plastic_fields

   !> The fields; nothing is allocated if no body can yield
   type :: plastic_fields_type
      !> Amplitudes of the plastic strain at all Gauss points, r, z, theta, rz, r-theta, z-theta,
      !> shear strains as in engineering, shape (6, points, modes)
      real(wp), allocatable :: strain(:, :, :)
      !> Angles of the planes on which the criteria are looked at [radian]
      real(wp), allocatable :: angles(:)
      !> Share of the strength that is left, 1 without shear, 0 at yield; 1 where nothing yields,
      !> shape (points, planes)
      real(wp), allocatable :: margin(:, :)
      !> Equivalent plastic strain, sqrt(2/3 e:e), shape (points, planes)
      real(wp), allocatable :: equivalent(:, :)
   end type plastic_fields_type

contains

   !> Find the fields of a state
   function plastic_fields(model, modes, element, position, stress, state) result(fields)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Element of each Gauss point, and r and z, shape (2, points)
      integer, intent(in) :: element(:)
      real(wp), intent(in) :: position(:, :)
      !> Stress amplitudes, shape (6, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> What plastic strain takes
      type(plastic_state_type), intent(in) :: state
      !> The fields
      type(plastic_fields_type) :: fields

      type(planes_type) :: planes
      type(yield_law_type), allocatable :: laws(:)
      real(wp), allocatable :: total(:, :, :), gained(:, :)
      integer :: i, j, k

      if (.not. allocated(state%place)) return
      planes = body_planes(modes)
      laws = law_at(model%materials(model%mesh%element_material(element))%yield, position(2, :))
      fields%angles = planes%angle
      fields%strain = on_all_points(state%place, state%amplitude, size(element))
      total = synthesize(planes, stress + fields%strain)
      allocate (gained(size(element), size(planes%angle)), source=0.0_wp)
      total(:, state%place, :) = total(:, state%place, :) - state%taken
      gained(state%place, :) = state%gained
      do k = 1, size(modes)
         do i = 1, size(state%place)
            associate (p => state%place(i))
               fields%strain(:, p, k) = elastic_strain(laws(p), state%amplitude(:, i, k))
            end associate
         end do
      end do
      allocate (fields%equivalent, source=gained)
      fields%equivalent = 0.0_wp
      do j = 1, size(planes%angle)
         do i = 1, size(state%place)
            associate (p => state%place(i))
               fields%equivalent(p, j) = equivalent(elastic_strain(laws(p), state%taken(:, i, j)))
            end associate
         end do
      end do
      allocate (fields%margin(size(element), size(planes%angle)), source=1.0_wp)
      do j = 1, size(planes%angle)
         do i = 1, size(element)
            if (laws(i)%criterion == yield_none) cycle
            fields%margin(i, j) = yield_margin(laws(i), gained(i, j), total(:, i, j))
         end do
      end do
   end function plastic_fields

   !> Equivalent strain sqrt(2/3 e:e): in uniaxial tension of what keeps its volume, its strain
   pure real(wp) function equivalent(strain)
      !> r, z, theta, rz, r-theta, z-theta, shear strains as in engineering
      real(wp), intent(in) :: strain(6)

      equivalent = sqrt(2.0_wp/3.0_wp*(sum(strain(1:3)**2) + 0.5_wp*sum(strain(4:6)**2)))
   end function equivalent

end module axijoint_analysis_core_plastic_fields
