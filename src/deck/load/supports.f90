!> Springs between faces and the ground: SPRINGS
module axijoint_deck_load_supports
   use axijoint_base_kinds, only : wp
   use axijoint_deck_load_card, only : load_card_type, reals_of, field_fault, is_sound, find_loaded_face
   use axijoint_deck_load_lists, only : load_lists_type
   use axijoint_model_load, only : edge_support_type
   implicit none
   private
   public :: read_springs

   !> First stiffness: k_n, k_s, k_theta
   integer, parameter :: field_stiffness = 2

contains

   !> Put the edges of a face on springs
   subroutine read_springs(card, lists)
      !> A card of SPRINGS
      type(load_card_type), intent(in) :: card
      !> The loads and supports
      type(load_lists_type), intent(inout) :: lists

      integer :: face, i

      call find_loaded_face(card, face)
      if (card%table%good(card%entry) .and. .not. any(reals_of(card, field_stiffness) > 0.0_wp)) then
         call field_fault(card, field_stiffness, 'all springs are zero', &
                          allowed='k_n, k_s, k_theta: one at least above 0')
      end if
      if (face == 0 .or. .not. is_sound(card)) return
      associate (edges => card%draft%faces(face)%edges)
         lists%edge_supports = [lists%edge_supports, &
            (edge_support_type(edges(i)%nodes, reals_of(card, field_stiffness)), i=1, size(edges))]
      end associate
   end subroutine read_springs

end module axijoint_deck_load_supports
