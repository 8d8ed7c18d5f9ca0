!> What the listing says of the files of the swept bodies
module axijoint_output_listing_sweep
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_text, only : count_of
   use axijoint_output_file_headings, only : write_heading
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_vtkhdf_swept_mesh, only : swept_mesh_type, n_points, n_cells
   implicit none
   private
   public :: picture_type, new_picture, write_pictures

   !> File, sectors, points, cells, bytes
   character(len=*), parameter :: format_row = '(a, 3(1x, i12), 1x, f14.3)'
   !> Columns of the name of a file
   integer, parameter :: name_width = 40

   !> A file of swept bodies or joints
   type :: picture_type
      !> Name, without directories
      character(len=:), allocatable :: name
      !> Its size
      integer(i8) :: bytes = 0
      !> Numbers of sectors, points, cells
      integer(i8) :: n_sectors = 0, n_points = 0, n_cells = 0
   end type picture_type

contains

   !> A file that has been written
   pure function new_picture(name, bytes, mesh) result(picture)
      !> Name, without directories
      character(len=*), intent(in) :: name
      !> Its size
      integer(i8), intent(in) :: bytes
      !> Its mesh
      type(swept_mesh_type), intent(in) :: mesh
      !> What is to be told of it
      type(picture_type) :: picture

      picture%name = name
      picture%bytes = bytes
      picture%n_sectors = mesh%n_sectors
      picture%n_points = n_points(mesh)
      picture%n_cells = n_cells(mesh)
   end function new_picture

   !> The files; nothing if there is none
   subroutine write_pictures(file, n_steps, pictures)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Number of time steps
      integer, intent(in) :: n_steps
      !> The files
      type(picture_type), intent(in) :: pictures(:)

      character(len=name_width) :: name
      character(len=120) :: line
      integer :: k

      if (size(pictures) == 0) return
      call write_heading(file, "SWEPT BODIES ("//count_of(n_steps, "time step")//")")
      call file%put("file                                         sectors       points        "// &
         "cells"// &
                    "    size [MiB]")
      do k = 1, size(pictures)
         associate (picture => pictures(k))
            name = picture%name
            write (line, format_row) name, picture%n_sectors, picture%n_points, picture%n_cells, &
               real(picture%bytes, wp)/2.0_wp**20
         end associate
         call file%put(trim(line))
      end do
   end subroutine write_pictures

end module axijoint_output_listing_sweep
