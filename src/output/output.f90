!> The files of a run: all of them complete under their final names, or none
module axijoint_output_output
   use omp_lib, only : omp_get_max_threads
   use axijoint_analysis_core_results, only : results_type, remark_type
   use axijoint_analysis_core_series, only : series_type
   use axijoint_base_error, only : error_type, fatal_error, exit_io, exit_internal
   use axijoint_base_kinds, only : i8
   use axijoint_base_last_words, only : note_lock, forget_lock
   use axijoint_base_lock, only : lock_type, take_lock, release_lock
   use axijoint_base_process, only : host_name
   use axijoint_base_system, only : process_id, path_kind, is_directory, same_file, path_absent, path_file, error_text, &
      make_directories, unlink_path
   use axijoint_base_team, only : team_type, take_team
   use axijoint_base_text, only : count_of
   use axijoint_base_version, only : program_name
   use axijoint_base_whole_file, only : first_bytes
   use axijoint_deck_text_source, only : source_type
   use axijoint_job_combination, only : combination_label
   use axijoint_job_job, only : job_type, job_name, result_name
   use axijoint_model_model, only : model_type
   use axijoint_output_claim, only : spare_sources
   use axijoint_output_file_echo, only : deck_path
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_json, only : json_string
   use axijoint_output_file_names, only : endings, file_arrays, file_listing, file_summary, &
      file_bodies, file_joints, file_old_listing, files_of, final_path, journal_ending, lock_ending, &
      state_ending, stop_ending, put_aside
   use axijoint_output_file_pending, only : join_path, check_name, temporary_path
   use axijoint_output_file_run, only : run_type, new_run, exit_code_of, status_error
   use axijoint_output_file_set, only : commit_set
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_increments, only : write_increments, help_with_increments
   use axijoint_output_hdf5_results, only : write_results
   use axijoint_output_legacy_fit, only : check_fit
   use axijoint_output_legacy_listing, only : old_listing_type, begin_old_listing, &
      end_old_listing
   use axijoint_output_listing_contents, only : write_listing, end_listing
   use axijoint_output_listing_solution, only : convergence_text
   use axijoint_output_listing_sweep, only : picture_type, new_picture
   use axijoint_output_summary, only : write_summary, write_failure_summary
   use axijoint_output_vtkhdf_bodies, only : bodies_type, begin_bodies, end_bodies
   use axijoint_output_vtkhdf_joints, only : surfaces_type, begin_surfaces, &
      end_surfaces
   implicit none
   private
   public :: check_output, write_output, write_error_summary, remove_error_summary

