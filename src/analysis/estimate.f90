!> What a job would cost with each solver, before anything is solved
module axijoint_analysis_estimate
   use axijoint_assembly_equations, only : equations_type, plan_solver, planned_seconds, needed_bytes
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_fe_reference, only : reference_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, element_references
   use axijoint_model_modes, only : used_modes
   use axijoint_solver_choice, only : orders_type
   implicit none
   private
   public :: estimate_type, estimate_job

   !> Costs of a job with one solver
   type :: estimate_type
      !> Number of harmonics
      integer :: n_harmonics = 0
      !> Equations of all harmonics together
      integer(i8) :: n_equations = 0
      !> Entries of all factors together
      integer(i8) :: factor_entries = 0
      !> Floating-point operations of all factorizations
      real(wp) :: operations = 0.0_wp
      !> Bytes at the peak
      integer(i8) :: bytes = 0
      !> Time of all factorizations, one after the other [second]
      real(wp) :: seconds = 0.0_wp
   end type estimate_type

   !> Bytes of a real
   integer(i8), parameter :: real_bytes = storage_size(1.0_wp)/8
   !> Program and libraries without any data [byte]
   integer(i8), parameter :: program_bytes = 22000000_i8

contains

   !> Costs of a job with a solver
   subroutine estimate_job(model, orders, kind, rate, estimate, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Orders of its nodes
      type(orders_type), intent(in) :: orders
      !> Solver, one of the `solver_` parameters, not auto
      integer, intent(in) :: kind
      !> Rate of large matrix products [operations/second]
      real(wp), intent(in) :: rate
      !> The costs
      type(estimate_type), intent(out) :: estimate
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(equations_type), allocatable :: equations
      integer :: k

      call plan_solver(equations, model, used_modes(model), orders, kind, error)
      if (allocated(error)) return
      estimate%n_harmonics = size(equations%systems)
      do k = 1, size(equations%systems)
         associate (solver => equations%plans(equations%systems(k)%class)%solver)
            estimate%n_equations = estimate%n_equations + solver%n
            estimate%factor_entries = estimate%factor_entries + solver%factor_entries
            estimate%operations = estimate%operations + solver%operations
         end associate
      end do
      estimate%seconds = planned_seconds(equations, rate)
      estimate%bytes = program_bytes + needed_bytes(equations) &
         + field_bytes(model, size(equations%modes))
   end subroutine estimate_job

   !> Bytes of displacements, forces, reactions and stresses
   pure function field_bytes(model, n_modes) result(bytes)
      !> The job
      type(model_type), intent(in) :: model
      !> Number of modes
      integer, intent(in) :: n_modes
      !> The bytes
      integer(i8) :: bytes

      type(reference_type) :: references(3:9)

      references = element_references(model)
      bytes = 12*int(n_nodes(model%mesh), i8)  ! displacements, loads twice, reactions
      bytes = bytes + 6*sum(int(references(model%mesh%element_size)%n_points, i8))
      bytes = bytes + 6*int(n_nodes(model%mesh), i8)  ! stresses smoothed to them
      bytes = bytes*n_modes*real_bytes
   end function field_bytes

end module axijoint_analysis_estimate
