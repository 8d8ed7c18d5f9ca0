!> Temperatures of Abaqus and CalculiX: what they change is a load
module axijoint_legacy_abaqus_temperatures
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_legacy_abaqus_lines, only : line_type, is_data, parameter_of, real_of
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, members, index_of, root_of
   use axijoint_legacy_abaqus_parameters, only : leave_data, reserve
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : list_type
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_temperatures
   use axijoint_legacy_words, only : put, exact
   implicit none
   private
   public :: temperatures_type, open_temperatures, read_initial, read_temperatures, put_temperatures

   !> Temperatures of the nodes
   type :: temperatures_type
      !> Before the steps, and at the end of the first
      real(wp), allocatable :: before(:), after(:)
      !> Whether a step gives any
      logical, allocatable :: given(:)
   end type temperatures_type

contains

   !> Begin with nothing
   subroutine open_temperatures(n, temperatures)
      !> Nodes at most
      integer, intent(in) :: n
      !> Temperatures
      type(temperatures_type), intent(out) :: temperatures

      allocate (temperatures%before(n), temperatures%after(n), source=0.0_wp)
      allocate (temperatures%given(n), source=.false.)
   end subroutine open_temperatures

   !> *INITIAL CONDITIONS, TYPE=TEMPERATURE: node or set, temperature
   subroutine read_initial(cards, keyword, at, mesh, temperatures, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes them
      type(temperatures_type), intent(inout) :: temperatures
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      if (parameter_of(keyword, 'TYPE') == 'TEMPERATURE' .and. parameter_of(keyword, 'FILE') == '') then
         call read_values(cards, keyword, at, mesh, temperatures%before, temperatures%given, .false., sketch)
      else
         call leave_data(cards, keyword, at, sketch)
      end if
   end subroutine read_initial

   !> *TEMPERATURE of a step: node or set, temperature
   subroutine read_temperatures(cards, keyword, at, mesh, temperatures, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes them
      type(temperatures_type), intent(inout) :: temperatures
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      if (parameter_of(keyword, 'FILE') == '') then
         call read_values(cards, keyword, at, mesh, temperatures%after, temperatures%given, .true., sketch)
      else
         call leave_data(cards, keyword, at, sketch)
      end if
   end subroutine read_temperatures

   !> Values of nodes or sets
   subroutine read_values(cards, keyword, at, mesh, value, given, gives, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes them
      real(wp), intent(inout) :: value(:)
      !> Takes which nodes have one, if these are given by a step
      logical, intent(inout) :: given(:)
      logical, intent(in) :: gives
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line
      type(list_type) :: list
      integer :: k, node

      do while (is_data(cards, at, line))
         if (len(reserve(keyword)) > 0) then
            call leave_out(sketch, line%card, '*'//keyword%keyword//reserve(keyword))
            cycle
         end if
         list = members(cards, line, 1, mesh%node_sets)
         do k = 1, list%n
            node = index_of(cards, line, mesh, list%value(k))
            if (node == 0) exit
            value(node) = real_of(cards, line, 2)
            given(node) = given(node) .or. gives
         end do
      end do
   end subroutine read_values

   !> Cards of what the step changes
   subroutine put_temperatures(mesh, temperatures, sketch)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Temperatures
      type(temperatures_type), intent(in) :: temperatures
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch

      integer :: k

      do k = 1, mesh%n_nodes
         associate (change => temperatures%after(k) - temperatures%before(k))
            if (temperatures%given(k) .and. mesh%used(k) .and. root_of(mesh, k) == k .and. abs(change) > 0.0_wp) &
               call put(sketch%parts(part_temperatures), to_text(mesh%node(k))//', , , 0, '//exact(change))
         end associate
      end do
   end subroutine put_temperatures

end module axijoint_legacy_abaqus_temperatures
