!> Decks of a run by several processes of this machine, one deck each
module axijoint_command_run_processes
   use axijoint_base_children, only : child_type, add_word, start_child, look_at_child, ask_to_end, &
      how_it_ended, pause_a_moment, no_program
   use axijoint_base_error, only : exit_memory, exit_stopped
   use axijoint_base_kinds, only : i8
   use axijoint_base_memory, only : free_memory
   use axijoint_base_progress, only : tell_below
   use axijoint_base_stop, only : stop_wished
   use axijoint_base_text, only : to_text
   use axijoint_command_line, only : command_type
   use axijoint_job_job, only : job_name, deck_name
   use omp_lib, only : omp_get_max_threads
   implicit none
   private
   public :: run_in_processes, are_apart

   !> Time between two looks at the processes [millisecond]: a small deck takes some ten
   integer, parameter :: look_after = 1

contains

   !> Let processes run the decks, each the next that none has begun. As in a process of all decks, none is begun after one that was
   !> told to end
   subroutine run_in_processes(command, codes, n_begun)
      !> Decks and options
      type(command_type), intent(in) :: command
      !> Exit codes; 128 and the number of a signal that ended a process; that of a stop where none was begun
      integer, intent(out) :: codes(:)
      !> Decks that were begun
      integer, intent(out) :: n_begun

      type(child_type) :: children(min(command%n_processes, size(codes)))
      integer :: deck_of(size(children))
      integer(i8) :: mebibytes
      integer :: k
      logical :: ends, asked

      mebibytes = max(1_i8, free_memory(command%options%memory_limit)/size(children)/2_i8**20)
      codes = exit_stopped
      n_begun = 0
      deck_of = 0
      ends = .false.
      asked = .false.
      do
         do k = 1, size(children)
            if (deck_of(k) > 0) then
               call look_at_child(children(k))
               if (children(k)%code < 0) cycle
               call note_end(command%decks(deck_of(k))%text, children(k)%code, size(children), mebibytes)
               codes(deck_of(k)) = children(k)%code
               ends = ends .or. children(k)%code == exit_stopped
               deck_of(k) = 0
            end if
            if (ends .or. n_begun == size(codes)) cycle
            associate (deck => command%decks(n_begun + 1)%text)
               children(k) = start_child(words_of_deck(command, deck, size(children), mebibytes))
               if (children(k)%code >= 0 .and. any(deck_of > 0)) cycle  ! no room for one more now: later
               if (command%verbose) call tell_below('axijoint: '//deck_name(deck)//' is begun')
            end associate
            n_begun = n_begun + 1
            deck_of(k) = n_begun
         end do
         if (all(deck_of == 0)) exit
         if (stop_wished() .and. .not. asked) then
            do k = 1, size(children)
               if (deck_of(k) > 0) call ask_to_end(children(k))
            end do
            asked = .true.
            ends = .true.
         end if
         call pause_a_moment(look_after)
      end do
   end subroutine run_in_processes

   !> Tell how a process ended that could say nothing itself, and of one without memory what it does not know: that others share it
   subroutine note_end(deck, code, n_processes, mebibytes)
      !> Its deck
      character(len=*), intent(in) :: deck
      !> Its exit code, the number of processes
      integer, intent(in) :: code, n_processes
      !> The memory of one
      integer(i8), intent(in) :: mebibytes

      if (code == exit_memory .and. n_processes > 1) call tell_below('axijoint: '//deck_name(deck)// &
         ': the limit is the share of one of '//to_text(n_processes)//' processes, '//to_text(mebibytes)// &
         ' MiB; fewer --processes leave more to each')
      if (code >= no_program) call tell_below('axijoint: '//deck_name(deck)//': its process '//how_it_ended(code))
   end subroutine note_end

   !> Whether no deck can have the name of results of another, as of one of its combinations: who reads a deck by itself cannot see that
   pure logical function are_apart(command)
      !> Decks and options
      type(command_type), intent(in) :: command

      integer :: i, k

      are_apart = .true.
      do i = 1, size(command%decks)
         do k = 1, size(command%decks)
            are_apart = are_apart .and. index(job_name(command%decks(k)%text), job_name(command%decks(i)%text)//'.') /= 1
         end do
      end do
   end function are_apart

   !> Words of the process of a deck: the options of this process, but for what divides threads and memory
   function words_of_deck(command, deck, n_processes, mebibytes) result(words)
      !> Words and options
      type(command_type), intent(in) :: command
      !> The deck, the number of processes, and the memory of one
      character(len=*), intent(in) :: deck
      integer, intent(in) :: n_processes
      integer(i8), intent(in) :: mebibytes
      !> The words, each ended by a zero byte
      character(len=:), allocatable :: words

      integer :: k

      words = ''
      call add_word(words, 'run')
      call add_word(words, '--threads')
      call add_word(words, to_text(max(1, omp_get_max_threads()/n_processes)))
      call add_word(words, '--memory')
      call add_word(words, to_text(mebibytes))
      k = 1
      do while (k <= size(command%settings))
         associate (word => command%settings(k)%text)
            if (any(word == [character(len=11) :: '--processes', '--threads', '--memory'])) then
               k = k + 1
            else if (word /= '--verbose') then
               call add_word(words, word)
            end if
         end associate
         k = k + 1
      end do
      call add_word(words, '--')
      call add_word(words, deck)

   end function words_of_deck

end module axijoint_command_run_processes
