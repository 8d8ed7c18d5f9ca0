!> Semi-analytical finite element analysis of axisymmetric bodies with joints
program main
   use axijoint_command_program, only : run_program
   use axijoint_solver_registry, only : known_solvers
   implicit none

   integer :: exit_code

   call run_program(known_solvers(), exit_code)
   stop exit_code, quiet=.true.
end program main
