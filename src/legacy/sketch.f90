!> What is gathered of a deck of another program: cards of axijoint by section, and lines that are not
!> translated
module axijoint_legacy_sketch
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_source, only : card_line
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_title, only : put_title
   use axijoint_legacy_words, only : text_type, put
   implicit none
   private
   public :: sketch_type, leave_out, tell_left, write_sketch
   public :: part_materials, part_orthotropic, part_yield, part_laws, part_law_details, part_nodes, part_elements, part_joints, &
      part_restraints, part_chains, part_tractions, part_pressures, part_ring_loads, part_gravity, part_rotation, &
      part_temperatures, part_moved, part_notes, n_parts

   !> Sections, in the order in which they are written, and remarks on groups
   integer, parameter :: part_materials = 1, part_orthotropic = 2, part_yield = 3, part_laws = 4, part_law_details = 5, &
      part_nodes = 6, part_elements = 7, part_joints = 8, part_chains = 9, part_restraints = 10, part_tractions = 11, &
      part_pressures = 12, part_ring_loads = 13, part_gravity = 14, part_rotation = 15, part_temperatures = 16, part_moved = 17, &
      part_notes = 18, n_parts = 18
   !> Their keywords
   character(len=*), parameter :: keywords(n_parts) = [character(len=11) :: 'MATERIALS', 'ORTHOTROPIC', 'YIELD', 'LAWS', &
      'LAWDETAILS', 'NODES', 'ELEMENTS', 'JOINTS', 'CHAINS', 'RESTRAINTS', 'TRACTIONS', 'PRESSURES', 'RINGLOADS', 'GRAVITY', &
      'ROTATION', 'NODETEMPS', 'MOVEDNODES', '']

   !> Lines that follow each other and are not translated
   type :: left_type
      !> What they are
      character(len=:), allocatable :: keyword
      !> Cards, the first and the last
      integer :: first = 0, last = 0
   end type left_type

   !> The deck so far
   type :: sketch_type
      !> Title, and its card; 0 if there is none
      character(len=:), allocatable :: title
      integer :: title_card = 0
      !> Highest harmonic; points in each direction of linear and of quadratic elements
      integer :: harmonic = 0, order_linear = 2, order_quadratic = 3
      !> Faces that are no sides of surfaces
      integer :: n_sides = 0
      !> Cards by section
      type(text_type) :: parts(n_parts)
      !> What is not translated
      type(left_type), allocatable :: left(:)
      integer :: n_left = 0
   end type sketch_type

contains

   !> Note that a card is not translated
   subroutine leave_out(sketch, card, keyword)
      !> The deck
      type(sketch_type), intent(inout) :: sketch
      !> The card
      integer, intent(in) :: card
      !> What it is
      character(len=*), intent(in) :: keyword

      type(left_type), allocatable :: more(:)
      integer :: k

      if (.not. allocated(sketch%left)) allocate (sketch%left(16))
      if (sketch%n_left > 0) then
         associate (last => sketch%left(sketch%n_left))
            if (last%keyword == keyword .and. last%last >= card - 1) then
               last%last = card
               return
            end if
         end associate
      end if
      if (sketch%n_left == size(sketch%left)) then
         allocate (more(2*sketch%n_left))
         do k = 1, sketch%n_left
            more(k) = sketch%left(k)
         end do
         call move_alloc(more, sketch%left)
      end if
      sketch%n_left = sketch%n_left + 1
      sketch%left(sketch%n_left)%keyword = keyword
      sketch%left(sketch%n_left)%first = card
      sketch%left(sketch%n_left)%last = card
   end subroutine leave_out

   !> Warn of what is not translated, line by line
   subroutine tell_left(sketch, cards)
      !> What was gathered
      type(sketch_type), intent(in) :: sketch
      !> The old deck's cards; take warnings
      type(cards_type), intent(inout) :: cards

      integer :: k

      do k = 1, sketch%n_left
         associate (left => sketch%left(k))
            call add_warning(cards%diagnostics, left%first, 0, 0, 'not translated: '//left%keyword//', '//place(cards, left))
         end associate
      end do
   end subroutine tell_left

   !> Lines of the old deck
   function place(cards, left)
      !> Its cards
      type(cards_type), intent(in) :: cards
      !> What is not translated
      type(left_type), intent(in) :: left
      !> Such as "line 7", "lines 7 to 9"
      character(len=:), allocatable :: place

      place = 'line '//to_text(card_line(cards%source, left%first))
      if (left%last > left%first) place = 'lines '//to_text(card_line(cards%source, left%first))//' to '// &
         to_text(card_line(cards%source, left%last))
   end function place

   !> The new deck, with what is not translated, line by line
   subroutine write_sketch(path, sketch, cards, text)
      !> Path of the old deck
      character(len=*), intent(in) :: path
      !> What was gathered of it
      type(sketch_type), intent(in) :: sketch
      !> Its cards; take warnings about the title
      type(cards_type), intent(inout) :: cards
      !> The new deck
      character(len=:), allocatable, intent(out) :: text

      type(text_type) :: new
      integer :: k

      call put_title(sketch%title, sketch%title_card, cards, new)
      call put(new, '! from '//path)
      do k = 1, sketch%n_left
         associate (left => sketch%left(k))
            call put(new, '! not translated: '//place(cards, left)//' '//left%keyword)
         end associate
      end do
      call append(sketch%parts(part_notes))
      call put(new, 'CONTROL')
      call put(new, to_text(sketch%harmonic)//', , '//to_text(sketch%order_linear)//', '// &
         to_text(sketch%order_quadratic))
      do k = 1, n_parts - 1
         if (sketch%parts(k)%used == 0) cycle
         call put(new, trim(keywords(k)))
         call append(sketch%parts(k))
      end do
      call put(new, 'END')
      text = new%letters(:new%used)

   contains

      !> Add the cards of a section
      subroutine append(part)
         !> The cards, a line feed behind each
         type(text_type), intent(in) :: part

         if (part%used > 0) call put(new, part%letters(:part%used - 1))
      end subroutine append

   end subroutine write_sketch

end module axijoint_legacy_sketch
