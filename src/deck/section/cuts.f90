!> CUTS: cuts z = const. whose resultants are given
module axijoint_deck_section_cuts
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : number_map_type
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_requests
   use axijoint_deck_text_common_fields, only : number, length, body, largest_division
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, is_good, field_fault
   use axijoint_deck_text_field, only : integer_field, real_field, described
   use axijoint_deck_text_labels, only : check_label
   use axijoint_model_mesh, only : mesh_type
   use axijoint_model_request, only : cut_type
   implicit none
   private
   public :: cuts_section, place_cuts, keyword_cuts

   !> The keyword
   character(len=*), parameter :: keyword_cuts = 'CUTS'
   !> Fields
   integer, parameter :: field_label = 1, field_z = 2, field_body = 3, field_last = 4, &
      field_number = 5
   !> Cuts between two heights unless the card says how many
   integer, parameter :: default_number = 11

contains

   !> CUTS
   function cuts_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_cuts
      section%purpose = 'resultants on cuts z = const.'
      section%numbered = .true.
      section%stage = stage_requests
      section%read => read_cuts
      section%fields = &
         [described(number('the cut', 1), 'cut; several are numbered on from it', &
                    limits='each number once'), &
          described(length('z', 6), 'z [length]', limits='lowest … highest z of the body'), &
          described(body(16), 'body', blank='all'), &
          described(real_field('z of the last cut', 21, default=0.0_wp), &
                    'z of the last of several cuts at equal distances', blank='one cut', &
                    limits='as z; another height'), &
          described(integer_field('the number of cuts', 31, 35, 2, largest_division, &
                                  default=default_number), 'number of these cuts')]
   end function cuts_section

   !> Read the cuts as far as their cards tell
   subroutine read_cuts(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(number_map_type) :: seen
      type(cut_type), allocatable :: cuts(:)
      type(cut_type) :: cut
      real(wp) :: last
      integer :: k, n

      allocate (cuts(0))
      card = cards_of(deck, keyword_cuts)
      do while (next_card(card))
         call check_label(card, field_label, 'cut', seen, &
            allowed='a number of its own for each cut')
         cut = cut_type(integer_of(card, field_label), real_of(card, field_z), 0, card%entry)
         if (is_given(card, field_body)) cut%body = integer_of(card, field_body)
         cuts = [cuts, cut]
         if (.not. is_given(card, field_last)) then
            if (is_given(card, field_number)) &
               call field_fault(card, field_number, 'several cuts need the height of the last', &
                                mend='give z of the last cut in columns 21-30')
            cycle
         end if
         if (.not. is_good(card)) cycle
         last = real_of(card, field_last)
         if (.not. abs(last - cut%z) > 0.0_wp) then
            call field_fault(card, field_last, 'first and last cut are at the same height', &
                             allowed='another z, or none')
            cycle
         end if
         n = integer_of(card, field_number)
         do k = 1, n - 1
            if (known_number(cut%label + k)) then
               call field_fault(card, field_number, 'the number '//to_text(cut%label + k)// &
                                ' of one of the cuts is that of another', &
                                allowed='a number of its own for each cut', &
                                mend='number cards further apart')
               exit
            end if
            cuts = [cuts, cut_type(cut%label + k, (real(n - 1 - k, wp)*cut%z &
                                                   + real(k, wp)*last)/real(n - 1, wp), &
                                   cut%body, card%entry)]
         end do
      end do
      deck%model%cuts = cuts

   contains

      !> Whether a number belongs to another cut: of a card, or made before
      pure logical function known_number(label)
         !> The number
         integer, intent(in) :: label

         integer :: e

         known_number = any(cuts%label == label)
         do e = 1, card%table%n
            known_number = known_number .or. nint(card%table%values(field_label, e)) == label
         end do
      end function known_number

   end subroutine read_cuts

   !> Check that cuts pass through their bodies
   subroutine place_cuts(deck, mesh)
      !> The deck
      type(deck_type), intent(inout), target :: deck
      !> The mesh
      type(mesh_type), intent(in) :: mesh

      type(card_type) :: card
      real(wp) :: low, high
      !> Body that these are of
      integer :: seen
      integer :: element, k

      card = cards_of(deck, keyword_cuts)
      seen = -1
      do k = 1, size(deck%model%cuts)
         associate (cut => deck%model%cuts(k))
            card%entry = cut%card
            if (.not. is_good(card)) cycle
            if (cut%body > 0 .and. .not. any(mesh%element_body == cut%body)) then
               call field_fault(card, field_body, 'body '//to_text(cut%body)//' has no elements')
               cycle
            end if
            if (cut%body /= seen) then
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
               seen = cut%body
            end if
            if (cut%z >= low .and. cut%z <= high) cycle
            call field_fault(card, field_of(k), 'the cut at z = '//to_text(cut%z)//' misses '// &
                             trim(merge('the body  ', 'all bodies', cut%body > 0)), &
                             allowed='z from '//to_text(low)//' to '//to_text(high))
         end associate
      end do

   contains

      !> The field that tells the height of a cut, or the end of several that is nearer
      pure integer function field_of(k) result(field)
         !> The cut
         integer, intent(in) :: k

         field = field_z
         if (count(deck%model%cuts%card == card%entry) > 1 .and. &
             2*(k - findloc(deck%model%cuts%card, card%entry, 1)) > &
             count(deck%model%cuts%card == card%entry)) field = field_last
      end function field_of

   end subroutine place_cuts

end module axijoint_deck_section_cuts
