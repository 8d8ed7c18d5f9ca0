!> What an old listing repeats of its deck: counts, elements, nodes, restraints, materials, loads
module axijoint_output_legacy_echo
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_kinds, only : wp, degree
   use axijoint_element_yield_law, only : yield_none
   use axijoint_model_mesh, only : n_nodes, n_elements
   use axijoint_model_model, only : model_type
   use axijoint_output_legacy_page, only : page_type
   implicit none
   private
   public :: echo_job

   !> NTYPE of axisymmetric bodies, components of displacement and of stress
   integer, parameter :: axisymmetric = 3, n_components = 2, n_stresses = 4

contains

   !> Repeat the job
   subroutine echo_job(page, model, results)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model
      !> Its results at the end, for the loads
      type(results_type), intent(in) :: results

      call page%put('1'//model%title)
      call echo_counts(page, model)
      call echo_elements(page, model)
      call echo_nodes(page, model)
      call echo_restraints(page, model, results)
      call echo_materials(page, model)
      call echo_loads(page, model, results)
   end subroutine echo_job

   !> The control card
   subroutine echo_counts(page, model)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model

      associate (mesh => model%mesh, kind => model%mesh%kinds(1))
         call skip(page, 2)
         call count('NPOIN', n_nodes(mesh), '    ')
         call count('NELEM', n_elements(mesh), '    ')
         call count('NVFIX', count_held(model), '    ')
         call count('NTYPE', axisymmetric, '    ')
         call count('NNODE', kind%n_nodes, '')
         call page%end_line()
         call skip(page, 1)
         call count('NMATS', size(model%materials), '    ')
         call count('NGAUS', kind%order, '    ')
         call count('NEVAB', n_components*kind%n_nodes, '    ')
         call count('NALGO', 2, '')
         call page%end_line()
         call skip(page, 1)
         call count('NCRIT', maxval(model%materials%yield%criterion), '    ')
         call count('NINCS', size(model%increments), '    ')
         call count('NSTRE', n_stresses, '')
         call page%end_line()
      end associate

   contains

      !> A count with its name
      subroutine count(name, value, gap)
         !> The name
         character(len=*), intent(in) :: name
         !> The count
         integer, intent(in) :: value
         !> Blanks behind it
         character(len=*), intent(in) :: gap

         call page%words(' '//name//' =')
         call page%whole(value, 4)
         call page%words(gap)
      end subroutine count

   end subroutine echo_counts

   !> Nodes that anything is held of
   pure integer function count_held(model)
      !> The job
      type(model_type), intent(in) :: model

      count_held = count(any(model%fixed(:n_components, :), 1))
   end function count_held

   !> Empty lines
   subroutine skip(page, n)
      !> The listing
      type(page_type), intent(inout) :: page
      !> How many
      integer, intent(in) :: n

      integer :: k

      do k = 1, n
         call page%put('')
      end do
   end subroutine skip

   !> Elements, nodes round their perimeter as on the cards
   subroutine echo_elements(page, model)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model

      integer, parameter :: ring(9) = [1, 5, 2, 6, 3, 7, 4, 8, 9]
      integer :: element, i

      call skip(page, 2)
      call page%put(' ELEMENT   PROPERTY      NODE NUMBERS')
      associate (mesh => model%mesh)
         do element = 1, n_elements(mesh)
            call page%words(' ')
            call page%whole(mesh%element_label(element), 5)
            call page%whole(mesh%element_material(element), 9)
            call page%words('      ')
            associate (n => mesh%element_size(element), nodes => mesh%element_nodes(:, element))
               do i = 1, n
                  call page%whole(mesh%node_label(nodes(merge(i, ring(i), n == 4))), 5)
               end do
            end associate
            call page%end_line()
         end do
      end associate
   end subroutine echo_elements

   !> Nodes
   subroutine echo_nodes(page, model)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model

      integer :: node

      call skip(page, 2)
      call page%put(' NODE          X          Y')
      do node = 1, n_nodes(model%mesh)
         call page%words(' ')
         call page%whole(model%mesh%node_label(node), 5)
         call page%fixed(model%mesh%coordinates(1, node), 10, 3)
         call page%fixed(model%mesh%coordinates(2, node), 10, 3)
         call page%end_line()
      end do
   end subroutine echo_nodes

   !> What is held, and the displacements that it has at the end
   subroutine echo_restraints(page, model, results)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results

      integer :: node

      call skip(page, 2)
      call page%put(' NODE      CODE      FIXED VALUES')
      do node = 1, n_nodes(model%mesh)
         associate (held => model%fixed(:n_components, node))
            if (.not. any(held)) cycle
            call page%words(' ')
            call page%whole(model%mesh%node_label(node), 4)
            call page%words('        '//merge('1', '0', held(1))//merge('1', '0', held(2)))
            call page%words('     ')
            call page%fixed(merge(results%displacement(1, node, 1), 0.0_wp, held(1)), 10, 6)
            call page%fixed(merge(results%displacement(2, node, 1), 0.0_wp, held(2)), 10, 6)
            call page%end_line()
         end associate
      end do
   end subroutine echo_restraints

   !> Materials: E, nu, thickness, density, yield stress or cohesion, H', phi
   subroutine echo_materials(page, model)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model

      real(wp) :: values(7)
      integer :: k, i

      call skip(page, 2)
      call page%put(' NUMBER      ELEMENT PROPERTIES')
      do k = 1, size(model%materials)
         associate (material => model%materials(k), law => model%materials(k)%yield)
            values = [material%young, material%poisson, 0.0_wp, material%density, 0.0_wp, 0.0_wp, &
               0.0_wp]
            if (law%criterion /= yield_none) values(5:7) = [law%strength, law%hardening, &
               law%friction/degree]
            call page%words(' ')
            call page%whole(material%label, 4)
            call page%words('   ')
            do i = 1, size(values)
               call page%exponential(values(i))
            end do
            call page%end_line()
         end associate
      end do
   end subroutine echo_materials

   !> Forces that all loads put on the nodes at the end, of the whole circle
   subroutine echo_loads(page, model, results)
      !> The listing
      type(page_type), intent(inout) :: page
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results

      real(wp) :: force(n_components)
      integer :: node

      call page%put('0      TOTAL NODAL FORCES AT THE END')
      call page%put('0      NODE      R-FORCE       Z-FORCE')
      do node = 1, n_nodes(model%mesh)
         force = results%acting(:n_components, node, 1)
         where (model%fixed(:n_components, node)) force = force - &
            results%reaction(:n_components, node, 1)
         if (.not. any(abs(force) > 0.0_wp)) cycle
         call page%whole(model%mesh%node_label(node), 10)
         call page%exponential(force(1))
         call page%exponential(force(2))
         call page%end_line()
      end do
   end subroutine echo_loads

end module axijoint_output_legacy_echo
