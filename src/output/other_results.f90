!> Results in the folder of a run that seem to be its own and are not
module axijoint_output_other_results
   use axijoint_base_system, only : path_kind, path_file
   use axijoint_base_text, only : to_text
   use axijoint_job_combination, only : combination_label
   use axijoint_job_job, only : job_type, job_name, deck_name, result_name
   use axijoint_output_file_names, only : endings, file_arrays
   implicit none
   private
   public :: other_results_text

contains

   !> What to say of results of combinations that the deck does not have, from an earlier run of it; nothing if there are none
   function other_results_text(job, beside) result(text)
      !> The job, its results written
      type(job_type), intent(in) :: job
      !> Files that were in the folder before, each followed by a line feed
      character(len=*), intent(in) :: beside
      !> A sentence
      character(len=:), allocatable :: text

      character(len=:), allocatable :: name, ending, first
      integer :: from, to, n
      logical :: other

      text = ''
      name = job_name(job%deck)
      ending = trim(endings(file_arrays))
      n = 0
      from = 1
      do while (from <= len(beside))
         to = from + index(beside(from:), new_line('a')) - 2
         associate (found => beside(from:to), own => beside(from:to - len(ending)))
            other = index(found, name//'.') == 1 .and. len(found) >= len(name) + len(ending)
            if (other) other = found(len(found) - len(ending) + 1:) == ending
            if (other) other = is_of_combination(own(len(name) + 1:)) .and. .not. is_own(job, own)
            if (other) other = .not. has_deck(job, own)
            if (other) then
               n = n + 1
               if (n == 1) first = found
               if (found < first) first = found
            end if
         end associate
         from = to + 2
      end do
      if (n == 0) return
      text = deck_name(job%deck)//': warning: '//first
      if (n == 2) text = text//' and one more'
      if (n > 2) text = text//' and '//to_text(n - 1)//' more'
      text = text//' beside the results '//trim(merge('is ', 'are', n == 1))//' not of this run: the deck has no such '// &
         trim(merge('combination ', 'combinations', n == 1))
   end function other_results_text

   !> Whether a name goes on as those of combinations do: a point and a number, or nothing
   pure logical function is_of_combination(rest)
      !> What follows the name of the deck
      character(len=*), intent(in) :: rest

      is_of_combination = len(rest) == 0
      if (len(rest) > 1) is_of_combination = rest(1:1) == '.' .and. verify(rest(2:), '0123456789') == 0
   end function is_of_combination

   !> Whether another deck stands beside that of the job whose results have this name
   logical function has_deck(job, name)
      !> The job
      type(job_type), intent(in) :: job
      !> Name of the results
      character(len=*), intent(in) :: name

      integer :: last

      last = index(job%deck, job_name(job%deck), back=.true.) - 1
      has_deck = name /= job_name(job%deck)
      if (has_deck) has_deck = path_kind(job%deck(:last)//name//job%deck(last + len(job_name(job%deck)) + 1:)) == path_file
   end function has_deck

   !> Whether results are of the job
   pure logical function is_own(job, name)
      !> The job
      type(job_type), intent(in) :: job
      !> Name of the results
      character(len=*), intent(in) :: name

      integer :: k

      is_own = .false.
      do k = 1, size(job%model%combinations)
         is_own = is_own .or. result_name(job, combination_label(job, k)) == name
      end do
   end function is_own

end module axijoint_output_other_results
