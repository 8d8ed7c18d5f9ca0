!> axijoint in several processes
program main
   use axijoint_command_program, only : run_program
   use axijoint_mpi_team, only : mpi_team_type, begin_mpi, end_mpi
   use axijoint_solver_registry, only : known_solvers
   implicit none

   type(mpi_team_type) :: team
   integer :: exit_code

   call begin_mpi(team)
   call run_program(known_solvers(), exit_code, team)
   call end_mpi(team, exit_code)
   stop exit_code, quiet=.true.
end program main
