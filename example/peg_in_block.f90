!> The job of inputs/first.dat, a peg in a block that is pushed sideways, described by a program.
!>
!> Usage: fpm run --example peg_in_block -- [DIRECTORY]
program peg_in_block
   use, intrinsic :: iso_fortran_env, only : error_unit, output_unit
   use axijoint, only : wp, error_type, job_type, results_type, mode_type, solid_material_type, &
      joint_law_type, &
      new_job, new_model, add_material, add_law, add_rectangle, add_interface, hold_edges, &
      add_traction, solve, &
      write_results
   implicit none

   real(wp), parameter :: pi = acos(-1.0_wp)
   !> The force over the area of the face that it is spread on
   real(wp), parameter :: pressure = 0.4_wp/(pi*0.5_wp**2)
   !> Tractions t_r ~ cos(theta) and t_theta ~ -sin(theta) push along theta = 0
   type(mode_type), parameter :: sideways = mode_type(harmonic=1)
   type(job_type), target :: job
   type(results_type), allocatable :: results(:)
   type(error_type), allocatable :: error
   character(len=1024) :: directory

   job = new_job('peg_in_block', new_model('A peg in a block, pushed sideways at its free end '// &
      '(MN, m, MPa)', 4))
   associate (model => job%model)
      call add_material(model, solid_material_type(young=2.0e4_wp, poisson=0.17_wp))
      call add_law(model, joint_law_type(stiffness=[1.0e4_wp, 2.0e4_wp, 1.0e4_wp], &
         friction=tan(pi/6)))
      call add_rectangle(model, 1, 4, [4, 12], [0.0_wp, -0.5_wp], [0.5_wp, 1.0_wp])
      call add_rectangle(model, 1, 4, [6, 8], [0.5_wp, 0.0_wp], [2.0_wp, 1.0_wp])
      call add_interface(model, 1, [1, 2], [0.5_wp, 0.0_wp], [0.5_wp, 1.0_wp], error)
      call stop_on(error)
      call hold_edges(model, [0.5_wp, 1.0_wp], [2.0_wp, 1.0_wp], [.true., .true., .true.], error)
      call stop_on(error)
      call add_traction(model, sideways, [0.0_wp, -0.5_wp], [0.5_wp, -0.5_wp], &
         [pressure, 0.0_wp, -pressure], error)
      call stop_on(error)
   end associate

   call solve(job, results, error)
   call stop_on(error)
   write (output_unit, '(a, es12.5)') 'largest u of harmonic 1:', &
      maxval(abs(results(1)%displacement(1, :, 2)))
   call get_command_argument(1, directory)
   if (len_trim(directory) > 0) job%options%directory = trim(directory)
   call write_results(job, results, error)
   call stop_on(error)

contains

   !> End the program with words
   subroutine stop_on(error)
      !> What went wrong, if anything
      type(error_type), allocatable, intent(in) :: error

      if (.not. allocated(error)) return
      write (error_unit, '(a)') error%message
      stop 1, quiet=.true.
   end subroutine stop_on

end program peg_in_block
