!> Nodes and elements of the mesh file: places and numbers that the deck cannot take
module axijoint_deck_gmsh_checks
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_gmsh_import, only : gmsh_import_type, mesh_line_error, mesh_line_text
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_mesh_places, only : extent_of
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_source, only : source_type
   implicit none
   private
   public :: check_positions, check_numbers

   !> Largest distance from the plane z = 0 of the file, and from the axis, in extents of the mesh
   !> that counts as rounding
   real(wp), parameter :: rounding = 1.0e-12_wp

contains

   !> Check that the nodes in use lie in the half plane r >= 0, z = 0 of the file
   subroutine check_positions(source, import, diagnostics)
      !> The deck
      type(source_type), intent(inout) :: source
      !> The mesh; nodes that only rounding keeps off the axis are put on it
      type(gmsh_import_type), intent(inout) :: import
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: tolerance
      integer :: node, off_plane, behind, n_off, n_behind

      off_plane = 0
      behind = 0
      n_off = 0
      n_behind = 0
      associate (mesh => import%mesh)
         tolerance = rounding*extent_of(mesh%position(:2, :mesh%n_nodes))
         do node = 1, mesh%n_nodes
            if (import%first_body(node) == 0) cycle
            if (abs(mesh%position(3, node)) > tolerance) then
               n_off = n_off + 1
               if (n_off == 1) off_plane = node
            end if
            if (mesh%position(1, node) < -tolerance) then
               n_behind = n_behind + 1
               if (n_behind == 1) behind = node
            end if
            if (abs(mesh%position(1, node)) <= tolerance) mesh%position(1, node) = 0.0_wp
         end do
         if (n_off > 0) then
            call mesh_line_error(source, mesh%node_line(off_plane), 0, 0, 'node '// &
                                 to_text(mesh%node_tag(off_plane))// &
                                 ' is not in the plane z = 0: z = '// &
                                 to_text(mesh%position(3, off_plane))//others(n_off), &
                                 'x = r, y = the axis, z = 0', &
                                 'draw the section in the (x, y) plane', diagnostics)
         end if
         if (n_behind > 0) then
            call mesh_line_error(source, mesh%node_line(behind), 0, 0, 'node '// &
                                 to_text(mesh%node_tag(behind))// &
                                 ' lies behind the axis: r = x is negative'// &
                                 others(n_behind), 'x >= 0', &
                                 'draw one half of the section, x being the distance from the '// &
                                 'axis', &
                                 diagnostics)
         end if
      end associate
   end subroutine check_positions

   !> How many further nodes have the same fault
   pure function others(n) result(text)
      !> Nodes with the fault
      integer, intent(in) :: n
      !> The text
      character(len=:), allocatable :: text

      text = ''
      if (n > 1) text = '; so are '//count_of(n - 1, 'other')
   end function others

   !> Report numbers of nodes and elements that the cards have, too
   subroutine check_numbers(source, import, use_of, draft, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> BODY card of each element; 0 for none
      integer, intent(in) :: use_of(:)
      !> The mesh of the deck
      type(draft_type), intent(in) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: element_of
      integer :: i, known

      associate (mesh => import%mesh)
         do i = 1, mesh%n_nodes
            known = find_number(draft%node_of, mesh%node_tag(i))
            if (known == 0 .or. import%first_body(i) == 0) cycle
            call report(draft%node_card(known), 'node', mesh%node_tag(i), mesh%node_line(i))
         end do
         if (draft%n_elements == 0) return
         do i = 1, draft%n_elements
            call insert_number(element_of, draft%element_label(i), i)
         end do
         do i = 1, mesh%n_elements
            known = find_number(element_of, mesh%element_tag(i))
            if (known == 0 .or. use_of(i) == 0) cycle
            call report(draft%element_card(known), 'element', mesh%element_tag(i), &
               mesh%element_line(i))
         end do
      end associate

   contains

      !> Report one number
      subroutine report(card, noun, label, line)
         !> Card that gives it
         integer, intent(in) :: card
         !> What it is the number of
         character(len=*), intent(in) :: noun
         !> The number, and its line in the mesh file
         integer, intent(in) :: label, line

         call add_error(diagnostics, card, 0, 0, noun//' '//to_text(label)// &
            ' is given twice: here and on '// &
                        mesh_line_text(source, line), mend='choose another number on the card')
      end subroutine report
   end subroutine check_numbers

end module axijoint_deck_gmsh_checks
