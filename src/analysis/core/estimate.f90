!> What a job would cost with each solver, before anything is solved
module axijoint_analysis_core_estimate
   use axijoint_analysis_core_footprint, only : footprint_type, data_footprint
   use axijoint_analysis_core_structure, only : reuses_factors
   use axijoint_assembly_equations, only : equations_type, plan_solver, planned_seconds
   use axijoint_assembly_factors, only : plan_factors, standing_bytes, parts_bytes, kept_bytes, &
                                         passing_bytes
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_model_joint_points, only : new_joint_points
   use axijoint_model_model, only : model_type
   use axijoint_model_modes, only : used_modes
   use axijoint_order_orders, only : orders_type
   use axijoint_solver_entry, only : solver_entry_type
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
      !> Factors that are there at once at most
      integer :: n_factors = 0
      !> Time of all factorizations, one after the other [second]
      real(wp) :: seconds = 0.0_wp
   end type estimate_type

   !> Program and libraries without any data while it solves; what the libraries of the output add
   !> once they are used [byte]; measured
   integer(i8), parameter :: program_bytes = 16500000_i8
   integer(i8), parameter :: output_bytes = 5500000_i8

contains

   !> Costs of a job with a solver
   subroutine estimate_job(model, orders, solver, rate, estimate, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Orders of its nodes
      type(orders_type), intent(in) :: orders
      !> The solver
      type(solver_entry_type), intent(in) :: solver
      !> Rate of large matrix products [operations/second]
      real(wp), intent(in) :: rate
      !> The costs
      type(estimate_type), intent(out) :: estimate
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(equations_type), allocatable :: equations
      type(footprint_type) :: others
      integer :: k

      call plan_solver(equations, model, used_modes(model), orders, solver, error)
      if (allocated(error)) return
      estimate%n_harmonics = size(equations%systems)
      do k = 1, size(equations%systems)
         associate (plan => equations%plans(equations%systems(k)%class)%solver)
            estimate%n_equations = estimate%n_equations + plan%n
            estimate%factor_entries = estimate%factor_entries + plan%factor_entries
            estimate%operations = estimate%operations + plan%operations
         end associate
      end do
      estimate%seconds = planned_seconds(equations, reuses_factors(model), rate)
      others = data_footprint(model, size(equations%modes), size(equations%systems), &
                              new_joint_points(model))
      call plan_factors(equations, reuses_factors(model), others%coming(), model%memory_limit, &
         error)
      if (allocated(error)) deallocate (error)  ! it is told all the same
      associate (n => size(equations%systems))
         estimate%n_factors = equations%n_kept + min(equations%n_workers, n - equations%n_kept)
      end associate
      estimate%bytes = program_bytes + solver%library_bytes + others%mesh + &
         standing_bytes(equations) + parts_bytes(equations) &
         + kept_bytes(equations) + others%joints + others%fine &
         + max(passing_bytes(equations) + others%loads + others%fine_work*equations%n_workers, &
               others%joint_work*equations%n_workers, &
               output_bytes + others%loads + others%stresses)
   end subroutine estimate_job

end module axijoint_analysis_core_estimate
