!> Headings of the listing
module axijoint_output_file_headings
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_heading, write_result_heading, write_lines, write_sentence, rule, mark_not_converged, width

   !> Columns of the listing
   integer, parameter :: width = 132
   !> Line across the listing
   character(len=*), parameter :: rule = repeat("=", width)
   !> Label of everything that is no equilibrium
   character(len=*), parameter :: mark_not_converged = "*** NOT CONVERGED ***"

contains

   !> Heading of a table, underlined, after a blank line
   subroutine write_heading(file, title)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Title
      character(len=*), intent(in) :: title

      call file%put("")
      call file%put(title)
      call file%put(repeat("-", len_trim(title)))
   end subroutine write_heading

   !> Heading of a table of results; says so if the run did not converge
   subroutine write_result_heading(file, title, converged)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> Title
      character(len=*), intent(in) :: title
      !> Whether the results are in equilibrium
      logical, intent(in) :: converged

      if (converged) then
         call write_heading(file, title)
      else
         call write_heading(file, title//"   "//mark_not_converged)
      end if
   end subroutine write_result_heading

   !> A text of one or more lines, each behind the same margin; long lines go on in the next, cut before a character and not
   !> within one; those of words with a whole word, if that is not longer than a line
   subroutine write_lines(file, margin, text, of_words)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> What stands before the first line; blanks before the others
      character(len=*), intent(in) :: margin
      !> Lines parted by line ends
      character(len=*), intent(in) :: text
      !> Whether parts end between words, the blank there left out; false if absent
      logical, intent(in), optional :: of_words

      integer :: first, last, ending, blank, end_of_part
      character(len=len(margin)) :: before
      logical :: by_words

      by_words = .false.
      if (present(of_words)) by_words = of_words
      before = margin
      first = 1
      do
         ending = index(text(first:), new_line("a"))
         last = merge(first + ending - 2, len(text), ending > 0)
         do while (last - first + 1 > width - len(margin))
            end_of_part = cut(text, first + width - len(margin) - 1)
            blank = 0
            if (by_words) blank = index(text(first:end_of_part + 1), " ", back=.true.)
            if (len_trim(text(first:first + max(0, blank - 1))) == 0) blank = 0
            if (blank > 1) end_of_part = first + blank - 2
            call file%put(before//text(first:end_of_part))
            first = end_of_part + merge(2, 1, blank > 1)
            before = ""
         end do
         call file%put(before//text(first:last))
         before = ""
         if (ending == 0) return
         first = last + 2
      end do
   end subroutine write_lines

   !> A sentence behind a margin; where one line is too narrow, what follows its first semicolon goes on in the next
   subroutine write_sentence(file, margin, sentence)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> What stands before both lines
      character(len=*), intent(in) :: margin
      !> The sentence
      character(len=*), intent(in) :: sentence

      integer :: semicolon

      semicolon = index(sentence, "; ")
      if (len(margin//sentence) <= width .or. semicolon == 0) then
         call write_lines(file, margin, sentence, of_words=.true.)
      else
         call write_lines(file, margin, sentence(:semicolon), of_words=.true.)
         call write_lines(file, margin, sentence(semicolon + 2:), of_words=.true.)
      end if
   end subroutine write_sentence

   !> Last byte not beyond `last` that ends a UTF-8 character
   pure integer function cut(text, last)
      !> The text
      character(len=*), intent(in) :: text
      !> Byte that may stand at the end of a line, followed by others
      integer, intent(in) :: last

      integer :: back

      cut = last
      do back = 0, 3
         if (iand(ichar(text(last - back + 1:last - back + 1)), 192) /= 128) then
            cut = last - back
            return
         end if
      end do
   end function cut

end module axijoint_output_file_headings
