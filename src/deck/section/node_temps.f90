!> NODETEMPS: temperatures of nodes
module axijoint_deck_section_node_temps
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_card, only : card_type, cards_of, next_card, find_row
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_loads
   use axijoint_deck_job_load_fields, only : harmonic, family, shape_number, name_harmonic, name_family, &
      name_shape
   use axijoint_deck_job_modes, only : read_shares, check_torsion
   use axijoint_deck_load_lists, only : add_temperatures
   use axijoint_deck_load_shares, only : share_type
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_text_common_fields, only : node, last_node, step, name_node
   use axijoint_deck_text_entry, only : integer_of, real_of, field_named, is_sound
   use axijoint_deck_text_field, only : real_field, described
   use axijoint_deck_text_section, only : needs_expansion
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: node_temps_section

   !> The keyword
   character(len=*), parameter :: keyword_node_temps = 'NODETEMPS'
   !> Field of the temperature
   integer, parameter :: field_value = 5
   !> Fields that tell with which cards a temperature adds up
   character(len=*), parameter :: name_of_field(3) = [character(len=12) :: name_harmonic, name_family, name_shape]

   !> Temperatures of nodes in one load case, harmonic and family, or by one shape
   type :: row_type
      !> Load case, harmonic, family, shape
      integer :: key(4) = 0
      !> What each mode takes
      type(share_type), allocatable :: shares(:)
      !> Temperatures, and which are given, shape (nodes)
      real(wp), allocatable :: temperature(:)
      logical, allocatable :: given(:)
   end type row_type

contains

   !> NODETEMPS
   function node_temps_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_node_temps
      section%purpose = 'changes of temperature of nodes'
      section%is_load = .true.
      section%needs = needs_expansion
      section%stage = stage_loads
      section%read => read_node_temps
      section%fields = &
         [node(name_node, 1), last_node(6), step(11), harmonic(16), &
          described(real_field('T', 21), 'T', limits='any'), family(31), shape_number(36)]
   end function node_temps_section

   !> Add the temperatures
   subroutine read_node_temps(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      type(row_type), allocatable :: rows(:)
      integer :: i, k

      allocate (rows(0))
      card = cards_of(deck, keyword_node_temps)
      do while (next_card(card))
         call read_row(card, rows)
      end do
      do k = 1, size(rows)
         associate (row => rows(k))
            call fill_between(deck%draft, row%temperature, row%given)
            call add_temperatures(deck%loads, row%key(1), row%shares, 0, pack([(i, i=1, size(row%given))], row%given), &
                                  pack(row%temperature, row%given))
         end associate
      end do
   end subroutine read_node_temps

   !> Read the temperature of a row of nodes, and add it to those of the same load case, harmonic, family and shape
   subroutine read_row(card, rows)
      !> A card of NODETEMPS
      type(card_type), intent(in) :: card
      !> What cards gave so far
      type(row_type), allocatable, intent(inout) :: rows(:)

      type(share_type), allocatable :: shares(:)
      integer, allocatable :: nodes(:)
      integer :: key(4), k

      call check_torsion(card, 'temperature')
      call find_row(card, nodes)
      call read_shares(card, shares)
      if (size(nodes) == 0 .or. .not. is_sound(card)) return
      key = [card%case, (integer_of(card, field_named(card, trim(name_of_field(k)))), k=1, 3)]
      do k = 1, size(rows)
         if (all(rows(k)%key == key)) exit
      end do
      if (k > size(rows)) then
         rows = [rows, row_type(key, shares)]
         allocate (rows(k)%temperature(card%deck%draft%n_nodes), source=0.0_wp)
         allocate (rows(k)%given(card%deck%draft%n_nodes), source=.false.)
      end if
      rows(k)%temperature(nodes) = rows(k)%temperature(nodes) + real_of(card, field_value)
      rows(k)%given(nodes) = .true.
   end subroutine read_row

   !> Give nodes in the middle of edges of which both ends have a temperature, and they have none, the mean of these; and the
   !> centre of a 9-node element, if it has none, that of its edges. Zero there would turn the mean of an element round
   pure subroutine fill_between(draft, temperature, given)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Temperatures of the nodes, and which have one
      real(wp), intent(inout) :: temperature(:)
      logical, intent(inout) :: given(:)

      integer :: element, side

      do element = 1, draft%n_elements
         associate (n => draft%element_size(element), nodes => draft%element_nodes(:, element))
            if (n <= 4 .or. any(nodes(:n) == 0)) cycle
            associate (corners => n_corners(n))
               do side = 1, corners
                  associate (a => nodes(side), b => nodes(mod(side, corners) + 1), middle => nodes(corners + side))
                     if (given(middle) .or. .not. (given(a) .and. given(b))) cycle
                     temperature(middle) = 0.5_wp*(temperature(a) + temperature(b))
                     given(middle) = .true.
                  end associate
               end do
            end associate
            if (n < 9) cycle
            if (given(nodes(9)) .or. .not. all(given(nodes(:8)))) cycle
            temperature(nodes(9)) = 0.25_wp*sum(temperature(nodes(5:8)))
            given(nodes(9)) = .true.
         end associate
      end do
   end subroutine fill_between

end module axijoint_deck_section_node_temps
