!> Elements that are too stiff for nearly incompressible materials, and for those that yield
module axijoint_deck_check_locking
   use axijoint_base_text, only : to_text
   use axijoint_deck_property_properties, only : properties_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_element_yield_law, only : yield_none
   use axijoint_fe_element_kind, only : is_reduced, locks
   use axijoint_model_locking, only : is_nearly_incompressible, effective_ratio
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: warn_of_locking

contains

   !> Warn of nearly incompressible materials in 3-node and plain 4-node elements
   subroutine warn_of_locking(properties, model, diagnostics)
      !> Materials, with their cards
      type(properties_type), intent(in) :: properties
      !> The job
      type(model_type), intent(in) :: model
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      logical :: used(size(model%materials), 3:4), stiff(size(model%materials))
      integer :: k, element

      used = .false.
      stiff = .false.
      do element = 1, size(model%mesh%element_kind)
         associate (kind => model%mesh%kinds(model%mesh%element_kind(element)))
            if (locks(kind)) used(model%mesh%element_material(element), kind%n_nodes) = .true.
            if (kind%n_nodes == 8 .and. .not. is_reduced(kind)) &
               stiff(model%mesh%element_material(element)) = .true.
         end associate
      end do
      do k = 1, size(model%materials)
         if (stiff(k) .and. model%materials(k)%yield%criterion /= yield_none) call warn_of_rule(k)
         if (.not. any(used(k, :))) cycle
         if (model%materials(k)%yield%criterion /= yield_none) then
            call warn_of_limit(k)
            cycle
         end if
         if (.not. is_nearly_incompressible(model%materials(k))) cycle
         if (used(k, 4)) call warn(k, 'plain 4-node', &
                                   'write BBAR in columns 31-40 of CONTROL, or use 8-node '// &
                                   'elements '// &
                                   'with 2 in columns 16-20')
         if (used(k, 3)) call warn(k, '3-node', &
                                   'use 4-node elements with BBAR in columns 31-40 of CONTROL, '// &
                                   'or '// &
                                   '6-node triangles')
      end do

   contains

      !> Warn of a material that yields: plastic strain keeps the volume, or dilates by as much as
      !> the law says, which these elements cannot
      subroutine warn_of_limit(material)
         !> The material
         integer, intent(in) :: material

         call add_warning(diagnostics, properties%material_card(material), 0, 0, &
                          'material '//to_text(model%materials(material)%label)// &
                          ' yields in elements that lock: plain 4-node elements carried 26 to '// &
                          '65 % more than the limit load of a disc in clay', &
                          mend='use 8-node elements with 2 in columns 16-20 of CONTROL, or '// &
                          'BBAR in columns 31-40')
      end subroutine warn_of_limit

      !> Warn of a material that yields in 8-node elements with the full rule
      subroutine warn_of_rule(material)
         !> The material
         integer, intent(in) :: material

         call add_warning(diagnostics, properties%material_card(material), 0, 0, &
                          'material '//to_text(model%materials(material)%label)// &
                          ' yields in 8-node elements with the full rule: these carried 7.7, '// &
                          '3.2, 1.8 % more than the limit load of a disc in clay on three '// &
                          'meshes, with the reduced rule 2.1, 1.5, 1.2 %', &
                          mend='write 2 in columns 16-20 of CONTROL')
      end subroutine warn_of_rule

      !> Warn of one material
      subroutine warn(material, kind, mend)
         !> The material
         integer, intent(in) :: material
         !> Kind of elements, and the remedy
         character(len=*), intent(in) :: kind, mend

         call add_warning(diagnostics, properties%material_card(material), 0, 0, &
                          'material '//to_text(model%materials(material)%label)// &
                          ' is nearly incompressible: '//kind// &
                          ' elements of it are much too stiff', &
                          found='nu = '//to_text(effective_ratio(model%materials(material))), &
                          mend=mend)
      end subroutine warn

   end subroutine warn_of_locking

end module axijoint_deck_check_locking
