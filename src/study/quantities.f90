!> What a study keeps of a row: numbers with names, increment by increment
module axijoint_study_quantities
   use axijoint_analysis_core_fields, only : n_resultants
   use axijoint_analysis_core_results, only : results_type, error_share_type
   use axijoint_analysis_core_series, only : series_type
   use axijoint_analysis_core_yield_errors, only : yield_share_type, sum_of_yield_shares
   use axijoint_analysis_error_budget, only : sum_of_shares
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_text, only : to_text
   use axijoint_fe_mode, only : meridional, circumferential
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: name_length, quantity_names, quantity_values

   !> Letters of a name
   integer, parameter :: name_length = 48
   !> What is always kept
   character(len=20), parameter :: general(12) = [character(len=20) :: &
      'increment', 'load_factor', 'iterations', 'residual', 'n_slip', 'n_open', &
      'largest_displacement', 'largest_pressure', 'largest_shear', 'work', 'energy', 'dissipated']
   !> Estimates of errors over the largest value, of the last increment; negative if not known
   character(len=20), parameter :: estimates(2) = [character(len=20) :: &
      'error_displacement', 'error_joint_stress']
   !> Resultants, and components of a displacement: u and v at theta = 0, w at 90 degrees, u and v there
   character(len=10), parameter :: resultants(n_resultants) = [character(len=10) :: &
      'axial', 'lateral', 'moment', 'torque', 'lateral_90', 'moment_90']
   integer, parameter :: n_components = 5
   character(len=4), parameter :: components(n_components) = [character(len=4) :: 'u', 'v', 'w', 'u_90', 'v_90']

