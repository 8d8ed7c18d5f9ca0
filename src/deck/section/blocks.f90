!> BLOCKS: blocks of quadrilaterals or triangles
module axijoint_deck_section_blocks
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_blocks
   use axijoint_deck_mesh_block_strips, only : find_strips
   use axijoint_deck_mesh_draft, only : most_nodes
   use axijoint_deck_mesh_generate_blocks, only : block_type, draft_blocks, nodes_of_block, &
      grade_block
   use axijoint_deck_property_properties, only : find_material
   use axijoint_deck_section_faces, only : face_ends
   use axijoint_deck_text_common_fields, only : number, body, ratio, largest_division
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_deck_text_entry, only : integer_of, real_of, reals_of, is_good, field_fault, &
      card_fault, first_card
   use axijoint_deck_text_field, only : field_type, integer_field, with_symbol, real_field, described
   use axijoint_model_strips, only : grid_type, strip_type, side_ends
   implicit none
   private
   public :: blocks_section
   public :: keyword_blocks, field_size, field_n1, field_n2

   !> The keyword
   character(len=*), parameter :: keyword_blocks = 'BLOCKS'
   !> Fields; coordinates of the corners from `field_corner` on
   integer, parameter :: field_body = 1, field_material = 2, field_size = 3, field_n1 = 4, &
      field_n2 = 5, &
      field_ratio1 = 6, field_ratio2 = 7, field_corner = 8
   !> Least sine of the angle at a corner of a block
   real(wp), parameter :: least_sine = 1.0e-6_wp

