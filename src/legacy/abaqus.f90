!> Input files of Abaqus and CalculiX with axisymmetric solids: mesh, groups, materials, what acts in
!> the first step
module axijoint_legacy_abaqus
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : add_error, add_warning
   use axijoint_deck_text_file_bytes, only : end_of_bytes => line_end, &
      next_bytes => next_line
   use axijoint_legacy_abaqus_bodies, only : body_loads_type, open_body_loads, put_body_loads
   use axijoint_legacy_abaqus_lines, only : line_type, next_line, is_data, parameter_of, field_of, &
      real_of, fault_of, line_keyword, line_data, line_end
   use axijoint_legacy_abaqus_loads, only : renew_boundary, add_boundary, add_ring_force, &
      add_distributed, add_faces
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, read_nodes, read_elements, read_set, &
      gather_nodes, read_surface
   use axijoint_legacy_abaqus_parameters, only : check_parameters, elsewhere, r_and_z
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : set_type, open_set, find_set
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_materials, part_yield, &
      part_nodes, part_elements, part_notes
   use axijoint_legacy_words, only : put, exact, integers
   implicit none
   private
   public :: read_abaqus, looks_like_abaqus

   !> A material
   type :: material_type
      !> Young's modulus, Poisson's ratio, density
      real(wp) :: young = 0.0_wp, poisson = 0.0_wp, density = 0.0_wp
      !> Yield stress, zero of a material that does not yield, and what it gains by a plastic strain of one
      real(wp) :: strength = 0.0_wp, hardening = 0.0_wp
   end type material_type

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

      type(abaqus_type) :: mesh
      type(body_loads_type) :: bodies
      type(set_type), allocatable :: names(:)
      type(material_type), allocatable :: materials(:)
      type(line_type) :: line, data
      integer :: at, n_steps, n_boundaries, material

      sketch%title = ''
      allocate (mesh%node(cards%source%n_cards), mesh%position(2, cards%source%n_cards))
      associate (n => cards%source%n_cards)
         allocate (mesh%element(n), mesh%nodes(9, n), mesh%size(n), mesh%material(n), source=0)
         allocate (mesh%reduced(n), source=.false.)
         call open_body_loads(n, bodies)
      end associate
      allocate (mesh%node_sets(0), mesh%element_sets(0), mesh%surfaces(0), names(0))
      call read_mesh(cards, mesh, names)
      allocate (materials(size(names)))
      at = 0
      n_steps = 0
      n_boundaries = 0
      material = 0
      call next_line(cards, at, line)
      do while (line%kind /= line_end)
         if (line%kind /= line_keyword) then
            call next_line(cards, at, line)
            cycle
         end if
         if (n_steps < merge(1, 2, line%keyword == 'STEP')) call check_parameters(cards, line, sketch)
         select case (line%keyword)
         case ('HEADING')
            call read_heading(cards, at, sketch)
         case ('NODE', 'ELEMENT')  ! are read already
         case ('NSET')
            if (parameter_of(line, 'ELSET') /= '') then
               call gather_nodes(cards, line, mesh)
            else
               call read_set(cards, line, at, 'NSET', mesh%node(:mesh%n_nodes), mesh%node_sets)
            end if
         case ('ELSET')
            call read_set(cards, line, at, 'ELSET', mesh%element(:mesh%n_elements), &
               mesh%element_sets)
         case ('SURFACE')
            if (all(parameter_of(line, 'TYPE') /= [character(len=7) :: '', 'ELEMENT'])) then
               call leave_data(cards, line, at, sketch)
            else
               call read_surface(cards, line, at, mesh)
            end if
         case ('MATERIAL')
            material = find_set(names, parameter_of(line, 'NAME'))
         case ('ELASTIC', 'DENSITY', 'PLASTIC')
            call read_property(cards, line, at, material, materials, sketch)
         case ('SOLID SECTION')
            call assign_material(cards, line, names, mesh)
            ! its data, a thickness, means nothing here
            call next_line(cards, at, line)
            if (line%kind /= line_data) cycle
         case ('BOUNDARY')
            if (n_steps > 1) then
               call leave_data(cards, line, at, sketch)
            else
               call renew_boundary(cards, line, n_steps > 0, n_boundaries, sketch)
               call add_boundary(cards, line, at, mesh, sketch)
            end if
         case ('CLOAD')
            if (n_steps > 1) then
               call leave_data(cards, line, at, sketch)
            else
               call add_ring_force(cards, line, at, mesh, sketch)
            end if
         case ('DLOAD', 'DSLOAD')
            if (n_steps > 1) then
               call leave_data(cards, line, at, sketch)
            else
               call add_distributed(cards, line, at, mesh, bodies, sketch)
            end if
         case ('STEP')
            n_steps = n_steps + 1
            if (n_steps > 1) call leave_out(sketch, line%card, '*STEP: only the first is translated')
         case ('STATIC', 'END STEP')
         case ('SYSTEM')
            ! without data it ends what one above began
            if (is_data(cards, at, data)) call fault_of(cards, line, 0, '*SYSTEM: '//elsewhere, r_and_z)
         case ('INCLUDE')
            call fault_of(cards, line, 0, '*INCLUDE is not read', 'the lines of the file itself')
         case default
            call leave_data(cards, line, at, sketch)
         end select
         call next_line(cards, at, line)
      end do
      if (cards%diagnostics%n_errors == 0) call write_mesh(cards, names, materials, mesh, bodies, sketch)
   end subroutine read_abaqus

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

      type(line_type) :: line
      integer :: at, material

      at = 0
      do
         call next_line(cards, at, line)
         if (line%kind == line_end) exit
         if (line%kind /= line_keyword) cycle
         if (line%keyword == 'NODE') call read_nodes(cards, line, at, mesh)
         if (line%keyword == 'ELEMENT') call read_elements(cards, line, at, mesh)
         if (line%keyword == 'MATERIAL') call open_set(names, parameter_of(line, 'NAME'), line%card, material)
      end do
   end subroutine read_mesh

   !> Note that a keyword and its data are not translated
   subroutine leave_data(cards, line, at, sketch)
      !> The file
      type(cards_type), intent(in) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Takes the note
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: data
      integer :: next

      call leave_out(sketch, line%card, '*'//line%keyword)
      next = at
      do
         call next_line(cards, next, data)
         if (data%kind /= line_data) exit
         at = next
         call leave_out(sketch, at, '*'//line%keyword)
      end do
   end subroutine leave_data

   !> *ELASTIC, *DENSITY or *PLASTIC of the material that was named last
   subroutine read_property(cards, line, at, material, materials, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; that of its data on return
      integer, intent(inout) :: at
      !> The material
      integer, intent(in) :: material
      !> All materials
      type(material_type), intent(inout) :: materials(:)
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      if (material == 0) then
         call fault_of(cards, line, 0, 'no material is named above', '*MATERIAL, NAME=')
      else if (line%keyword == 'PLASTIC') then
         call read_plastic(cards, line, at, materials(material), sketch)
      else
         call read_elastic(cards, line, at, materials(material), sketch)
      end if
   end subroutine read_property

   !> *ELASTIC and *DENSITY
   subroutine read_elastic(cards, line, at, material, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; that of its data on return
      integer, intent(inout) :: at
      !> The material
      type(material_type), intent(inout) :: material
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: data

      if (line%keyword == 'ELASTIC' .and. index(parameter_of(line, 'TYPE')//'ISO', 'ISO') /= 1) then
         call fault_of(cards, line, field_of(line, 'TYPE'), '*ELASTIC of this type is not translated', &
            'isotropic materials: TYPE=ISOTROPIC, or no TYPE, and E, nu')
         return
      end if
      call next_line(cards, at, data)
      if (data%kind /= line_data) then
         call fault_of(cards, line, 0, '*'//line%keyword//' has no values')
         at = at - 1
         return
      end if
      if (line%keyword == 'DENSITY') then
         material%density = real_of(cards, data, 1)
      else
         material%young = real_of(cards, data, 1)
         material%poisson = real_of(cards, data, 2)
      end if
      at = data%card
      do while (is_data(cards, at, data))
         call leave_out(sketch, data%card, '*'//line%keyword//' of other temperatures than that of '// &
            'its first line')
      end do
   end subroutine read_elastic

   !> *PLASTIC: yield stress and plastic strain a line
   subroutine read_plastic(cards, line, at, material, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; that of its data on return
      integer, intent(inout) :: at
      !> The material
      type(material_type), intent(inout) :: material
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: data
      real(wp) :: strain, stress
      integer :: n

      if (all(parameter_of(line, 'HARDENING') /= [character(len=9) :: '', 'ISOTROPIC'])) then
         call leave_data(cards, line, at, sketch)
         return
      end if
      n = 0
      do while (is_data(cards, at, data))
         n = n + 1
         stress = real_of(cards, data, 1)
         strain = real_of(cards, data, 2)
         if (abs(real_of(cards, data, 3)) > 0.0_wp) call leave_out(sketch, data%card, '*PLASTIC at other temperatures')
         if (n == 1) then
            material%strength = stress
            if (.not. stress > 0.0_wp .or. abs(strain) > 0.0_wp) call fault_of(cards, data, 0, &
               'this is no beginning of yield', 'a yield stress above 0, and a plastic strain of 0')
         else if (n == 2) then
            if (.not. (stress >= material%strength .and. strain > 0.0_wp)) then
               call fault_of(cards, data, 0, 'this is no hardening', 'no less yield stress, at more plastic strain')
               cycle
            end if
            material%hardening = (stress - material%strength)/strain
            call add_warning(cards%diagnostics, data%card, 0, 0, 'hardening goes on beyond this line as up to it')
         else
            call leave_out(sketch, data%card, '*PLASTIC beyond its second line')
         end if
      end do
      if (n == 0) call fault_of(cards, line, 0, '*PLASTIC has no values')
   end subroutine read_plastic

   !> *SOLID SECTION: the material of a set of elements
   subroutine assign_material(cards, line, names, mesh)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Names of the materials
      type(set_type), intent(in), allocatable :: names(:)
      !> The mesh
      type(abaqus_type), intent(inout) :: mesh

      integer :: set, material, k, element

      set = find_set(mesh%element_sets, parameter_of(line, 'ELSET'))
      material = find_set(names, parameter_of(line, 'MATERIAL'))
      if (set == 0) call fault_of(cards, line, 0, 'there is no set '//parameter_of(line, 'ELSET'), &
         'sets that are above')
      if (material == 0) call fault_of(cards, line, 0, 'there is no material '// &
         parameter_of(line, 'MATERIAL'), 'a name of *MATERIAL')
      if (set == 0 .or. material == 0) return
      do k = 1, mesh%element_sets(set)%list%n
         element = find_number(mesh%element_map, mesh%element_sets(set)%list%value(k))
         if (element > 0) mesh%material(element) = material
      end do
   end subroutine assign_material

   !> Cards of materials. Here gravity and rotation act on all elements: those that are spared get
   !> materials of their own without density, which are numbered behind the others
   subroutine put_materials(cards, names, materials, mesh, weightless, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> Names of the materials, and what they are
      type(set_type), intent(in), allocatable :: names(:)
      type(material_type), intent(in) :: materials(:)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Which elements are spared
      logical, intent(in) :: weightless(:)
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch

      integer :: k

      do k = 1, size(materials)
         if (.not. materials(k)%young > 0.0_wp) call add_error(cards%diagnostics, names(k)%card, &
            0, 0, 'material '//names(k)%name//' has no *ELASTIC', allowed='E > 0')
         if (.not. (any(spared(k)) .and. all(spared(k) .or. mesh%material(:size(weightless)) /= k))) &
            call put_one(k, materials(k)%density, names(k)%name)
      end do
      do k = 1, size(materials)
         if (any(spared(k))) call put_one(size(materials) + k, 0.0_wp, names(k)%name// &
            ' of elements on which neither gravity nor rotation acts: without density')
      end do

   contains

      !> Elements of a material that are spared
      function spared(material)
         !> The material
         integer, intent(in) :: material
         !> Whether an element is
         logical :: spared(size(weightless))

         spared = weightless .and. mesh%material(:size(weightless)) == material
      end function spared

      !> Card of a material
      subroutine put_one(number, density, remark)
         !> Its number
         integer, intent(in) :: number
         !> Its density
         real(wp), intent(in) :: density
         !> What it is
         character(len=*), intent(in) :: remark

         call put(sketch%parts(part_materials), '! '//remark)
         call put(sketch%parts(part_materials), to_text(number)//', '// &
            exact(materials(k)%young)//', '//exact(materials(k)%poisson)//', '//exact(density))
         if (materials(k)%strength > 0.0_wp) call put(sketch%parts(part_yield), to_text(number)//', MISES, '// &
            exact(materials(k)%strength)//', , , '//exact(materials(k)%hardening))
      end subroutine put_one

   end subroutine put_materials

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
      integer :: k, n, kind

      call put_body_loads(cards, mesh, bodies, sketch, weightless)
      call put_materials(cards, names, materials, mesh, weightless, sketch)
      do k = 1, mesh%n_nodes
         call put(sketch%parts(part_nodes), to_text(mesh%node(k))//', '// &
            exact(mesh%position(1, k))//', '//exact(mesh%position(2, k)))
      end do
      if (mesh%n_elements == 0) call add_error(cards%diagnostics, cards%source%n_cards, 0, 0, &
         'there are no elements', allowed='*ELEMENT, TYPE=CAX4, CAX6, CAX8, ...')
      do k = 1, mesh%n_elements
         if (mesh%material(k) == 0) call add_error(cards%diagnostics, cards%source%n_cards, 0, 0, &
            'element '//to_text(mesh%element(k))//' has no material', allowed='*SOLID SECTION')
         n = mesh%size(k)
         kind = findloc([3, 4, 6, 8], n, 1)
         call put(sketch%parts(part_elements), to_text(mesh%element(k))//', '// &
            to_text(mesh%material(k) + merge(size(materials), 0, weightless(k)))//', 1'// &
            integers(mesh%nodes(order(:n, kind), k)))
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

   contains

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
