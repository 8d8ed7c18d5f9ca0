!> Input files of Abaqus and CalculiX with axisymmetric solids: mesh, groups, materials, what acts in
!> the first step
module axijoint_legacy_abaqus
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_mesh_places, only : clear_rounding
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_deck_text_file_bytes, only : end_of_bytes => line_end, next_bytes => next_line
   use axijoint_legacy_abaqus_bodies, only : body_loads_type, open_body_loads, put_body_loads
   use axijoint_legacy_abaqus_boundary, only : boundary_type, open_boundary, renew_boundary, add_boundary, put_boundary
   use axijoint_legacy_abaqus_contact, only : contact_type, open_interaction, read_friction, read_behavior, read_pairs, &
      read_ties, put_contact, find_bodies
   use axijoint_legacy_abaqus_lines, only : line_type, next_line, is_data, parameter_of, real_of, fault_of, line_keyword, line_end
   use axijoint_legacy_abaqus_loads, only : add_ring_force, add_distributed, add_faces
   use axijoint_legacy_abaqus_materials, only : material_type, read_property, assign_material, put_materials
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, read_nodes, read_elements, read_set, &
      gather_nodes, read_surface, number_at, root_of
   use axijoint_legacy_abaqus_parameters, only : check_parameters, leave_data, elsewhere, r_and_z
   use axijoint_legacy_abaqus_temperatures, only : temperatures_type, open_temperatures, read_initial, read_temperatures, &
      put_temperatures
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : set_type, open_set, find_set
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_nodes, part_elements, part_notes
   use axijoint_legacy_words, only : put, exact, integers
   implicit none
   private
   public :: read_abaqus, looks_like_abaqus

   !> What is gathered of a file
   type :: file_type
      !> Nodes, elements, sets, surfaces
      type(abaqus_type) :: mesh
      !> Materials: their names, what they are, the one that was named last
      type(set_type), allocatable :: names(:)
      type(material_type), allocatable :: materials(:)
      integer :: material = 0
      !> What is held, what is in contact, what acts on masses
      type(boundary_type) :: boundary
      type(contact_type) :: contact
      type(body_loads_type) :: bodies
      !> Temperatures
      type(temperatures_type) :: temperatures
      !> Steps so far, and *BOUNDARY in this one
      integer :: n_steps = 0, n_boundaries = 0
   end type file_type

