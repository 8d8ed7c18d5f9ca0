!> Sums of harmonics at an angle, and the extreme values of a run
module axijoint_analysis_core_totals
   use, intrinsic :: ieee_arithmetic, only : ieee_is_finite
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, pi
   use axijoint_element_joint_law, only : eta
   use axijoint_fe_mode, only : mode_type, meridional, circumferential, family_symmetric
   implicit none
   private
   public :: circle_type, new_circle, total_displacement, total_stress, n_unknowns
   public :: peak_type, largest_displacement, largest_vector, largest_pressure, count_states

   !> Intervals of the circle in the search for the largest displacement
   integer, parameter :: search_intervals = 72

   !> Factors of all modes at one angle
   type :: circle_type
      !> The angle [radian]
      real(wp) :: angle = 0.0_wp
      !> Of r and z components, and of theta components, in the order of the results
      real(wp), allocatable :: meridional(:), circumferential(:)
   end type circle_type

   !> An extreme value and where it stands
   type :: peak_type
      !> The value; negative if there is none
      real(wp) :: value = -1.0_wp
      !> Index of the node or joint point; 0 if there is none
      integer :: place = 0
      !> Angle theta [radian]
      real(wp) :: angle = 0.0_wp
   end type peak_type

contains

   !> Factors of all modes at an angle. What is zero but for rounding, as
   !> cos(pi/2), is zero.
   pure function new_circle(modes, angle) result(circle)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Angle [radian]
      real(wp), intent(in) :: angle
      !> The factors
      type(circle_type) :: circle

      circle%angle = angle
      circle%meridional = without_rounding(meridional(modes, angle), modes%harmonic)
      circle%circumferential = without_rounding(circumferential(modes, angle), modes%harmonic)
   end function new_circle

   !> Zero for what lies within the rounding of the angle m theta
   elemental real(wp) function without_rounding(value, harmonic) result(clean)
      !> Cosine or sine
      real(wp), intent(in) :: value
      !> Harmonic m
      integer, intent(in) :: harmonic

      clean = value
      if (abs(value) < 4.0_wp*real(max(1, harmonic), wp)*epsilon(1.0_wp)) clean = 0.0_wp
   end function without_rounding

   !> Displacement u, v, w at an angle (Eq. 1)
   pure function total_displacement(amplitude, circle) result(total)
      !> Amplitudes, shape (3, modes)
      real(wp), intent(in) :: amplitude(:, :)
      !> The angle
      type(circle_type), intent(in) :: circle
      !> u, v, w
      real(wp) :: total(3)

      total(1:2) = matmul(amplitude(1:2, :), circle%meridional)
      total(3) = dot_product(amplitude(3, :), circle%circumferential)
   end function total_displacement

   !> Stress r, z, theta, rz, r-theta, z-theta at an angle
   pure function total_stress(amplitude, circle) result(total)
      !> Amplitudes, shape (6, modes)
      real(wp), intent(in) :: amplitude(:, :)
      !> The angle
      type(circle_type), intent(in) :: circle
      !> Six stresses
      real(wp) :: total(6)

      total(1:4) = matmul(amplitude(1:4, :), circle%meridional)
      total(5:6) = matmul(amplitude(5:6, :), circle%circumferential)
   end function total_stress

   !> Number of unknowns of all modes together
   pure integer function n_unknowns(results)
      !> Results
      type(results_type), intent(in) :: results
      n_unknowns = sum(results%solves%n_equations)
   end function n_unknowns

   !> Largest length of the displacement vector at steps of 5 degrees, at the first node that has it. The modes of a
   !> node together cannot give more than the sum of their amplitudes, by which most nodes need not be looked at
   pure function largest_displacement(modes, displacement) result(peak)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Length, node, angle
      type(peak_type) :: peak

      real(wp), parameter :: rounding = 1.0e-12_wp
      type(circle_type) :: circles(0:search_intervals)
      type(peak_type) :: likely
      real(wp), allocatable :: total(:, :)
      real(wp) :: most(size(displacement, 2))
      integer :: node, i, k, last

      if (size(most) == 0 .or. size(modes) == 0) return
      last = search_intervals
      if (all(modes%family == family_symmetric)) last = search_intervals/2
      do i = 0, last
         circles(i) = new_circle(modes, 2.0_wp*pi*real(i, wp)/real(search_intervals, wp))
      end do
      total = abs(displacement(:, :, 1))
      do k = 2, size(modes)
         total = total + abs(displacement(:, :, k))
      end do
      most = (1.0_wp + rounding)*sqrt(sum(total**2, 1))
      call look(maxloc(most, 1, mask=ieee_is_finite(most)), likely)
      do node = 1, size(most)
         if (ieee_is_finite(most(node)) .and. most(node) >= likely%value .and. most(node) > peak%value) &
            call look(node, peak)
      end do

   contains

      !> Look round a node
      pure subroutine look(node, peak)
         !> The node; 0 if there is none
         integer, intent(in) :: node
         !> The largest so far
         type(peak_type), intent(inout) :: peak

         real(wp) :: length
         integer :: i

         if (node == 0) return
         do i = 0, last
            length = norm2(total_displacement(displacement(:, node, :), circles(i)))
            if (length > peak%value) peak = peak_type(length, node, circles(i)%angle)
         end do
      end subroutine look

   end function largest_displacement

   !> Its length alone; zero if there is none
   pure real(wp) function largest_vector(modes, displacement) result(largest)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)

      type(peak_type) :: peak

      peak = largest_displacement(modes, displacement)
      largest = max(0.0_wp, peak%value)
   end function largest_vector

   !> Largest pressure -sigma of the joint points; its value is negative if
   !> there is no joint or all joints are in tension
   pure function largest_pressure(results) result(peak)
      !> Results
      type(results_type), intent(in) :: results
      !> Pressure, joint point, angle
      type(peak_type) :: peak

      integer :: point, plane

      do plane = 1, size(results%joint_stress, 3)
         do point = 1, size(results%joint_stress, 2)
            associate (pressure => -results%joint_stress(eta, point, plane))
               if (.not. ieee_is_finite(pressure)) cycle
               if (pressure > peak%value .or. peak%place == 0) then
                  peak = peak_type(pressure, point, results%plane_angles(plane))
               end if
            end associate
         end do
      end do
   end function largest_pressure

   !> Number of joint points times planes in a state
   pure integer function count_states(results, state)
      !> Results
      type(results_type), intent(in) :: results
      !> One of the `state_` parameters
      integer, intent(in) :: state
      count_states = count(results%joint_state == state)
   end function count_states

end module axijoint_analysis_core_totals
