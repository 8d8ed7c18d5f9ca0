!> Cards of a deck as a list in JSON, for programs that write decks
module axijoint_command_card_list
   use axijoint_deck_text_field, only : field_type, kind_integer, kind_real, kind_word, kind_text
   use axijoint_deck_text_reference, only : meaning, default, allowed
   use axijoint_deck_text_section, only : section_type, form_entries, form_file
   use axijoint_output_file_json, only : json_string, json_number, json_strings
   implicit none
   private
   public :: cards_json

   !> End of a line
   character(len=1), parameter :: nl = new_line('a')
   !> Names of the kinds of fields and of the forms of sections
   character(len=7), parameter :: kinds(kind_integer:kind_text) = &
      [character(len=7) :: 'integer', 'real', 'word', 'code', 'text'], &
      forms(form_entries:form_file) = &
      [character(len=7) :: 'entries', 'title', 'end', 'include', 'file']

contains

   !> All sections: an array of JSON, a line for each section and field
   function cards_json(sections) result(json)
      !> The sections
      type(section_type), intent(in) :: sections(:)
      !> The array
      character(len=:), allocatable :: json

      integer :: i, k

      json = '['
      do k = 1, size(sections)
         if (k > 1) json = json//','
         json = json//nl//'{"card": '//json_string(trim(sections(k)%name))//', "purpose": '// &
            json_string(trim(sections(k)%purpose))//', "form": '// &
            json_string(trim(forms(sections(k)%form)))//', "once": '//logic(sections(k)%once)// &
            ', "required": '//logic(sections(k)%required)//', "alone": '// &
            logic(sections(k)%alone)//', "load": '//logic(sections(k)%is_load)//', "fields": ['
         do i = 1, size(sections(k)%fields)
            if (i > 1) json = json//','
            json = json//nl//'  '//field_json(sections(k)%fields(i))
         end do
         json = json//']}'
      end do
      json = json//nl//']'
   end function cards_json

   !> A field. What is told of it stands with the first of the fields that are told of together
   function field_json(field) result(json)
      !> The field
      type(field_type), intent(in) :: field
      !> An object of JSON
      character(len=:), allocatable :: json

      json = '{"name": '//json_string(trim(field%name))//', "kind": '// &
         json_string(trim(kinds(field%kind)))//', "card": '//json_number(field%card)// &
         ', "columns": ['//json_number(field%first)//', '//json_number(field%last)// &
         '], "joined": '//logic(field%joined)//', "required": '//logic(field%required)// &
         ', "meaning": '//json_string(meaning(field))//', "blank": '// &
         json_string(default(field))//', "allowed": '//json_string(allowed(field))
      if (any(field%kind == [kind_integer, kind_real])) then
         json = json//', "low": '//json_number(field%low)//', "high": '// &
            json_number(field%high)//', "above_low": '//logic(field%above_low)// &
            ', "below_high": '//logic(field%below_high)
      else if (field%kind == kind_word) then
         json = json//', "words": '//json_strings(pack(field%words, field%words /= ''))
      end if
      json = json//'}'
   end function field_json

   !> A logical
   function logic(value)
      !> Whether it is true
      logical, intent(in) :: value
      !> In JSON
      character(len=:), allocatable :: logic

      logic = 'false'
      if (value) logic = 'true'
   end function logic

end module axijoint_command_card_list
