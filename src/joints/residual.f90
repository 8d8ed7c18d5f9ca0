!> Residual forces of joint stress that is out of balance, and what they are measured by (Eq. 17):
!> the whole load, and part by part and harmonic by harmonic what the joints themselves carry of the
!> load of the increment
module axijoint_joints_residual
   use axijoint_assembly_equations, only : equations_type, on_equations
   use axijoint_assembly_loading, only : loading_type
   use axijoint_assembly_rigid_motion, only : solid_parts
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_rows, only : jump_rows
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : mesh_type
   implicit none
   private
   public :: measure_type, reference_type, strictest_type, residual_record_type, new_measure, &
      set_reference
   public :: strictest, ratios_of, residual_norm, load_norm, balance_each_other, ratio

   !> A residual this small beside the forces of the increment is rounding: smaller parts and
   !> harmonics are not resolved beyond it
   real(wp), parameter :: resolution = 1.0e-11_wp
   !> The paper's loop is held to Eq. 17, and part by part and harmonic by harmonic to this share of
   !> it
   real(wp), parameter :: paper_share = 0.1_wp

   !> How stress at the joint points acts on the unknowns of a class
   type :: rows_type
      !> First entry of each jump of points 1, 2 ..., and one beyond; unknown (counted among those of
      !> joints) and factor of each
      integer, allocatable :: first(:), unknown(:)
      real(wp), allocatable :: factor(:)
      !> Part of each unknown, counted among those with joints
      integer, allocatable :: part(:)
   end type rows_type

   !> How residual forces are measured
   type :: measure_type
      private
      !> One entry a class of the equations, and the class and the integral of each mode
      type(rows_type), allocatable :: rows(:)
      integer, allocatable :: class(:)
      real(wp), allocatable :: integral(:)
      !> Weights of the joint points
      real(wp), allocatable :: weight(:)
      !> A node of each part that has joints
      integer, allocatable, public :: part_node(:)
   end type measure_type

   !> What residual forces are held against
   type :: reference_type
      !> Norm of the loads so far (Psi_f)
      real(wp) :: loads = 0.0_wp
      !> Norm of forces of the increment, shape (parts, modes); zero for none
      real(wp), allocatable :: forces(:, :)
   end type reference_type

   !> The largest ratio of residual forces
   type :: strictest_type
      !> The ratio that decides, and that of the whole structure to the loads (Eq. 17)
      real(wp) :: ratio = 0.0_wp, whole = 0.0_wp
      !> Where it is: a node of the part, and place of the mode; zero if it is the whole
      integer :: node = 0, mode = 0
   end type strictest_type

   !> What the iterations left out of balance in a load step
   type :: residual_record_type
      !> Increment, and sum of the load factors
      integer :: increment = 0
      real(wp) :: load_factor = 0.0_wp
      !> Of the whole structure to the loads (Eq. 17)
      real(wp) :: whole = 0.0_wp
      !> Part by part and harmonic by harmonic to what the joints would carry of the increment,
      !> shape (parts, modes)
      real(wp), allocatable :: ratio(:, :)
   end type residual_record_type

