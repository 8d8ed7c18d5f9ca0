!> Interfaces, which stand in listing, JSON and HDF5
module axijoint_output_table_interfaces
   use axijoint_base_text, only : to_text
   use axijoint_model_interface, only : interface_name
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_model, only : model_type
   use axijoint_output_file_hdf5, only : hdf5_file_type
   use axijoint_output_file_headings, only : write_heading, width
   use axijoint_output_file_json, only : json_string, json_number
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_interfaces, interfaces_json, write_interface_group

   !> An interface
   character(len=*), parameter :: format_interface = '(i10, a10, 5i10, 3x, a)'
   !> Longest line of pairs of numbers
   integer, parameter :: width_of_pairs = 90

contains

   !> Interfaces, and numbers of nodes that bodies share
   subroutine write_interfaces(file, model)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=width) :: line
      character(len=10) :: law
      integer :: i

      if (size(model%interfaces) == 0) return
      call write_heading(file, "INTERFACES (side 1-2 of their joints on face a, 4-3 on face b)")
      call file%put(" interface       law    face a    face b    body a    body b    joints   name")
      do i = 1, size(model%interfaces)
         associate (interface => model%interfaces(i))
            law = "    bonded"
            if (interface%law > 0) write (law, '(i10)') &
               model%joint_materials(interface%law)%label
            write (line, format_interface) i, law, interface%faces, interface%bodies, &
               count(model%mesh%joint_interface == i), interface_name(model%interfaces, i)
            call file%put(trim(line))
         end associate
      end do
      call write_shared(file, model%mesh)
   end subroutine write_interfaces

   !> Numbers of nodes that are one
   subroutine write_shared(file, mesh)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The mesh
      type(mesh_type), intent(in) :: mesh

      character(len=:), allocatable :: text, pair
      integer :: i

      if (size(mesh%shared_label, 2) == 0) return
      call file%put("")
      call file%put("Nodes that bonded bodies share; tables have the first number:")
      text = ""
      do i = 1, size(mesh%shared_label, 2)
         pair = to_text(mesh%shared_label(1, i))//" = "//to_text(mesh%shared_label(2, i))
         if (len(text) + len(pair) > width_of_pairs) then
            call file%put("   "//text)
            text = ""
         end if
         if (len(text) > 0) text = text//", "
         text = text//pair
      end do
      call file%put("   "//text)
   end subroutine write_shared

   !> All interfaces
   pure function interfaces_json(model) result(json)
      !> The job
      type(model_type), intent(in) :: model
      !> A JSON array
      character(len=:), allocatable :: json

      character(len=:), allocatable :: law
      integer :: i

      json = "["
      do i = 1, size(model%interfaces)
         associate (interface => model%interfaces(i))
            law = '"bonded"'
            if (interface%law > 0) law = json_number(model%joint_materials(interface%law)%label)
            if (i > 1) json = json//", "
            json = json//'{"name": '//json_string(interface_name(model%interfaces, i))// &
               ', "law": '//law// &
               ', "face_a": '//json_number(interface%faces(1))// &
               ', "face_b": '//json_number(interface%faces(2))// &
               ', "body_a": '//json_number(interface%bodies(1))// &
               ', "body_b": '//json_number(interface%bodies(2))// &
               ', "joints": '//json_number(count(model%mesh%joint_interface == i))//'}'
         end associate
      end do
      json = json//"]"
   end function interfaces_json

   !> All interfaces in the HDF5 file
   subroutine write_interface_group(file, model)
      !> The file
      class(hdf5_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model

      character(len=:), allocatable :: names
      integer :: i, n

      n = size(model%interfaces)
      names = ""
      do i = 1, n
         names = names//interface_name(model%interfaces, i)//new_line("a")
      end do
      call file%group("/interfaces")
      associate (all => model%interfaces)
         call file%write("/interfaces/name", names, "Names, one a line; (interface)")
         call file%write("/interfaces/law", (all%law), &
            "Index into /joint_materials, 0 if bonded; (interface)")
         call file%write("/interfaces/face_a", [(all(i)%faces(1), i=1, n)], &
            "Number of the face of side 1-2, 0 if it has none; (interface)")
         call file%write("/interfaces/face_b", [(all(i)%faces(2), i=1, n)], &
            "Number of the face of side 4-3, 0 if it has none; (interface)")
         call file%write("/interfaces/body_a", [(all(i)%bodies(1), i=1, n)], &
            "Body of side 1-2; (interface)")
         call file%write("/interfaces/body_b", [(all(i)%bodies(2), i=1, n)], &
            "Body of side 4-3; (interface)")
      end associate
   end subroutine write_interface_group

end module axijoint_output_table_interfaces
