!> Gravity and rotation of elements of Abaqus and CalculiX: here they act on all elements that have mass
module axijoint_legacy_abaqus_bodies
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : add_error, add_warning
   use axijoint_deck_text_source, only : card_line
   use axijoint_legacy_abaqus_lines, only : line_type, field_text, real_of, fault_of
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, members
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : list_type
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_gravity, part_rotation
   use axijoint_legacy_words, only : put, exact
   implicit none
   private
   public :: body_loads_type, open_body_loads, add_body_gravity, add_body_rotation, put_body_loads

   !> What acts on the mass of an element
   integer, parameter :: gravity = 1, rotation = 2, n_kinds = 2
   !> The words for it
   character(len=*), parameter :: kinds(n_kinds) = [character(len=7) :: 'GRAV', 'CENTRIF']
   !> Lengths of a direction that differ by less from one are one
   real(wp), parameter :: unit_length = 1.0e-6_wp

   !> What acts on the mass of all elements
   type :: body_loads_type
      !> Acceleration along z, square of the angular velocity; shape (kinds, elements)
      real(wp), allocatable :: value(:, :)
      !> Cards that say so, same shape; 0 if nothing acts
      integer, allocatable :: card(:, :)
   end type body_loads_type

contains

   !> Begin with nothing
   subroutine open_body_loads(n, bodies)
      !> Elements at most
      integer, intent(in) :: n
      !> Loads
      type(body_loads_type), intent(out) :: bodies

      allocate (bodies%value(n_kinds, n), source=0.0_wp)
      allocate (bodies%card(n_kinds, n), source=0)
   end subroutine open_body_loads

   !> GRAV: elements, acceleration, direction
   subroutine add_body_gravity(cards, line, keyword, mesh, bodies, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line
      type(line_type), intent(in) :: line
      !> Keyword of the load, for remarks
      character(len=*), intent(in) :: keyword
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes the load
      type(body_loads_type), intent(inout) :: bodies
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      real(wp) :: direction(3), length
      integer :: k

      do k = 1, 3
         direction(k) = real_of(cards, line, 3 + k)
      end do
      length = norm2(direction)
      if (.not. length > 0.0_wp) then
         call fault_of(cards, line, 0, 'GRAV has no direction', 'elements, GRAV, g, 0, 1 or -1, 0')
         return
      end if
      if (any(abs(direction([1, 3])) > 0.0_wp)) then
         call leave_out(sketch, line%card, '*'//keyword//' of kind GRAV across the axis')
         return
      end if
      if (abs(length - 1.0_wp) > unit_length) call add_warning(cards%diagnostics, line%card, 0, 0, &
         'the direction of GRAV has the length '//to_text(length)//'; it is taken as a direction '// &
         'alone, and the acceleration is '//to_text(abs(real_of(cards, line, 3))))
      call add_load(cards, line, gravity, sign(real_of(cards, line, 3), &
         real_of(cards, line, 3)*direction(2)), mesh, bodies)
   end subroutine add_body_gravity

   !> CENTRIF: elements, square of the angular velocity, a point of the axis of rotation, its
   !> direction
   subroutine add_body_rotation(cards, line, keyword, mesh, bodies, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line
      type(line_type), intent(in) :: line
      !> Keyword of the load, for remarks
      character(len=*), intent(in) :: keyword
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes the load
      type(body_loads_type), intent(inout) :: bodies
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      ! coordinates of the point and components of the direction that the axis of the body has not
      integer, parameter :: off_axis(4) = [4, 6, 7, 9]
      integer :: k

      if (real_of(cards, line, 3) < 0.0_wp) then
         call fault_of(cards, line, 3, 'this is no square of an angular velocity', '0 or above')
         return
      end if
      do k = 1, size(off_axis)
         if (.not. abs(real_of(cards, line, off_axis(k))) > 0.0_wp) cycle
         call leave_out(sketch, line%card, '*'//keyword//' of kind CENTRIF about another axis')
         return
      end do
      call add_load(cards, line, rotation, real_of(cards, line, 3), mesh, bodies)
   end subroutine add_body_rotation

   !> A load on the elements of a line; no name means all of them
   subroutine add_load(cards, line, kind, value, mesh, bodies)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line
      type(line_type), intent(in) :: line
      !> One of the parameters above
      integer, intent(in) :: kind
      !> The load
      real(wp), intent(in) :: value
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes it
      type(body_loads_type), intent(inout) :: bodies

      type(list_type) :: list
      integer :: k, element

      if (len(field_text(line, 1)) == 0) then
         list%value = mesh%element(:mesh%n_elements)
         list%n = mesh%n_elements
      else
         list = members(cards, line, 1, mesh%element_sets)
      end if
      do k = 1, list%n
         element = find_number(mesh%element_map, list%value(k))
         if (element == 0) then
            call fault_of(cards, line, 1, 'there is no element '//to_text(list%value(k)))
            return
         end if
         associate (card => bodies%card(kind, element))
            if (card == line%card) cycle
            if (card > 0) then
               call fault_of(cards, line, 1, 'element '//to_text(list%value(k))//' has '// &
                  trim(kinds(kind))//' of line '//to_text(card_line(cards%source, card))// &
                  ' already', 'one of them for each element')
               return
            end if
            card = line%card
         end associate
         bodies%value(kind, element) = value
      end do
   end subroutine add_load

   !> Cards of gravity and rotation; which elements are to have no mass, as neither acts on them
   subroutine put_body_loads(cards, mesh, bodies, sketch, weightless)
      !> The file; takes errors
      type(cards_type), intent(inout) :: cards
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> The loads
      type(body_loads_type), intent(in) :: bodies
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch
      !> Whether a load on masses acts, but not on this element
      logical, intent(out) :: weightless(:)

      logical :: acts(n_kinds, mesh%n_elements)
      integer :: kind, first

      acts = abs(bodies%value(:, :mesh%n_elements)) > 0.0_wp
      weightless = any(acts) .and. .not. any(acts, 1)
      do kind = 1, n_kinds
         first = findloc(acts(kind, :), .true., 1)
         if (first == 0) cycle
         call check_even(kind, first)
         if (kind == gravity) call put(sketch%parts(part_gravity), exact(bodies%value(kind, first)))
         if (kind == rotation) call put(sketch%parts(part_rotation), &
            exact(sqrt(bodies%value(kind, first))))
      end do

   contains

      !> An error unless all elements that have mass here have the same load: one card is for all
      subroutine check_even(kind, first)
         !> The load
         integer, intent(in) :: kind
         !> The first element that has it
         integer, intent(in) :: first

         integer :: k

         do k = 1, mesh%n_elements
            if (weightless(k)) cycle
            if (abs(bodies%value(kind, k) - bodies%value(kind, first)) <= &
                1.0e-12_wp*abs(bodies%value(kind, first))) cycle
            call add_error(cards%diagnostics, bodies%card(kind, first), 0, 0, trim(kinds(kind))// &
               ' of this line acts on element '//to_text(mesh%element(first))//', and not alike on '// &
               'element '//to_text(mesh%element(k))//', on which GRAV or CENTRIF acts, too', &
               allowed='one acceleration and one angular velocity for all elements that have any')
            return
         end do
      end subroutine check_even

   end subroutine put_body_loads

end module axijoint_legacy_abaqus_bodies
