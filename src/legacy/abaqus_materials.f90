!> Materials of Abaqus and CalculiX
module axijoint_legacy_abaqus_materials
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_diagnostics, only : add_error, add_warning
   use axijoint_legacy_abaqus_lines, only : line_type, next_line, is_data, parameter_of, field_of, real_of, fault_of, line_data
   use axijoint_legacy_abaqus_mesh, only : abaqus_type
   use axijoint_legacy_abaqus_parameters, only : leave_data
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : set_type, find_set
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_materials, part_orthotropic, part_yield
   use axijoint_legacy_words, only : put, list, exact
   implicit none
   private
   public :: material_type, read_property, assign_material, put_materials

   !> A material
   type :: material_type
      !> Young's modulus, Poisson's ratio, density
      real(wp) :: young = 0.0_wp, poisson = 0.0_wp, density = 0.0_wp
      !> Yield stress, zero of a material that does not yield, and what it gains by a plastic strain of one
      real(wp) :: strength = 0.0_wp, hardening = 0.0_wp
      !> Thermal expansion along r, z, theta
      real(wp) :: expansion(3) = 0.0_wp
      !> Along r, z, theta: E_1 E_2 E_3, nu_12 nu_13 nu_23, G_12 G_13 G_23; not allocated for a material that is isotropic
      real(wp), allocatable :: constants(:)
   end type material_type

contains

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
      else if (line%keyword == 'EXPANSION') then
         call read_expansion(cards, line, at, materials(material), sketch)
      else if (parameter_of(line, 'TYPE') == 'ENGINEERING CONSTANTS') then
         call read_constants(cards, line, at, materials(material), sketch)
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
            'TYPE=ISOTROPIC, or no TYPE, and E, nu; TYPE=ENGINEERING CONSTANTS')
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

   !> *ELASTIC, TYPE=ENGINEERING CONSTANTS: nine values on two lines
   subroutine read_constants(cards, line, at, material, sketch)
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

      integer, parameter :: n_first = 8
      type(line_type) :: first, second
      integer :: k

      if (.not. is_data(cards, at, first)) then
         call fault_of(cards, line, 0, '*ELASTIC has no values')
         return
      end if
      if (.not. is_data(cards, at, second)) then
         call fault_of(cards, first, 0, 'there are too few values', 'E1 E2 E3 nu12 nu13 nu23 G12 G13, and G23 on the next line')
         return
      end if
      material%constants = [(real_of(cards, first, k), k=1, n_first), real_of(cards, second, 1)]
      material%young = minval(material%constants(:3))
      do while (is_data(cards, at, first))
         call leave_out(sketch, first%card, '*ELASTIC of other temperatures than that of its first lines')
      end do
   end subroutine read_constants

   !> *EXPANSION: one value, or three along r, z, theta
   subroutine read_expansion(cards, line, at, material, sketch)
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
      integer :: k

      if (all(parameter_of(line, 'TYPE') /= [character(len=5) :: '', 'ISO', 'ORTHO'])) then
         call leave_data(cards, line, at, sketch)
         return
      end if
      if (.not. is_data(cards, at, data)) then
         call fault_of(cards, line, 0, '*EXPANSION has no values')
         return
      end if
      material%expansion = real_of(cards, data, 1)
      if (parameter_of(line, 'TYPE') == 'ORTHO') material%expansion = [(real_of(cards, data, k), k=1, 3)]
      do while (is_data(cards, at, data))
         call leave_out(sketch, data%card, '*EXPANSION at other temperatures than that of its first line')
      end do
   end subroutine read_expansion

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

         associate (a => materials(k)%expansion)
            if (allocated(materials(k)%constants)) then
               call put_orthotropic(number, materials(k)%constants, a, density, remark, sketch)
            else
               call put(sketch%parts(part_materials), '! '//remark)
               call put(sketch%parts(part_materials), list([materials(k)%young, materials(k)%poisson, density, &
                  pack(a(:1), abs(a(:1)) > 0.0_wp)], number))
               if (any(abs(a - a(1)) > 0.0_wp)) call add_error(cards%diagnostics, names(k)%card, 0, 0, 'material '// &
                  names(k)%name//' expands along r, z and theta by other parts', &
                  allowed='*EXPANSION, TYPE=ORTHO with *ELASTIC, TYPE=ENGINEERING CONSTANTS')
            end if
         end associate
         if (materials(k)%strength > 0.0_wp) call put(sketch%parts(part_yield), to_text(number)//', MISES, '// &
            exact(materials(k)%strength)//', , , '//exact(materials(k)%hardening))
      end subroutine put_one

   end subroutine put_materials

   !> Cards of an orthotropic material
   subroutine put_orthotropic(number, constants, expansion, density, remark, sketch)
      !> Its number
      integer, intent(in) :: number
      !> E_1 E_2 E_3, nu_12 nu_13 nu_23, G_12 G_13 G_23
      real(wp), intent(in) :: constants(:)
      !> Thermal expansion along r, z, theta, and the density
      real(wp), intent(in) :: expansion(3), density
      !> What it is
      character(len=*), intent(in) :: remark
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch

      associate (part => sketch%parts(part_orthotropic), c => constants)
         call put(part, '! '//remark)
         call put(part, list([c(1:3), 0.0_wp, density, expansion(1:2)], number))
         call put(part, exact(c(4))//', '//exact(c(6))//', '//exact(c(5))//', '//exact(c(7))//', '//exact(c(9))//', '// &
            exact(c(8))//', '//exact(expansion(3)))
      end associate
   end subroutine put_orthotropic

end module axijoint_legacy_abaqus_materials
