!> How far a run has come, beside its results: where the state is kept, what an earlier run left
!> there, and the file by which somebody asks the run to end
module axijoint_output_state
   use axijoint_base_error, only : error_type, fatal_error, exit_io, exit_state
   use axijoint_base_kinds, only : wp
   use axijoint_base_sha256, only : sha256
   use axijoint_base_state_file, only : state_mark_type, read_state_file, is_state_file
   use axijoint_base_stop, only : heed_file
   use axijoint_base_system, only : path_kind, path_absent, error_text, rename_path, unlink_path
   use axijoint_base_text, only : to_text
   use axijoint_base_version, only : program_name, program_version
   use axijoint_base_whole_file, only : file_size, is_not_there, read_whole_file
   use axijoint_deck_text_source, only : source_type
   use axijoint_job_combination, only : combination_label
   use axijoint_job_job, only : job_type, job_name, result_name
   use axijoint_output_file_names, only : files_of, final_path, file_summary, state_ending, &
      stop_ending, put_aside
   use axijoint_output_file_pending, only : join_path
   implicit none
   private
   public :: begin_state, end_state, stopped_text, note_written, is_written, remove_stop_file, mark_of, is_another, hash_of_files

   !> Number of what the bytes of a state mean: another wherever that changes
   character(len=*), parameter :: layout = '6'

