!> Bytes that no field of a card may have: tabs on fixed cards, and what is not ASCII
module axijoint_deck_text_strange_byte
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_source, only : tab
   implicit none
   private
   public :: has_strange_byte, report_strange_byte

contains

   !> Whether a card has a byte that no field may have
   pure logical function has_strange_byte(content, free)
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Whether it is written with commas, where tabs are blanks
      logical, intent(in) :: free

      has_strange_byte = strange_byte(content, free) > 0
   end function has_strange_byte

   !> Column of the first byte that no field may have; 0 if there is none
   pure integer function strange_byte(content, free) result(column)
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Whether it is written with commas
      logical, intent(in) :: free

      do column = 1, len(content)
         if (iachar(content(column:column)) >= 128) return
         if (content(column:column) == tab .and. .not. free) return
      end do
      column = 0
   end function strange_byte

   !> Report a tab, or a character that is not ASCII
   subroutine report_strange_byte(diagnostics, card, content, free)
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics
      !> The card
      integer, intent(in) :: card
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> Whether it is written with commas
      logical, intent(in) :: free

      character(len=2) :: code
      integer :: first, last

      first = strange_byte(content, free)
      last = first
      if (content(first:first) == tab) then
         call add_error(diagnostics, card, first, last, 'there is a tab on a fixed card', &
                        mend='write blanks, or separate the values by commas')
         return
      end if
      ! The further bytes of a character in UTF-8 begin with the bits 10.
      do while (last < len(content))
         if (iand(iachar(content(last + 1:last + 1)), 192) /= 128) exit
         last = last + 1
      end do
      write (code, '(z2.2)') iachar(content(first:first))
      call add_error(diagnostics, card, first, last, 'this character is not ASCII', &
                     found='a character that begins with the byte '//code//' (hexadecimal)', &
                     allowed='ASCII; any text in the title and in comments', &
                     mend='retype it; a blank that is not ASCII, or a byte order mark, looks '// &
                     'like nothing')
   end subroutine report_strange_byte

end module axijoint_deck_text_strange_byte
