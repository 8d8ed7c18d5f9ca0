!> From the bytes of a Gmsh file, format 2.2 or 4.1, to a mesh
module axijoint_gmsh_reader
   use axijoint_gmsh_format_2, only : read_nodes_2, read_elements_2
   use axijoint_gmsh_format_4, only : entities_type, read_entities, read_nodes_4, read_elements_4
   use axijoint_gmsh_mesh, only : gmsh_mesh_type
   use axijoint_gmsh_parts, only : read_names
   use axijoint_gmsh_scanner, only : scanner_type, fault_type, new_scanner, next_line, next_token, &
      token_text, line_fault, token_fault, read_integer
   use axijoint_gmsh_section, only : end_section, skip_section
   use axijoint_gmsh_unite, only : unite_elements
   implicit none
   private
   public :: read_gmsh

   !> Mend for files in other formats
   character(len=*), parameter :: other_format = &
      'save the mesh by Gmsh with Mesh.MshFileVersion=4.1 or 2.2 and Mesh.Binary=0'

contains

   !> Read a mesh
   pure subroutine read_gmsh(bytes, mesh, fault)
      !> The file
      character(len=*), intent(in) :: bytes
      !> The mesh; not whole if there is a fault
      type(gmsh_mesh_type), intent(out) :: mesh
      !> The first fault of the file
      type(fault_type), allocatable, intent(out) :: fault

      type(scanner_type) :: scanner
      type(entities_type) :: entities
      character(len=:), allocatable :: word
      integer :: version
      logical :: found

      allocate (mesh%groups(0), mesh%sets(0), entities%set(0))
      scanner = new_scanner(bytes)
      call read_format(scanner, version, fault)
      do
         if (allocated(fault)) return
         call next_line(scanner, found)
         if (.not. found) exit
         call next_token(scanner)
         word = token_text(scanner)
         call check_order(scanner, word, mesh, fault)
         if (allocated(fault)) return
         select case (word)
         case ('$PhysicalNames')
            call read_names(scanner, mesh, fault)
         case ('$Entities')
            call read_entities(scanner, mesh, entities, fault)
         case ('$Nodes')
            if (version == 2) call read_nodes_2(scanner, word(2:), mesh, fault)
            if (version == 4) call read_nodes_4(scanner, mesh, fault)
         case ('$ParametricNodes')  ! of format 2.2 with Mesh.SaveParametric=1; 4.1 has $Nodes then, too
            call read_nodes_2(scanner, word(2:), mesh, fault)
         case ('$Elements')
            if (version == 2) call read_elements_2(scanner, mesh, fault)
            if (version == 4) call read_elements_4(scanner, entities, mesh, fault)
         case default
            call skip_section(scanner, word(2:), fault)
         end select
      end do
      if (.not. allocated(mesh%node_tag)) then
         fault = line_fault(scanner, 'the file has no section $Nodes')
      else if (.not. allocated(mesh%element_tag)) then
         fault = line_fault(scanner, 'the file has no section $Elements')
      else
         call unite_elements(mesh, fault)
      end if
   end subroutine read_gmsh

   !> Read $MeshFormat: version, 0 for ASCII or 1 for binary, size of a real
   pure subroutine read_format(scanner, version, fault)
      !> The scanner, before the first line
      type(scanner_type), intent(inout) :: scanner
      !> 2 or 4
      integer, intent(out) :: version
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      logical :: found
      integer :: binary, size_of_real

      version = 0
      do
         call next_line(scanner, found)
         call next_token(scanner)
         if (.not. found .or. token_text(scanner) /= '$Comments') exit
         call skip_section(scanner, 'Comments', fault)
         if (allocated(fault)) return
      end do
      if (token_text(scanner) /= '$MeshFormat') then
         fault = line_fault(scanner, 'this is not a mesh file of Gmsh: it does not begin with '// &
            '$MeshFormat', &
                            mend=other_format)
         return
      end if
      call next_line(scanner, found)
      call next_token(scanner)
      if (token_text(scanner) == '2.2') version = 2
      if (token_text(scanner) == '4.1') version = 4
      if (version == 0) then
         fault = token_fault(scanner, 'this format cannot be read', allowed='2.2 or 4.1', &
            mend=other_format)
      end if
      call read_integer(scanner, 'the mark of binary files', 0, 1, binary, fault)
      if (.not. allocated(fault) .and. binary == 1) then
         fault = token_fault(scanner, 'the mesh file is binary', allowed='0: ASCII', &
                             mend='save it with Mesh.Binary=0')
      end if
      call read_integer(scanner, 'the size of a real', 1, 16, size_of_real, fault)
      call end_section(scanner, 'MeshFormat', fault)
   end subroutine read_format

   !> See that a section may stand where it does
   pure subroutine check_order(scanner, word, mesh, fault)
      !> The scanner, behind the first word of a line
      type(scanner_type), intent(in) :: scanner
      !> The word
      character(len=*), intent(in) :: word
      !> The mesh so far
      type(gmsh_mesh_type), intent(in) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      if (word(1:1) /= '$' .or. index(word, '$End') == 1) then
         fault = line_fault(scanner, 'the line belongs to no section', &
                            allowed='$Nodes, $Elements or another word that opens a section')
      else if (word == '$PartitionedEntities') then
         fault = token_fault(scanner, 'the mesh is partitioned', &
                             mend='save it without partitions: Mesh.PartitionSplitMeshFiles=0, '// &
                             'unpartition')
      else if (word == '$Elements' .and. .not. allocated(mesh%node_tag)) then
         fault = token_fault(scanner, 'the elements come before the nodes')
      else if (((word == '$Nodes' .or. word == '$ParametricNodes') .and. allocated(mesh%node_tag)) &
               .or. (word == '$Elements' .and. allocated(mesh%element_tag))) then
         fault = token_fault(scanner, 'the section '//word//' is there twice')
      end if
   end subroutine check_order

end module axijoint_gmsh_reader
