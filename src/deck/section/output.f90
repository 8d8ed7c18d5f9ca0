!> OUTPUT: angles at which totals are listed
module axijoint_deck_section_output
   use axijoint_base_kinds, only : wp, degree
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type, cards_of
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_job
   use axijoint_deck_text_common_fields, only : angle
   use axijoint_deck_text_field, only : described
   implicit none
   private
   public :: output_section

   !> The keyword
   character(len=*), parameter :: keyword_output = 'OUTPUT'
   !> Angles unless the section gives others [degree]
   real(wp), parameter :: default_angles(3) = [0.0_wp, 90.0_wp, 180.0_wp]

contains

   !> OUTPUT
   function output_section() result(section)
      !> The section
      type(read_section_type) :: section

      integer :: i

      section%name = keyword_output
      section%purpose = 'angles at which totals are listed'
      section%stage = stage_job
      section%read => read_output
      section%fields = described([(angle('angle '//to_text(i), 10*i - 9), i=1, 8)], &
                                 'angles θ [degree] at which totals are listed', &
                                 blank='without the section 0, 90, 180')
      section%fields(1)%required = .true.
   end function output_section

   !> Take the angles into the job
   subroutine read_output(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card

      card = cards_of(deck, keyword_output)
      associate (table => card%table)
         deck%model%output_angles = degree*pack(table%values(:, :table%n), table%given(:, :table%n))
         if (table%n == 0) deck%model%output_angles = degree*default_angles
      end associate
   end subroutine read_output

end module axijoint_deck_section_output
