!> A job: what is run, and all that goes with it from its deck to its files
module axijoint_job_job
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : i8
   use axijoint_base_memory, only : no_limit
   use axijoint_base_progress, only : progress_type
   use axijoint_base_team, only : team_type
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : timer_type
   use axijoint_deck_text_source, only : source_type, add_file, add_card
   use axijoint_job_checkpoint, only : checkpoint_type
   use axijoint_legacy_layout, only : dialect_type
   use axijoint_model_model, only : model_type
   use axijoint_solver_entry, only : solver_entry_type
   implicit none
   private
   public :: job_type, options_type, new_job, take_options, job_name, result_name, &
      deck_name, standard_input

   !> The path that means the standard input
   character(len=*), parameter :: standard_input = '-'

   !> What is asked for beside the deck
   type :: options_type
      !> Directory for results; the current one unless another is given
      character(len=:), allocatable :: directory
      !> Whether a solver was asked for, and which; none if the choice is the program's
      logical :: solver_given = .false.
      type(solver_entry_type), allocatable :: solver
      !> Bytes that the process may take
      integer(i8) :: memory_limit = no_limit
      !> Whether the bodies are to be swept through theta, whatever the deck says
      logical :: swept = .false.
      !> Whether errors are estimated
      logical :: estimated = .true.
      !> Whether a listing in an old layout is wanted, too
      logical :: old_listing = .false.
      !> Processes that share the work; this one alone if there is none
      class(team_type), allocatable :: team
      !> Where values stand on the cards, if the deck is one of Owen and Hinton's program
      type(dialect_type), allocatable :: legacy
   end type options_type

   !> A job
   type :: job_type
      !> Path of the deck; it names the result files
      character(len=:), allocatable :: deck
      !> What came from the standard input, if the deck stands there; it comes only once
      character(len=:), allocatable :: input
      !> What is to be said about a deck of an older program, if the deck is one
      character(len=:), allocatable :: conversion
      !> What is asked for beside it
      type(options_type) :: options
      !> Its cards, and warnings about them
      type(source_type) :: source
      character(len=:), allocatable :: warnings(:)
      !> What it describes
      type(model_type) :: model
      !> Equations and joints, factored and condensed; there once something was solved
      type(structure_type), allocatable :: structure
      !> How far it is, for a later run to go on from
      type(checkpoint_type) :: checkpoint
      !> Times of the phases
      type(timer_type) :: timer
      !> Where to show progress
      type(progress_type) :: progress
   end type job_type

contains

   !> A job that a program describes, not a deck
   function new_job(name, model) result(job)
      !> Name of the result files
      character(len=*), intent(in) :: name
      !> What is to be solved
      type(model_type), intent(in) :: model
      !> The job
      type(job_type) :: job

      character(len=:), allocatable :: card

      card = '! '//name//': described by a program'
      job%deck = name
      job%options%directory = '.'
      call add_card(job%source, 1, 1, 1, len(card))
      call add_file(job%source, name, card, 0)
      allocate (character(len=0) :: job%warnings(0))
      job%model = model
   end function new_job

   !> What the options say of the model
   subroutine take_options(options, model)
      !> The options
      type(options_type), intent(in) :: options
      !> The job
      type(model_type), intent(inout) :: model

      if (options%solver_given) then
         if (allocated(model%solver)) deallocate (model%solver)
         if (allocated(options%solver)) model%solver = options%solver
      end if
      if (allocated(model%team)) deallocate (model%team)
      if (allocated(options%team)) allocate (model%team, source=options%team)
      model%memory_limit = options%memory_limit
      model%sweep%wanted = model%sweep%wanted .or. options%swept
      model%old_listing = options%old_listing
   end subroutine take_options

   !> What a deck is called in messages
   pure function deck_name(deck) result(name)
      !> Path of the deck
      character(len=*), intent(in) :: deck
      !> The path, or a name for the standard input
      character(len=:), allocatable :: name

      name = deck
      if (deck == standard_input) name = 'stdin'
   end function deck_name

   !> Name of a deck without directories and ending
   pure function job_name(deck) result(name)
      !> Path of the deck
      character(len=*), intent(in) :: deck
      !> The name
      character(len=:), allocatable :: name

      integer :: dot

      name = deck_name(deck)
      name = name(index(name, '/', back=.true.) + 1:)
      dot = index(name, '.', back=.true.)
      if (dot > 1) name = name(:dot - 1)
   end function job_name

   !> Name of the result files: that of the deck, with the number of the
   !> combination if there are several
   pure function result_name(job, combination) result(name)
      !> The job
      type(job_type), intent(in) :: job
      !> The user's number of the combination; 0 if there is one only
      integer, intent(in) :: combination
      !> The name
      character(len=:), allocatable :: name

      name = job_name(job%deck)
      if (combination > 0) name = name//'.'//to_text(combination)
   end function result_name

end module axijoint_job_job