contains

   !> Begin to keep the state of a job, from where an earlier run was if that is asked for. Of several
   !> processes the first keeps it, and tells the others what was there
   subroutine begin_state(job, interval, resume, notes, error)
      !> The job, read
      type(job_type), intent(inout) :: job
      !> Least time between two states that are kept [second]
      real(wp), intent(in) :: interval
      !> Whether to go on from the state that is there
      logical, intent(in) :: resume
      !> What was found, a line each
      character(len=:), allocatable, intent(out) :: notes
      !> The state cannot be gone on from, or a file of its name is in the way
      type(error_type), allocatable, intent(out) :: error

      type(state_mark_type) :: mark
      character(len=:), allocatable :: path, bytes
      logical :: taken

      notes = ''
      mark = mark_of(job)
      path = join_path(job%options%directory, job_name(job%deck)//state_ending)
      if (is_another(job)) path = ''
      call job%checkpoint%begin(path, mark, interval, size(job%model%combinations), &
         size(job%model%increments))
      if (.not. is_another(job)) call look_for_state(job, mark, resume, notes, error)
      if (.not. allocated(job%options%team)) return
      associate (team => job%options%team)
         call team%agree(error)
         if (allocated(error)) return
         call job%checkpoint%tell_bytes(bytes)
         call team%tell(bytes)
         if (is_another(job)) call job%checkpoint%take(bytes, '', taken)
      end associate
   end subroutine begin_state

   !> Whether another process keeps the state
   pure logical function is_another(job)
      !> The job
      type(job_type), intent(in) :: job

      is_another = .false.
      if (allocated(job%options%team)) is_another = job%options%team%rank > 0
   end function is_another

   !> Heed the file that asks the run to end, and look for what an earlier run left
   subroutine look_for_state(job, mark, resume, notes, error)
      !> The job, whose state is begun
      type(job_type), intent(inout) :: job
      !> What its state is of
      type(state_mark_type), intent(in) :: mark
      !> Whether to go on from the state that is there
      logical, intent(in) :: resume
      !> What was found, a line each, is added
      character(len=:), allocatable, intent(inout) :: notes
      !> The state cannot be gone on from, or a file of its name is in the way
      type(error_type), allocatable, intent(out) :: error

      type(state_mark_type) :: found
      character(len=:), allocatable :: body, failure, stop_file
      integer :: errno
      logical :: there, removed, foreign

      stop_file = join_path(job%options%directory, job_name(job%deck)//stop_ending)
      call remove_stop_file(stop_file, removed, error)
      if (allocated(error)) return
      if (removed) call add('a STOP file from before this run was removed: '//stop_file)
      call heed_file(stop_file)
      foreign = is_foreign(job%checkpoint%path)
      there = foreign
      if (foreign) then
         failure = 'is no state of axijoint that can be read'
      else
         call read_state_file(job%checkpoint%path, found, body, there, failure)
      end if
      if (resume .and. .not. there) call add('there is no state '//job%checkpoint%path// &
         ' to go on from: the run begins anew')
      if (there .and. resume) then
         call go_on()
      else if (there) then
         call put_state_aside()
      end if
      if (allocated(error)) return
      if (is_foreign(job%checkpoint%path//put_aside)) &
         call add(job%checkpoint%path//put_aside//' is no state of axijoint, and is left as it is')

   contains

      !> Go on from the state
      subroutine go_on()
         logical :: taken

         if (.not. allocated(failure)) call compare_marks(mark, found, failure)
         if (.not. allocated(failure)) then
            call job%checkpoint%take(body, found%place, taken)
            if (.not. taken) failure = 'is of another job'
         end if
         if (allocated(failure)) then
            call fatal_error(error, exit_state, 'the state '//job%checkpoint%path//' '//failure//new_line('a')// &
               'mend: run without --resume, which begins anew'//trim(merge(', and move that file away first', &
               '                               ', foreign)))
            return
         end if
         call add('goes on from '//job%checkpoint%path//', '//found%place//' of '//found%date)
      end subroutine go_on

      !> Keep the state under another name: somebody may have forgotten to go on from it. What is no
      !> state is not renamed, nor is another file replaced by one
      subroutine put_state_aside()
         character(len=:), allocatable :: what
         logical :: replaces

         if (foreign) then
            call fatal_error(error, exit_io, job%checkpoint%path//' '//failure//', and the state of this run '// &
               'would replace it'//new_line('a')//'mend: move it away, or choose another directory with -o')
            return
         end if
         if (is_foreign(job%checkpoint%path//put_aside)) then
            call fatal_error(error, exit_io, job%checkpoint%path//put_aside//' is no state of axijoint, and the '// &
               'state that an earlier run left would replace it'//new_line('a')// &
               'mend: move it away, choose another directory with -o, or go on from that state with --resume')
            return
         end if
         what = ''
         if (.not. allocated(failure)) what = ' ('//found%place//', '//found%date//')'
         replaces = path_kind(job%checkpoint%path//put_aside) /= path_absent
         call rename_path(job%checkpoint%path, job%checkpoint%path//put_aside, errno)
         if (errno == 0) call add('a run that was not ended left its state'//what//', now '// &
            job%checkpoint%path//put_aside//'; --resume would have gone on from it, this run begins anew')
         if (errno == 0 .and. replaces) call add('the state that had this name, of a run before that, is gone')
      end subroutine put_state_aside

      !> Add a line to the notes
      subroutine add(line)
         !> The line
         character(len=*), intent(in) :: line

         if (len(notes) > 0) notes = notes//new_line('a')
         notes = notes//'axijoint: '//line
      end subroutine add

   end subroutine look_for_state

   !> Whether somebody else's file has the name of a state
   logical function is_foreign(path)
      !> The name
      character(len=*), intent(in) :: path

      is_foreign = path_kind(path) /= path_absent
      if (is_foreign) is_foreign = .not. is_state_file(path)
   end function is_foreign

   !> Remove a STOP file from before a run, which it would end at once
   subroutine remove_stop_file(path, removed, error)
      !> Its path
      character(len=*), intent(in) :: path
      !> Whether there was one
      logical, intent(out) :: removed
      !> It cannot be removed
      type(error_type), allocatable, intent(out) :: error

      integer :: errno

      removed = .false.
      if (path_kind(path) == path_absent) return
      call unlink_path(path, errno)
      removed = errno == 0
      if (removed) return
      if (.not. is_not_there(errno)) call fatal_error(error, exit_io, path//' would end the run '// &
         'at once, and cannot be removed: '//error_text(errno)//new_line('a')// &
         'mend: move it away, or choose another directory with -o')
   end subroutine remove_stop_file

   !> What a state must be of, to be gone on from
   subroutine compare_marks(mark, found, failure)
      !> This job, and that of the state
      type(state_mark_type), intent(in) :: mark, found
      !> What differs; not allocated if nothing does
      character(len=:), allocatable, intent(out) :: failure

      if (found%program /= mark%program) then
         failure = 'is of '//found%program//', and this is '//mark%program
      else if (found%deck /= mark%deck) then
         failure = 'is of another deck: the cards, an included file or the mesh changed since'
      else if (found%options /= mark%options) then
         failure = 'is of a run with the solver '//found%options//', not '//mark%options
      end if
   end subroutine compare_marks

   !> What the state of a job is of
   function mark_of(job) result(mark)
      !> The job
      type(job_type), intent(in) :: job
      !> What it is of
      type(state_mark_type) :: mark

      mark%program = program_name//' '//program_version//', layout '//layout
      mark%deck = hash_of_files(job%source)
      mark%options = 'of the deck'
      if (job%options%solver_given) then
         mark%options = 'of the program''s choice'
         if (allocated(job%options%solver)) mark%options = trim(job%options%solver%name)
      end if
      mark%place = ''
   end function mark_of

   !> Hash of all files of a deck, that of its mesh among them
   function hash_of_files(source) result(hash)
      !> The deck
      type(source_type), intent(in) :: source
      !> The hash
      character(len=64) :: hash

      character(len=:), allocatable :: hashes
      integer :: k

      hashes = ''
      do k = 1, source%n_files
         hashes = hashes//sha256(source%files(k)%bytes)
      end do
      hash = sha256(hashes)
   end function hash_of_files

   !> The job is done: there is nothing to go on from. Files of these names that are no states stay
   subroutine end_state(job)
      !> The job
      type(job_type), intent(inout) :: job

      integer :: errno

      call heed_file('')
      if (.not. allocated(job%checkpoint%path)) return
      if (is_state_file(job%checkpoint%path)) call unlink_path(job%checkpoint%path, errno)
      if (is_state_file(job%checkpoint%path//put_aside)) call unlink_path(job%checkpoint%path//put_aside, errno)
   end subroutine end_state

   !> How a run was stopped, and how to go on. What is pending is written
   function stopped_text(job, cause) result(text)
      !> The job
      type(job_type), intent(inout) :: job
      !> What stopped it, in words
      character(len=*), intent(in) :: cause
      !> A line
      character(len=:), allocatable :: text

      integer :: errno

      if (allocated(job%checkpoint%path)) then
         call unlink_path(join_path(job%options%directory, job_name(job%deck)//stop_ending), errno)
         call job%checkpoint%flush()
      end if
      text = cause//' before anything was kept'
      if (allocated(job%checkpoint%failure)) then
         text = cause//'; the state cannot be kept: '//job%checkpoint%failure
      else if (job%checkpoint%there) then
         text = cause//' after '//job%checkpoint%place//'; --resume goes on from '// &
            job%checkpoint%path
      end if
   end function stopped_text

   !> Note in the state that the results of a combination are written
   subroutine note_written(job, k, exit_code)
      !> The job
      type(job_type), intent(inout) :: job
      !> The combination
      integer, intent(in) :: k
      !> How it ended
      integer, intent(in) :: exit_code

      if (.not. allocated(job%checkpoint%parts)) return
      if (len(job%checkpoint%path) == 0) return
      job%checkpoint%at = k
      call job%checkpoint%note_done(exit_code, digest_of(job, k))
   end subroutine note_written

   !> Whether the run that is gone on with wrote the results of a combination, and they are there. Of
   !> several processes the first looks
   logical function is_written(job, k)
      !> The job
      type(job_type), intent(in) :: job
      !> The combination
      integer, intent(in) :: k

      is_written = .false.
      if (.not. allocated(job%checkpoint%parts)) return
      is_written = job%checkpoint%parts(k)%done
      if (.not. is_written) return
      if (len(job%checkpoint%path) > 0) &
         is_written = job%checkpoint%parts(k)%digest == digest_of(job, k)
      if (allocated(job%options%team)) is_written = job%options%team%all_of(is_written)
   end function is_written

   !> What tells the results of a combination from others: the hash of the summary, which holds the
   !> stamp of the run, and the sizes of all files
   function digest_of(job, k) result(digest)
      !> The job
      type(job_type), intent(in) :: job
      !> The combination
      integer, intent(in) :: k
      !> The digest
      character(len=:), allocatable :: digest

      character(len=:), allocatable :: summary
      integer, allocatable :: files(:)
      integer :: i, errno

      files = files_of(job%model)
      associate (directory => job%options%directory, &
                 label => combination_label(job, k))
         call read_whole_file(final_path(directory, result_name(job, label), file_summary), &
            summary, errno)
         digest = sha256(summary)
         do i = 1, size(files)
            digest = digest//' '//to_text(file_size(final_path(directory, &
               result_name(job, label), files(i))))
         end do
      end associate
   end function digest_of

end module axijoint_output_state
