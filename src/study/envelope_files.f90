!> The files of an envelope: NAME.envelope.csv with a line a direction, and NAME.envelope.h5
module axijoint_study_envelope_files
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_base_version, only : program_name, program_version
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_text, only : text_file_type
   use axijoint_study_envelope, only : capacity_type
   use axijoint_study_files, only : quoted
   use axijoint_study_undertaking, only : undertaking_type, commit_pair
   implicit none
   private
   public :: write_envelope

contains

   !> Write the files
   subroutine write_envelope(undertaking, cases, directions, found, error)
      !> What is under way: where the files go
      type(undertaking_type), intent(in) :: undertaking
      !> Numbers of the load cases
      integer, intent(in), contiguous :: cases(:)
      !> Unit vectors, shape (cases, directions)
      real(wp), intent(in), contiguous :: directions(:, :)
      !> What was found
      type(capacity_type), intent(in) :: found(:)
      !> A file could not be written
      type(error_type), allocatable, intent(out) :: error

      type(text_file_type) :: csv
      type(hdf5_file_type) :: arrays
      logical :: halfway
      character(len=:), allocatable :: line
      integer :: i, k

      call csv%open(undertaking%stem//'.csv', error)
      if (allocated(error)) return
      line = 'direction'
      do i = 1, size(cases)
         line = line//',direction of case '//to_text(cases(i))
      end do
      line = line//',capacity,no equilibrium found at'
      do i = 1, size(cases)
         line = line//',factor of case '//to_text(cases(i))
      end do
      call csv%put(line//',exit_code,increments,seconds,mechanism')
      do k = 1, size(found)
         line = to_text(k)
         do i = 1, size(cases)
            line = line//','//all_digits(directions(i, k))
         end do
         line = line//','//all_digits(found(k)%factor)//','
         if (found(k)%without > 0.0_wp) line = line//all_digits(found(k)%without)
         do i = 1, size(cases)
            line = line//','//all_digits(found(k)%factor*directions(i, k))
         end do
         call csv%put(line//','//to_text(found(k)%code)//','//to_text(found(k)%n_increments)// &
            ','//all_digits(found(k)%seconds)//','//quoted(found(k)%message))
      end do
      call csv%finish(error)
      if (.not. allocated(error)) call arrays%create(undertaking%stem//'.h5', error)
      if (.not. allocated(error)) then
         call arrays%attribute('/', 'program', program_name)
         call arrays%attribute('/', 'version', program_version)
         call arrays%write('/cases', cases, 'Numbers of the load cases; (case)')
         call arrays%write('/directions', directions, 'Unit vectors; (case, direction)')
         call arrays%write('/capacity', (found%factor), &
            'Largest factor that equilibrium was found for; (direction)')
         call arrays%write('/without', (found%without), &
            'Least factor at which none was found, 0 if there is none; (direction)')
         call arrays%write('/exit_code', (found%code), &
            '4 a mechanism, 3 no equilibrium found, 0 no end; (direction)')
         call arrays%write('/increments', (found%n_increments), 'Solved; (direction)')
         call arrays%write('/seconds', (found%seconds), 'Time; (direction) [second]')
         call arrays%finish(error)
      end if
      halfway = .false.
      if (.not. allocated(error)) call commit_pair(undertaking, halfway, error)
      if (halfway) return
      call arrays%abandon()
      call csv%abandon()
   end subroutine write_envelope

   !> A real with all its digits
   function all_digits(value) result(text)
      !> The value
      real(wp), intent(in) :: value
      !> The text
      character(len=:), allocatable :: text

      character(len=24) :: buffer

      write (buffer, '(es24.16e3)') value
      text = trim(adjustl(buffer))
   end function all_digits

end module axijoint_study_envelope_files
