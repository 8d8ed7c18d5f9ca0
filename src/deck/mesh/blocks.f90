!> Blocks of quadrilaterals or triangles as the cards give them, checked
module axijoint_deck_mesh_blocks
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_draft, only : draft_type, most_nodes
   use axijoint_deck_property_properties, only : properties_type, find_property
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, field_error, entry_error
   implicit none
   private
   public :: block_type, check_blocks, count_nodes

   !> Fields of BLOCKS
   integer, parameter, public :: field_body = 1, field_material = 2, field_size = 3, field_n1 = 4, &
      field_n2 = 5, field_ratio1 = 6, field_ratio2 = 7, field_corner = 8
   !> Least sine of the angle at a corner of a block
   real(wp), parameter :: least_sine = 1.0e-6_wp

   !> A block
   type :: block_type
      !> Entry of BLOCKS, and material (index)
      integer :: entry = 0, material = 0
      !> Corners, counterclockwise, shape (2, 4)
      real(wp) :: corners(2, 4) = 0.0_wp
   end type block_type

contains

   !> Check the cards and keep the blocks that are sound
   subroutine check_blocks(source, table, properties, draft, blocks, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> BLOCKS
      type(table_type), intent(in) :: table
      !> Materials
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Sound blocks
      type(block_type), allocatable, intent(out) :: blocks(:)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(block_type) :: block
      integer :: entry, errors_before, n
      integer(i8) :: n_nodes

      allocate (blocks(table%n))
      n = 0
      n_nodes = draft%n_nodes
      do entry = 1, table%n
         errors_before = diagnostics%n_errors
         block%entry = entry
         call find_property(source, table, entry, field_material, properties%material_of, &
                            properties%materials_complete, 'material', block%material, diagnostics)
         if (table%good(entry)) then
            errors_before = diagnostics%n_errors
            call check_block(source, table, entry, block%corners, diagnostics)
            n_nodes = n_nodes + count_nodes(table, entry)
            if (n_nodes > most_nodes) then
               call entry_error(diagnostics, table, entry, &
                                'the blocks make more nodes than a deck may have', &
                                found=to_text(n_nodes)//' nodes', &
                                allowed='at most '//to_text(most_nodes)//' nodes in all')
               n_nodes = n_nodes - count_nodes(table, entry)
            end if
         end if
         if (table%good(entry) .and. diagnostics%n_errors == errors_before) then
            n = n + 1
            blocks(n) = block
         else
            draft%elements_complete = .false.
            draft%nodes_complete = .false.
         end if
      end do
      blocks = blocks(:n)
   end subroutine check_blocks

   !> Nodes of a block
   pure integer(i8) function count_nodes(table, entry) result(n)
      !> BLOCKS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry

      integer(i8) :: n1, n2

      n1 = integer_value(table, field_n1, entry)
      n2 = integer_value(table, field_n2, entry)
      select case (integer_value(table, field_size, entry))
      case (3, 4)
         n = (n1 + 1)*(n2 + 1)
      case (8)
         n = (2*n1 + 1)*(2*n2 + 1) - n1*n2
      case default
         n = (2*n1 + 1)*(2*n2 + 1)
      end select
   end function count_nodes

   !> Check a block and find its corners
   subroutine check_block(source, table, entry, corners, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> BLOCKS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Corners, counterclockwise
      real(wp), intent(out) :: corners(2, 4)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: n

      corners = 0.0_wp
      if (all(integer_value(table, field_size, entry) /= [3, 4, 6, 8, 9])) then
         call field_error(diagnostics, source, table, entry, field_size, &
                          'there are no such elements', allowed='3, 4, 6, 8 or 9 nodes')
      end if
      n = count(table%given(field_corner:, entry))
      if (n == 4 .and. all(table%given(field_corner:field_corner + 3, entry))) then
         call rectangle(source, table, entry, corners, diagnostics)
      else if (n == 8) then
         corners = reshape(table%values(field_corner:, entry), [2, 4])
         call check_corners(source, table, entry, corners, diagnostics)
      else
         call field_error(diagnostics, source, table, entry, field_corner + 4, &
                          'a block has two opposite corners (4 values) or four corners (8 values)', &
                          allowed='r and z of corners 1 and 3, or of corners 1, 2, 3 and 4')
      end if
   end subroutine check_block

   !> Corners of an axis-parallel rectangle from two opposite ones
   subroutine rectangle(source, table, entry, corners, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> BLOCKS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Corners from the one with the least r and z on
      real(wp), intent(out) :: corners(2, 4)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: low(2), high(2)
      integer :: axis

      associate (a => table%values(field_corner:field_corner + 1, entry), &
                 b => table%values(field_corner + 2:field_corner + 3, entry))
         low = min(a, b)
         high = max(a, b)
      end associate
      corners = reshape([low, high(1), low(2), high, low(1), high(2)], [2, 4])
      do axis = 1, 2
         if (high(axis) - low(axis) > least_sine*maxval(high - low)) cycle
         call field_error(diagnostics, source, table, entry, field_corner + 1 + axis, &
                          'the block has no extent in '//merge('r', 'z', axis == 1), &
                          allowed='two opposite corners of a rectangle')
      end do
   end subroutine rectangle

   !> Check that four corners run counterclockwise round a convex block
   subroutine check_corners(source, table, entry, corners, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> BLOCKS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> Corners
      real(wp), intent(in) :: corners(2, 4)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp) :: next(2), last(2), sine(4)
      integer :: i

      sine = 0.0_wp
      do i = 1, 4
         next = corners(:, mod(i, 4) + 1) - corners(:, i)
         last = corners(:, mod(i + 2, 4) + 1) - corners(:, i)
         if (norm2(next) > 0.0_wp .and. norm2(last) > 0.0_wp) then
            next = next/norm2(next)
            last = last/norm2(last)
            sine(i) = next(1)*last(2) - next(2)*last(1)
         end if
      end do
      if (all(sine > least_sine)) return
      if (all(sine < -least_sine)) then
         call second_card_error(table, entry, 'the corners of the block run clockwise', &
                            'exchange corners 2 and 4', diagnostics)
      else
         i = minloc(sine, 1)
         call field_error(diagnostics, source, table, entry, field_corner + 2*i - 2, &
                          'the block is not convex at corner '//to_text(i), &
                          allowed='angles between 0 and 180 degrees at all corners, counterclockwise')
      end if
   end subroutine check_corners

   !> Report an error on the second card of a block
   subroutine second_card_error(table, entry, text, mend, diagnostics)
      !> BLOCKS
      type(table_type), intent(in) :: table
      !> The entry
      integer, intent(in) :: entry
      !> What is wrong, and how to mend it
      character(len=*), intent(in) :: text, mend
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      call add_error(diagnostics, table%cards(2, entry), 0, 0, text, mend=mend)
   end subroutine second_card_error

end module axijoint_deck_mesh_blocks