contains

   !> Before the solve: the directory is there, files can be made in it, and
   !> the final names are free or regular files
   subroutine check_output(job, error)
      !> The job; its files must not be overwritten
      type(job_type), intent(in) :: job
      !> What stands in the way
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      if (job%model%old_listing) call check_fit(job%model, error)
      do k = 1, size(job%model%combinations)
         if (allocated(error)) return
         call check_place(job%options%directory, result_name(job, combination_label(job, k)), &
            job%source, files_of(job%model), error)
      end do
      if (allocated(error)) return
      call spare_sources(job%options%directory, job_name(job%deck), [character(len=16) :: state_ending, &
         state_ending//put_aside, stop_ending], job%source, "the deck", error)
   end subroutine check_output

   !> The same for one combination
   subroutine check_place(directory, name, source, files, error)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> Their name
      character(len=*), intent(in) :: name
      !> Cards of the deck
      type(source_type), intent(in) :: source
      !> The files, indices of their endings
      integer, intent(in) :: files(:)
      !> What stands in the way
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: probe

      call make_place(directory, error)
      if (allocated(error)) return
      call check_names(directory, name, files, error)
      if (allocated(error)) return
      call spare_sources(directory, name, endings(files), source, "the deck", error)
      if (allocated(error)) return
      call note_lock(join_path(directory, name//lock_ending), host_name(), process_id())
      call probe%open(final_path(directory, name, file_summary), error)
      call probe%abandon()
      call forget_lock(join_path(directory, name//lock_ending))
   end subroutine check_place

   !> Make the directory of the files if it is not there
   subroutine make_place(directory, error)
      !> The directory; empty for the current one
      character(len=*), intent(in) :: directory
      !> What stands in the way
      type(error_type), allocatable, intent(out) :: error

      integer :: errno

      if (is_directory(join_path(directory, "."))) return
      call make_directories(directory, errno)
      if (errno /= 0) call fatal_error(error, exit_io, "the directory "//directory// &
         " for the results cannot be made: "//error_text(errno)//new_line("a")// &
         "mend: make it first, or choose another with -o")
   end subroutine make_place

   !> Write results, swept bodies, listing and summary. Of processes that share the work the first
   !> one writes, and the others help to find what is written.
   subroutine write_output(job, results, error)
      !> The job; its factors are used again for the fields of earlier increments
      type(job_type), intent(inout), target :: job
      !> Results of a combination
      type(results_type), intent(in) :: results
      !> A file could not be written
      type(error_type), allocatable, intent(out) :: error

      class(team_type), allocatable :: team

      call check_results(results, error)
      if (allocated(error)) return
      call take_team(job%options%team, team)
      if (team%rank == 0) then
         call make_place(job%options%directory, error)  ! which may be gone since
         if (allocated(error)) deallocate (error)  ! then the first file says so
         call write_files(job, results, team, error)
      else
         call team%agree(error)
         if (.not. allocated(error)) call help_with_increments(job, results, error)
      end if
      call team%agree(error)
   end subroutine write_output

   !> Write all files. Nothing changes under a final name before all are complete on the disk; after
   !> an error the temporary files are gone and earlier files stand. The summary gets its name last:
   !> it speaks for all.
   subroutine write_files(job, results, team, error)
      !> The job; its factors are used again for the fields of earlier increments
      type(job_type), intent(inout), target :: job
      !> Results of a combination
      type(results_type), intent(in) :: results
      !> Who helps to find the fields of earlier increments
      class(team_type), intent(in) :: team
      !> A file could not be written
      type(error_type), allocatable, intent(out) :: error

      type(run_type) :: run
      type(hdf5_file_type) :: arrays
      type(bodies_type) :: bodies
      type(surfaces_type) :: surfaces
      type(old_listing_type) :: old_listing
      type(series_type) :: series
      type(text_file_type) :: listing, summary
      character(len=:), allocatable :: directory, name, warnings(:), messages(:)
      integer, allocatable :: files(:)
      logical :: halfway

      directory = job%options%directory
      files = files_of(job%model)
      name = result_name(job, results%combination)
      run = new_run(deck_path(job%source), exit_code_of(results))
      warnings = all_warnings(job%warnings, results%remarks)
      messages = warnings
      if (.not. results%converged) messages = with_first(convergence_text(results), warnings)

      call begin_arrays()
      call team%agree(error)
      if (.not. allocated(error)) then
         call write_increments(job, results, arrays, bodies, surfaces, old_listing, &
            series, error)
      end if
      if (old_listing%page%n_noted > 0) then
         call add_last(warnings, no_room(old_listing, name))
         call add_last(messages, no_room(old_listing, name))
      end if
      if (.not. allocated(error)) call end_bodies(bodies, results, error)
      if (.not. allocated(error)) call end_surfaces(surfaces, results, error)
      if (.not. allocated(error)) call end_old_listing(old_listing, error)
      if (.not. allocated(error)) &
         call listing%open(final_path(directory, name, file_listing), error)
      if (.not. allocated(error)) call write_arrays_and_listing()
      if (.not. allocated(error)) &
         call summary%open(final_path(directory, name, file_summary), error)
      if (.not. allocated(error)) then
         call write_summary(summary, run, messages, job, results, series, sizes_json(directory, name, files))
         call summary%finish(error)
      end if

      if (.not. allocated(error)) call check_names(directory, name, files, error)
      halfway = .false.
      if (.not. allocated(error)) call commit_set(directory, name//journal_ending, &
         names_of_files(name, files), halfway, error)
      if (halfway) return
      call arrays%abandon()
      call bodies%file%abandon()
      call surfaces%file%abandon()
      call old_listing%page%file%abandon()
      call listing%abandon()
      call summary%abandon()

   contains

      !> The results file, swept bodies and joints and an old listing if they are wanted, before what
      !> is written increment by increment
      subroutine begin_arrays()
         call arrays%create(final_path(directory, name, file_arrays), error)
         if (allocated(error)) return
         if (any(files == file_bodies)) &
            call begin_bodies(final_path(directory, name, file_bodies), run, job%model, results, &
               bodies, error)
         if (allocated(error)) return
         if (any(files == file_joints)) &
            call begin_surfaces(final_path(directory, name, file_joints), run, job%model, &
               job%structure, results, surfaces, error)
         if (allocated(error)) return
         if (any(files == file_old_listing)) &
            call begin_old_listing(final_path(directory, name, file_old_listing), job%model, &
               results, old_listing, error)
      end subroutine begin_arrays

      !> Arrays and listing, at once where there is a thread for each – other processes of the machine that work on the
      !> job wait meanwhile; the listing ends with the times of both. Not where bodies yield: both say in words what errors that
      !> leaves, and gfortran keeps the length of the text that a function gives in one place for all threads
      subroutine write_arrays_and_listing()
         type(error_type), allocatable :: unfinished
         type(picture_type), allocatable :: pictures(:)
         integer :: n

         pictures = pictures_of(name, bodies, surfaces)
         n = min(2, max(omp_get_max_threads(), team%sharers))
         if (allocated(results%yield_errors)) n = 1
         !$omp parallel sections num_threads(n)
         !$omp section
         call arrays%mute()
         call write_results(arrays, run, job%source, messages, job%model, results)
         call arrays%finish(unfinished)
         !$omp section
         call write_listing(listing, run, job, warnings, results, series, pictures)
         !$omp end parallel sections
         call end_listing(listing, results, job%timer)
         call listing%finish(error)
         if (allocated(unfinished)) error = unfinished
      end subroutine write_arrays_and_listing

   end subroutine write_files

   !> Bytes of the files that are finished
   function sizes_json(directory, name, files) result(json)
      !> Their directory and name
      character(len=*), intent(in) :: directory, name
      !> Indices of their endings, the summary among them, which does not count
      integer, intent(in) :: files(:)
      !> JSON object, by ending
      character(len=:), allocatable :: json

      character(len=24) :: digits
      integer(i8) :: bytes
      integer :: k

      json = '{'
      do k = 1, size(files)
         if (files(k) == file_summary) cycle
         inquire (file=temporary_path(final_path(directory, name, files(k))), size=bytes)
         write (digits, '(i0)') bytes
         if (len(json) > 1) json = json//', '
         json = json//json_string(trim(endings(files(k))))//': '//trim(digits)
      end do
      json = json//'}'
   end function sizes_json

   !> Sizes of the files of swept bodies and joints
   function pictures_of(name, bodies, surfaces) result(pictures)
      !> Name of the job
      character(len=*), intent(in) :: name
      !> The files
      type(bodies_type), intent(in) :: bodies
      type(surfaces_type), intent(in) :: surfaces
      !> One a file
      type(picture_type), allocatable :: pictures(:)

      allocate (pictures(0))
      if (bodies%wanted) pictures = [new_picture(name//trim(endings(file_bodies)), &
                                                 bodies%file%size(), bodies%mesh)]
      if (surfaces%wanted) pictures = [pictures, new_picture(name//trim(endings(file_joints)), &
                                                             surfaces%file%size(), surfaces%mesh)]
   end function pictures_of

   !> Warnings about the deck and remarks on the results
   pure function all_warnings(warnings, remarks) result(texts)
      !> Warnings about the deck
      character(len=*), intent(in) :: warnings(:)
      !> Remarks on the results
      type(remark_type), intent(in) :: remarks(:)
      !> All of them
      character(len=:), allocatable :: texts(:)

      integer :: k, length

      length = len(warnings)
      do k = 1, size(remarks)
         length = max(length, len(remarks(k)%text))
      end do
      allocate (character(len=length) :: texts(size(warnings) + size(remarks)))
      texts(:size(warnings)) = warnings
      do k = 1, size(remarks)
         texts(size(warnings) + k) = remarks(k)%text
      end do
   end function all_warnings

   !> Remark on values without room in an old listing
   pure function no_room(listing, name) result(text)
      !> The listing
      type(old_listing_type), intent(in) :: listing
      !> Name of the job
      character(len=*), intent(in) :: name
      !> The remark
      character(len=:), allocatable :: text

      text = count_of(listing%page%n_noted, 'value')//' without room in the fields of '//name// &
         trim(endings(file_old_listing))//', which says at its end what is meant'
   end function no_room

   !> Add a text to others
   pure subroutine add_last(texts, text)
      !> The texts
      character(len=:), allocatable, intent(inout) :: texts(:)
      !> The new one
      character(len=*), intent(in) :: text

      character(len=:), allocatable :: longer(:)

      allocate (character(len=max(len(texts), len(text))) :: longer(size(texts) + 1))
      longer(:size(texts)) = texts
      longer(size(texts) + 1) = text
      call move_alloc(longer, texts)
   end subroutine add_last

   !> A text before others
   pure function with_first(first, others) result(texts)
      !> The text
      character(len=*), intent(in) :: first
      !> The others
      character(len=*), intent(in) :: others(:)
      !> All of them
      character(len=max(len(first), len(others))) :: texts(1 + size(others))

      texts(1) = first
      texts(2:) = others
   end function with_first

   !> Names of the files of a run
   pure function names_of_files(name, files) result(names)
      !> Name of the job
      character(len=*), intent(in) :: name
      !> The files, indices of their endings
      integer, intent(in) :: files(:)
      !> The names
      character(len=len(name) + len(endings)) :: names(size(files))

      integer :: k

      do k = 1, size(files)
         names(k) = name//endings(files(k))
      end do
   end function names_of_files

   !> Summary of a run that failed. Results of an earlier run stay untouched:
   !> nothing is written where its listing or arrays stand, or where another run is at work. A
   !> failure to write is passed over, since the error itself is on its way to the user.
   subroutine write_error_summary(directory, name, deck, exit_code, messages, claimed)
      !> Directory of the files; empty for the current one
      character(len=*), intent(in) :: directory
      !> Name of the job
      character(len=*), intent(in) :: name
      !> Path of the deck
      character(len=*), intent(in) :: deck
      !> Exit code of the program
      integer, intent(in) :: exit_code
      !> Causes
      character(len=*), intent(in) :: messages(:)
      !> Whether this run holds the lock of the name; false if absent
      logical, intent(in), optional :: claimed

      type(text_file_type) :: summary
      type(lock_type) :: lock
      type(error_type), allocatable :: error
      logical :: locked

      if (path_kind(final_path(directory, name, file_arrays)) /= path_absent) return
      if (path_kind(final_path(directory, name, file_listing)) /= path_absent) return
      if (same_file(final_path(directory, name, file_summary), deck)) return
      call make_place(directory, error)
      if (allocated(error)) return
      call check_names(directory, name, [file_arrays, file_listing, file_summary], error)
      if (allocated(error)) return
      locked = .false.
      if (present(claimed)) locked = claimed
      if (.not. locked) call take_lock(join_path(directory, name//lock_ending), 'run '//deck, &
         lock, error)
      if (allocated(error)) return
      call summary%open(final_path(directory, name, file_summary), error)
      if (.not. allocated(error)) then
         call write_failure_summary(summary, new_run(deck, exit_code), messages)
         call summary%finish(error)
         if (.not. allocated(error)) call summary%commit(error)
         call summary%abandon()
      end if
      call release_lock(lock)
   end subroutine write_error_summary

   !> Remove the summary of an error that an earlier run of a job of several combinations left: their results have names
   !> of their own, and it would speak against them for ever
   subroutine remove_error_summary(job)
      !> The job, whose results are written
      type(job_type), intent(in) :: job

      !> Bytes of a summary that tell what it is of
      integer, parameter :: enough = 65536
      character(len=:), allocatable :: path, text
      integer :: errno

      if (size(job%model%combinations) == 1) return
      path = final_path(job%options%directory, job_name(job%deck), file_summary)
      if (path_kind(path) /= path_file) return
      if (same_file(path, job%deck)) return
      text = first_bytes(path, enough)
      if (index(text, '"program": "'//program_name//'"') > 0 .and. index(text, '"status": "'//status_error//'"') > 0) &
         call unlink_path(path, errno)
   end subroutine remove_error_summary

   !> The final names are free or of regular files
   subroutine check_names(directory, name, files, error)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> Name of the job
      character(len=*), intent(in) :: name
      !> The files, indices of their endings
      integer, intent(in) :: files(:)
      !> The name that is taken
      type(error_type), allocatable, intent(out) :: error

      integer :: i

      do i = 1, size(files)
         call check_name(final_path(directory, name, files(i)), &
            "move it away, or choose another directory with -o", error)
         if (allocated(error)) return
      end do
   end subroutine check_names

   !> Every array is there, if only with size zero
   subroutine check_results(results, error)
      !> Results
      type(results_type), intent(in) :: results
      !> An array is missing
      type(error_type), allocatable, intent(out) :: error

      if (allocated(results%modes) .and. allocated(results%solves) &
         .and. allocated(results%displacement) .and. allocated(results%reaction) &
         .and. allocated(results%point_element) .and. allocated(results%point_position) &
         .and. allocated(results%stress) .and. allocated(results%plane_angles) &
         .and. allocated(results%joint_point_joint) &
         .and. allocated(results%joint_point_position) &
         .and. allocated(results%joint_jump) .and. allocated(results%joint_stress) &
         .and. allocated(results%joint_state) .and. allocated(results%path) &
         .and. allocated(results%states)) return
      call fatal_error(error, exit_internal, "the results are not complete"//new_line("a")// &
         "mend: this is a fault of the program; please report it with the deck")
   end subroutine check_results

end module axijoint_output_output
