!> Graded blocks of quadrilaterals or triangles
module axijoint_deck_mesh_generate_blocks
   use axijoint_base_kinds, only : wp, i8
   use axijoint_base_sort, only : refine_order
   use axijoint_deck_mesh_draft, only : draft_type, add_node, add_element
   use axijoint_deck_mesh_grading, only : graded_fraction, between
   use axijoint_deck_mesh_places, only : group_places, extent_of, same_place
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: block_type, draft_blocks, nodes_of_block, grade_block, point_of_block

   !> A block
   type :: block_type
      !> Its card, body, material (index), and nodes of an element
      integer :: card = 0, body = 1, material = 0, size = 4
      !> Elements along sides 1-2 and 2-3
      integer :: n(2) = 1
      !> Where they end, from 0 to 1, shape (0:largest n, 2)
      real(wp), allocatable :: ends(:, :)
      !> Corners, counterclockwise, shape (2, 4)
      real(wp) :: corners(2, 4) = 0.0_wp
   end type block_type

   !> Places of an element's nodes on the grid of half elements, from its first corner
   integer, parameter :: grid_1(9) = [0, 2, 2, 0, 1, 2, 1, 0, 1], &
      grid_2(9) = [0, 0, 2, 2, 0, 1, 2, 1, 1]
   !> Places among them of the nodes of the two triangles of a cell, cut from corner 1
   !> to 3 or from 2 to 4, shape (nodes, triangles, cuts)
   integer, parameter :: in_cell(6, 2, 2) = reshape([1, 2, 3, 5, 6, 9, 1, 3, 4, 9, 7, 8, &
                                                     1, 2, 4, 5, 9, 8, 2, 3, 4, 6, 7, 9], [6, 2, 2])
   !> Nodes of blocks before those at one place become one
   type :: candidates_type
      !> Number of them
      integer :: n = 0
      !> r and z
      real(wp), allocatable :: position(:, :)
      !> Body and card
      integer, allocatable :: body(:), card(:)
   end type candidates_type