contains

   !> Whether a text is such a file: its first line that is no comment begins with an asterisk
   pure logical function looks_like_abaqus(bytes)
      !> The text
      character(len=*), intent(in) :: bytes

      character(len=:), allocatable :: line
      integer :: first, last

      looks_like_abaqus = .false.
      first = 1
      do while (first <= len(bytes))
         last = end_of_bytes(bytes, first)
         line = adjustl(bytes(first:min(last, first + 200)))
         if (len_trim(line) > 0 .and. index(line, '**') /= 1) then
            looks_like_abaqus = index(line, '*') == 1
            return
         end if
         first = next_bytes(bytes, last)
      end do
   end function looks_like_abaqus

   !> Read a file
   subroutine read_abaqus(cards, sketch)
      !> Its cards
      type(cards_type), intent(inout) :: cards
      !> What is made of it
      type(sketch_type), intent(inout) :: sketch

      type(file_type) :: file
      type(line_type) :: line
      real(wp), allocatable :: young(:)
      integer :: at

      sketch%title = ''
      associate (mesh => file%mesh, n => cards%source%n_cards)
         allocate (mesh%node(n), mesh%position(2, n))
         allocate (mesh%element(n), mesh%nodes(9, n), mesh%size(n), mesh%material(n), source=0)
         allocate (mesh%reduced(n), source=.false.)
         allocate (mesh%node_sets(0), mesh%element_sets(0), mesh%surfaces(0), file%names(0))
         call open_body_loads(n, file%bodies)
         call open_boundary(n, file%boundary)
         call open_temperatures(n, file%temperatures)
         call read_mesh(cards, mesh, file%names)
      end associate
      allocate (file%materials(size(file%names)))
      at = 0
      do
         call next_line(cards, at, line)
         if (line%kind == line_end) exit
         if (line%kind == line_keyword) call read_keyword(cards, line, at, file, sketch)
      end do
      if (cards%diagnostics%n_errors > 0) return
      call put_boundary(file%mesh, file%boundary, sketch)
      call put_temperatures(file%mesh, file%temperatures, sketch)
      young = file%materials%young
      call put_contact(cards, file%mesh, file%contact, young, sketch)
      call write_mesh(cards, file%names, file%materials, file%mesh, file%bodies, sketch)
   end subroutine read_abaqus

   !> Read a keyword with its data
   subroutine read_keyword(cards, line, at, file, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> What is gathered of the file
      type(file_type), intent(inout) :: file
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: data

      if (file%n_steps < merge(1, 2, line%keyword == 'STEP')) call check_parameters(cards, line, sketch)
      if (file%n_steps > 1 .and. acts_from_its_step(line%keyword)) then
         call leave_data(cards, line, at, sketch)
         return
      end if
      select case (line%keyword)
      case ('HEADING')
         call read_heading(cards, at, sketch)
      case ('NSET', 'ELSET', 'SURFACE')
         call read_group(cards, line, at, file%mesh, sketch)
      case ('MATERIAL')
         file%material = find_set(file%names, parameter_of(line, 'NAME'))
      case ('ELASTIC', 'DENSITY', 'PLASTIC', 'EXPANSION')
         call read_property(cards, line, at, file%material, file%materials, sketch)
      case ('SOLID SECTION')  ! its data, a thickness, means nothing here
         call assign_material(cards, line, file%names, file%mesh)
      case ('SURFACE INTERACTION')
         call open_interaction(line, file%contact)
      case ('CHANGE FRICTION')  ! what follows is none of an interaction
         file%contact%last = 0
         call leave_data(cards, line, at, sketch)
      case ('FRICTION')
         call read_friction(cards, line, at, file%contact, sketch)
      case ('SURFACE BEHAVIOR')
         call read_behavior(cards, line, at, file%contact, sketch)
      case ('CONTACT PAIR')
         call read_pairs(cards, line, at, file%mesh, file%contact)
      case ('TIE')
         call read_ties(cards, at, file%mesh, sketch)
      case ('STEP')
         file%n_steps = file%n_steps + 1
         if (file%n_steps > 1) call leave_out(sketch, line%card, '*STEP: only the first is translated')
      case ('INITIAL CONDITIONS')
         call read_initial(cards, line, at, file%mesh, file%temperatures, sketch)
      case ('BOUNDARY', 'CLOAD', 'DLOAD', 'DSLOAD', 'TEMPERATURE')
         call read_load(cards, line, at, file, sketch)
      case ('NODE', 'ELEMENT', 'INSTANCE')  ! are read already
      case ('STATIC', 'END STEP', 'PART', 'END PART', 'ASSEMBLY', 'END ASSEMBLY', 'END INSTANCE')
      case ('TRANSFORM')
         call fault_of(cards, line, 0, '*TRANSFORM: components along other directions than r and z are not translated', &
            'components along r and z')
      case ('NGEN', 'NFILL', 'NCOPY', 'NMAP', 'ELGEN', 'ELCOPY')
         call fault_of(cards, line, 0, '*'//line%keyword//': nodes and elements that keywords make are not read', &
            'all of them on lines of *NODE and *ELEMENT')
      case ('SYSTEM')
         ! without data it ends what one above began
         if (is_data(cards, at, data)) call fault_of(cards, line, 0, '*SYSTEM: '//elsewhere, r_and_z)
      case ('INCLUDE')
         call fault_of(cards, line, 0, '*INCLUDE is not read', 'the lines of the file itself')
      case default
         call leave_data(cards, line, at, sketch)
      end select
   end subroutine read_keyword

   !> Whether a keyword in a step counts from that on, so that those of later steps are none of the first
   pure logical function acts_from_its_step(keyword) result(acts)
      !> The keyword
      character(len=*), intent(in) :: keyword

      acts = any(keyword == [character(len=16) :: 'BOUNDARY', 'CLOAD', 'DLOAD', 'DSLOAD', 'TEMPERATURE', 'CONTACT PAIR', &
         'FRICTION', 'SURFACE BEHAVIOR', 'TIE'])
   end function acts_from_its_step

   !> *NSET, *ELSET, *SURFACE
   subroutine read_group(cards, line, at, mesh, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      if (line%keyword == 'ELSET') then
         call read_set(cards, line, at, 'ELSET', mesh%element(:mesh%n_elements), mesh%element_sets)
      else if (line%keyword == 'SURFACE') then
         if (all(parameter_of(line, 'TYPE') /= [character(len=7) :: '', 'ELEMENT'])) then
            call leave_data(cards, line, at, sketch)
         else
            call read_surface(cards, line, at, mesh)
         end if
      else if (parameter_of(line, 'ELSET') /= '') then
         call gather_nodes(cards, line, mesh)
      else
         call read_set(cards, line, at, 'NSET', mesh%node(:mesh%n_nodes), mesh%node_sets)
      end if
   end subroutine read_group

   !> What acts, or is held, before the steps and in the first of them
   subroutine read_load(cards, line, at, file, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> What is gathered of the file
      type(file_type), intent(inout) :: file
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      if (line%keyword == 'BOUNDARY') then
         call renew_boundary(cards, line, file%n_steps > 0, file%n_boundaries, file%boundary)
         call add_boundary(cards, line, at, file%mesh, file%boundary, sketch)
      else if (line%keyword == 'TEMPERATURE') then
         call read_temperatures(cards, line, at, file%mesh, file%temperatures, sketch)
      else if (line%keyword == 'CLOAD') then
         call add_ring_force(cards, line, at, file%mesh, sketch)
      else
         call add_distributed(cards, line, at, file%mesh, file%bodies, sketch)
      end if
   end subroutine read_load

   !> *HEADING: the title, and lines that become remarks
   subroutine read_heading(cards, at, sketch)
      !> The file
      type(cards_type), intent(in) :: cards
      !> The card of the keyword; the last of its data on return
      integer, intent(inout) :: at
      !> The new deck
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line

      do while (is_data(cards, at, line))
         if (sketch%title_card == 0) then
            sketch%title = trim(line%text)
            sketch%title_card = line%card
         else
            call put(sketch%parts(part_notes), '! '//trim(line%text))
         end if
      end do
   end subroutine read_heading

   !> Nodes, elements and names of materials, wherever they stand: sets take what is there of them, sections may stand above
   subroutine read_mesh(cards, mesh, names)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> Takes nodes and elements
      type(abaqus_type), intent(inout) :: mesh
      !> Takes the names
      type(set_type), allocatable, intent(inout) :: names(:)

      type(line_type) :: line, data
      real(wp) :: shift(2), across
      integer :: at, material, n_instances, k

      at = 0
      n_instances = 0
      shift = 0.0_wp
      do
         call next_line(cards, at, line)
         if (line%kind == line_end) exit
         if (line%kind /= line_keyword) cycle
         select case (line%keyword)
         case ('NODE')
            call read_nodes(cards, line, at, mesh)
         case ('ELEMENT')
            call read_elements(cards, line, at, mesh)
         case ('MATERIAL')
            call open_set(names, parameter_of(line, 'NAME'), line%card, material)
         case ('INSTANCE')
            n_instances = n_instances + 1
            if (.not. is_data(cards, at, data)) cycle
            shift = [real_of(cards, data, 1), real_of(cards, data, 2)]
            across = real_of(cards, data, 3)
            if (n_instances > 1 .or. abs(across) > 0.0_wp) call fault_of(cards, data, 0, &
               'an instance that is moved is not translated', 'one instance, moved along r and z alone; or nodes where they are')
            if (is_data(cards, at, data)) call fault_of(cards, data, 0, 'an instance that is turned is not translated', &
               'nodes where they are')
         end select
      end do
      if (n_instances > 1 .and. any(abs(shift) > 0.0_wp)) call add_error(cards%diagnostics, 0, 0, 0, &
         'one of several instances is moved', allowed='nodes where they are')
      do k = 1, mesh%n_nodes
         mesh%position(:, k) = mesh%position(:, k) + shift
      end do
      call clear_rounding(mesh%position(:, :mesh%n_nodes))
      call find_used(mesh)
      mesh%tied_to = [(k, k=1, mesh%n_nodes)]
   end subroutine read_mesh

   !> Find which nodes elements have
   subroutine find_used(mesh)
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh

      integer :: k, i, node

      allocate (mesh%used(mesh%n_nodes), source=.false.)
      do k = 1, mesh%n_elements
         do i = 1, mesh%size(k)
            node = find_number(mesh%node_map, mesh%nodes(i, k))
            if (node > 0) mesh%used(node) = .true.
         end do
      end do
   end subroutine find_used

   !> Cards of mesh, materials and surfaces, remarks on sets
   subroutine write_mesh(cards, names, materials, mesh, bodies, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> Names of the materials, and what they are
      type(set_type), intent(in), allocatable :: names(:)
      type(material_type), intent(in) :: materials(:)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> What acts on masses
      type(body_loads_type), intent(in) :: bodies
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch

      ! from corners first to round the perimeter
      integer, parameter :: order(8, 4) = reshape([1, 2, 3, 0, 0, 0, 0, 0, 1, 2, 3, 4, 0, 0, 0, 0, &
         1, 4, 2, 5, 3, 6, 0, 0, 1, 5, 2, 6, 3, 7, 4, 8], [8, 4])
      logical :: weightless(mesh%n_elements)
      integer, allocatable :: body(:)
      integer :: k, i, n, kind

      call put_body_loads(cards, mesh, bodies, sketch, weightless)
      call put_materials(cards, names, materials, mesh, weightless, sketch)
      do k = 1, mesh%n_nodes
         if (.not. mesh%used(k) .or. root_of(mesh, k) /= k) cycle
         call put(sketch%parts(part_nodes), to_text(mesh%node(k))//', '// &
            exact(mesh%position(1, k))//', '//exact(mesh%position(2, k)))
      end do
      if (mesh%n_elements == 0) call add_error(cards%diagnostics, cards%source%n_cards, 0, 0, &
         'there are no elements', allowed='*ELEMENT, TYPE=CAX4, CAX6, CAX8, ...')
      n = count(mesh%material(:mesh%n_elements) == 0)
      if (n > 0) call add_error(cards%diagnostics, cards%source%n_cards, 0, 0, 'element '// &
         to_text(mesh%element(findloc(mesh%material(:mesh%n_elements), 0, 1)))//' has no material'// &
         others_too(n), allowed='*SOLID SECTION')
      call find_bodies(mesh, body)
      do k = 1, mesh%n_elements
         n = mesh%size(k)
         kind = findloc([3, 4, 6, 8], n, 1)
         call put(sketch%parts(part_elements), to_text(mesh%element(k))//', '// &
            to_text(mesh%material(k) + merge(size(materials), 0, weightless(k)))//', '//to_text(body(k))// &
            integers([(number_at(mesh, mesh%nodes(order(i, kind), k)), i=1, n)]))
      end do
      if (any(mesh%reduced(:mesh%n_elements))) sketch%order_quadratic = 2
      if (any(mesh%reduced(:mesh%n_elements)) .and. any(mesh%size(:mesh%n_elements) > 4 .and. &
          .not. mesh%reduced(:mesh%n_elements))) call add_error(cards%diagnostics, 1, 0, 0, &
          'quadratic elements with the reduced rule and with the full one', &
          allowed='one of both')
      do k = 1, size(mesh%node_sets)
         call note('node set', mesh%node_sets(k))
      end do
      do k = 1, size(mesh%element_sets)
         call note('element set', mesh%element_sets(k))
      end do
      call add_faces(mesh, sketch)
      if (any(.not. mesh%used)) call put(sketch%parts(part_notes), '! nodes that no element has are left out: '// &
         to_text(count(.not. mesh%used)))
      if (any(mesh%tied_to /= [(k, k=1, mesh%n_nodes)])) call put(sketch%parts(part_notes), &
         '! nodes that are tied have the number of those that they are tied to')

   contains

      !> Words on elements that are as one
      function others_too(n) result(words)
         !> How many they are
         integer, intent(in) :: n
         !> The words
         character(len=:), allocatable :: words

         words = ''
         if (n > 1) words = ', nor have '//to_text(n - 1)//' others'
      end function others_too

      !> Remark on a set
      subroutine note(what, set)
         !> What it is a set of
         character(len=*), intent(in) :: what
         !> The set
         type(set_type), intent(in) :: set

         character(len=:), allocatable :: members
         integer :: first

         call put(sketch%parts(part_notes), '! '//what//' '//set%name//':')
         do first = 1, set%list%n, 16
            members = integers(set%list%value(first:min(first + 15, set%list%n)))
            call put(sketch%parts(part_notes), '!   '//members(3:))
         end do
      end subroutine note

   end subroutine write_mesh

end module axijoint_legacy_abaqus
