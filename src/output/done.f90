!> Whether an earlier run of a job is done: its results are there, complete, and would be the same
module axijoint_output_done
   use axijoint_analysis_core_results, only : round_type
   use axijoint_base_kinds, only : i8
   use axijoint_base_sha256, only : sha256
   use axijoint_base_state_file, only : state_mark_type
   use axijoint_base_system, only : path_kind, path_absent, path_file
   use axijoint_base_text, only : to_text
   use axijoint_base_whole_file, only : read_whole_file
   use axijoint_job_combination, only : combination_label
   use axijoint_job_job, only : job_type, job_name, result_name
   use axijoint_output_file_names, only : endings, files_of, final_path, file_summary, state_ending
   use axijoint_output_file_pending, only : join_path
   use axijoint_output_state, only : mark_of, is_another
   implicit none
   private
   public :: earlier_exit_code, job_hash

contains

   !> Exit code of an earlier run of the same job whose results are there, complete; negative if they are not. A state goes
   !> before them: it is of a later run, which was not ended. Of several processes the first looks
   integer function earlier_exit_code(job) result(code)
      !> The job, read
      type(job_type), intent(in) :: job

      character(len=:), allocatable :: text

      code = -1
      if (.not. is_another(job)) code = code_of_results(job)
      if (.not. allocated(job%options%team)) return
      text = to_text(code)
      call job%options%team%tell(text)
      read (text, *) code
   end function earlier_exit_code

   !> The same of one process
   integer function code_of_results(job) result(code)
      !> The job, read
      type(job_type), intent(in) :: job

      character(len=:), allocatable :: hash
      integer :: k, found

      code = -1
      if (path_kind(join_path(job%options%directory, job_name(job%deck)//state_ending)) /= path_absent) return
      hash = hash_of_mark(mark_of(job), files_of(job%model), job%options%estimated)
      do k = 1, size(job%model%combinations)
         found = code_of_combination(job, result_name(job, combination_label(job, k)), hash)
         code = merge(max(code, found), -1, found >= 0)
         if (code < 0) return
      end do
   end function code_of_results

   !> Exit code of a combination whose results are there, with this hash; negative if they are not
   integer function code_of_combination(job, name, hash) result(code)
      !> The job
      type(job_type), intent(in) :: job
      !> Name of its files, and what tells it from others
      character(len=*), intent(in) :: name, hash

      character(len=*), parameter :: key = '"exit_code": '
      character(len=:), allocatable :: summary
      integer, allocatable :: files(:)
      integer(i8) :: bytes
      integer :: errno, i, place

      code = -1
      call read_whole_file(final_path(job%options%directory, name, file_summary), summary, errno)
      if (errno /= 0 .or. index(summary, '"job_sha256": "'//hash//'"') == 0) return
      files = files_of(job%model)
      do i = 1, size(files)
         if (path_kind(final_path(job%options%directory, name, files(i))) /= path_file) return
         if (files(i) == file_summary) cycle
         inquire (file=final_path(job%options%directory, name, files(i)), size=bytes)
         if (bytes /= bytes_in(summary, files(i))) return
      end do
      place = index(summary, key) + len(key)
      read (summary(place:place + 1), *, iostat=errno) code
   end function code_of_combination

   !> Bytes of a file as its summary has them; negative if it does not say
   integer(i8) function bytes_in(summary, file) result(bytes)
      !> The summary
      character(len=*), intent(in) :: summary
      !> The file, index of its ending
      integer, intent(in) :: file

      integer :: first, last, errno

      bytes = -1
      associate (key => '"'//trim(endings(file))//'": ')
         first = index(summary, key) + len(key)
         if (first == len(key)) return
      end associate
      last = first + verify(summary(first:)//',', '0123456789') - 2
      read (summary(first:last), *, iostat=errno) bytes
   end function bytes_in

   !> What tells a job from others whose results differ, as its summary has it: hash of the program and its version, of all files
   !> of the deck as it was first read, of the solver that was asked for, of which files are written, and whether errors are
   !> estimated. Empty where more memory may tell more: a round of refinement had none
   function job_hash(job, rounds) result(hash)
      !> The job, its state begun
      type(job_type), intent(in) :: job
      !> Rounds of refinement; not allocated without
      type(round_type), allocatable, intent(in) :: rounds(:)
      !> The hash
      character(len=:), allocatable :: hash

      integer :: k

      hash = ''
      if (.not. allocated(job%checkpoint%mark%deck)) return
      if (allocated(rounds)) then
         do k = 1, size(rounds)
            if (allocated(rounds(k)%failure)) return
         end do
      end if
      hash = hash_of_mark(job%checkpoint%mark, files_of(job%model), job%options%estimated)
   end function job_hash

   !> The same of what a state would be of, and files
   function hash_of_mark(mark, files, estimated) result(hash)
      !> What a state would be of
      type(state_mark_type), intent(in) :: mark
      !> Files that are written, by number
      integer, intent(in) :: files(:)
      !> Whether errors are estimated
      logical, intent(in) :: estimated
      !> The hash
      character(len=64) :: hash

      character(len=:), allocatable :: text
      integer :: i

      text = mark%program//new_line('a')//mark%deck//new_line('a')//mark%options
      do i = 1, size(files)
         text = text//new_line('a')//to_text(files(i))
      end do
      if (.not. estimated) text = text//new_line('a')//'no estimates'
      hash = sha256(text)
   end function hash_of_mark

end module axijoint_output_done
