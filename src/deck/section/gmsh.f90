!> GMSH: the mesh file. The source reader keeps it
module axijoint_deck_section_gmsh
   use axijoint_deck_gmsh_import, only : read_mesh_file
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_text_section, only : form_file
   implicit none
   private
   public :: gmsh_section

contains

   !> GMSH
   function gmsh_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = 'GMSH'
      section%purpose = 'path of a mesh file of Gmsh or its .geo file, from column 11 on; '// &
         'GROUPS says what groups mean'
      section%form = form_file
      section%once = .true.
      section%stage = stage_properties
      section%read => read_gmsh
   end function gmsh_section

   !> Read the mesh file
   subroutine read_gmsh(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      call read_mesh_file(deck%source, deck%import, deck%diagnostics)
   end subroutine read_gmsh

end module axijoint_deck_section_gmsh
