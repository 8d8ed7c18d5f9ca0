!> The elastic structure as an operator on vectors that hold the unknowns of all modes, one mode
!> after the other
module axijoint_plastic_elastic
   use axijoint_assembly_dofs, only : gather, expand, collect
   use axijoint_assembly_equations, only : equations_type
   use axijoint_assembly_factors, only : workspace_type, new_workspaces, own, hold_factor, &
      release_factor
   use axijoint_assembly_harmonic, only : harmonic_product
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   implicit none
   private
   public :: n_unknowns, pushed_modes, to_vector, from_nodes, to_nodes, stiff_force, elastic_response, ring_norm

contains

   !> Unknowns of all modes
   pure integer function n_unknowns(equations)
      !> The equations
      type(equations_type), intent(in) :: equations

      integer :: last(0:size(equations%modes))

      last = last_unknowns(equations)
      n_unknowns = last(size(equations%modes))
   end function n_unknowns

   !> Last unknown of each mode, shape (0:modes)
   pure function last_unknowns(equations) result(last)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The places
      integer :: last(0:size(equations%modes))

      integer :: k

      last(0) = 0
      do k = 1, size(equations%modes)
         associate (class => equations%systems(equations%system(k))%class)
            last(k) = last(k - 1) + equations%classes(class)%dofs%n_equations
         end associate
      end do
   end function last_unknowns

   !> Forces on the unknowns of all modes
   pure function to_vector(equations, force) result(vector)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Forces on components, shape (3, nodes, modes)
      real(wp), intent(in) :: force(:, :, :)
      !> The forces
      real(wp), allocatable :: vector(:)

      integer :: last(0:size(equations%modes)), k

      last = last_unknowns(equations)
      allocate (vector(last(size(equations%modes))))
      do k = 1, size(equations%modes)
         associate (class => equations%systems(equations%system(k))%class)
            vector(last(k - 1) + 1:last(k)) = gather(equations%classes(class)%dofs, force(:, :, k))
         end associate
      end do
   end function to_vector

   !> Unknowns of all modes from displacements
   pure function from_nodes(equations, displacement) result(vector)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Amplitudes, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> The unknowns
      real(wp), allocatable :: vector(:)

      integer :: last(0:size(equations%modes)), k

      last = last_unknowns(equations)
      allocate (vector(last(size(equations%modes))))
      do k = 1, size(equations%modes)
         associate (class => equations%systems(equations%system(k))%class)
            vector(last(k - 1) + 1:last(k)) = collect(equations%classes(class)%dofs, &
               displacement(:, :, k))
         end associate
      end do
   end function from_nodes

   !> Displacements of one mode from the unknowns of all
   pure function to_nodes(equations, vector, k) result(displacement)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The unknowns
      real(wp), intent(in) :: vector(:)
      !> Place of the mode
      integer, intent(in) :: k
      !> Amplitudes, shape (3, nodes); zero where they are held
      real(wp), allocatable :: displacement(:, :)

      integer :: last(0:size(equations%modes))

      last = last_unknowns(equations)
      associate (class => equations%systems(equations%system(k))%class)
         displacement = expand(equations%classes(class)%dofs, vector(last(k - 1) + 1:last(k)))
      end associate
   end function to_nodes

   !> Forces K u of the elastic structure in all modes
   function stiff_force(equations, vector) result(force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The unknowns u
      real(wp), intent(in) :: vector(:)
      !> K u
      real(wp) :: force(size(vector))

      integer :: last(0:size(equations%modes)), k

      last = last_unknowns(equations)
      do k = 1, size(equations%modes)
         associate (system => equations%systems(equations%system(k)))
            force(last(k - 1) + 1:last(k)) = harmonic_product(equations%classes(system%class), &
               system%harmonic, vector(last(k - 1) + 1:last(k)))
         end associate
      end do
   end function stiff_force

   !> Response K^-1 f of the elastic structure in all modes
   subroutine elastic_response(equations, force, response)
      !> The equations, assembled; systems that cannot be factored are marked there
      type(equations_type), intent(inout) :: equations
      !> The forces f
      real(wp), intent(in) :: force(:)
      !> K^-1 f
      real(wp), intent(out) :: response(:)

      type(workspace_type), allocatable :: spaces(:)
      real(wp), allocatable :: b(:, :)  ! threads have small stacks
      integer :: last(0:size(equations%modes)), s, i

      last = last_unknowns(equations)
      response = 0.0_wp
      call new_workspaces(equations, spaces)
      !$omp parallel do schedule(dynamic) private(i, b) num_threads(size(spaces))
      do s = 1, size(equations%systems)
         call hold_factor(equations, s, spaces(own()))
         if (equations%systems(s)%failed) cycle
         associate (modes => equations%systems(s)%modes)
            allocate (b(last(modes(1)) - last(modes(1) - 1), size(modes)))
            do i = 1, size(modes)
               b(:, i) = force(last(modes(i) - 1) + 1:last(modes(i)))
            end do
            call equations%systems(s)%factor%solve(b)
            do i = 1, size(modes)
               response(last(modes(i) - 1) + 1:last(modes(i))) = b(:, i)
            end do
            deallocate (b)
         end associate
         call release_factor(equations, s, spaces(own()))
      end do
      !$omp end parallel do
   end subroutine elastic_response

   !> Modes in which forces act, not by rounding alone
   pure function pushed_modes(equations, force) result(pushed)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Forces on the unknowns
      real(wp), intent(in) :: force(:)
      !> Shape (modes)
      logical :: pushed(size(equations%modes))

      !> Part of the largest force that is rounding
      real(wp), parameter :: rounding = 1.0e-10_wp
      integer :: last(0:size(equations%modes)), k

      last = last_unknowns(equations)
      do k = 1, size(pushed)
         pushed(k) = any(abs(force(last(k - 1) + 1:last(k))) > rounding*maxval(abs(force)))
      end do
   end function pushed_modes

   !> Norm of forces on the unknowns: the forces on rings, squared and integrated round the circle
   pure real(wp) function ring_norm(equations, force) result(norm)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The forces
      real(wp), intent(in) :: force(:)

      integer :: last(0:size(equations%modes)), k

      last = last_unknowns(equations)
      norm = 0.0_wp
      do k = 1, size(equations%modes)
         norm = norm + sum(force(last(k - 1) + 1:last(k))**2) &
            /circle_integral(equations%modes(k)%harmonic)
      end do
      norm = sqrt(norm)
   end function ring_norm

end module axijoint_plastic_elastic
