!> Names of the files of a run
module axijoint_output_file_names
   use axijoint_output_file_pending, only : join_path
   implicit none
   private
   public :: endings, file_arrays, file_listing, file_summary, file_bodies, file_joints
   public :: final_path, journal_ending, lock_ending, state_ending, table_ending

   !> Endings of the files
   character(len=14), parameter :: endings(5) = [character(len=14) :: &
      ".h5", ".lis", ".json", ".vtkhdf", ".joints.vtkhdf"]
   integer, parameter :: file_arrays = 1, file_listing = 2, file_summary = 3, file_bodies = 4, &
      file_joints = 5
   !> Ending of the table of a study
   character(len=*), parameter :: table_ending = ".csv"
   !> Endings of what is there only while a run is under way, or was not ended: who writes these
   !> files, which of them are about to get their names, how far it is
   character(len=*), parameter :: lock_ending = ".lock", journal_ending = ".commit", &
      state_ending = ".state"

contains

   !> Path of one of the files
   pure function final_path(directory, name, ending) result(path)
      !> Directory of the files
      character(len=*), intent(in) :: directory
      !> Name of the job
      character(len=*), intent(in) :: name
      !> Index into `endings`
      integer, intent(in) :: ending
      !> The path
      character(len=:), allocatable :: path

      path = join_path(directory, name//trim(endings(ending)))
   end function final_path

end module axijoint_output_file_names
