!> Title of a new deck: what another program allows there need not be a title here
module axijoint_legacy_title
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_registry, only : all_sections
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_section, only : names_of, keyword_length, keyword_last, card_width
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_words, only : text_type, put
   implicit none
   private
   public :: put_title

contains

   !> Cards of the title: what is too long is cut, what is a keyword gets quotes, by which it is none
   subroutine put_title(title, card, cards, new)
      !> The title of the old deck
      character(len=*), intent(in) :: title
      !> Its card, for warnings; 0 if there is none
      integer, intent(in) :: card
      !> Cards of the old deck; take warnings
      type(cards_type), intent(inout) :: cards
      !> The new deck
      type(text_type), intent(inout) :: new

      character(len=:), allocatable :: text

      text = trim(title)
      if (length(text) > card_width) then
         text = trim(first_letters(text, card_width))
         call add_warning(cards%diagnostics, card, 0, 0, 'the title is cut to '// &
            to_text(card_width)//' characters')
      end if
      if (is_keyword(text)) text = '"'//trim(first_letters(text, card_width - 2))//'"'
      call put(new, 'TITLE')
      call put(new, text)
   end subroutine put_title

   !> Letters of a text: bytes that begin one in UTF-8
   pure integer function length(text)
      !> The text
      character(len=*), intent(in) :: text

      integer :: k

      length = count([(begins_letter(text(k:k)), k=1, len(text))])
   end function length

   !> The first letters of a text
   pure function first_letters(text, n) result(first)
      !> The text
      character(len=*), intent(in) :: text
      !> How many
      integer, intent(in) :: n
      !> What is left
      character(len=:), allocatable :: first

      integer :: k, letters

      letters = 0
      do k = 1, len(text)
         if (begins_letter(text(k:k))) letters = letters + 1
         if (letters > n) exit
      end do
      first = text(:k - 1)
   end function first_letters

   !> Whether a byte begins a letter in UTF-8
   elemental logical function begins_letter(byte)
      !> The byte
      character(len=1), intent(in) :: byte

      begins_letter = iand(iachar(byte), 192) /= 128
   end function begins_letter

   !> Whether a title would be taken for a keyword: its first word is one, and nothing but numbers
   !> stands behind the columns of keywords
   logical function is_keyword(text)
      !> The title
      character(len=*), intent(in) :: text

      character(len=keyword_length), allocatable :: keywords(:)
      integer :: behind

      keywords = names_of(all_sections())
      behind = scan(text//' ', ' !'//achar(9))
      is_keyword = .false.
      if (behind == 1) return
      if (behind - 1 > keyword_length) return
      is_keyword = any(keywords == upper(text(:behind - 1)))
      if (len(text) > keyword_last) is_keyword = is_keyword .and. &
         verify(text(keyword_last + 1:), ' 0123456789'//achar(9)) == 0
   end function is_keyword

end module axijoint_legacy_title