contains

   !> Make ready to measure
   subroutine new_measure(mesh, equations, points, measure)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Joint points that can yield
      type(model_joint_point_type), intent(in) :: points(:)
      !> The measure
      type(measure_type), intent(out) :: measure

      integer, allocatable :: part(:), unknowns(:), number(:), owner(:), place(:, :, :)
      real(wp), allocatable :: coefficient(:, :, :)
      integer :: c, i, node, k

      measure%weight = points%weight
      measure%class = equations%systems(equations%system)%class
      measure%integral = circle_integral(equations%modes%harmonic)
      call solid_parts(mesh, part)
      allocate (measure%rows(size(equations%classes)), number(maxval(part)), measure%part_node(0))
      number = 0
      do k = 1, size(points)
         do i = 1, 2*points(k)%n_pairs
            node = points(k)%nodes(i)
            if (number(part(node)) > 0) cycle
            measure%part_node = [measure%part_node, node]
            number(part(node)) = size(measure%part_node)
         end do
      end do
      do c = 1, size(equations%classes)
         associate (dofs => equations%classes(c)%dofs, rows => measure%rows(c))
            call jump_rows(dofs, points, unknowns, place, coefficient)
            call leave_out_zeros(place, coefficient, rows)
            allocate (owner(dofs%n_equations), source=0)
            do node = 1, size(part)
               do i = 1, 3
                  if (dofs%equation(i, node) > 0) owner(dofs%equation(i, node)) = number(part(node))
               end do
            end do
            rows%part = owner(unknowns)
            deallocate (owner)
         end associate
      end do
   end subroutine new_measure

   !> Rows without their zeros
   pure subroutine leave_out_zeros(place, coefficient, rows)
      !> Unknown (zero for none) and factor of each jump, shape (18, 3, points)
      integer, intent(in) :: place(:, :, :)
      real(wp), intent(in) :: coefficient(:, :, :)
      !> Takes what is left
      type(rows_type), intent(inout) :: rows

      logical :: acts(size(place, 1), size(place, 2), size(place, 3))
      integer :: i, p

      acts = place > 0 .and. abs(coefficient) > 0.0_wp
      rows%unknown = pack(place, acts)
      rows%factor = pack(coefficient, acts)
      allocate (rows%first(3*size(place, 3) + 1))
      rows%first(1) = 1
      do p = 1, size(place, 3)
         do i = 1, 3
            rows%first(3*(p - 1) + i + 1) = rows%first(3*(p - 1) + i) + count(acts(:, i, p))
         end do
      end do
   end subroutine leave_out_zeros

   !> Set what the residuals of an increment are held against: the forces that its joints would
   !> carry of its load if they held, part by part in the harmonics that this load has, and of all
   !> harmonics in the others. Beside what they would carry before it, too, little is rounding: an
   !> increment that moves all parts together loads no joint
   subroutine set_reference(measure, loads, elastic, before, rounding, tolerance, reference)
      !> The measure
      type(measure_type), intent(in) :: measure
      !> Norm of the largest loads so far (Psi_f)
      real(wp), intent(in) :: loads
      !> Change of the joint stress by the increment if all joints held, shape (3, points, modes)
      real(wp), intent(in) :: elastic(:, :, :)
      !> The joint stress before it if all had held, same shape
      real(wp), intent(in) :: before(:, :, :)
      !> Joint stress that is rounding of the displacements, same shape
      real(wp), intent(in) :: rounding(:, :, :)
      !> Tolerance on the ratio
      real(wp), intent(in) :: tolerance
      !> The reference
      type(reference_type), intent(inout) :: reference

      real(wp), dimension(size(measure%part_node)) :: of_part, acting, of_rounding, least_forces
      real(wp) :: least
      integer :: k

      reference%loads = loads
      reference%forces = sqrt(squares(measure, elastic))
      of_part = sqrt(sum(reference%forces**2, 2))
      acting = sqrt(sum(squares(measure, before), 2))
      of_rounding = sqrt(sum(squares(measure, rounding), 2))
      if (norm2(of_part) <= max(resolution*norm2(acting), norm2(of_rounding))) then
         reference%forces = 0.0_wp
         return
      end if
      least = resolution/max(resolution, tolerance)
      acting = max(of_part, acting)
      least_forces = max(least*max(acting, least*maxval([0.0_wp, acting])), of_rounding/max(resolution, tolerance))
      of_part = max(of_part, least*maxval([0.0_wp, of_part]), least_forces)
      do k = 1, size(measure%integral)
         associate (forces => reference%forces(:, k))
            forces = merge(max(forces, least_forces), of_part, forces > 0.0_wp)
         end associate
      end do
   end subroutine set_reference

   !> Hold residual forces against the reference
   pure function strictest(measure, reference, residual, paper) result(found)
      !> The measure, and what is held against
      type(measure_type), intent(in) :: measure
      type(reference_type), intent(in) :: reference
      !> Amplitudes of joint stress out of balance, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> Whether the ratio of the whole decides, as in the paper, unless it hides much larger ones
      logical, intent(in) :: paper
      !> The largest ratio
      type(strictest_type) :: found

      type(residual_record_type) :: record
      integer :: place(2)

      record = ratios_of(measure, reference, residual)
      found%whole = record%whole
      found%ratio = found%whole
      if (size(record%ratio) == 0) return
      record%ratio = merge(paper_share, 1.0_wp, paper)*record%ratio
      place = maxloc(record%ratio)
      if (.not. record%ratio(place(1), place(2)) > found%whole) return
      found%ratio = record%ratio(place(1), place(2))
      found%node = measure%part_node(place(1))
      found%mode = place(2)
   end function strictest

   !> Residual forces over the reference, of the whole and part by part and harmonic by harmonic
   pure function ratios_of(measure, reference, residual) result(record)
      !> The measure, and what is held against
      type(measure_type), intent(in) :: measure
      type(reference_type), intent(in) :: reference
      !> Amplitudes of joint stress out of balance, shape (3, points, modes)
      real(wp), intent(in) :: residual(:, :, :)
      !> The ratios; those by parts are zero if the increment loads no joint
      type(residual_record_type) :: record

      real(wp), allocatable :: squared(:, :)

      squared = squares(measure, residual)
      record%whole = ratio(sqrt(sum(squared)), reference%loads)
      allocate (record%ratio, mold=squared)
      record%ratio = 0.0_wp
      if (.not. allocated(reference%forces)) return
      if (any(reference%forces > 0.0_wp)) record%ratio = ratio(sqrt(squared), reference%forces)
   end function ratios_of

   !> Norm of the residual forces r = N*^T e of joint stress: the ring forces on all equations,
   !> squared and integrated round the circle, which is the sum over m of |r_m|^2 / c_m for
   !> generalized forces r_m (Psi^r of Eq. 17)
   pure real(wp) function residual_norm(measure, stress) result(norm)
      !> The measure
      type(measure_type), intent(in) :: measure
      !> Amplitudes of that stress, shape (3, points, modes)
      real(wp), intent(in) :: stress(:, :, :)

      norm = sqrt(sum(squares(measure, stress)))
   end function residual_norm

   !> Squares of the forces of joint stress, part by part and mode by mode. Modes above those of the equations have the
   !> unknowns of the last of these
   pure function squares(measure, stress) result(squared)
      !> The measure
      type(measure_type), intent(in) :: measure
      !> Amplitudes of the stress, shape (3, points, modes)
      real(wp), intent(in) :: stress(:, :, :)
      !> Shape (parts, modes)
      real(wp) :: squared(size(measure%part_node), size(stress, 3))

      real(wp), allocatable :: force(:)
      integer :: i, k, l, p, like

      squared = 0.0_wp
      do k = 1, size(squared, 2)
         like = min(k, size(measure%class))
         associate (rows => measure%rows(measure%class(like)))
            allocate (force(size(rows%part)), source=0.0_wp)
            do p = 1, size(stress, 2)
               do i = 1, 3
                  do l = rows%first(3*(p - 1) + i), rows%first(3*(p - 1) + i + 1) - 1
                     force(rows%unknown(l)) = force(rows%unknown(l)) &
                        + measure%weight(p)*rows%factor(l)*stress(i, p, k)
                  end do
               end do
            end do
            do l = 1, size(force)
               squared(rows%part(l), k) = squared(rows%part(l), k) + measure%integral(like)*force(l)**2
            end do
            deallocate (force)
         end associate
      end do
   end function squares

   !> Norm of the loads (Psi_f of Eq. 17): of the external forces, and of those
   !> that held displacements and initial stresses give, which may balance them
   function load_norm(equations, loading) result(norm)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The loads
      type(loading_type), intent(in) :: loading
      !> The norm
      real(wp) :: norm

      real(wp) :: squared(size(equations%modes))
      integer :: k

      do k = 1, size(equations%modes)
         squared(k) = squared_parts(equations, loading, k)/circle_integral(equations%modes(k)%harmonic)
      end do
      norm = sqrt(sum(squared))
   end function load_norm

   !> Sum of the squares of the loads of a mode: external forces, and what held displacements and initial
   !> stresses make
   function squared_parts(equations, loading, k) result(squared)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Place of the mode
      integer, intent(in) :: k
      !> The sum
      real(wp) :: squared

      associate (external => loading%external(:, :, k), right => loading%right(:, :, k))
         squared = 0.0_wp
         if (.not. (is_loaded(external) .or. is_loaded(right))) return
         squared = sum(on_equations(equations, k, external)**2) &
                   + sum(on_equations(equations, k, right - external)**2)
      end associate
   end function squared_parts

   !> Whether loads balance each other in every mode, but for rounding of their own and of the mesh,
   !> before anything moves
   function balance_each_other(equations, loading) result(balance)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The loads
      type(loading_type), intent(in) :: loading
      !> Whether they do
      logical :: balance

      !> What is left of them, over them
      real(wp), parameter :: left = 1.0e-9_wp
      integer :: k

      balance = .false.
      do k = 1, size(equations%modes)
         if (sum(on_equations(equations, k, loading%right(:, :, k))**2) &
             > left**2*squared_parts(equations, loading, k)) return
      end do
      balance = .true.
   end function balance_each_other

   !> Whether there is any force: most harmonics of most jobs are not loaded
   pure logical function is_loaded(force)
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)

      integer :: i, node

      is_loaded = .true.
      do node = 1, size(force, 2)
         do i = 1, 3
            if (abs(force(i, node)) > 0.0_wp) return
         end do
      end do
      is_loaded = .false.
   end function is_loaded

   !> Quotient of two sizes; zero over zero is zero
   elemental function ratio(part, whole)
      !> Sizes, not negative
      real(wp), intent(in) :: part, whole
      !> part/whole; the largest number if only the whole is zero
      real(wp) :: ratio

      if (whole > 0.0_wp) then
         ratio = part/whole
      else
         ratio = merge(huge(1.0_wp), 0.0_wp, part > 0.0_wp)
      end if
   end function ratio

end module axijoint_joints_residual
