!> The mesh file that a deck names, and what its groups mean
module axijoint_deck_gmsh_import
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_source, only : source_type, add_card
   use axijoint_gmsh_mesh, only : gmsh_mesh_type
   use axijoint_gmsh_reader, only : read_gmsh
   use axijoint_gmsh_scanner, only : fault_type, line_bounds
   implicit none
   private
   public :: gmsh_import_type, group_use_type, read_mesh_file, mesh_line_error, mesh_line_text, &
      copy_label, use_body, use_face, use_joint, name_number, name_group

   !> What a group is used for, in the order of the words of GROUPS
   integer, parameter :: use_body = 1, use_face = 2, use_joint = 3
   !> Names of the fields of GROUPS that messages point at
   character(len=*), parameter :: name_number = 'the number', name_group = 'the name of the group'
   !> Longest piece of a line of the mesh file in messages
   integer, parameter :: longest_line = 120

   !> What a card of GROUPS says
   type :: group_use_type
      !> Entry of GROUPS
      integer :: entry = 0
      !> One of the `use_` parameters
      integer :: kind = 0
      !> Number of the body or face; law (index) of a joint
      integer :: number = 0
      !> Material (index) of a body
      integer :: material = 0
      !> Group (index) of the mesh; 0 if there is none
      integer :: group = 0
   end type group_use_type

   !> The mesh of the file on its way into the deck's mesh
   type :: gmsh_import_type
      !> Whether the deck has a mesh file, or cards about it
      logical :: given = .false.
      !> Whether the file and the cards of GROUPS are without fault
      logical :: sound = .false.
      !> The mesh of the file
      type(gmsh_mesh_type) :: mesh
      !> Cards of GROUPS without fault
      type(group_use_type), allocatable :: uses(:)
      !> Least number of the bodies that have a node of the file; 0 for none. In this body the node
      !> keeps its number
      integer, allocatable :: first_body(:)
      !> Copies of the node for other bodies: the first of each node, 0 if there is none, and the
      !> next one of each copy
      integer, allocatable :: first_copy(:), next_copy(:)
      !> Number of copies, and the body and node number of each
      integer :: n_copies = 0
      integer, allocatable :: copy_body(:), copy_number(:)
   end type gmsh_import_type

contains

   !> Read the file of the GMSH card
   subroutine read_mesh_file(source, import, diagnostics)
      !> The deck; the line at fault becomes a card
      type(source_type), intent(inout) :: source
      !> The mesh
      type(gmsh_import_type), intent(inout) :: import
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(fault_type), allocatable :: fault

      import%given = source%mesh_card > 0
      import%sound = source%mesh_file > 0
      if (.not. import%sound) return
      call read_gmsh(source%files(source%mesh_file)%bytes, import%mesh, fault)
      import%sound = .not. allocated(fault)
      if (import%sound) return
      call mesh_line_error(source, fault%line, fault%first, fault%last, fault%text, fault%allowed, &
                           fault%mend, diagnostics)
   end subroutine read_mesh_file

   !> Report an error in a line of the mesh file
   subroutine mesh_line_error(source, line, first, last, text, allowed, mend, diagnostics)
      !> The deck; the line becomes a card
      type(source_type), intent(inout) :: source
      !> Line of the file, and columns; 0 for the whole line
      integer, intent(in) :: line, first, last
      !> What is wrong, what is allowed, how to mend it
      character(len=*), intent(in) :: text, allowed, mend
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: from, to

      call line_bounds(source%files(source%mesh_file)%bytes, line, from, to)
      to = min(to, from + longest_line - 1)
      call add_card(source, source%mesh_file, line, from, to)
      if (last <= longest_line) then
         call add_error(diagnostics, source%n_cards, first, last, text, allowed=allowed, mend=mend)
      else
         call add_error(diagnostics, source%n_cards, 0, 0, text, allowed=allowed, mend=mend)
      end if
   end subroutine mesh_line_error

   !> A line of the mesh file, to be named in a message: line 7 of pile.msh
   pure function mesh_line_text(source, line) result(text)
      !> The deck
      type(source_type), intent(in) :: source
      !> The line
      integer, intent(in) :: line
      !> The text
      character(len=:), allocatable :: text

      text = 'line '//to_text(line)//' of '//source%files(source%mesh_file)%path
   end function mesh_line_text

   !> Number of a node of the file in a body; 0 if the body does not have it
   pure integer function copy_label(import, node, body) result(label)
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Node (index) of the file, and body
      integer, intent(in) :: node, body

      integer :: copy

      label = 0
      if (import%first_body(node) == body) label = import%mesh%node_tag(node)
      copy = import%first_copy(node)
      do while (copy > 0)
         if (import%copy_body(copy) == body) label = import%copy_number(copy)
         copy = import%next_copy(copy)
      end do
   end function copy_label

end module axijoint_deck_gmsh_import
