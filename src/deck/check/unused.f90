!> What a deck gives and nothing uses: often a wrong number on another card
module axijoint_deck_check_unused
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_deck, only : deck_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_text_sections, only : sections_type
   use axijoint_deck_text_table, only : table_type, integer_value
   implicit none
   private
   public :: warn_of_unused

   !> Numbers that are listed in a message
   integer, parameter :: most_listed = 10

contains

   !> Warn of materials, laws, faces and shapes that nothing uses, and of sections without cards.
   !> For decks without errors: of others too little is known
   subroutine warn_of_unused(deck)
      !> The deck with its model
      type(deck_type), intent(inout), target :: deck

      integer :: k

      associate (draft => deck%draft, mesh => deck%model%mesh, properties => deck%properties, &
                 shapes => deck%shapes, sections => deck%sections, diagnostics => deck%diagnostics)
         call tell('material', (properties%materials%label), properties%material_card, &
                   occur(mesh%element_material, size(properties%materials)), &
                   'used by no element', diagnostics)
         call tell('law', (properties%laws%label), properties%law_card, &
                   occur(mesh%joint_material, size(properties%laws)), 'used by no joint', &
                   diagnostics)
         call tell('face', (draft%faces%label), (draft%faces%card), &
                   are_in((draft%faces%label), numbers_that_refer_to(sections, 'face')), &
                   'used by no card', diagnostics)
         call tell('shape', shapes%label, shapes%card, &
                   are_in(shapes%label, numbers_that_refer_to(sections, 'shape')), &
                   'used by no load', diagnostics)
         do k = 1, size(sections%empty)
            associate (keyword => deck%source%cards(sections%empty(k))%keyword)
               call add_warning(diagnostics, sections%empty(k), 0, 0, &
                                trim(sections%names(keyword))//' has no cards', &
                                mend='remove the keyword, or write 0 behind it from column 11 '// &
                                'on if that is meant')
            end associate
         end do
      end associate
   end subroutine warn_of_unused

   !> Warn of the things of one kind that nothing uses, in one message
   subroutine tell(noun, numbers, cards, used, what, diagnostics)
      !> What they are
      character(len=*), intent(in) :: noun
      !> Their numbers and cards; a number may be there several times
      integer, intent(in) :: numbers(:), cards(:)
      !> Whether anything uses them
      logical, intent(in) :: used(:)
      !> What is wrong: "used by ..."
      character(len=*), intent(in) :: what
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(number_map_type) :: told
      character(len=:), allocatable :: list
      integer :: k, n

      n = 0
      list = ''
      do k = 1, size(used)
         if (used(k) .or. find_number(told, numbers(k)) > 0) cycle
         call insert_number(told, numbers(k), k)
         n = n + 1
         if (n <= most_listed) list = list//', '//to_text(numbers(k))
      end do
      if (n == 0) return
      if (n > most_listed) list = list//', ...'
      if (n == 1) list = noun//' '//list(3:)//' is '//what
      if (n > 1) list = to_text(n)//' '//noun//'s are '//what//': '//list(3:)
      call add_warning(diagnostics, cards(findloc(used, .false., 1)), 0, 0, list, &
                       mend='remove what is not needed, or correct the number on the cards '// &
                       'that should use it')
   end subroutine tell

   !> Whether indices occur in a list
   pure function occur(list, n)
      !> The list
      integer, intent(in) :: list(:)
      !> Largest index
      integer, intent(in) :: n
      !> The answers
      logical :: occur(n)

      occur = .false.
      occur(list) = .true.
   end function occur

   !> Whether numbers are among others
   pure function are_in(numbers, others)
      !> The numbers
      integer, intent(in) :: numbers(:)
      !> The others
      type(number_map_type), intent(in) :: others
      !> The answers
      logical :: are_in(size(numbers))

      integer :: k

      are_in = [(find_number(others, numbers(k)) > 0, k=1, size(numbers))]
   end function are_in

   !> Numbers of the things of a kind that cards refer to
   pure function numbers_that_refer_to(sections, kind) result(numbers)
      !> The sections
      type(sections_type), intent(in) :: sections
      !> The kind: face, shape
      character(len=*), intent(in) :: kind
      !> The numbers
      type(number_map_type) :: numbers

      integer :: k, field

      do k = 1, size(sections%tables)
         do field = 1, size(sections%tables(k)%fields)
            if (sections%tables(k)%fields(field)%refers_to /= kind) cycle
            call add_field(sections%tables(k), field, numbers)
         end do
      end do
   end function numbers_that_refer_to

   !> Add the numbers in a field of a section
   pure subroutine add_field(table, field, numbers)
      !> The section
      type(table_type), intent(in) :: table
      !> The field
      integer, intent(in) :: field
      !> The numbers
      type(number_map_type), intent(inout) :: numbers

      integer :: entry

      do entry = 1, table%n
         if (table%given(field, entry)) call insert_number(numbers, &
            integer_value(table, field, entry), entry)
      end do
   end subroutine add_field

end module axijoint_deck_check_unused
