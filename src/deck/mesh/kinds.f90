!> Kinds of the elements of the mesh in the making: rule and formulation
module axijoint_deck_mesh_kinds
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_fe_element_kind, only : element_kind_type, kind_choice_type, chosen_kind, find_kind
   implicit none
   private
   public :: choose_kinds

contains

   !> Choose the kinds of all elements
   subroutine choose_kinds(choice, draft)
      !> Rules and formulation of the job
      type(kind_choice_type), intent(in) :: choice
      !> The mesh; all elements are there
      type(draft_type), intent(inout) :: draft

      integer :: element

      draft%kinds = [element_kind_type ::]
      draft%element_kind = draft%element_size(:draft%n_elements)
      do element = 1, draft%n_elements
         call find_kind(draft%kinds, chosen_kind(choice, draft%element_size(element)), draft%element_kind(element))
      end do
   end subroutine choose_kinds

end module axijoint_deck_mesh_kinds
