!> The equations of all harmonics: matrices, factors, solution
module axijoint_assembly_equations
   use axijoint_assembly_dofs, only : gather, expand, kinematic_class, component_name
   use axijoint_assembly_pattern, only : node_graph
   use axijoint_assembly_stiffness, only : stiffness_type, new_stiffness, assemble_parts, &
                                           harmonic_matrix
   use axijoint_base_error, only : error_type, fatal_error, exit_singular
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : require_memory
   use axijoint_base_text, only : to_text
   use axijoint_linalg_symmetric_matrix, only : symmetric_matrix_type, multiply, infinity_norm
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type, on_axis
   use axijoint_order_graph, only : graph_type
   use axijoint_order_rcm, only : reverse_cuthill_mckee
   use axijoint_solver_band, only : band_solver_type
   use axijoint_solver_type, only : factor_type, pivot_report_type
   implicit none
   private
   public :: equations_type, new_equations, factorize_equations, solve_harmonic, elastic_force
   public :: backward_error, on_equations

   !> Factor of one harmonic
   type :: factor_slot_type
      !> The factor
      class(factor_type), allocatable :: factor
   end type factor_slot_type

   !> Equations of the harmonics in use
   type :: equations_type
      !> Harmonics m, ascending
      integer, allocatable :: harmonics(:)
      !> Class of each harmonic: its place in `classes` and `plans`
      integer, allocatable :: class(:)
      !> Unknowns and sparsity of the classes; parts are dropped once the
      !> matrices stand
      type(stiffness_type), allocatable :: classes(:)
      !> Plans of the solver, one a class
      type(band_solver_type), allocatable :: plans(:)
      !> K_m of each harmonic
      type(symmetric_matrix_type), allocatable :: matrices(:)
      !> Factors of each harmonic
      type(factor_slot_type), allocatable :: slots(:)
      !> Pivots of each harmonic
      type(pivot_report_type), allocatable :: pivots(:)
   end type equations_type