contains

   !> BLOCKS
   function blocks_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_blocks
      section%purpose = 'quadrilaterals or triangles in a quadrilateral with straight sides'
      section%entry = 'block'
      section%cards(:2) = [character(len=40) :: 'numbers and divisions', 'the corners']
      section%stage = stage_blocks
      section%read => read_blocks
      section%fields = &
         [body(1), described(number('the material', 6), 'material', &
                             limits='of MATERIALS or ORTHOTROPIC'), &
          described(integer_field('the number of nodes per element', 11, 15, 3, 9), &
                    'nodes per element', &
                    limits='3, 4, 6, 8, 9'), &
          described(with_symbol(integer_field('the number of elements along 1-2', 16, 20, 1, largest_division), 'n1'), &
                    'n1: elements along side 1-2'), &
          described(with_symbol(integer_field('the number of elements along 2-3', 21, 25, 1, largest_division), 'n2'), &
                    'n2: elements along side 2-3'), &
          described(ratio('the ratio along 1-2', 26), &
                    'ratio of the last to the first element along 1-2'), &
          described(ratio('the ratio along 2-3', 36), 'the same along 2-3'), &
          described(corner_fields(), 'r1 z1 r2 z2 r3 z3 r4 z4: corners, counterclockwise; or '// &
          'r1 z1 r3 z3 '// &
                    'alone: opposite corners of a rectangle', limits='r ≥ 0')]
   end function blocks_section

   !> Fields of the second card
   pure function corner_fields() result(fields)
      !> r and z of four corners
      type(field_type) :: fields(8)

      character(len=1), parameter :: axis(0:1) = ['r', 'z']
      integer :: i

      do i = 0, 7
         fields(i + 1) = real_field(axis(mod(i, 2))//' of corner '//to_text(i/2 + 1), 10*i + 1, &
                                    symbol=axis(mod(i, 2))//to_text(i/2 + 1))
         if (mod(i, 2) == 0) fields(i + 1)%low = 0.0_wp
      end do
      fields%card = 2
      fields(5:)%required = .false.
   end function corner_fields

   !> Make the nodes and elements of the blocks that are sound
   subroutine read_blocks(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(block_type), allocatable :: blocks(:)
      integer :: n, errors_before
      integer(i8) :: n_nodes

      card = cards_of(deck, keyword_blocks)
      allocate (blocks(card%table%n))
      n = 0
      n_nodes = deck%draft%n_nodes
      do while (next_card(card))
         associate (block => blocks(n + 1))
            call find_material(card, field_material, deck%properties, block%material)
            errors_before = deck%diagnostics%n_errors
            if (is_good(card)) call read_block(card, n_nodes, block)
            if (is_good(card) .and. deck%diagnostics%n_errors == errors_before) then
               n = n + 1
            else
               deck%draft%elements_complete = .false.
               deck%draft%nodes_complete = .false.
            end if
         end associate
      end do
      if (deck%strips_wanted) then
         call find_strips(blocks(:n), face_ends(deck), deck%model%grid)
         if (allocated(deck%model%grid) .and. allocated(deck%strips)) &
            call divide_anew(deck%strips, deck%model%grid, blocks(:n))
      end if
      call draft_blocks(blocks(:n), deck%draft)
   end subroutine read_blocks

   !> Divide blocks as their strips are to be divided
   subroutine divide_anew(strips, grid, blocks)
      !> The strips as they are to be divided
      type(strip_type), intent(in) :: strips(:)
      !> The strips of the blocks; divided anew on return
      type(grid_type), intent(inout) :: grid
      !> The blocks
      type(block_type), intent(inout) :: blocks(:)

      real(wp), allocatable :: first(:), second(:)
      integer :: k

      do k = 1, size(grid%strips)
         grid%strips(k)%ends = strips(k)%ends
      end do
      do k = 1, size(blocks)
         first = side_ends(grid%blocks(k)%sides(1), grid%strips)
         second = side_ends(grid%blocks(k)%sides(2), grid%strips)
         associate (block => blocks(k))
            block%n = [size(first), size(second)] - 1
            deallocate (block%ends)
            allocate (block%ends(0:maxval(block%n), 2), source=1.0_wp)
            block%ends(:block%n(1), 1) = first
            block%ends(:block%n(2), 2) = second
         end associate
      end do
   end subroutine divide_anew

   !> Read and check a block
   subroutine read_block(card, n_nodes, block)
      !> The card
      type(card_type), intent(in) :: card
      !> Nodes so far, with those of the blocks that share places counted as often
      integer(i8), intent(inout) :: n_nodes
      !> The block
      type(block_type), intent(inout) :: block

      block%card = first_card(card)
      block%body = integer_of(card, field_body)
      block%size = integer_of(card, field_size)
      block%n = [integer_of(card, field_n1), integer_of(card, field_n2)]
      call grade_block(block, [real_of(card, field_ratio1), real_of(card, field_ratio2)])
      call check_block(card, block%corners)
      if (n_nodes + nodes_of_block(block) > most_nodes) then
         call card_fault(card, 'the blocks make more nodes than a deck may have', &
                         found=to_text(n_nodes + nodes_of_block(block))//' nodes', &
                         allowed='at most '//to_text(most_nodes)//' nodes in all')
         return
      end if
      n_nodes = n_nodes + nodes_of_block(block)
   end subroutine read_block

   !> Check a block and find its corners
   subroutine check_block(card, corners)
      !> The card
      type(card_type), intent(in) :: card
      !> Corners, counterclockwise
      real(wp), intent(out) :: corners(2, 4)

      integer :: n

      corners = 0.0_wp
      if (all(integer_of(card, field_size) /= [3, 4, 6, 8, 9])) then
         call field_fault(card, field_size, &
                          'there are no such elements', allowed='3, 4, 6, 8 or 9 nodes')
      end if
      n = count(card%table%given(field_corner:, card%entry))
      if (n == 4 .and. all(card%table%given(field_corner:field_corner + 3, card%entry))) then
         call rectangle(card, corners)
      else if (n == 8) then
         corners = reshape(card%table%values(field_corner:, card%entry), [2, 4])
         call check_corners(card, corners)
      else
         call field_fault(card, field_corner + 4, &
                          'a block has two opposite corners (4 values) or four corners (8 '// &
                          'values)', &
                          allowed='r and z of corners 1 and 3, or of corners 1, 2, 3 and 4')
      end if
   end subroutine check_block

   !> Corners of an axis-parallel rectangle from two opposite ones
   subroutine rectangle(card, corners)
      !> The card
      type(card_type), intent(in) :: card
      !> Corners from the one with the least r and z on
      real(wp), intent(out) :: corners(2, 4)

      real(wp) :: low(2), high(2)
      integer :: axis

      associate (a => reals_of(card, field_corner, 2), &
                 b => card%table%values(field_corner + 2:field_corner + 3, card%entry))
         low = min(a, b)
         high = max(a, b)
      end associate
      corners = reshape([low, high(1), low(2), high, low(1), high(2)], [2, 4])
      do axis = 1, 2
         if (high(axis) - low(axis) > least_sine*maxval(high - low)) cycle
         call field_fault(card, field_corner + 1 + axis, &
                          'the block has no extent in '//merge('r', 'z', axis == 1), &
                          allowed='two opposite corners of a rectangle')
      end do
   end subroutine rectangle

   !> Check that four corners run counterclockwise round a convex block
   subroutine check_corners(card, corners)
      !> The card
      type(card_type), intent(in) :: card
      !> Corners
      real(wp), intent(in) :: corners(2, 4)

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
         call add_error(card%diagnostics, card%table%cards(2, card%entry), 0, 0, &
                        'the corners of the block run clockwise', mend='exchange corners 2 and 4')
      else
         i = minloc(sine, 1)
         call field_fault(card, field_corner + 2*i - 2, &
                          'the block is not convex at corner '//to_text(i), &
                          allowed='angles between 0 and 180 degrees at all corners, '// &
                          'counterclockwise')
      end if
   end subroutine check_corners

end module axijoint_deck_section_blocks
