!> TITLE, INCLUDE and END: what holds a deck together. The source reader follows them
module axijoint_deck_section_frame
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_job
   use axijoint_deck_text_section, only : form_title, form_include, form_end
   implicit none
   private
   public :: title_section, include_section, end_section

contains

   !> TITLE
   function title_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = 'TITLE'
      section%purpose = 'the next card, all 80 columns of it, is the title'
      section%form = form_title
      section%once = .true.
      section%stage = stage_job
      section%read => read_title
   end function title_section

   !> INCLUDE
   function include_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = 'INCLUDE'
      section%purpose = 'path of a file, from column 11 on, whose cards take the place of this one'
      section%form = form_include
   end function include_section

   !> END
   function end_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = 'END'
      section%purpose = 'last card of every file'
      section%form = form_end
   end function end_section

   !> Take the title into the job
   subroutine read_title(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      deck%model%title = deck%sections%title
   end subroutine read_title

end module axijoint_deck_section_frame
