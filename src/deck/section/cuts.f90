!> CUTS: cuts z = const. whose resultants are given
module axijoint_deck_section_cuts
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_text_common_fields, only : number, length, body
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, field_fault
   use axijoint_deck_text_field, only : described
   use axijoint_deck_text_labels, only : check_label
   use axijoint_model_mesh, only : mesh_type
   implicit none
   private
   public :: cuts_section, place_cuts, keyword_cuts

   !> The keyword
   character(len=*), parameter :: keyword_cuts = 'CUTS'
   !> Fields
   integer, parameter :: field_label = 1, field_z = 2, field_body = 3

contains

   !> CUTS
   function cuts_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_cuts
      section%purpose = 'resultants on cuts z = const.'
      section%stage = stage_requests
      section%read => read_cuts
      section%fields = [described(number('the cut', 1), 'cut', limits='each number once'), &
                        described(length('z', 6), 'z [length]', &
                                  limits='lowest … highest z of the body'), &
                        described(body(16), 'body', blank='all')]
   end function cuts_section

   !> Read the cuts as far as their cards tell
   subroutine read_cuts(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(number_map_type) :: seen

      card = cards_of(deck, keyword_cuts)
      allocate (deck%model%cuts(card%table%n))
      do while (next_card(card))
         call check_label(card, field_label, 'cut', seen, &
            allowed='a number of its own for each cut')
         associate (cut => deck%model%cuts(card%entry))
            cut%label = integer_of(card, field_label)
            cut%z = real_of(card, field_z)
            if (is_given(card, field_body)) cut%body = integer_of(card, field_body)
         end associate
      end do
   end subroutine read_cuts

   !> Check that cuts pass through their bodies
   subroutine place_cuts(deck, mesh)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> The mesh
      type(mesh_type), intent(in) :: mesh

      type(card_type) :: card
      real(wp) :: low, high
      integer :: element

      card = cards_of(deck, keyword_cuts)
      do while (next_card(card))
         if (.not. is_good(card)) cycle
         associate (cut => deck%model%cuts(card%entry))
            if (cut%body > 0 .and. .not. any(mesh%element_body == cut%body)) then
               call field_fault(card, field_body, 'body '//to_text(cut%body)//' has no elements')
               cycle
            end if
            low = huge(low)
            high = -huge(high)
            do element = 1, size(mesh%element_body)
               if (cut%body > 0 .and. mesh%element_body(element) /= cut%body) cycle
               associate (z => mesh%coordinates(2, &
                  mesh%element_nodes(:mesh%element_size(element), element)))
                  low = min(low, minval(z))
                  high = max(high, maxval(z))
               end associate
            end do
            if (cut%z >= low .and. cut%z <= high) cycle
            call field_fault(card, field_z, 'the cut misses '// &
                             trim(merge('the body  ', 'all bodies', cut%body > 0)), &
                             allowed='z from '//to_text(low)//' to '//to_text(high))
         end associate
      end do
   end subroutine place_cuts

end module axijoint_deck_section_cuts
