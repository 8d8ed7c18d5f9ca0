!> What an old listing shows of an increment: displacements, reactions, stresses at Gauss points
module axijoint_output_legacy_states
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_principal, only : plane_principal
   use axijoint_model_mesh, only : n_nodes
   use axijoint_model_model, only : model_type
   use axijoint_output_legacy_page, only : page_type
   implicit none
   private
   public :: put_head, put_displacements, put_reactions, put_stresses

   !> NCHEK: in equilibrium, and not
   integer, parameter :: converged = 0, diverged = 999

contains

   !> Number of the increment, load factor, tolerance, how well it is in equilibrium
   subroutine put_head(page, model, results, i, amount)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model
      !> Its results at the end, with all states
      type(results_type), intent(in) :: results
      !> The increment, a place among the states
      integer, intent(in) :: i
      !> NOUTP
      integer, intent(in) :: amount

      logical :: balanced

      associate (state => results%states(i))
         balanced = i < size(results%states) .or. results%converged
         call page%words('0     INCREMENT NUMBER ')
         call page%whole(state%increment, 5)
         call page%end_line()
         call page%words('0     LOAD FACTOR =')
         call page%fixed(state%load_factor, 10, 5)
         associate (increment => model%increments(state%increment))
            call page%words('     CONVERGENCE TOLERANCE =')
            call page%fixed(100.0_wp*increment%tolerance, 10, 5)
            call page%words('     MAX. NO. OF ITERATIONS =')
            call page%whole(increment%max_iterations, 5)
         end associate
         call page%end_line()
         call page%put('')
         call page%words(' INITIAL OUTPUT PARAMETER =')
         call page%whole(0, 5)
         call page%words('     FINAL OUTPUT PARAMETER =')
         call page%whole(amount, 5)
         call page%end_line()
         call page%words('0   CONVERGENCE CODE =')
         call page%whole(merge(converged, diverged, balanced), 4)
         call page%end_line()
      end associate
   end subroutine put_head

   !> Displacements of all nodes
   subroutine put_displacements(page, model, now)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model
      !> Fields of the increment
      class(fields_type), intent(in) :: now

      integer :: node

      call page%put('0     DISPLACEMENTS')
      call page%put('0      NODE      R-DISP.       Z-DISP.')
      do node = 1, n_nodes(model%mesh)
         call put_pair(page, model%mesh%node_label(node), now%displacement(:2, node, 1))
      end do
   end subroutine put_displacements

   !> Reactions of nodes that anything is held of, or springs; on the axis, where u is no unknown,
   !> none along r
   subroutine put_reactions(page, model, now)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model
      !> Fields of the increment
      class(fields_type), intent(in) :: now

      integer :: node

      call page%put('0     REACTIONS')
      call page%put('0      NODE      R-REAC.       Z-REAC.')
      do node = 1, n_nodes(model%mesh)
         associate (reaction => now%reaction(:2, node, 1))
            if (any(model%fixed(:2, node)) .or. any(abs(reaction) > 0.0_wp)) &
               call put_pair(page, model%mesh%node_label(node), reaction)
         end associate
      end do
   end subroutine put_reactions

   !> A node and two values
   subroutine put_pair(page, label, values)
      !> The listing
      type(page_type), intent(inout) :: page
      !> Number of the node
      integer, intent(in) :: label
      !> The values along r and z
      real(wp), intent(in) :: values(:)

      call page%whole(label, 10)
      call page%exponential(values(1))
      call page%exponential(values(2))
      call page%end_line()
   end subroutine put_pair

   !> Stresses at the Gauss points, which run along eta first there
   subroutine put_stresses(page, model, now, strain)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model
      !> Fields of the increment
      class(fields_type), intent(in) :: now
      !> Effective plastic strain, shape (points)
      real(wp), intent(in) :: strain(:)

      real(wp) :: stress(4), others(3)
      integer :: first, element, point, order, xi, eta, i

      call page%put('0  G.P.      RR-STRESS     ZZ-STRESS     RZ-STRESS     TT-STRESS      '// &
         'MAX P.S.      MIN P.S.   ANGLE   E.P.S.')
      order = model%mesh%kinds(1)%order
      do first = 1, size(now%point_element), order**2
         element = now%point_element(first)
         call page%words('0     ELEMENT NO. =')
         call page%whole(model%mesh%element_label(element), 5)
         call page%end_line()
         do xi = 1, order
            do eta = 1, order
               point = first + xi - 1 + order*(eta - 1)
               stress = now%stress([1, 2, 4, 3], point, 1)
               others = plane_principal(stress(:3))
               call page%whole((xi - 1)*order + eta, 5)
               call page%words('  ')
               do i = 1, 4
                  call page%exponential(stress(i))
               end do
               call page%exponential(others(1))
               call page%exponential(others(2))
               call page%fixed(others(3), 8, 3)
               call page%exponential(strain(point))
               call page%end_line()
            end do
         end do
      end do
   end subroutine put_stresses

end module axijoint_output_legacy_states
