!> Results of all increments, one after the other, for every file that shows them
module axijoint_output_increments
   use omp_lib, only : omp_get_max_threads
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_increment_fields, only : solve_increment, solve_increments, is_found, recover_state, move_bodies
   use axijoint_analysis_core_results, only : results_type
   use axijoint_analysis_core_series, only : series_type, new_series, append_increment
   use axijoint_analysis_core_solution, only : solved_state_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_progress, only : show_progress
   use axijoint_base_text, only : to_text
   use axijoint_base_timer, only : phase_recover
   use axijoint_job_job, only : job_type
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type, is_shown, shows_stress
   use axijoint_model_request, only : is_kept, keep_series
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_hdf5_history, only : history_fields_type, begin_history, put_history, &
      end_history, write_series
   use axijoint_output_legacy_listing, only : old_listing_type, put_old_listing
   use axijoint_output_vtkhdf_bodies, only : bodies_type, put_bodies
   use axijoint_output_vtkhdf_joints, only : surfaces_type, put_surfaces
   implicit none
   private
   public :: write_increments, help_with_increments

   !> Nodes up to which a thread finds the fields of an increment by itself: its stack is small. Of
   !> larger meshes the harmonics are shared
   integer, parameter :: most_nodes = 20000
   !> Increments whose displacements are found at once, so that a factor is read once for all of them: at least, and as
   !> many more as have so many numbers
   integer, parameter :: least_at_once = 4, most_at_once = 8
   real(wp), parameter :: numbers_at_once = 4.0e6_wp

contains

   !> Find the fields of each increment, the last of which are the results, and hand them to all
   !> files: while one thread writes, another finds the next
   subroutine write_increments(job, results, arrays, bodies, surfaces, &
      old_listing, series, error)
      !> The job; its factors are used again
      type(job_type), intent(inout), target :: job
      !> Results of a combination
      type(results_type), intent(in) :: results
      !> The results file
      class(hdf5_file_type), intent(inout) :: arrays
      !> Swept bodies and joints, begun if they are wanted
      type(bodies_type), intent(inout) :: bodies
      type(surfaces_type), intent(inout) :: surfaces
      !> Listing in an old layout, begun if it is wanted
      type(old_listing_type), intent(inout) :: old_listing
      !> What is followed from increment to increment
      type(series_type), intent(out) :: series
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(history_fields_type) :: fields
      type(solved_state_type), allocatable :: solved(:)
      integer, allocatable :: shown(:)
      logical, allocatable :: found(:)
      integer :: first, i, k, last, n

      last = size(results%states)
      associate (model => job%model, structure => job%structure, states => results%states)
         call begin_history(arrays, model, results, fields)
         series = new_series(model, results, &
            count([(is_kept(model%keep(keep_series), states(i)%increment, &
                            states(last)%increment), i=1, last)]))
         call job%timer%push(phase_recover)
         shown = pack([(i, i=1, last - 1)], [(is_shown(model, states(i)%increment, states(last)%increment), i=1, last - 1)])
         allocate (solved(merge(at_once(), 1, by_threads())))
         do first = 1, size(shown), size(solved)
            n = min(size(solved), size(shown) - first + 1)
            call show_progress(job%progress, 'fields of increment '//to_text(shown(first))//' of '//to_text(last))
            associate (now => shown(first:first + n - 1))
               found = [(is_found(states(now(k))%increment, results%earlier), k=1, n)]
               call solve_increments(model, structure, states, pack(now, .not. found), solved(:count(.not. found)), error)
               if (allocated(error)) exit
               !$omp parallel do ordered schedule(dynamic) if (n > 1)
               do k = 1, n
                  call find(now(k), found(k), solved(max(1, count(.not. found(:k)))))
               end do
               !$omp end parallel do
            end associate
         end do
         if (.not. allocated(error)) call put(last, results)
         call job%timer%pop()
         call end_history(arrays, fields)
         call write_series(arrays, model, series)
      end associate

   contains

      !> Whether threads share the increments. Processes meet increment by increment
      logical function by_threads()
         by_threads = .false.
         if (size(shown) < 2) return  ! no structure may be there
         by_threads = job%structure%equations%team%size == 1 .and. n_nodes(job%model%mesh) <= most_nodes
      end function by_threads

      !> Increments whose displacements are found at once
      pure integer function at_once()
         at_once = max(least_at_once, min(most_at_once, int(numbers_at_once/size(results%displacement))))
      end function at_once

      !> Find the fields of an increment, and hand them to the files when its turn comes
      subroutine find(i, found, solved)
         !> Its place
         integer, intent(in) :: i
         !> Whether they were found beside the iterations
         logical, intent(in) :: found
         !> Its displacements, if not
         type(solved_state_type), intent(inout) :: solved

         type(fields_type) :: fields

         associate (model => job%model, structure => job%structure, state => results%states(i))
            if (found) then
               fields = results%earlier(state%increment)
            else
               call recover_state(model, structure, state, results%plane_angles, solved, fields, &
                  smoothed=shows_stress(model, state%increment, results%states(last)%increment))
            end if
            call move_bodies(model, structure, state, fields)
         end associate
         !$omp ordered
         call put(i, fields)
         !$omp end ordered
      end subroutine find

      !> Hand the fields of an increment to the files
      subroutine put(i, now)
         !> Its place
         integer, intent(in) :: i
         !> The fields
         class(fields_type), intent(in) :: now

         associate (model => job%model, structure => job%structure)
            if (is_kept(model%keep(keep_series), results%states(i)%increment, &
                        results%states(last)%increment)) &
               call append_increment(model, structure, results, i, now, series)
            call arrays%mute()  ! in this thread
            call put_history(arrays, model, results, i, now, fields)
            call arrays%to_disk()
            call put_bodies(bodies, now)
            call put_surfaces(surfaces, model, structure, results%states(i), now)
            call put_old_listing(old_listing, model, results, i, now)
         end associate
      end subroutine put

   end subroutine write_increments

   !> Take part in finding the fields that another process writes
   subroutine help_with_increments(job, results, error)
      !> The job; its factors are used again
      type(job_type), intent(inout), target :: job
      !> Results of a combination
      type(results_type), intent(in) :: results
      !> Out of memory
      type(error_type), allocatable, intent(out) :: error

      type(fields_type) :: fields
      integer :: i

      associate (states => results%states, last => results%states(size(results%states))%increment)
         do i = 1, size(states) - 1
            if (.not. is_shown(job%model, states(i)%increment, last)) cycle
            call solve_increment(job%model, job%structure, i, states, results%plane_angles, fields, error, &
               smoothed=shows_stress(job%model, states(i)%increment, last))
            if (allocated(error)) return
         end do
      end associate
   end subroutine help_with_increments

end module axijoint_output_increments
