!> Meshes that Gmsh makes anew, with elements of the sizes that the estimate of errors asks for
module axijoint_job_remesh
   use axijoint_base_error, only : error_type, fatal_error, exit_io, exit_state
   use axijoint_base_kinds, only : wp
   use axijoint_base_sha256, only : sha256
   use axijoint_base_system, only : error_text, rename_path, unlink_path
   use axijoint_base_text, only : to_text, name_of
   use axijoint_base_whole_file, only : read_whole_file, write_new_file
   use axijoint_gmsh_size_view, only : size_view
   use axijoint_job_job, only : job_type, job_name
   use axijoint_model_request, only : refinement_type
   implicit none
   private
   public :: remake_mesh, check_mesh_file

   !> Ending of the sizes, of what Gmsh says, and of the mesh of a round
   character(len=*), parameter :: sizes_ending = '.size.pos', log_ending = '.gmsh.log', &
      mesh_ending = '.msh'
   !> Exit code of the shell for a command that is not there
   integer, parameter :: not_there = 127

contains

   !> Write the sizes that are wanted, and have Gmsh make a mesh of them if it can
   subroutine remake_mesh(job, round, refinement, made, note, error)
      !> The job as it was solved
      type(job_type), intent(in) :: job
      !> Number of the round that the mesh is for
      integer, intent(in) :: round
      !> The sizes wanted; takes the mesh
      type(refinement_type), intent(inout) :: refinement
      !> Whether there is another mesh
      logical, intent(out) :: made
      !> Why not, and what can be done about it; empty if it was made
      character(len=:), allocatable, intent(out) :: note
      !> The sizes cannot be written
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: stem, sizes, mesh, part, bytes, by_hand
      integer :: errno, code, status

      made = .false.
      stem = path_of(job)
      sizes = stem//sizes_ending
      call write_sizes(job, refinement%sizes, sizes, error)
      if (allocated(error)) return
      associate (geometry => job%model%error_goal%geometry)
         by_hand = command(geometry, sizes, geometry(:index(geometry, '.', back=.true.) - 1)//mesh_ending)
         if (len(geometry) == 0) then
            note = 'the deck names no .geo file that Gmsh could make its mesh of anew; '//name_of(sizes)// &
               ' has the sizes of elements wanted (gmsh -bgm)'
            return
         else if (allocated(job%options%team)) then
            note = 'several processes do not make meshes anew; by hand: '//by_hand
            return
         end if
         mesh = stem//'.round'//to_text(round)//mesh_ending
         part = stem//'.part'//mesh_ending
         call unlink_path(part, errno)
         code = 0
         call execute_command_line(command(geometry, sizes, part)//' >'//quoted(stem//log_ending)// &
                                   ' 2>&1', exitstat=code, cmdstat=status)
         if (status == 0 .and. code == 0) then
            call read_whole_file(part, bytes, errno)
            if (errno == 0) call rename_path(part, mesh, errno)
            made = errno == 0
         end if
         if (made) then
            refinement%mesh_file = mesh
            refinement%mesh_hash = sha256(bytes)
            note = ''
            call unlink_path(stem//log_ending, errno)
         else if (code == not_there) then
            note = 'gmsh is not installed; where it is: '//by_hand
            call unlink_path(stem//log_ending, errno)
         else
            note = 'gmsh made no mesh (see '//name_of(stem//log_ending)//'): '//by_hand
         end if
      end associate
   end subroutine remake_mesh

   !> What has Gmsh make a mesh of sizes that are wanted, for the shell
   pure function command(geometry, sizes, mesh)
      !> Files of the geometry and of the sizes; the file that the mesh is written into
      character(len=*), intent(in) :: geometry, sizes, mesh
      !> The command
      character(len=:), allocatable :: command

      command = 'gmsh -2 '//quoted(geometry)//' -bgm '//quoted(sizes)// &
         ' -setnumber Mesh.MeshSizeExtendFromBoundary 0 -o '//quoted(mesh)
   end function command

   !> Write the view of the sizes under its final name when it is complete
   subroutine write_sizes(job, sizes, path, error)
      !> The job as it was solved
      type(job_type), intent(in) :: job
      !> Size wanted at each node
      real(wp), intent(in) :: sizes(:)
      !> The file
      character(len=*), intent(in) :: path
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      integer :: errno

      call unlink_path(path//'.tmp', errno)
      associate (mesh => job%model%mesh)
         call write_new_file(path//'.tmp', size_view(mesh%coordinates, mesh%element_nodes, &
            merge(3, 4, mesh%element_size == 3 .or. mesh%element_size == 6), sizes), errno)
      end associate
      if (errno == 0) call rename_path(path//'.tmp', path, errno)
      if (errno /= 0) call fatal_error(error, exit_io, 'cannot write '//path//': '// &
         error_text(errno)//new_line('a')// &
         'mend: make room and allow writing there, or choose another directory with -o')
   end subroutine write_sizes

   !> Make sure that the mesh of a round that is gone on with is the one that it was begun with
   subroutine check_mesh_file(refinement, error)
      !> How the job is refined
      type(refinement_type), intent(in) :: refinement
      !> The mesh is another
      type(error_type), allocatable, intent(out) :: error

      character(len=:), allocatable :: bytes
      integer :: errno

      if (.not. allocated(refinement%mesh_file)) return
      call read_whole_file(refinement%mesh_file, bytes, errno)
      if (errno == 0) then
         if (sha256(bytes) == refinement%mesh_hash) return
      end if
      call fatal_error(error, exit_state, 'the mesh that the run was stopped with, '// &
         refinement%mesh_file//', has changed or is not there'//new_line('a')// &
         'mend: put it back, or begin anew without --resume')
   end subroutine check_mesh_file

   !> Path of the results without an ending
   function path_of(job) result(path)
      !> The job
      type(job_type), intent(in) :: job
      !> The path
      character(len=:), allocatable :: path

      path = job_name(job%deck)
      if (job%options%directory /= '.') path = job%options%directory//'/'//path
   end function path_of

   !> A path as a word of the shell
   pure function quoted(path) result(word)
      !> The path
      character(len=*), intent(in) :: path
      !> The word: a quotation mark ends it, stands alone, and begins it again
      character(len=:), allocatable :: word

      integer :: i

      word = "'"
      if (index(path, '-') == 1) word = "'./"
      do i = 1, len(path)
         if (path(i:i) == "'") then
            word = word//"'\''"
         else
            word = word//path(i:i)
         end if
      end do
      word = word//"'"
   end function quoted

end module axijoint_job_remesh
