!> Sizes of elements for Gmsh: a view in its parsed format, that it takes as a background mesh
module axijoint_gmsh_size_view
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: size_view

   !> Numbers with all their digits
   character(len=*), parameter :: format_number = '(es24.16e3)'
   integer, parameter :: number_length = 24

contains

   !> The view: a value at each corner of each element
   function size_view(coordinates, element_nodes, n_corners, sizes) result(text)
      !> r and z of the nodes, shape (2, nodes)
      real(wp), intent(in) :: coordinates(:, :)
      !> Nodes of the elements, corners first, shape (any, elements), and the number of corners
      integer, intent(in) :: element_nodes(:, :), n_corners(:)
      !> Size at each node
      real(wp), intent(in) :: sizes(:)
      !> Lines with their ends
      character(len=:), allocatable :: text

      character(len=*), parameter :: heading = 'View "size of elements" {', ending = '};'
      character(len=*), parameter :: nl = new_line('a')
      integer :: e, i, used

      ! two coordinates, a zero and a value, with commas and brackets, of each corner
      allocate (character(len=len(heading) + len(ending) + 2 + size(n_corners)*8 &
                + sum(n_corners)*(3*(number_length + 1) + 2)) :: text)
      used = 0
      call add(heading//nl)
      do e = 1, size(n_corners)
         call add(merge('ST(', 'SQ(', n_corners(e) == 3))
         do i = 1, n_corners(e)
            associate (node => element_nodes(i, e))
               if (i > 1) call add(',')
               call add(number_text(coordinates(1, node))//','//number_text(coordinates(2, node))//',0')
            end associate
         end do
         call add('){')
         do i = 1, n_corners(e)
            if (i > 1) call add(',')
            call add(number_text(sizes(element_nodes(i, e))))
         end do
         call add('};'//nl)
      end do
      call add(ending//nl)
      text = text(:used)

   contains

      !> Add a piece of text
      subroutine add(piece)
         !> The piece
         character(len=*), intent(in) :: piece

         text(used + 1:used + len(piece)) = piece
         used = used + len(piece)
      end subroutine add

   end function size_view

   !> A number
   pure function number_text(value) result(text)
      !> The number
      real(wp), intent(in) :: value
      !> Its digits
      character(len=:), allocatable :: text

      character(len=number_length) :: buffer

      write (buffer, format_number) value
      text = trim(adjustl(buffer))
   end function number_text

end module axijoint_gmsh_size_view
