!> The solvers that there are. A new one is a file of its own and a line of `known_solvers`
module axijoint_solver_registry
   use axijoint_solver_band, only : band_entry
   use axijoint_solver_entry, only : solver_entry_type, name_length
   use axijoint_solver_skyline, only : skyline_entry
   use axijoint_solver_sparse, only : sparse_entry
   implicit none
   private
   public :: known_solvers, chosen_solver, solver_words, find_solver, auto_word

   !> The word for the choice of the program
   character(len=name_length), parameter :: auto_word = 'AUTO'

contains

   !> All solvers of this library
   pure function known_solvers() result(solvers)
      !> The solvers, in the order in which they are listed
      type(solver_entry_type), allocatable :: solvers(:)

      solvers = [band_entry(), skyline_entry(), sparse_entry()]
   end function known_solvers

   !> The solver that is asked for, or the choice of the program: the sparse one, which none of the others is clearly faster than
   !> in any mesh that was tried, rows of single elements among them
   pure function chosen_solver(wanted) result(solver)
      !> The solver that is asked for; none if the choice is the program's
      type(solver_entry_type), allocatable, intent(in) :: wanted
      !> The solver
      type(solver_entry_type) :: solver

      solver = sparse_entry()
      if (allocated(wanted)) solver = wanted
   end function chosen_solver

   !> Words for solvers on cards and the command line: that for the choice of the program, then
   !> their names
   pure function solver_words(solvers) result(words)
      !> The solvers
      type(solver_entry_type), intent(in) :: solvers(:)
      !> The words
      character(len=name_length) :: words(size(solvers) + 1)

      words = [auto_word, solvers%name]
   end function solver_words

   !> Find a solver by its name
   pure subroutine find_solver(solvers, name, solver, found)
      !> The solvers
      type(solver_entry_type), intent(in) :: solvers(:)
      !> Its name in capitals, or AUTO
      character(len=*), intent(in) :: name
      !> The solver; none if the choice is the program's
      type(solver_entry_type), allocatable, intent(out) :: solver
      !> Whether the word is known
      logical, intent(out) :: found

      integer :: k

      found = name == auto_word
      k = findloc(solvers%name == name, .true., 1)
      if (k == 0) return
      found = .true.
      solver = solvers(k)
   end subroutine find_solver

end module axijoint_solver_registry
