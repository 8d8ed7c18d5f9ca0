!> What each approximation leaves of the error of a run, side by side and in all, and what
!> would halve it
module axijoint_analysis_error_budget
   use axijoint_analysis_core_left_out, only : excited_in_vain
   use axijoint_analysis_core_named_points, only : at_points
   use axijoint_analysis_core_results, only : results_type, error_share_type, &
      source_discretization, source_harmonics, &
      source_planes, source_iteration, source_solver, source_sum
   use axijoint_analysis_error_cut_errors, only : n_kinds, sizes_on_cuts, relative_on_cuts
   use axijoint_analysis_error_response_tail, only : response_tail, tail_of_points, stress_tail, is_cancelled
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_fe_circle_function, only : are_alike
   use axijoint_joints_residual, only : ratio
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: new_budget, solver_error, sum_of_shares, is_known

   !> So many times as many harmonics, or intervals between planes, about halve an error that falls with the square of their number
   real, parameter :: more = 1.4142

contains

   !> Put the estimates of a run together
   pure function new_budget(model, case_factor, results) result(budget)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of its load cases, shape (cases)
      real(wp), intent(in) :: case_factor(:)
      !> Results with the estimates of their parts, and the size of displacements at points with names
      type(results_type), intent(in) :: results
      !> Discretization, harmonics, planes, iteration, solver
      type(error_share_type), allocatable :: budget(:)

      real(wp), allocatable :: sizes(:, :)
      logical :: yields
      integer :: i

      yields = size(results%path) > 0
      allocate (budget(5))
      budget(source_discretization) = discretization_share(model, case_factor, results)
      budget(source_harmonics) = harmonics_share(model, case_factor, results, yields)
      budget(source_planes) = error_share_type(source=source_planes, remedy='planes: '// &
                                   to_text(nint(more*(model%n_planes - 1)) + 1)//' in CONTROL')
      budget(source_iteration) = error_share_type(source=source_iteration, &
         remedy='half the tolerance in INCREMENTS')
      if (yields) then
         call take(model, results%joint_errors(2), budget(source_planes))
         call take(model, results%joint_errors(1), budget(source_iteration))
      else
         budget(source_planes:source_iteration)%displacement = 0.0_wp
         budget(source_planes)%at_points = spread(0.0_wp, 1, size(results%point_size))
         budget(source_iteration)%at_points = budget(source_planes)%at_points
         budget(source_planes)%on_cuts = no_errors(size(model%cuts))
         budget(source_iteration)%on_cuts = no_errors(size(model%cuts))
         budget(source_planes)%on_lines = spread(0.0_wp, 1, size(model%lines))
         budget(source_iteration)%on_lines = budget(source_planes)%on_lines
         if (size(results%joint_stress) > 0) budget(source_planes:source_iteration)%joint_stress = 0.0_wp
      end if
      budget(source_solver) = error_share_type(source=source_solver, &
         remedy='less contrast of the stiffnesses')
      budget(source_solver)%displacement = solver_error(results)
      budget(source_solver)%at_points = spread(solver_error(results)*results%discretization%largest_displacement, 1, &
         size(results%point_size))
      budget(source_solver)%on_lines = solver_error(results)*max(0.0_wp, stress_on_lines(model, results))
      sizes = sizes_on_cuts(results%cut_resultants)
      budget(source_solver)%on_cuts = spread(solver_error(results)*[(maxval([0.0_wp, sizes(i, :)]), i=1, n_kinds)], 2, &
         size(sizes, 2))
      do i = 1, size(budget)
         if (results%at_rest) then
            budget(i)%at_points = min(0.0_wp, budget(i)%at_points)
            budget(i)%on_lines = min(0.0_wp, budget(i)%on_lines)
         end if
         call compare_points(results%point_size, results%discretization%largest_displacement, budget(i))
         call compare_lines(stress_on_lines(model, results), budget(i))
         associate (x => model%mesh%coordinates)
            budget(i)%cuts = relative_on_cuts(budget(i)%on_cuts, sizes, &
               max(maxval(x(1, :)), maxval(x(2, :)) - minval(x(2, :))), results%discretization%least_force)
         end associate
      end do
      if (results%at_rest) budget%displacement = min(0.0_wp, budget%displacement)  ! nothing is left to be off
   end function new_budget

   !> What rounding in the solver leaves of the displacements, over the largest
   pure real(wp) function solver_error(results) result(error)
      !> Results
      type(results_type), intent(in) :: results

      !> A further step of refinement would correct by about as much as the last did; what the
      !> matrix itself lost to rounding is as much again
      real(wp), parameter :: safety = 2.0_wp
      real(wp) :: by_condition

      ! a backward error is a relative change of the data, which the condition number passes on at
      ! most
      by_condition = maxval(results%solves%backward_error*results%solves%condition)
      error = ratio(safety*sum(results%solves%correction), &
         results%discretization%largest_displacement)
      error = min(error, by_condition)
   end function solver_error

   !> Elements too large or of too low an order
   pure function discretization_share(model, case_factor, results) result(share)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of its load cases, shape (cases)
      real(wp), intent(in) :: case_factor(:)
      !> Results
      type(results_type), intent(in) :: results
      !> Their share
      type(error_share_type) :: share

      integer :: k
      logical :: on_axis, on_circles

      share%source = source_discretization
      share%energy = results%discretization%relative
      share%displacement = results%discretization%displacement
      share%joint_stress = results%discretization%joint_stress
      share%at_points = results%discretization%at_points
      share%on_cuts = results%discretization%on_cuts
      share%on_lines = spread(-1.0_wp, 1, size(model%lines))
      if (allocated(results%discretization%on_lines)) share%on_lines = results%discretization%on_lines
      share%seconds = results%discretization%seconds
      if (results%locks) then
         share%remedy = 'elements that do not lock'
      else if (any(model%mesh%element_size < 5)) then
         share%remedy = 'elements 0.7 (for stresses 0.5) times as large'
      else
         share%remedy = 'elements 0.6 times as large'
      end if
      on_axis = .false.
      on_circles = .false.
      do k = 1, size(model%ring_loads)
         associate (load => model%ring_loads(k))
            if (.not. abs(case_factor(load%case)) > 0.0_wp) cycle
            on_circles = .true.
            on_axis = on_axis .or. .not. model%mesh%coordinates(1, load%node) > 0.0_wp
         end associate
      end do
      if (on_axis) then
         share%remedy = share%remedy//' or, where forces on the axis leave it, under which displacements have no limit, these '// &
            'spread over faces'
      else if (on_circles) then
         share%remedy = share%remedy//' or, where loads on circles leave it, these spread over faces'
      end if
   end function discretization_share

   !> Harmonics above M, of the loads and of joints that open and slip
   pure function harmonics_share(model, case_factor, results, yields) result(share)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of its load cases, shape (cases)
      real(wp), intent(in) :: case_factor(:)
      !> Results
      type(results_type), intent(in) :: results
      !> Whether joints yield
      logical, intent(in) :: yields
      !> Their share
      type(error_share_type) :: share

      real(wp), allocatable :: amplitude(:)
      real(wp) :: tail
      logical, allocatable :: counts(:)
      integer, allocatable :: harmonic(:), moved(:)
      real(wp), allocatable :: at_point(:, :, :)
      integer :: i, k, p

      share%source = source_harmonics
      share%remedy = 'harmonics: M = '//to_text(max(model%max_harmonic + 1, nint(more*model%max_harmonic)))// &
         ' in CONTROL'
      if (size(model%harmonics) <= model%max_harmonic) share%remedy = 'harmonics: more of them in HARMONICS'
      share%displacement = 0.0_wp
      share%at_points = spread(0.0_wp, 1, size(results%point_size))
      share%on_cuts = no_errors(size(model%cuts))  ! of loads' harmonics above M none has resultants
      if (size(results%joint_stress) > 0) share%joint_stress = 0.0_wp
      share%on_lines = spread(0.0_wp, 1, size(model%lines))
      if (yields) call take(model, results%joint_errors(3), share)
      if (size(excited_in_vain(model, results)) > 0) then
         call forget(share)
         share%on_cuts = -1.0_wp
      end if
      share%load = 0.0_wp
      do k = 1, size(model%truncations)
         associate (cut => model%truncations(k))
            if (abs(case_factor(cut%case)) > 0.0_wp) share%load = max(share%load, cut%left_out)
         end associate
      end do
      if (.not. share%load > 0.0_wp) return
      if (yields) share%on_cuts = -1.0_wp  ! what joints make of loads above M has resultants
      if (any(abs(case_factor(model%left_out%case)) > 0.0_wp)) then  ! what others tell is no measure of these
         call forget(share)
         share%on_cuts = -1.0_wp
         return
      end if
      if (share%load >= 1.0_wp) share%remedy = 'loads on parts of the circle in place of those at points'
      harmonic = results%modes%harmonic
      amplitude = [(sqrt(maxval(sum(results%displacement(:, :, k)**2, 1))), k=1, &
         size(results%modes))]
      if (is_cancelled(harmonic, amplitude)) then
         call forget(share)
         return
      end if
      associate (solution => results%discretization)
         ! displacements that are given in a harmonic tell nothing of what loads leave above M
         associate (given => model%prescribed)
            counts = [(harmonic(k) == 0 .or. .not. any(given%mode%harmonic == harmonic(k) .and. abs(given%value) > 0.0_wp .and. &
               abs(case_factor(given%case)) > 0.0_wp), k=1, size(harmonic))]
         end associate
         if (.not. any(counts .and. 2*harmonic > maxval(harmonic))) counts = .true.
         moved = pack(harmonic, .not. counts)
         harmonic = pack(harmonic, counts)
         call add_tail(largest_tail(model, case_factor, harmonic, pack(amplitude, counts), moved), solution%largest_displacement, &
            share%displacement)
         at_point = at_points(model%points, results%displacement)
         do p = 1, size(model%points)
            amplitude = [(norm2(at_point(:, p, k)), k=1, size(results%modes))]
            call add_tail(largest_tail(model, case_factor, harmonic, pack(amplitude, counts), moved), 1.0_wp, share%at_points(p))
         end do
         if (allocated(solution%line_amplitude)) then
            do p = 1, size(model%lines)
               tail = 0.0_wp
               do i = 1, size(solution%line_amplitude, 2)
                  amplitude = pack(solution%line_amplitude(:, i, p), counts)
                  if (.not. maxval(amplitude) > 0.0_wp) cycle
                  tail = max(tail, largest_tail(model, case_factor, harmonic, amplitude, moved, of_stress=.true.))
               end do
               call add_tail(tail, 1.0_wp, share%on_lines(p))
            end do
         end if
         ! joints that stay elastic may carry nothing at the angles where their stress is known
         call add_tail(largest_tail(model, case_factor, harmonic, pack(solution%joint_amplitude, counts), moved), &
            max(solution%joint_scale, maxval(solution%joint_amplitude)), share%joint_stress)
         tail = response_tail(harmonic, pack(solution%energy, counts))
         if (tail >= 0.0_wp) share%energy = sqrt(ratio(tail, sum(solution%energy)))
      end associate
   end function harmonics_share

   !> Largest stress along each line
   pure function stress_on_lines(model, results) result(stress)
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results
      !> Shape (lines) [stress]; negative if no point is judged
      real(wp) :: stress(size(model%lines))

      stress = -1.0_wp
      if (allocated(results%discretization%line_stress)) stress = results%discretization%line_stress
   end function stress_on_lines

   !> Errors of displacements and joint stress are not known
   pure subroutine forget(share)
      !> The share
      type(error_share_type), intent(inout) :: share

      share%displacement = -1.0_wp
      share%joint_stress = -1.0_wp
      share%at_points = -1.0_wp
      share%on_lines = -1.0_wp
   end subroutine forget

   !> What harmonics above M would add to the response, by that of the loads which is most; negative if it is not known
   pure real(wp) function largest_tail(model, case_factor, harmonic, amplitude, without, of_stress) result(tail)
      !> The job
      type(model_type), intent(in) :: model
      !> Factors of its load cases, shape (cases)
      real(wp), intent(in) :: case_factor(:)
      !> Harmonic of each mode, and its amplitude, shape (modes)
      integer, intent(in) :: harmonic(:)
      real(wp), intent(in) :: amplitude(:)
      !> Harmonics up to M of which these tell nothing
      integer, intent(in) :: without(:)
      !> Whether the response is a stress; false if absent
      logical, intent(in), optional :: of_stress

      logical :: stress
      integer :: k

      stress = .false.
      if (present(of_stress)) stress = of_stress
      tail = -1.0_wp
      do k = 1, size(model%truncations)
         associate (cut => model%truncations(k))
            if (.not. (cut%left_out > 0.0_wp .and. abs(case_factor(cut%case)) > 0.0_wp)) cycle
            if (allocated(cut%course)) then
               if (is_like_the_last(model, k)) cycle
               if (stress) then
                  tail = max(tail, stress_tail(harmonic, amplitude, cut%course, without))
               else
                  tail = max(tail, response_tail(harmonic, amplitude, cut%course, without))
               end if
            else if (stress) then
               tail = max(tail, stress_tail(harmonic, amplitude))
            else
               tail = max(tail, tail_of_points(harmonic, amplitude))
            end if
         end associate
      end do
   end function largest_tail

   !> Whether a load goes round the circle as the one before it
   pure logical function is_like_the_last(model, k) result(is_like)
      !> The job
      type(model_type), intent(in) :: model
      !> Place of the load, one that goes round the circle
      integer, intent(in) :: k

      is_like = k > 1
      if (is_like) is_like = allocated(model%truncations(k - 1)%course) &
         .and. model%truncations(k)%case == model%truncations(max(1, k - 1))%case
      if (is_like) is_like = are_alike(model%truncations(k)%course, model%truncations(k - 1)%course)
   end function is_like_the_last

   !> Add what harmonics above M would bring to an error, which is not known if that is not
   pure subroutine add_tail(tail, scale, error)
      !> What they would bring, and what the error is a part of
      real(wp), intent(in) :: tail, scale
      !> The error; negative if it is not known
      real(wp), intent(inout) :: error

      if (error < 0.0_wp) return
      error = merge(error + ratio(tail, scale), -1.0_wp, tail >= 0.0_wp)
   end subroutine add_tail

   !> Take an estimate of the joints
   pure subroutine take(model, error, share)
      !> The job
      type(model_type), intent(in) :: model
      !> The estimate
      type(error_share_type), intent(in) :: error
      !> The share
      type(error_share_type), intent(inout) :: share

      share%displacement = error%displacement
      share%joint_stress = error%joint_stress
      share%at_points = spread(-1.0_wp, 1, size(model%points))
      if (allocated(error%at_points)) share%at_points = error%at_points
      share%on_lines = spread(-1.0_wp, 1, size(model%lines))
      if (allocated(error%on_lines)) share%on_lines = error%on_lines
      share%on_cuts = no_errors(size(model%cuts)) - 1.0_wp
      if (allocated(error%on_cuts)) share%on_cuts = error%on_cuts
      share%seconds = error%seconds
   end subroutine take

   !> Errors on cuts that are none
   pure function no_errors(n) result(none)
      !> How many cuts
      integer, intent(in) :: n
      !> Shape (n_kinds, cuts)
      real(wp) :: none(n_kinds, n)

      none = 0.0_wp
   end function no_errors

   !> Largest error at a point with a name over the largest displacement of these
   pure subroutine compare_points(displacement, largest, share)
      !> Largest displacement of each, shape (points), and of all nodes
      real(wp), intent(in) :: displacement(:), largest
      !> Errors of each; takes the ratio
      type(error_share_type), intent(inout) :: share

      !> Part of the largest displacement below which that of points is none
      real(wp), parameter :: slight = 1.0e-6_wp

      if (size(displacement) == 0) return
      if (any(share%at_points < 0.0_wp)) return
      share%points = ratio(maxval(share%at_points), max(maxval(displacement), slight*largest))
   end subroutine compare_points

   !> Largest error of the stress along a line over the largest stress along any; where it is not known of one, of the others
   pure subroutine compare_lines(stress, share)
      !> Largest stress along each, shape (lines)
      real(wp), intent(in) :: stress(:)
      !> Errors of each; takes the ratio
      type(error_share_type), intent(inout) :: share

      share%sections = -1.0_wp
      if (size(stress) == 0) return
      if (any(share%on_lines >= 0.0_wp)) share%sections = ratio(maxval(share%on_lines), maxval(stress))
   end subroutine compare_lines

   !> All shares together, each quantity without those that are not known; negative if none is. Of a single point, cut or line it is
   !> not known if one of them is not: a sum without it would be taken for all
   pure function sum_of_shares(budget) result(total)
      !> The budget
      type(error_share_type), intent(in) :: budget(:)
      !> The sums
      type(error_share_type) :: total

      integer :: i, k, p

      total%source = source_sum
      total%energy = known_sum((budget%energy))
      total%displacement = known_sum((budget%displacement))
      total%joint_stress = known_sum((budget%joint_stress))
      total%points = known_sum((budget%points))
      total%cuts = known_sum((budget%cuts))
      total%sections = known_sum((budget%sections))
      total%on_lines = [(whole_sum([(budget(i)%on_lines(p), i=1, size(budget))]), p=1, size(budget(1)%on_lines))]
      total%at_points = [(whole_sum([(budget(i)%at_points(p), i=1, size(budget))]), p=1, size(budget(1)%at_points))]
      allocate (total%on_cuts, mold=budget(1)%on_cuts)
      do p = 1, size(total%on_cuts, 2)
         total%on_cuts(:, p) = [(whole_sum([(budget(i)%on_cuts(k, p), i=1, size(budget))]), k=1, n_kinds)]
      end do
      total%seconds = sum(budget%seconds)
   end function sum_of_shares

   !> Sum of what is known
   pure real(wp) function known_sum(values)
      !> Values, negative if not known
      real(wp), intent(in) :: values(:)

      known_sum = -1.0_wp
      if (any(values >= 0.0_wp)) known_sum = sum(values, mask=values >= 0.0_wp)
   end function known_sum

   !> The sum, if all is known; else negative
   pure real(wp) function whole_sum(values)
      !> Values, negative if not known
      real(wp), intent(in) :: values(:)

      whole_sum = -1.0_wp
      if (all(values >= 0.0_wp)) whole_sum = sum(values)
   end function whole_sum

   !> Whether all shares of a quantity are known; the solver has none of joint stress
   pure logical function is_known(budget, values)
      !> The budget
      type(error_share_type), intent(in) :: budget(:)
      !> The shares of a quantity
      real(wp), intent(in) :: values(:)

      is_known = all(values >= 0.0_wp .or. budget%source == source_solver)
   end function is_known

end module axijoint_analysis_error_budget
