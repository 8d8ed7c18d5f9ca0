!> What joints cost beside an elastic solution of the same harmonics, and the
!> paper's loop done the classical way, a back-substitution of the whole field in
!> every sweep, to the same residual. Writes one line of comma-separated values.
!>
!> Usage: classical ELASTIC DECK RUNS
!>
!> ELASTIC is DECK with joints that do not yield, loaded in all harmonics. Times
!> are the least of so many runs of each, one after the other in turn.
program classical
   use, intrinsic :: iso_fortran_env, only : output_unit
   use axijoint_analysis_core_results, only : results_type, mode_solve_type
   use axijoint_analysis_core_solution, only : solve_displacements
   use axijoint_analysis_core_structure, only : structure_type, build_structure
   use axijoint_analysis_static, only : analyse_model
   use axijoint_assembly_equations, only : solve_mode, worth_threads
   use axijoint_assembly_force, only : joint_force, joint_jump
   use axijoint_assembly_loading, only : loading_type, new_loading
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : progress_type
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type, phase_assemble, phase_factor, phase_joints
   use axijoint_bench_measure, only : seconds, stop_on, fail
   use axijoint_deck_reader, only : read_deck
   use axijoint_deck_text_diagnostics, only : diagnostics_type
   use axijoint_deck_text_source, only : source_type
   use axijoint_joints_field, only : joint_field_type, admit_jump
   use axijoint_joints_history, only : history_type, new_state
   use axijoint_joints_increments, only : run_increments
   use axijoint_joints_planes, only : synthesize, analyse
   use axijoint_joints_residual, only : residual_norm, load_norm, ratio
   use axijoint_joints_scene, only : scene_type, new_scene, views
   use axijoint_linalg_lapack, only : use_one_blas_thread
   use axijoint_model_model, only : model_type
   implicit none

   !> More sweeps are not made
   integer, parameter :: most_sweeps = 20000

   type(model_type), target :: elastic, model
   type(timer_type) :: timer, elastic_timer
   real(wp) :: best(2), alone(2), loop, displacement_difference
   type(results_type) :: results
   real(wp), allocatable :: field_of_loop(:, :, :)
   character(len=:), allocatable :: word
   integer :: runs, k, n_sweeps, stat

   call use_one_blas_thread()
   call read_model(1, elastic)
   call read_model(2, model)
   word = argument(3)
   read (word, *, iostat=stat) runs
   if (stat /= 0) call fail('the third argument is the number of runs')
   best = huge(1.0_wp)
   alone = huge(1.0_wp)
   do k = 1, runs
      alone = min(alone, [solution_time(elastic), solution_time(model)])
      call time_analysis(elastic, best(1), elastic_timer)
      call time_analysis(model, best(2), timer)
   end do
   call run_loop()
   displacement_difference = maxval(abs(field_of_loop - results%displacement))/maxval(abs(results%displacement))
   write (output_unit, '(a)') 'elastic_s,elastic_assemble_factor_s,joints_s,all_s,joints_phase_s,iterations,'// &
      'residual,sweeps,loop_s,difference,elastic_alone_s,joints_alone_s'
   write (output_unit, '(a)') to_text(best(1))//','// &
      to_text(elastic_timer%seconds(phase_assemble) + elastic_timer%seconds(phase_factor))//','// &
      to_text(best(2) - best(1))//','//to_text(best(2))//','//to_text(timer%seconds(phase_joints))//','// &
      to_text(size(results%path))//','//to_text(results%residual_ratio)//','//to_text(n_sweeps)//','// &
      to_text(loop)//','//to_text(displacement_difference)//','//to_text(alone(1))//','//to_text(alone(2))

