!> The unknowns of one harmonic that relative displacements at joint points depend on
module axijoint_joints_rows
   use axijoint_assembly_dofs, only : dofs_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : jump_matrix
   use axijoint_model_joint_points, only : model_joint_point_type
   implicit none
   private
   public :: jump_rows

contains

   !> The rows of N: jumps from the unknowns of the joints' nodes
   subroutine jump_rows(dofs, points, unknowns, place, coefficient)
      !> Unknowns of the harmonic
      type(dofs_type), intent(in) :: dofs
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)
      !> Equations of the joints' nodes, ascending
      integer, allocatable, intent(out) :: unknowns(:)
      !> For each jump: places in `unknowns`, zero for none, and factors, shape
      !> (18, 3, points)
      integer, allocatable, intent(out) :: place(:, :, :)
      real(wp), allocatable, intent(out) :: coefficient(:, :, :)

      real(wp) :: matrix(3, 18)
      integer, allocatable :: number(:)
      integer :: k, a, i, n, count

      allocate (number(dofs%n_equations), source=0)
      do k = 1, size(points)
         do a = 1, 2*points(k)%n_pairs
            do i = 1, 3
               associate (equation => dofs%equation(i, points(k)%nodes(a)))
                  if (equation > 0) number(equation) = 1
               end associate
            end do
         end do
      end do
      unknowns = pack([(i, i=1, size(number))], number > 0)
      do count = 1, size(unknowns)
         number(unknowns(count)) = count
      end do
      allocate (place(18, 3, size(points)), source=0)
      allocate (coefficient(18, 3, size(points)), source=0.0_wp)
      do k = 1, size(points)
         n = 2*points(k)%n_pairs
         call jump_matrix(points(k)%joint_point_type, matrix(:, :3*n))
         do a = 1, n
            do i = 1, 3
               associate (node => points(k)%nodes(a), l => 3*(a - 1) + i)
                  if (dofs%equation(i, node) == 0) cycle
                  place(l, :, k) = number(dofs%equation(i, node))
                  coefficient(l, :, k) = dofs%factor(i, node)*matrix(:, l)
               end associate
            end do
         end do
      end do
   end subroutine jump_rows

end module axijoint_joints_rows
