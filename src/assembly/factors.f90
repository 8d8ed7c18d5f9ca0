!> Factors of the harmonics: as many at once as memory allows, each for as long as it is needed
module axijoint_assembly_factors
   use omp_lib, only : omp_get_max_threads, omp_get_num_threads, omp_get_thread_num, omp_in_parallel
   use axijoint_assembly_dofs, only : component_name
   use axijoint_assembly_equations, only : equations_type, system_type, worth_threads, growth
   use axijoint_assembly_harmonic, only : harmonic_values
   use axijoint_assembly_stiffness, only : n_parts, has_sparsity
   use axijoint_base_error, only : error_type, fatal_error, exit_singular
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_stop, only : stop_wished, check_stop
   use axijoint_base_large_pages, only : use_large_pages
   use axijoint_base_memory, only : require_memory, free_memory, give_back_memory
   use axijoint_base_text, only : to_text
   use axijoint_fe_element_kind, only : is_reduced, reduced_hint
   use axijoint_linalg_lapack, only : use_one_blas_thread
   use axijoint_linalg_symmetric_matrix, only : infinity_norm
   use axijoint_model_model, only : model_type
   use axijoint_solver_type, only : factor_type
   implicit none
   private
   public :: workspace_type, new_workspaces, own, plan_factors, factorize_equations
   public :: factor_together, hold_factor, release_factor, report_failure
   public :: standing_bytes, parts_bytes, kept_bytes, passing_bytes

   !> Bytes of a value
   integer(i8), parameter :: value_bytes = storage_size(1.0_wp)/8

   !> Memory of one thread that factors one harmonic after the other
   type :: workspace_type
      private
      !> Values of a matrix
      real(wp), allocatable :: value(:)
      !> A factor that is not needed any more, and its class: memory for the next
      class(factor_type), allocatable :: spare
      integer :: class = 0
   end type workspace_type

