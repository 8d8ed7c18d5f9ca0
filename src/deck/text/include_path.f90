!> The path on an INCLUDE or a GMSH card, and whether it may be followed
module axijoint_deck_text_include_path
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_section, only : card_width, keyword_last
   use axijoint_deck_text_source, only : source_type, tab
   implicit none
   private
   public :: locate_path, path_fault, nesting_fault, folder

   !> Files included by files included by files ...
   integer, parameter :: max_depth = 20
   !> Files in all, so that files that include each other twice stay finite
   integer, parameter :: max_files = 1000

contains

   !> Columns of the path: from 11 on, or behind a comma after the keyword
   pure subroutine locate_path(content, first, last, fault)
      !> The card without its comment
      character(len=*), intent(in) :: content
      !> First and last column; last < first if there is no path
      integer, intent(out) :: first, last
      !> What is wrong with the card; empty if nothing is
      character(len=:), allocatable, intent(out) :: fault

      integer :: word_end

      fault = ''
      last = len(content)
      word_end = scan(content//' ', ' ,'//tab) - 1
      first = word_end + verify(content(word_end + 1:)//'.', ' ')
      if (first > last) then
         first = keyword_last + 1
      else if (content(first:first) == ',') then
         first = first + verify(content(first + 1:)//'.', ' ')
      else if (first <= keyword_last) then
         fault = 'the path begins before column 11'
      end if
      if (last > card_width) fault = 'the path runs past column 80'
   end subroutine locate_path

   !> What is wrong with a path as it is written; empty if nothing is
   pure function path_fault(keyword, path) result(fault)
      !> Keyword of the card
      character(len=*), intent(in) :: keyword
      !> The path
      character(len=*), intent(in) :: path
      !> What is wrong
      character(len=:), allocatable :: fault

      fault = ''
      if (len(path) == 0) then
         fault = keyword//' has no path'
      else if (scan(path, tab) > 0) then
         fault = 'there is a tab in the path'
      else if (scan(path(1:1), '/\~') > 0 .or. index(path, ':') == 2) then
         fault = 'the path is absolute'
      else if (index('/'//path//'/', '/../') > 0) then
         fault = 'the path leads upwards by ..'
      end if
   end function path_fault

   !> What is wrong with following a path; empty if nothing is
   pure function nesting_fault(source, file, path, depth) result(fault)
      !> The deck
      type(source_type), intent(in) :: source
      !> File that includes
      integer, intent(in) :: file
      !> File that is included
      character(len=*), intent(in) :: path
      !> Depth of the file that includes
      integer, intent(in) :: depth
      !> What is wrong
      character(len=:), allocatable :: fault

      integer :: above

      fault = ''
      above = file
      do while (above > 0)
         if (source%files(above)%path == path) fault = 'the file includes itself in a loop'
         above = source%files(above)%parent
      end do
      if (len(fault) > 0) return
      if (depth >= max_depth) fault = 'files include files more than '//to_text(max_depth)//' deep'
      if (source%n_files >= max_files) &
         fault = 'more than '//to_text(max_files)//' files are included'
   end function nesting_fault

   !> Folder part of a path with its slash; empty if it has none
   pure function folder(path)
      !> The path
      character(len=*), intent(in) :: path
      !> Folder
      character(len=:), allocatable :: folder

      folder = path(:index(path, '/', back=.true.))
   end function folder

end module axijoint_deck_text_include_path
