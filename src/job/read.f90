!> From a deck to a job
module axijoint_job_read
   use axijoint_base_timer, only : phase_read
   use axijoint_deck_reader, only : read_deck
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, render, &
      warning_texts
   use axijoint_deck_text_file_bytes, only : read_bytes, read_input_bytes
   use axijoint_deck_text_source, only : source_type, add_file
   use axijoint_job_in_situ_messages, only : judge_in_situ
   use axijoint_job_yield_messages, only : judge_in_situ_yield
   use axijoint_job_job, only : job_type, take_options, deck_name, standard_input
   use axijoint_legacy_abaqus, only : looks_like_abaqus
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_convert, only : convert_deck, looks_old
   use axijoint_legacy_nastran, only : looks_like_nastran
   use axijoint_model_request, only : refinement_type
   implicit none
   private
   public :: read_job

contains

   !> Read a deck with all that it includes. The job is of use only if there are no errors among
   !> the messages; its options stay, and stand above what the deck says
   subroutine read_job(path, job, diagnostics, refinement)
      !> The deck
      character(len=*), intent(in) :: path
      !> The job
      type(job_type), intent(inout) :: job
      !> Errors and warnings
      type(diagnostics_type), intent(out) :: diagnostics
      !> Refinement of what the deck says; none if absent
      type(refinement_type), intent(in), optional :: refinement

      job%deck = path
      if (.not. allocated(job%options%directory)) job%options%directory = '.'
      if (allocated(job%structure)) deallocate (job%structure)
      call job%timer%push(phase_read)
      if (allocated(job%options%legacy)) then
         call read_legacy(path, job, diagnostics, refinement)
      else if (path == standard_input) then
         call read_input(job, diagnostics, refinement)
      else
         call read_deck(path, job%source, job%model, diagnostics, refinement)
      end if
      if (diagnostics%n_errors > 0 .and. .not. allocated(job%options%legacy)) &
         call offer_legacy(job%source, diagnostics)
      if (diagnostics%n_errors == 0) then
         if (size(job%model%initial_stresses) > 0) then
            call judge_in_situ(job%model, diagnostics)
            call judge_in_situ_yield(job%model, diagnostics)
         end if
      end if
      call job%timer%pop()
      job%warnings = warning_texts(diagnostics, job%source)
      call take_options(job%options, job%model)
   end subroutine read_job

   !> Read a deck of Owen and Hinton's program: written anew in memory, then read as any
   subroutine read_legacy(path, job, diagnostics, refinement)
      !> The deck
      character(len=*), intent(in) :: path
      !> The job
      type(job_type), intent(inout) :: job
      !> Errors and warnings
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Refinement of what the deck says
      type(refinement_type), intent(in), optional :: refinement

      character(len=:), allocatable :: bytes, failure, text
      type(cards_type) :: cards

      if (path == standard_input) then
         failure = ''
         if (.not. allocated(job%input)) call read_once(job, failure)
         bytes = job%input
      else
         call read_bytes(path, bytes, failure)
      end if
      if (len(failure) > 0) then
         job%source = source_type()
         call add_file(job%source, deck_name(path), bytes, 0)
         call add_error(diagnostics, 0, 0, 0, failure)
         return
      end if
      call convert_deck(deck_name(path), bytes, job%options%legacy, cards, text)
      if (cards%diagnostics%n_errors > 0) then
         job%source = cards%source
         diagnostics = cards%diagnostics
         return
      end if
      job%conversion = render(cards%diagnostics, cards%source)
      call read_deck(deck_name(path)//' (converted)', job%source, job%model, diagnostics, &
         refinement, text)
   end subroutine read_legacy

   !> Offer to read a deck of another program as one, or to convert it: what its cards would mean here is of no interest
   !> then
   subroutine offer_legacy(source, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> What is wrong with its cards; the offer alone if there is one
      type(diagnostics_type), intent(inout) :: diagnostics

      if (source%n_files == 0) return
      associate (bytes => source%files(1)%bytes)
         if (looks_like_nastran(bytes)) then
            call offer('a deck of NASTRAN', '')
         else if (looks_like_abaqus(bytes)) then
            call offer('an input file of Abaqus or CalculiX', '')
         else if (looks_old(bytes)) then
            call offer('a deck of the plasticity program of Owen and Hinton', &
               'axijoint run --legacy owen-hinton DECK solves it, ')
         end if
      end associate

   contains

      !> Say what the deck is
      subroutine offer(what, more)
         !> What it looks like, and what can be done besides converting it
         character(len=*), intent(in) :: what, more

         type(diagnostics_type) :: alone

         call add_error(alone, 0, 0, 0, 'this looks like '//what, &
            mend=more//'axijoint convert OLD NEW writes it anew')
         diagnostics = alone
      end subroutine offer

   end subroutine offer_legacy

   !> Read the deck that comes from the standard input, or has come from it before
   subroutine read_input(job, diagnostics, refinement)
      !> The job
      type(job_type), intent(inout) :: job
      !> Errors and warnings
      type(diagnostics_type), intent(inout) :: diagnostics
      !> Refinement of what the deck says
      type(refinement_type), intent(in), optional :: refinement

      character(len=:), allocatable :: failure

      if (.not. allocated(job%input)) then
         call read_once(job, failure)
         if (len(failure) > 0) then
            job%source = source_type()
            call add_file(job%source, deck_name(standard_input), job%input, 0)
            call add_error(diagnostics, 0, 0, 0, failure)
            return
         end if
      end if
      call read_deck(deck_name(standard_input), job%source, job%model, diagnostics, refinement, &
                     job%input)
   end subroutine read_input

   !> Read the standard input, which of processes that share the work the first one has
   subroutine read_once(job, failure)
      !> Takes what came
      type(job_type), intent(inout) :: job
      !> The error, empty if there is none
      character(len=:), allocatable, intent(out) :: failure

      if (.not. allocated(job%options%team)) then
         call read_input_bytes(job%input, failure)
         return
      end if
      associate (team => job%options%team)
         if (team%rank == 0) then
            call read_input_bytes(job%input, failure)
         else
            job%input = ''
            failure = ''
         end if
         call team%tell(job%input)
         call team%tell(failure)
      end associate
   end subroutine read_once

end module axijoint_job_read