contains

   !> Number the unknowns and assemble the matrices of all harmonics
   subroutine new_equations(equations, model, joint_points, harmonics, error)
      !> The equations, not yet factored
      type(equations_type), intent(out) :: equations
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: joint_points(:)
      !> Harmonics m, ascending
      integer, intent(in) :: harmonics(:)
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(graph_type) :: graph
      integer, allocatable :: order(:), kinds(:)
      integer :: k, n_classes

      graph = node_graph(model%mesh)
      call reverse_cuthill_mckee(graph, order)

      kinds = kinematic_class(harmonics, any(on_axis(model%mesh)))
      equations%harmonics = harmonics
      allocate (equations%class(size(harmonics)))
      n_classes = 0
      do k = 1, size(harmonics)  ! ascending harmonics have ascending kinds
         if (k == 1) then
            n_classes = 1
         else if (kinds(k) /= kinds(k - 1)) then
            n_classes = n_classes + 1
         end if
         equations%class(k) = n_classes
      end do

      allocate (equations%classes(n_classes), equations%plans(n_classes))
      do k = 1, n_classes
         call new_stiffness(equations%classes(k), model, &
                            harmonics(findloc(equations%class, k, 1)), graph, order)
         call equations%plans(k)%analyse(equations%classes(k)%pattern, error)
         if (allocated(error)) return
      end do
      call require_memory(needed_bytes(equations), 'the factors of '// &
                          to_text(size(harmonics))//' harmonics', error)
      if (allocated(error)) return
      call assemble_parts(equations%classes, model, joint_points)
      allocate (equations%matrices(size(harmonics)))
      do k = 1, size(harmonics)
         call harmonic_matrix(equations%classes(equations%class(k)), harmonics(k), &
                              equations%matrices(k))
      end do
      do k = 1, n_classes
         deallocate (equations%classes(k)%parts)
      end do
   end subroutine new_equations

   !> Bytes of all matrices and factors
   pure function needed_bytes(equations) result(bytes)
      !> The equations, analysed
      type(equations_type), intent(in) :: equations
      !> Bytes
      integer(i8) :: bytes

      !> Bytes of an entry of a matrix: a real and its column
      integer(i8), parameter :: entry_bytes = (storage_size(1.0_wp) + storage_size(1))/8
      integer :: k

      bytes = 0
      do k = 1, size(equations%harmonics)
         associate (class => equations%class(k))
            bytes = bytes + equations%plans(class)%factor_bytes &
               + entry_bytes*size(equations%classes(class)%pattern%column, kind=i8)
         end associate
      end do
   end function needed_bytes

   !> Factor the matrices of all harmonics
   subroutine factorize_equations(equations, model, error)
      !> The equations
      type(equations_type), intent(inout) :: equations
      !> The job, for the words of an error
      type(model_type), intent(in) :: model
      !> Out of memory; a pivot that is not positive, as node and direction
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      allocate (equations%slots(size(equations%harmonics)))
      allocate (equations%pivots(size(equations%harmonics)))
      do k = 1, size(equations%harmonics)
         associate (pivots => equations%pivots(k))
            call equations%plans(equations%class(k))%factorize(equations%matrices(k), &
                                                       equations%slots(k)%factor, pivots, error)
            if (allocated(error)) return
            if (pivots%equation == 0) cycle
            call fatal_error(error, exit_singular, &
                             pivot_message(equations, k, pivots%equation, model))
            return
         end associate
      end do
   end subroutine factorize_equations

   !> A pivot that is not positive, in words
   function pivot_message(equations, k, equation, model) result(message)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Equation of the pivot
      integer, intent(in) :: equation
      !> The job
      type(model_type), intent(in) :: model
      !> Cause and remedy
      character(len=:), allocatable :: message

      integer :: place(2)

      place = findloc(equations%classes(equations%class(k))%dofs%equation, equation)
      message = 'the stiffness of harmonic '//to_text(equations%harmonics(k))// &
                ' is singular: node '//to_text(model%mesh%node_label(place(2)))// &
                ' (r = '//to_text(model%mesh%coordinates(1, place(2)))// &
                ', z = '//to_text(model%mesh%coordinates(2, place(2)))// &
                ') can move freely in direction '//trim(component_name(place(1)))//new_line('a')// &
                'mend: is a restraint missing, is a joint stiffness zero or far below '// &
                'that of the bodies, or is a material far softer than the rest?'
   end function pivot_message

   !> Displacement of one harmonic under nodal forces
   subroutine solve_harmonic(equations, k, force, displacement)
      !> The equations, factored
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(out) :: displacement(:, :)

      real(wp), allocatable :: b(:, :)

      associate (dofs => equations%classes(equations%class(k))%dofs)
         allocate (b(dofs%n_equations, 1))
         b(:, 1) = gather(dofs, force)
         call equations%slots(k)%factor%solve(b)
         displacement = expand(dofs, b(:, 1))
      end associate
   end subroutine solve_harmonic

   !> Forces on the equations of one harmonic, from forces on components
   function on_equations(equations, k, force) result(vector)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Forces on equations
      real(wp), allocatable :: vector(:)

      vector = gather(equations%classes(equations%class(k))%dofs, force)
   end function on_equations

   !> Forces K_m u of the elastic structure, joints sticking, on the equations
   function elastic_force(equations, k, displacement) result(force)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Forces, shape (n_equations)
      real(wp), allocatable :: force(:)

      force = multiply(equations%matrices(k), on_unknowns(equations, k, displacement))
   end function elastic_force

   !> Values of the unknowns from displacement components
   function on_unknowns(equations, k, displacement) result(vector)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Unknowns, shape (n_equations)
      real(wp), allocatable :: vector(:)

      integer :: node, i

      associate (dofs => equations%classes(equations%class(k))%dofs)
         allocate (vector(dofs%n_equations))
         do node = 1, size(displacement, 2)
            do i = 1, 3
               if (dofs%equation(i, node) > 0) then
                  vector(dofs%equation(i, node)) = dofs%factor(i, node)*displacement(i, node)
               end if
            end do
         end do
      end associate
   end function on_unknowns

   !> Backward error |b - K u| / (|K| |u| + |b|) of one harmonic, maximum norms
   function backward_error(equations, k, force, displacement) result(ratio)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the harmonic
      integer, intent(in) :: k
      !> Forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> Backward error; zero without loads
      real(wp) :: ratio

      real(wp), allocatable :: b(:)
      real(wp) :: scale

      b = on_equations(equations, k, force)
      scale = infinity_norm(equations%matrices(k))*maxval(abs(displacement)) &
         + maxval([0.0_wp, abs(b)])
      ratio = 0.0_wp
      if (scale > 0.0_wp) then
         ratio = maxval([0.0_wp, abs(b - elastic_force(equations, k, displacement))])/scale
      end if
   end function backward_error

end module axijoint_assembly_equations
