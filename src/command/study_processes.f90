!> Rows of a study by several processes of this machine, each a part by itself
module axijoint_command_study_processes
   use axijoint_base_children, only : child_type, add_word, start_child, look_at_child, ask_to_end, &
      how_it_ended, pause_a_moment
   use axijoint_base_error, only : error_type, exit_in_use
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_memory, only : free_memory, resident_bytes
   use axijoint_base_progress, only : progress_type, show_progress, tell_below
   use axijoint_base_stop, only : stop_wished, check_stop
   use axijoint_base_text, only : to_text
   use axijoint_command_line, only : command_type
   use axijoint_output_claim, only : claim_type, claim_names, release_output
   use axijoint_study_parts, only : part_type, part_name, first_row, last_row, gather_parts, &
      processes_that_pay
   use axijoint_study_rows, only : row_type
   use axijoint_study_undertaking, only : undertaking_type
   use omp_lib, only : omp_get_max_threads
   implicit none
   private
   public :: solve_in_processes, worth_processes

   !> Looks at the processes between two looks at what they have done
   integer, parameter :: looks = 20
   !> Times that a part is begun whose name an earlier process does not give back
   integer, parameter :: most_attempts = 20

contains

   !> Processes that rows are worth when some are solved, as far as memory has room for them
   integer function worth_processes(seconds, n_left, memory_limit) result(n)
      !> Time of each row that was solved, structures and all [second]
      real(wp), intent(in) :: seconds(:)
      !> Rows that are not done
      integer, intent(in) :: n_left
      !> Bytes that the user lets the process take in all
      integer(i8), intent(in) :: memory_limit

      n = 1
      if (size(seconds) < 2) return
      associate (first => maxval(seconds))
         n = processes_that_pay((sum(seconds) - first)/(size(seconds) - 1), first, n_left, &
            omp_get_max_threads())
      end associate
      if (n == 1) return
      associate (own => max(1_i8, resident_bytes()))
         n = max(1, int(min(int(n, i8), (free_memory(memory_limit) + own)/own)))
      end associate
   end function worth_processes

   !> Let processes solve the rows that are not done, and wait for them. What a process leaves, as it
   !> was killed or found no memory, is not done
   subroutine solve_in_processes(command, n_processes, undertaking, key, n_quantities, order, done, &
      progress, error)
      !> Words and options
      type(command_type), intent(in) :: command
      !> Number of processes
      integer, intent(in) :: n_processes
      !> The study's files
      type(undertaking_type), intent(in) :: undertaking
      !> What tells the study from others
      character(len=*), intent(in) :: key
      !> Quantities of a row
      integer, intent(in) :: n_quantities
      !> Numbers of the rows in their order
      integer, intent(in) :: order(:)
      !> Rows by number; takes those that are done
      type(row_type), intent(inout) :: done(:)
      !> Where progress is shown
      type(progress_type), intent(inout) :: progress
      !> The program is to end
      type(error_type), allocatable, intent(out) :: error

      type(child_type) :: children(n_processes)
      type(part_type) :: part
      integer :: attempts(n_processes)
      integer :: k, look, n_others
      logical :: asked

      do k = 1, size(children)
         children(k) = start_child(words_of_part(command, part_type(k, n_processes)))
      end do
      attempts = 1
      asked = .false.
      look = 0
      do
         do k = 1, size(children)
            call look_at_child(children(k))
            if (children(k)%code /= exit_in_use .or. asked .or. attempts(k) == most_attempts) cycle
            attempts(k) = attempts(k) + 1
            children(k) = start_child(words_of_part(command, part_type(k, n_processes)))
         end do
         if (all(children%code >= 0)) exit
         if (stop_wished() .and. .not. asked) then
            do k = 1, size(children)
               call ask_to_end(children(k))
            end do
            asked = .true.
         end if
         if (mod(look, looks) == 0 .and. (progress%enabled .or. progress%logged)) then
            call gather_parts(undertaking%directory, undertaking%name, key, n_quantities, done, n_others)
            call show_progress(progress, 'row '//to_text(count(done%number > 0))//' of '// &
               to_text(size(done))//' by '//to_text(size(children))//' processes')
         end if
         look = look + 1
         call pause_a_moment()
      end do
      call gather_parts(undertaking%directory, undertaking%name, key, n_quantities, done, n_others)
      call forget_locks(undertaking, size(children))
      call check_stop(error)
      if (allocated(error)) return
      do k = 1, size(children)
         part = part_type(k, size(children))
         if (all(done(order(first_row(part, size(order)):last_row(part, size(order))))%number > 0)) &
            cycle
         call tell_below('axijoint: the process of part '//to_text(k)//' of '// &
            to_text(size(children))//' '//how_it_ended(children(k)%code)// &
            '; what it left is solved here')
      end do
   end subroutine solve_in_processes

   !> Remove locks and temporary files of parts whose process was killed
   subroutine forget_locks(undertaking, n)
      !> The study's files
      type(undertaking_type), intent(in) :: undertaking
      !> Number of parts
      integer, intent(in) :: n

      type(claim_type) :: claim
      type(error_type), allocatable :: held
      character(len=:), allocatable :: notes
      integer :: k

      do k = 1, n
         call claim_names(undertaking%directory, [part_name(undertaking%name, part_type(k, n))], &
            'study', claim, notes, held)
         call release_output(claim)
      end do
   end subroutine forget_locks

   !> Words of the process of a part: those of this process, but for what divides threads and memory
   function words_of_part(command, part) result(words)
      !> Words and options
      type(command_type), intent(in) :: command
      !> The part
      type(part_type), intent(in) :: part
      !> The words, each ended by a zero byte
      character(len=:), allocatable :: words

      integer(i8) :: mebibytes
      integer :: k
      logical :: only_names

      mebibytes = max(1_i8, free_memory(command%options%memory_limit)/part%n/2_i8**20)
      words = ''
      call add_word(words, 'study')
      call add_word(words, '--part')
      call add_word(words, to_text(part%number)//'/'//to_text(part%n))
      call add_word(words, '--threads')
      call add_word(words, to_text(max(1, omp_get_max_threads()/part%n)))
      call add_word(words, '--memory')
      call add_word(words, to_text(mebibytes))
      call add_word(words, '--quiet')
      only_names = .false.
      k = 1
      do while (k <= size(command%words))
         associate (word => command%words(k)%text)
            if (word == '--') only_names = .true.
            if (.not. only_names) then
               if (any(word == [character(len=11) :: '--processes', '--threads', '--memory'])) then
                  k = k + 2
                  cycle
               else if (word == '--quiet' .or. word == '--verbose') then
                  k = k + 1
                  cycle
               end if
            end if
            call add_word(words, word)
         end associate
         k = k + 1
      end do

   end function words_of_part

end module axijoint_command_study_processes