contains

   !> Decide how many factors are kept and how many harmonics are worked on at once: as many as
   !> are wanted and fit. The harmonics whose factors are not kept are factored anew whenever they
   !> are solved; results do not depend on it.
   subroutine plan_factors(equations, keep, other_bytes, thread_bytes, later_bytes, limit, error)
      !> The equations, planned
      type(equations_type), intent(inout) :: equations
      !> Whether factors are needed more than once, so that keeping them saves time
      logical, intent(in) :: keep
      !> Bytes that the job takes besides: always, each thread that solves, and once all is solved
      integer(i8), intent(in) :: other_bytes, thread_bytes, later_bytes
      !> Bytes that the process may take in all
      integer(i8), intent(in) :: limit
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      integer(i8) :: found

      associate (n => equations%last - equations%first + 1)
         equations%n_workers = 1
         if (worth_threads(equations) .and. equations%solver%concurrent) then
            equations%n_workers = max(1, min(omp_get_max_threads(), n))
         end if
         equations%n_kept = merge(n, 0, keep)
      end associate
      found = free_memory(limit, equations%team%sharers)
      if (wanted() > found) then
         call give_back_memory()  ! what jobs before this one freed
         found = free_memory(limit, equations%team%sharers)
      end if
      do while (wanted() > found)
         if (equations%n_kept > 0) then
            equations%n_kept = equations%n_kept - 1
         else if (equations%n_workers > 1) then
            equations%n_workers = equations%n_workers - 1
         else
            exit
         end if
      end do
      call require_memory(wanted(), 'the factor of one harmonic and the results', limit, error, &
                          equations%team%sharers, found)

   contains

      !> Bytes as planned so far
      integer(i8) function wanted()

         wanted = parts_bytes(equations) + kept_bytes(equations) + other_bytes &
            + max(passing_bytes(equations) + thread_bytes*equations%n_workers, later_bytes)
      end function wanted

   end subroutine plan_factors

   !> Bytes of patterns and plans, which stand once the equations are planned
   pure integer(i8) function standing_bytes(equations) result(bytes)
      !> The equations, planned
      type(equations_type), intent(in) :: equations

      integer(i8), parameter :: column_bytes = storage_size(1)/8
      integer :: k

      bytes = 0
      do k = 1, size(equations%classes)
         if (.not. has_sparsity(equations%classes(k))) cycle
         bytes = bytes + column_bytes*size(equations%classes(k)%pattern%column, kind=i8) &
            + equations%plans(k)%solver%plan_bytes
      end do
   end function standing_bytes

   !> Bytes of the stiffness of all classes
   pure integer(i8) function parts_bytes(equations) result(bytes)
      !> The equations, planned
      type(equations_type), intent(in) :: equations

      integer :: k

      bytes = 0
      do k = 1, size(equations%classes)
         if (.not. has_sparsity(equations%classes(k))) cycle
         bytes = bytes + value_bytes*n_parts(equations%classes(k)) &
            *size(equations%classes(k)%pattern%column, kind=i8)
      end do
   end function parts_bytes

   !> Bytes of the factors that are kept
   pure integer(i8) function kept_bytes(equations) result(bytes)
      !> The equations, planned
      type(equations_type), intent(in) :: equations

      integer :: s

      bytes = 0
      do s = equations%first, equations%first + equations%n_kept - 1
         bytes = bytes + equations%plans(equations%systems(s)%class)%solver%factor_bytes
      end do
   end function kept_bytes

   !> Bytes of the factors that are made, used and given up, by all threads at once, with what
   !> factoring takes besides
   pure integer(i8) function passing_bytes(equations) result(bytes)
      !> The equations, planned
      type(equations_type), intent(in) :: equations

      integer(i8) :: work, largest
      integer :: s

      work = 0
      largest = 0
      do s = equations%first, equations%last
         associate (class => equations%systems(s)%class)
            associate (solver => equations%plans(class)%solver)
               work = max(work, solver%work_bytes &
                          + value_bytes*size(equations%classes(class)%pattern%column, kind=i8))
               if (.not. is_kept(equations, s)) largest = max(largest, solver%factor_bytes)
            end associate
         end associate
      end do
      bytes = work*equations%n_workers &
         + largest*min(equations%n_workers, &
                       equations%last - equations%first + 1 - equations%n_kept)
   end function passing_bytes

   !> Whether a system keeps its factor
   pure logical function is_kept(equations, s)
      !> The equations, planned
      type(equations_type), intent(in) :: equations
      !> Place of the system
      integer, intent(in) :: s

      is_kept = s < equations%first + equations%n_kept
   end function is_kept

   !> Memory for all threads of a loop over systems, each of which calls BLAS by itself
   subroutine new_workspaces(equations, spaces)
      !> The equations, planned
      type(equations_type), intent(in) :: equations
      !> One a thread; within a region of threads one for each of these
      type(workspace_type), allocatable, intent(out) :: spaces(:)

      call use_one_blas_thread()
      allocate (spaces(merge(omp_get_num_threads(), equations%n_workers, omp_in_parallel())))
   end subroutine new_workspaces

   !> Place of this thread's workspace
   integer function own()
      own = omp_get_thread_num() + 1
   end function own

   !> Form and factor the matrices of the harmonics whose factors are kept, one harmonic a thread
   subroutine factorize_equations(equations, model, error)
      !> The equations
      type(equations_type), intent(inout) :: equations
      !> The job, for the words of an error
      type(model_type), intent(in) :: model
      !> Out of memory; a pivot that is not positive, as node and direction
      type(error_type), allocatable, intent(out) :: error

      type(workspace_type), allocatable :: spaces(:)
      integer :: s
      logical :: made

      call new_workspaces(equations, spaces)
      call factor_together(equations, equations%first + equations%n_kept - 1, 1.0_wp, spaces(1), size(spaces), made)
      !$omp parallel do schedule(dynamic) num_threads(size(spaces))
      do s = equations%first, equations%first + equations%n_kept - 1
         if (stop_wished()) cycle
         call hold_factor(equations, s, spaces(own()))
      end do
      !$omp end parallel do
      call report_failure(equations, model, error)
      call check_stop(error)
   end subroutine factorize_equations

   !> Factor the last of the systems up to one by all threads together, if that is sooner done than where threads wait for the one
   !> that has it alone
   subroutine factor_together(equations, last, part, space, n_threads, made)
      !> The equations
      type(equations_type), intent(inout) :: equations
      !> Place of the last of those that threads take one after the other
      integer, intent(in) :: last
      !> Part that factorization has of what is done to each
      real(wp), intent(in) :: part
      !> Memory of this thread
      type(workspace_type), intent(inout) :: space
      !> Threads
      integer, intent(in) :: n_threads
      !> Whether it was
      logical, intent(out) :: made

      !> What threads gain together over what they do apart; time that is worth the while, over all; and the least equations
      real(wp), parameter :: together = 0.85_wp, worth = 0.97_wp
      integer, parameter :: least_equations = 6000
      real(wp) :: cost(equations%first:last)
      integer :: s

      made = .false.
      if (n_threads == 1 .or. last < equations%first) return
      if (allocated(equations%systems(last)%factor)) return
      cost = [(real(equations%classes(equations%systems(s)%class)%dofs%n_equations, wp), s=equations%first, last)]
      if (cost(last) < least_equations) return
      cost = cost**growth
      associate (ahead => part*cost(last)/(together*n_threads), left => (1.0_wp - part)*cost(last))
         made = ahead + duration([left, cost(:last - 1)], n_threads) < worth*duration(cost, n_threads)
      end associate
      if (made) call hold_factor(equations, last, space)
   end subroutine factor_together

   !> How long threads take that take the next system whenever they have done one
   pure real(wp) function duration(cost, n_threads)
      !> Time that one thread takes for each
      real(wp), intent(in) :: cost(:)
      !> Threads
      integer, intent(in) :: n_threads

      real(wp) :: busy(n_threads)
      integer :: s, thread

      busy = 0.0_wp
      do s = 1, size(cost)
         thread = minloc(busy, 1)
         busy(thread) = busy(thread) + cost(s)
      end do
      duration = maxval(busy)
   end function duration

   !> Make sure that the factor of a system is there. If it cannot be, the system has failed;
   !> `report_failure` puts that into words
   subroutine hold_factor(equations, s, space)
      !> The equations, assembled
      type(equations_type), intent(inout) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Memory of the thread
      type(workspace_type), intent(inout) :: space

      associate (system => equations%systems(s))
         if (allocated(system%factor) .or. system%failed) return
         if (allocated(space%spare)) then
            if (space%class == system%class) then
               call move_alloc(space%spare, system%factor)
            else
               deallocate (space%spare)
            end if
         end if
         call factorize_system(equations, system, .not. is_kept(equations, s), space%value)
         system%failed = allocated(system%failure) .or. system%pivots%equation > 0
         if (system%failed .and. allocated(system%factor)) deallocate (system%factor)
      end associate
   end subroutine hold_factor

   !> Give a factor up unless it is kept; its memory serves the next one of the thread
   subroutine release_factor(equations, s, space)
      !> The equations
      type(equations_type), intent(inout) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> Memory of the thread
      type(workspace_type), intent(inout) :: space

      associate (system => equations%systems(s))
         if (is_kept(equations, s) .or. .not. allocated(system%factor)) return
         space%class = system%class
         call move_alloc(system%factor, space%spare)
      end associate
   end subroutine release_factor

   !> Form and factor the matrix of one system
   subroutine factorize_system(equations, system, passing, value)
      !> The equations, assembled
      type(equations_type), intent(in) :: equations
      !> The system
      type(system_type), intent(inout) :: system
      !> Whether the memory of the factor will be used again
      logical, intent(in) :: passing
      !> Values of a matrix: memory to be used again
      real(wp), allocatable, intent(inout) :: value(:)

      associate (class => equations%classes(system%class))
         if (allocated(value)) then
            if (size(value) /= size(class%pattern%column)) deallocate (value)
         end if
         if (.not. allocated(value)) then
            allocate (value(size(class%pattern%column)))
            call use_large_pages(value)
         end if
         call harmonic_values(class, system%harmonic, value)
         system%norm = infinity_norm(class%pattern, value)
         call equations%plans(system%class)%solver%factorize(class%pattern, value, system%factor, &
                                                             system%pivots, system%failure, passing)
      end associate
   end subroutine factorize_system

   !> The failure of the lowest harmonic that has one: the same with any number of threads and ranks
   subroutine report_failure(equations, model, error)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> The job, for the words
      type(model_type), intent(in) :: model
      !> Out of memory; a pivot that is not positive, as node and direction
      type(error_type), allocatable, intent(out) :: error

      integer :: s

      s = findloc(equations%systems%failed, .true., 1)
      if (s > 0) then
         if (allocated(equations%systems(s)%failure)) then
            error = equations%systems(s)%failure
         else
            call fatal_error(error, exit_singular, pivot_message(equations, s, model))
         end if
      end if
      call equations%team%agree(error)
   end subroutine report_failure

   !> A pivot that is not positive, in words
   function pivot_message(equations, s, model) result(message)
      !> The equations
      type(equations_type), intent(in) :: equations
      !> Place of the system
      integer, intent(in) :: s
      !> The job
      type(model_type), intent(in) :: model
      !> Cause and remedy
      character(len=:), allocatable :: message

      integer :: place(2)

      associate (system => equations%systems(s))
         place = findloc(equations%classes(system%class)%dofs%equation, system%pivots%equation)
         message = 'the stiffness of harmonic '//to_text(system%harmonic)// &
                   ' is singular: node '//to_text(model%mesh%node_label(place(2)))// &
                   ' (r = '//to_text(model%mesh%coordinates(1, place(2)))// &
                   ', z = '//to_text(model%mesh%coordinates(2, place(2)))// &
                   ') can move freely in direction '//trim(component_name(place(1)))// &
                   new_line('a')// &
                   'mend: is a restraint missing, a joint stiffness zero, or a stiffness, or a length beside a '// &
                   'thickness, out of all proportion to the rest?'
         if (any(is_reduced(model%mesh%kinds))) message = message//new_line('a')//'      '//reduced_hint
      end associate
   end function pivot_message

end module axijoint_assembly_factors
