!> SPRINGS: springs between faces and the ground
module axijoint_deck_section_springs
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_loaded_face
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_load_lists, only : add_edge_support
   use axijoint_deck_text_common_fields, only : face_field => face
   use axijoint_deck_text_entry, only : reals_of, is_good, is_sound, field_fault
   use axijoint_deck_text_field, only : field_type, real_field, described
   use axijoint_model_load, only : edge_support_type
   implicit none
   private
   public :: springs_section

   !> The keyword
   character(len=*), parameter :: keyword_springs = 'SPRINGS'
   !> Fields: the face, then k_n, k_s, k_theta
   integer, parameter :: field_face = 1, field_stiffness = 2

contains

   !> SPRINGS
   function springs_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_springs
      section%purpose = 'springs between faces and the ground, in all harmonics and load cases'
      section%is_support = .true.
      section%stage = stage_loads
      section%read => read_springs
      section%fields = &
         [face_field(1), &
          described([spring('k_n', 6), spring('k_s', 16), spring('k_theta', 26)], &
                    'k_n k_s k_θ [stress/length]: normal to the face, along it in the r-z '// &
                    'plane, along θ', &
                    limits='≥ 0, one above 0')]
   end function springs_section

   !> Field of a spring stiffness
   pure function spring(name, first) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = real_field(name, first, from=0.0_wp, default=0.0_wp, symbol=name)
   end function spring

   !> Put the faces on springs
   subroutine read_springs(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_springs)
      do while (next_card(card))
         call put_on_springs(card)
      end do
   end subroutine read_springs

   !> Put the edges of a face on springs
   subroutine put_on_springs(card)
      !> A card of SPRINGS
      type(card_type), intent(in) :: card

      integer :: face, i

      call find_loaded_face(card, field_face, face)
      if (is_good(card) .and. .not. any(reals_of(card, field_stiffness, 3) > 0.0_wp)) then
         call field_fault(card, field_stiffness, 'all springs are zero', &
                          allowed='k_n, k_s, k_theta: one at least above 0')
      end if
      if (face == 0 .or. .not. is_sound(card)) return
      associate (edges => card%deck%draft%faces(face)%edges)
         do i = 1, size(edges)
            call add_edge_support(card%deck%loads, &
                                  edge_support_type(edges(i)%nodes, &
                                  reals_of(card, field_stiffness, 3)))
         end do
      end associate
   end subroutine put_on_springs

end module axijoint_deck_section_springs
