!> Comments and headings as other programs write them: they are errors, but named for what they are
module axijoint_deck_text_foreign
   use axijoint_base_text, only : upper, nearest_word
   use axijoint_deck_text_section, only : section_type, section_named, names_of, keyword_length
   use axijoint_deck_text_source, only : tab
   implicit none
   private
   public :: comment_mark, heading_mark, heading_word, trailing_comment

   !> What comments begin with elsewhere
   character(len=2), parameter :: comment_marks(5) = ['# ', '//', '; ', '% ', '**']
   !> The first of these stand behind values, too, where asterisks are a number without room
   integer, parameter :: n_trailing = 4
   !> What headings begin with elsewhere; the first two begin nothing else
   character(len=*), parameter :: heading_marks = '*[#%&<@$', sure_marks = '*['
   !> Letters of a keyword
   character(len=*), parameter :: letters = 'ABCDEFGHIJKLMNOPQRSTUVWXYZ'

contains

   !> What makes a card a comment elsewhere; empty if nothing does
   pure function comment_mark(content) result(mark)
      !> The card, not blank
      character(len=*), intent(in) :: content
      !> The mark
      character(len=:), allocatable :: mark

      character(len=:), allocatable :: text
      integer :: k

      text = content(verify(content, ' '//tab):)
      mark = ''
      do k = 1, size(comment_marks)
         if (index(text, trim(comment_marks(k))) == 1) mark = trim(comment_marks(k))
      end do
      if (mark == '**' .and. is_overflow(text)) mark = ''
      if (upper(content(:min(2, len(content)))) == 'C') mark = content(1:1)
   end function comment_mark

   !> Whether a card begins with a number that was too wide for its field: asterisks, then values
   pure logical function is_overflow(text)
      !> The card from its first value on
      character(len=*), intent(in) :: text

      integer :: behind

      behind = verify(text, '*')
      is_overflow = behind > 3
      if (is_overflow) is_overflow = scan(text(behind:behind), ' ,') == 1
   end function is_overflow

   !> What makes a card a heading elsewhere: a mark before a word, or a colon behind it. Of the
   !> marks that begin comments, too, only before a keyword. Empty if nothing does
   pure function heading_mark(sections, text) result(mark)
      !> Sections that the deck may have
      type(section_type), intent(in) :: sections(:)
      !> The card
      character(len=*), intent(in) :: text
      !> The mark
      character(len=:), allocatable :: mark

      integer :: behind

      mark = ''
      if (len_trim(text) < 2) return
      if (scan(text(1:1), heading_marks) == 1) then
         if (scan(upper(text(2:2)), letters) == 0) return
         if (scan(text(1:1), sure_marks) == 1 .or. &
             section_named(sections, heading_word(text)) > 0) mark = text(1:1)
         return
      end if
      behind = verify(upper(text), letters)
      if (behind < 2) return
      if (text(behind:behind) == ':') mark = ':'
   end function heading_mark

   !> The word of a heading, in capitals
   pure function heading_word(text) result(word)
      !> The card, which has a `heading_mark`
      character(len=*), intent(in) :: text
      !> The word
      character(len=keyword_length) :: word

      integer :: first, behind

      first = merge(2, 1, scan(text(1:1), heading_marks) == 1)
      behind = first - 1 + verify(upper(text(first:))//' ', letters)
      word = upper(text(first:behind - 1))
   end function heading_word

   !> Column where a comment of another program begins behind the values of a card; 0 if there
   !> is none
   pure integer function trailing_comment(content) result(column)
      !> The card
      character(len=*), intent(in) :: content

      integer :: k, places(n_trailing)

      do k = 1, n_trailing
         places(k) = index(content, ' '//trim(comment_marks(k)))
      end do
      column = 0
      if (any(places > 0)) column = minval(places, places > 0) + 1
   end function trailing_comment

end module axijoint_deck_text_foreign
