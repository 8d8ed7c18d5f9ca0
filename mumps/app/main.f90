!> axijoint with MUMPS as one more solver
program main
   use axijoint_command_program, only : run_program
   use axijoint_mumps_solver, only : mumps_entry
   use axijoint_solver_registry, only : known_solvers
   implicit none

   integer :: exit_code

   call run_program([known_solvers(), mumps_entry()], exit_code)
   stop exit_code, quiet=.true.
end program main
