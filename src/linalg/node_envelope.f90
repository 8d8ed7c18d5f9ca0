!> Factors of small symmetric matrices of nodes with three components, many of them, by their envelope: of one, or of some of
!> one envelope at once, which lie number beside number. node_envelope.c
module axijoint_linalg_node_envelope
   use, intrinsic :: iso_c_binding, only : c_double, c_int32_t
   use axijoint_base_kinds, only : wp, i8
   implicit none
   private
   public :: n_lanes, panel_size, factor_envelope, factor_envelopes, solve_envelope, solve_envelopes, solve_with_one

   !> Matrices, or right-hand sides, that are worked on at once
   integer, parameter :: n_lanes = 8

   interface
      !> Factor one matrix, or `n_lanes`; 1 if a pivot is not positive
      integer(c_int32_t) function c_factor(at_once, n, below, a) bind(c, name='axijoint_factor_envelope')
         import :: c_int32_t, c_double
         integer(c_int32_t), value :: at_once, n
         integer(c_int32_t), intent(in) :: below(*)
         real(c_double), intent(inout) :: a(*)
      end function c_factor
      !> Solve with one factor, or `n_lanes`, for one right-hand side or as many
      subroutine c_solve(at_once, sides, n, below, a, b) bind(c, name='axijoint_solve_envelope')
         import :: c_int32_t, c_double
         integer(c_int32_t), value :: at_once, sides, n
         integer(c_int32_t), intent(in) :: below(*)
         real(c_double), intent(in) :: a(*)
         real(c_double), intent(inout) :: b(*)
      end subroutine c_solve
   end interface

contains

   !> Numbers of the panel of a node: three columns with the rows of the node and of so many behind it
   elemental integer(i8) function panel_size(below)
      !> Nodes behind it
      integer, intent(in) :: below

      panel_size = 9_i8*(1 + below)
   end function panel_size

   !> Factor a matrix
   subroutine factor_envelope(n, below, a, failed)
      !> Nodes, and how many behind each its columns reach: none ends before that in front of it
      integer, intent(in) :: n, below(n)
      !> Panels of the lower triangle, one behind the other, each column by column; then the factor
      real(wp), intent(inout) :: a(*)
      !> Whether a pivot is not positive
      logical, intent(out) :: failed

      failed = c_factor(1_c_int32_t, n, below, a) /= 0
   end subroutine factor_envelope

   !> Factor some matrices of one envelope: the same numbers as by `factor_envelope` one by one
   subroutine factor_envelopes(n, below, a, failed)
      !> As of `factor_envelope`
      integer, intent(in) :: n, below(n)
      !> The same of all, number beside number; then the factors
      real(wp), intent(inout) :: a(n_lanes, *)
      !> Whether a pivot is not positive
      logical, intent(out) :: failed

      failed = c_factor(int(n_lanes, c_int32_t), n, below, a) /= 0
   end subroutine factor_envelopes

   !> Solve
   subroutine solve_envelope(n, below, a, b)
      !> As of `factor_envelope`
      integer, intent(in) :: n, below(n)
      !> The factor
      real(wp), intent(in) :: a(*)
      !> Right-hand side, then solution
      real(wp), intent(inout) :: b(3*n)

      call c_solve(1_c_int32_t, 1_c_int32_t, n, below, a, b)
   end subroutine solve_envelope

   !> Solve with some factors of one envelope: the same numbers as by `solve_envelope` one by one
   subroutine solve_envelopes(n, below, a, b)
      !> As of `factor_envelope`
      integer, intent(in) :: n, below(n)
      !> The factors
      real(wp), intent(in) :: a(n_lanes, *)
      !> Right-hand sides, then solutions
      real(wp), intent(inout) :: b(n_lanes, 3*n)

      call c_solve(int(n_lanes, c_int32_t), int(n_lanes, c_int32_t), n, below, a, b)
   end subroutine solve_envelopes

   !> Solve some systems with one factor: the same numbers as by `solve_envelope` one by one
   subroutine solve_with_one(n, below, a, b)
      !> As of `factor_envelope`
      integer, intent(in) :: n, below(n)
      !> The factor
      real(wp), intent(in) :: a(*)
      !> Right-hand sides, then solutions
      real(wp), intent(inout) :: b(n_lanes, 3*n)

      call c_solve(1_c_int32_t, int(n_lanes, c_int32_t), n, below, a, b)
   end subroutine solve_with_one

end module axijoint_linalg_node_envelope