contains

   !> An argument of the command line
   function argument(k) result(text)
      !> Its place
      integer, intent(in) :: k
      !> The argument
      character(len=:), allocatable :: text

      integer :: length

      call get_command_argument(k, length=length)
      allocate (character(len=length) :: text)
      call get_command_argument(k, text)
   end function argument

   !> Read the deck of an argument
   subroutine read_model(k, model)
      !> Place of the argument
      integer, intent(in) :: k
      !> The job
      type(model_type), intent(out) :: model

      type(source_type) :: source
      type(diagnostics_type) :: diagnostics

      call read_deck(argument(k), source, model, diagnostics)
      if (diagnostics%n_errors > 0) call fail(argument(k)//' has errors')
   end subroutine read_model

   !> Analyse once; keep the least time
   subroutine time_analysis(model, best, best_timer)
      !> The job
      type(model_type), intent(in), target :: model
      !> Least time so far [second], and the phases of that run
      real(wp), intent(inout) :: best
      type(timer_type), intent(inout) :: best_timer

      type(timer_type) :: timer
      type(progress_type) :: progress
      type(error_type), allocatable :: error
      real(wp) :: start, time

      call timer%start()
      start = seconds()
      call analyse_model(model, results, timer, progress, error)
      time = seconds() - start
      call stop_on(error)
      if (time >= best) return
      best = time
      best_timer = timer
   end subroutine time_analysis

   !> Time of the solution alone: assembly, factorization, joints, displacements; no recovery of
   !> stresses, no estimates of errors [second]
   real(wp) function solution_time(model) result(time)
      !> The job
      type(model_type), intent(in), target :: model

      type(structure_type) :: structure
      type(timer_type) :: timer
      type(progress_type) :: progress
      type(error_type), allocatable :: error
      type(history_type) :: history
      type(mode_solve_type), allocatable :: solves(:)
      real(wp), allocatable :: displacement(:, :, :)
      real(wp) :: start

      call timer%start()
      start = seconds()
      call build_structure(model, structure, timer, progress, error)
      call stop_on(error)
      if (size(structure%yielding) > 0) then
         call run_increments(model, structure%equations, structure%condensed, structure%joint_points, &
                             structure%support_points, model%combinations(1), history, progress)
         allocate (displacement, mold=history%loading%right)
         call solve_displacements(structure, model, history%loading, displacement, solves, error, history%field%excess)
      else
         call new_loading(model, structure%joint_points, structure%support_points, structure%modes, &
                          structure%equations%unit_loads, model%combinations(1), history%loading)
         allocate (displacement, mold=history%loading%right)
         call solve_displacements(structure, model, history%loading, displacement, solves, error)
      end if
      call stop_on(error)
      time = seconds() - start
   end function solution_time

   !> The loop on total jumps with the structure's factors, to Newton's residual
   subroutine run_loop()
      type(structure_type) :: structure
      type(timer_type) :: timer
      type(progress_type) :: progress
      type(error_type), allocatable :: error
      type(loading_type) :: loading
      type(scene_type) :: scene
      type(joint_field_type) :: field
      real(wp), allocatable :: jump(:, :, :), excess(:, :, :), residual(:, :, :), force(:, :)
      real(wp) :: start, norm
      integer :: s, i, k

      call timer%start()
      call build_structure(model, structure, timer, progress, error)
      call stop_on(error)
      start = seconds()
      scene = new_scene(model, structure%condensed)
      field = new_state(structure%condensed, scene)
      associate (points => structure%condensed%points, equations => structure%equations)
         call new_loading(model, structure%joint_points, structure%support_points, equations%modes, &
                          equations%unit_loads, model%combinations(1), loading)
         norm = load_norm(equations, loading)
         allocate (jump, residual, mold=field%excess)
         allocate (excess, mold=field%jump)
         field_of_loop = loading%right
         do n_sweeps = 1, most_sweeps
            !$omp parallel do schedule(dynamic) private(i, k, force) if (worth_threads(equations))
            do s = 1, size(equations%systems)
               do i = 1, size(equations%systems(s)%modes)
                  k = equations%systems(s)%modes(i)
                  force = loading%right(:, :, k) + joint_force(points, equations%modes(k)%harmonic, &
                     field%excess(:, :, k), size(loading%right, 2))
                  call solve_mode(equations, k, force, field_of_loop(:, :, k))
                  jump(:, :, k) = joint_jump(points, field_of_loop(:, :, k))
               end do
            end do
            !$omp end parallel do
            field%jump = synthesize(scene%planes, jump)
            call admit_jump(scene%laws, reshape([(points(k)%base, k=1, size(points))], [3, size(points)]), &
                            views(structure%condensed, scene, field), field, excess)
            residual = analyse(scene%planes, excess) - field%excess
            if (ratio(residual_norm(structure%condensed%measure, residual), norm) <= model%increments(1)%tolerance) exit
            field%excess = field%excess + residual
         end do
      end associate
      loop = seconds() - start
   end subroutine run_loop

end program classical
