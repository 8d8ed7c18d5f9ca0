!> Names of the files of a run
module axijoint_output_file_names
   use axijoint_model_mesh, only : n_joints
   use axijoint_model_model, only : model_type
   use axijoint_output_file_pending, only : join_path
   implicit none
   private
   public :: endings, file_arrays, file_listing, file_summary, file_bodies, file_joints, &
      file_old_listing
   public :: files_of, final_path, journal_ending, lock_ending, state_ending, stop_ending, table_ending, &
      rows_ending, put_aside

   !> Endings of the files
   character(len=16), parameter :: endings(6) = [character(len=16) :: &
      ".h5", ".lis", ".json", ".vtkhdf", ".joints.vtkhdf", ".owen-hinton.lis"]
   integer, parameter :: file_arrays = 1, file_listing = 2, file_summary = 3, file_bodies = 4, &
      file_joints = 5, file_old_listing = 6
   !> Endings of the table of a study, and of the journal of its rows
   character(len=*), parameter :: table_ending = ".csv", rows_ending = ".rows"
   !> Endings of what is there only while a run is under way, or was not ended: who writes these
   !> files, which of them are about to get their names, how far it is, and that it shall end
   character(len=*), parameter :: lock_ending = ".lock", journal_ending = ".commit", &
      state_ending = ".state", stop_ending = ".STOP"
   !> What is added to the name of a state, or of the rows of a study, that was not gone on from
   character(len=*), parameter :: put_aside = ".old"

contains

   !> Files that a job writes, the summary, which speaks for all, last
   pure function files_of(model) result(files)
      !> The job
      type(model_type), intent(in) :: model
      !> Indices into `endings`
      integer, allocatable :: files(:)

      files = [file_arrays, file_listing]
      if (model%sweep%wanted) files = [files, file_bodies]
      if (model%sweep%wanted .and. n_joints(model%mesh) > 0) files = [files, file_joints]
      if (model%old_listing) files = [files, file_old_listing]
      files = [files, file_summary]
   end function files_of

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
