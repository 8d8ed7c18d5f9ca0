!> Stiffness of a block of nodes that follow each other, put where its factor will be. envelope_fill.c
module axijoint_assembly_envelope_fill
   use, intrinsic :: iso_c_binding, only : c_double, c_int32_t, c_int64_t
   use axijoint_assembly_product_stiffness, only : product_stiffness_type
   use axijoint_base_kinds, only : wp, i8
   use axijoint_linalg_node_envelope, only : panel_size
   implicit none
   private
   public :: all_free, tied_state, fill_envelope

   !> What may be said of a node: all components are free, of which component k is 2**(k - 1); and w follows u: w = -u
   integer, parameter :: all_free = 7, tied_state = 8

   interface
      !> Add a block to a matrix of zeros
      subroutine c_fill(first, last, below, panel, state, factors, start, column, parts, n_elements, element, row, n_nodes, shape, &
         shape_parts, lanes, a) bind(c, name='axijoint_fill_envelope')
         import :: c_double, c_int32_t, c_int64_t
         integer(c_int32_t), value :: first, last, n_elements, lanes
         integer(c_int32_t), intent(in) :: below(*), state(*), column(*), element(*), row(*), n_nodes(*)
         integer(c_int64_t), intent(in) :: panel(*), start(*), shape(*)
         real(c_double), intent(in) :: factors(*), parts(*), shape_parts(*)
         real(c_double), intent(inout) :: a(*)
      end subroutine c_fill
   end interface

contains

   !> Add a block to a matrix of zeros; what is held, and nodes that others at once have more, has an equation of its own
   subroutine fill_envelope(stiffness, factors, state, first, last, elements, below, lanes, lane, a)
      !> The stiffness
      type(product_stiffness_type), intent(in) :: stiffness
      !> Factors of its parts in the harmonic
      real(wp), intent(in) :: factors(3)
      !> What is said of each node
      integer, intent(in) :: state(:)
      !> First and last node of the block, and congruent elements that have nodes of it
      integer, intent(in) :: first, last, elements(:)
      !> How many nodes behind each the columns of the matrix reach
      integer, intent(in) :: below(:)
      !> Matrices that lie number beside number, and which of them is filled
      integer, intent(in) :: lanes, lane
      !> Panels of the lower triangles
      real(wp), intent(inout) :: a(lanes, *)

      integer(i8) :: panel(size(below))
      integer :: i, k

      panel(1) = 0
      do i = 2, size(below)
         panel(i) = panel(i - 1) + panel_size(below(i - 1))
      end do
      associate (rest => stiffness%blocks, congruent => stiffness%congruent)
         call c_fill(first, last, below, panel, state, factors, rest%start(:, 2), rest%column, rest%parts, size(elements), &
            elements, congruent%row, congruent%n_nodes, congruent%start, congruent%parts, lanes, a(lane, 1))
      end associate
      do i = 1, size(below)
         do k = 1, 3
            if (first + i - 1 <= last) then
               if (btest(state(first + i - 1), k - 1)) cycle
            end if
            a(lane, panel(i) + 1 + 3*(1 + below(i))*(k - 1) + k - 1) = 1.0_wp
         end do
      end do
   end subroutine fill_envelope

end module axijoint_assembly_envelope_fill