contains

   !> Add the nodes and elements of blocks
   subroutine draft_blocks(blocks, draft)
      !> The blocks
      type(block_type), intent(in) :: blocks(:)
      !> The mesh
      type(draft_type), intent(inout) :: draft

      type(candidates_type) :: candidates
      integer :: i, n_before, label

      call make_room(blocks, candidates)
      n_before = draft%n_elements
      label = maxval([0, draft%element_label(:n_before)])
      do i = 1, size(blocks)
         call fill_block(blocks(i), label, draft, candidates)
      end do
      call number_candidates(candidates, n_before, draft)
   end subroutine draft_blocks

   !> Nodes of a block
   pure integer(i8) function nodes_of_block(block) result(n)
      !> The block
      type(block_type), intent(in) :: block

      integer(i8) :: n1, n2

      n1 = block%n(1)
      n2 = block%n(2)
      select case (block%size)
      case (3, 4)
         n = (n1 + 1)*(n2 + 1)
      case (8)
         n = (2*n1 + 1)*(2*n2 + 1) - n1*n2
      case default
         n = (2*n1 + 1)*(2*n2 + 1)
      end select
   end function nodes_of_block

   !> Room for the nodes of all blocks
   pure subroutine make_room(blocks, candidates)
      !> The blocks
      type(block_type), intent(in) :: blocks(:)
      !> The nodes
      type(candidates_type), intent(out) :: candidates

      integer :: i, total

      total = 0
      do i = 1, size(blocks)
         total = total + int(nodes_of_block(blocks(i)))
      end do
      allocate (candidates%position(2, total), candidates%body(total), candidates%card(total))
   end subroutine make_room

   !> Make the nodes and elements of a block. The elements refer to the nodes by
   !> their place among the candidates, behind the nodes of the draft
   pure subroutine fill_block(block, label, draft, candidates)
      !> The block
      type(block_type), intent(in) :: block
      !> Number of the last element
      integer, intent(inout) :: label
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Nodes of blocks
      type(candidates_type), intent(inout) :: candidates

      integer, allocatable :: node(:, :)
      integer :: i, j, k, n, n1, n2, cell(9)

      n = block%size
      n1 = block%n(1)
      n2 = block%n(2)
      allocate (node(0:2*n1, 0:2*n2), source=0)
      do j = 0, 2*n2
         do i = 0, 2*n1
            if (n <= 4 .and. (mod(i, 2) == 1 .or. mod(j, 2) == 1)) cycle
            if (n == 8 .and. mod(i, 2) == 1 .and. mod(j, 2) == 1) cycle
            k = candidates%n + 1
            candidates%n = k
            candidates%position(:, k) = point_of_block(block, [i, j])
            candidates%body(k) = block%body
            candidates%card(k) = block%card
            node(i, j) = draft%n_nodes + k
         end do
      end do
      do j = 0, n2 - 1
         do i = 0, n1 - 1
            cell = [(node(2*i + grid_1(k), 2*j + grid_2(k)), k=1, 9)]
            call add_cell(block, cell, 1 + mod(i + j, 2), label, draft, candidates)
         end do
      end do
   end subroutine fill_block

   !> Add the quadrilateral or both triangles of a cell
   pure subroutine add_cell(block, cell, cut, label, draft, candidates)
      !> The block
      type(block_type), intent(in) :: block
      !> Nodes of the cell, behind the nodes of the draft by their place among the candidates
      integer, intent(in) :: cell(9)
      !> How triangles cut it: 1 from corner 1 to 3, 2 from corner 2 to 4
      integer, intent(in) :: cut
      !> Number of the last element
      integer, intent(inout) :: label
      !> The mesh
      type(draft_type), intent(inout) :: draft
      !> Nodes of blocks
      type(candidates_type), intent(inout) :: candidates

      integer :: i

      if (n_corners(block%size) == 4) then
         label = label + 1
         call add_element(draft, label, block%card, block%material, block%body, cell(:block%size))
         return
      end if
      do i = 1, 2
         label = label + 1
         call add_element(draft, label, block%card, block%material, block%body, &
                          cell(in_cell(:block%size, i, cut)))
      end do
      if (block%size == 6) then  ! the cut is straight
         associate (x => candidates%position, k => cell - draft%n_nodes)
            x(:, k(9)) = between(x(:, k(cut)), x(:, k(cut + 2)), 0.5_wp)
         end associate
      end if
   end subroutine add_cell

   !> Divide the sides of a block in geometric progression
   pure subroutine grade_block(block, ratio)
      !> The block; its numbers of elements are known
      type(block_type), intent(inout) :: block
      !> Ratio of the last to the first element along sides 1-2 and 2-3
      real(wp), intent(in) :: ratio(2)

      integer :: i, d

      if (allocated(block%ends)) deallocate (block%ends)  ! of a faulty block before it
      allocate (block%ends(0:maxval(block%n), 2), source=1.0_wp)
      do d = 1, 2
         do i = 0, block%n(d)
            block%ends(i, d) = graded_fraction(i, block%n(d), ratio(d))
         end do
      end do
   end subroutine grade_block

   !> Point of a block at a place of the grid of half elements, whose middles halve the elements:
   !> straight lines between points of opposite sides
   pure function point_of_block(block, place) result(point)
      !> The block
      type(block_type), intent(in) :: block
      !> Half elements along sides 1-2 and 2-3, 0 to 2 n
      integer, intent(in) :: place(2)
      !> r and z
      real(wp) :: point(2)

      real(wp) :: x(2)
      integer :: d

      do d = 1, 2
         x(d) = 0.5_wp*(block%ends(place(d)/2, d) + block%ends((place(d) + 1)/2, d))
      end do
      associate (corners => block%corners)
         point = between(between(corners(:, 1), corners(:, 2), x(1)), &
                         between(corners(:, 4), corners(:, 3), x(1)), x(2))
      end associate
   end function point_of_block

   !> Let nodes of one body at one place become one, number the new ones and
   !> give them to the elements
   subroutine number_candidates(candidates, n_before, draft)
      !> Nodes of blocks
      type(candidates_type), intent(in) :: candidates
      !> Elements that are no blocks'
      integer, intent(in) :: n_before
      !> The mesh
      type(draft_type), intent(inout) :: draft

      real(wp), allocatable :: position(:, :)
      integer, allocatable :: body(:), group(:), order(:), first(:), node(:)
      integer :: i, n, label

      n = draft%n_nodes
      allocate (position(2, n + candidates%n), body(n + candidates%n))
      position(:, :n) = draft%position(:, :n)
      position(:, n + 1:) = candidates%position
      body(:n) = merge(draft%node_body(:n), 0, draft%node_good(:n))
      body(n + 1:) = candidates%body
      draft%extent = extent_of(position)
      group = group_places(position, same_place*draft%extent)
      order = [(i, i=1, size(group))]
      call refine_order(order, group)
      call refine_order(order, body)
      first = [(i, i=1, size(group))]
      do i = 2, size(order)
         if (group(order(i)) == group(order(i - 1)) .and. body(order(i)) == body(order(i - 1))) then
            first(order(i)) = first(order(i - 1))
         end if
      end do
      node = [0, (i, i=1, size(group))]
      label = maxval([0, draft%node_label(:n)])
      do i = n + 1, size(group)
         if (first(i) < i) then
            node(i + 1) = node(first(i) + 1)
         else
            label = label + 1
            call add_node(draft, label, candidates%card(i - n), candidates%position(:, i - n), &
               .true.)
            node(i + 1) = draft%n_nodes
            draft%node_body(draft%n_nodes) = body(i)
         end if
      end do
      do i = n_before + 1, draft%n_elements
         draft%element_nodes(:, i) = node(draft%element_nodes(:, i) + 1)
      end do
   end subroutine number_candidates

end module axijoint_deck_mesh_generate_blocks