contains

   !> Names of the quantities
   function quantity_names(model) result(names)
      !> The job
      type(model_type), intent(in) :: model
      !> The names
      character(len=name_length), allocatable :: names(:)

      character(len=:), allocatable :: thing
      integer :: k, i, n

      allocate (names(size(general) + size(estimates) + 1 + n_components*size(model%points) &
                      + n_resultants*(size(model%supported_faces) + size(model%cuts))))
      names(:size(general)) = general
      n = size(general)
      names(n + 1:n + 2) = estimates
      names(n + 3) = 'largest_mises'
      n = n + 3
      do k = 1, size(model%points)
         thing = trim(model%points(k)%name)
         if (thing == '') thing = 'point '//to_text(model%points(k)%label)
         names(n + 1:n + n_components) = [(thing//' '//components(i), i=1, n_components)]
         n = n + n_components
      end do
      do k = 1, size(model%supported_faces)
         names(n + 1:n + n_resultants) = [('face '//to_text(model%supported_faces(k)%label)//' '// &
                                           resultants(i), i=1, n_resultants)]
         n = n + n_resultants
      end do
      do k = 1, size(model%cuts)
         names(n + 1:n + n_resultants) = [('cut '//to_text(model%cuts(k)%label)//' '// &
                                           resultants(i), i=1, n_resultants)]
         n = n + n_resultants
      end do
   end function quantity_names

   !> Their values
   function quantity_values(series, results) result(values)
      !> What was followed from increment to increment
      type(series_type), intent(in) :: series
      !> Results at the end
      type(results_type), intent(in) :: results
      !> Shape (quantities, increments)
      real(wp), allocatable :: values(:, :)

      type(error_share_type) :: total
      type(yield_share_type) :: of_bodies
      integer :: i, n

      n = size(general) + size(estimates) + 1
      allocate (values(n + n_components*size(series%points, 2) + size(series%faces(:, :, 1)) + &
                       size(series%cuts(:, :, 1)), series%n))
      values(size(general) + 1:n, :) = -1.0_wp
      do i = 1, series%n
         values(:size(general), i) = &
            [real(series%increment(i), wp), series%load_factor(i), real(series%iterations(i), wp), &
             series%residual(i), real(series%n_slip(i), wp), real(series%n_open(i), wp), &
             series%displacement(i), series%pressure(i), series%shear(i), &
             series%work(i), series%energy(i), series%dissipated(i)]
         values(n + 1:, i) = [totals(i), series%faces(:, :, i), series%cuts(:, :, i)]
      end do
      if (allocated(results%budget)) then
         total = sum_of_shares(results%budget)
         values(size(general) + 1:size(general) + 2, series%n) = &
            [total%displacement, total%joint_stress]
      else if (allocated(results%yield_errors)) then
         of_bodies = sum_of_yield_shares(results%yield_errors)
         values(size(general) + 1, series%n) = of_bodies%displacement
      end if
      values(n, series%n) = largest_mises(results)

   contains

      !> Displacements of the points: u and v at theta = 0, w at 90 degrees, u and v there: a load along 90 degrees moves
      !> nothing of the first three
      function totals(i)
         !> Place of the increment
         integer, intent(in) :: i
         !> Shape (components points)
         real(wp), allocatable :: totals(:)

         integer :: k
         real(wp) :: sums(n_components, size(series%points, 2))

         sums = 0.0_wp
         do k = 1, size(results%modes)
            associate (mode => results%modes(k), amplitude => series%points(:, :, k, i))
               sums(1:2, :) = sums(1:2, :) + meridional(mode, 0.0_wp)*amplitude(1:2, :)
               sums(3, :) = sums(3, :) + circumferential(mode, 0.5_wp*pi)*amplitude(3, :)
               sums(4:5, :) = sums(4:5, :) + meridional(mode, 0.5_wp*pi)*amplitude(1:2, :)
            end associate
         end do
         totals = reshape(sums, [size(sums)])
      end function totals

   end function quantity_values

   !> Largest stress of von Mises at a Gauss point and any of the angles 0, 15, ... degrees. It is a
   !> norm: the modes together cannot give more than the sum of what each gives, squared not more than
   !> their number times the sum of the squares. By that most points need not be looked at
   pure real(wp) function largest_mises(results) result(largest)
      !> Results with stresses
      type(results_type), intent(in) :: results

      real(wp), parameter :: step = pi/12.0_wp
      !> What rounding may take from the bound
      real(wp), parameter :: rounding = 1.0e-12_wp
      real(wp) :: most(size(results%stress, 2))
      real(wp), allocatable :: even(:, :), odd(:, :)
      integer :: j, k, n, point

      largest = 0.0_wp
      if (size(most) == 0) return
      n = 12
      if (any(results%modes%family /= results%modes(1)%family)) n = 23
      allocate (even(0:n, size(results%modes)), odd(0:n, size(results%modes)))
      do j = 0, n
         even(j, :) = meridional(results%modes, j*step)
         odd(j, :) = circumferential(results%modes, j*step)
      end do
      most = 0.0_wp
      do k = 1, size(results%modes)
         do point = 1, size(most)
            most(point) = most(point) + max(in_plane(results%stress(:4, point, k)), &
               across(results%stress(5:, point, k)))
         end do
      end do
      most = (1.0_wp + rounding)*size(results%modes)*most
      largest = there(maxloc(most, 1))
      do point = 1, size(most)
         if (most(point) > largest) largest = max(largest, there(point))
      end do
      largest = sqrt(largest)

   contains

      !> Square of the largest at a point
      pure real(wp) function there(point)
         !> The point
         integer, intent(in) :: point

         real(wp) :: stress(6)
         integer :: j, k

         there = 0.0_wp
         do j = 0, n
            stress = 0.0_wp
            do k = 1, size(results%modes)
               stress(:4) = stress(:4) + even(j, k)*results%stress(:4, point, k)
               stress(5:) = stress(5:) + odd(j, k)*results%stress(5:, point, k)
            end do
            there = max(there, in_plane(stress(:4)) + across(stress(5:)))
         end do
      end function there

   end function largest_mises

   !> Square of the stress of von Mises of r, z, theta, rz
   pure real(wp) function in_plane(stress)
      !> The stresses
      real(wp), intent(in) :: stress(4)

      in_plane = 0.5_wp*((stress(1) - stress(2))**2 + (stress(2) - stress(3))**2 &
                         + (stress(3) - stress(1))**2) + 3.0_wp*stress(4)**2
   end function in_plane

   !> Square of the stress of von Mises of r-theta, z-theta
   pure real(wp) function across(stress)
      !> The stresses
      real(wp), intent(in) :: stress(2)

      across = 3.0_wp*sum(stress**2)
   end function across

end module axijoint_study_quantities
