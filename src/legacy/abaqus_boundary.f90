!> Held and moved nodes of Abaqus and CalculiX: the last line that names a component of a node counts
module axijoint_legacy_abaqus_boundary
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, upper
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_legacy_abaqus_lines, only : line_type, is_data, field_text, integer_of, real_of, fault_of, &
      parameter_of, has_parameter
   use axijoint_legacy_abaqus_mesh, only : abaqus_type, members, index_of, root_of
   use axijoint_legacy_abaqus_parameters, only : reserve
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_list, only : list_type
   use axijoint_legacy_sketch, only : sketch_type, leave_out, part_restraints, part_moved
   use axijoint_legacy_words, only : put, exact
   implicit none
   private
   public :: boundary_type, open_boundary, renew_boundary, add_boundary, put_boundary

   !> What is given of the nodes
   type :: boundary_type
      !> Whether u and v are given, and what they are, shape (2, nodes)
      logical, allocatable :: held(:, :)
      real(wp), allocatable :: value(:, :)
   end type boundary_type

contains

   !> Begin with nothing
   subroutine open_boundary(n, boundary)
      !> Nodes at most
      integer, intent(in) :: n
      !> What is given
      type(boundary_type), intent(out) :: boundary

      allocate (boundary%held(2, n), source=.false.)
      allocate (boundary%value(2, n), source=0.0_wp)
   end subroutine open_boundary

   !> OP=NEW on the first *BOUNDARY of a step removes what is above; on later ones it means nothing
   subroutine renew_boundary(cards, keyword, in_step, n, boundary)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Whether it stands in a step
      logical, intent(in) :: in_step
      !> How many of them the step has above; with this one on return
      integer, intent(inout) :: n
      !> What is given
      type(boundary_type), intent(inout) :: boundary

      if (.not. in_step) return
      n = n + 1
      if (parameter_of(keyword, 'OP') /= 'NEW') return
      if (n == 1) then
         boundary%held = .false.
      else
         call add_warning(cards%diagnostics, keyword%card, 0, 0, 'OP=NEW counts on the first '// &
            '*BOUNDARY of a step alone: what stands above it stays')
      end if
   end subroutine renew_boundary

   !> *BOUNDARY: node or set, first component, last, value; or a word for components
   subroutine add_boundary(cards, keyword, at, mesh, boundary, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> Takes them
      type(boundary_type), intent(inout) :: boundary
      !> Takes what is not translated
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: line
      type(list_type) :: list
      character(len=:), allocatable :: word
      logical :: held(2), good
      integer :: k, node
      real(wp) :: value

      do while (is_data(cards, at, line))
         list = members(cards, line, 1, mesh%node_sets)
         word = upper(field_text(line, 2))
         call find_held(cards, line, held, value, good)
         if (.not. good) cycle
         if (.not. any(held)) then  ! of symmetry about z = constant nothing is left: nothing moves along theta
            if (word /= 'ZSYMM') call leave_out(sketch, line%card, '*'//keyword%keyword//' of component '//word)
            cycle
         end if
         ! zero is zero over time, too, unless the values come from somewhere else
         if (len(reserve(keyword)) > 0 .and. (abs(value) > 0.0_wp .or. &
             has_parameter(keyword, 'USER') .or. has_parameter(keyword, 'SUBMODEL'))) then
            call leave_out(sketch, line%card, '*'//keyword%keyword//reserve(keyword))
            cycle
         end if
         do k = 1, list%n
            node = index_of(cards, line, mesh, list%value(k))
            if (node == 0) exit
            if (.not. mesh%used(node)) then
               call leave_out(sketch, line%card, '*'//keyword%keyword//' of nodes that no element has')
               cycle
            end if
            where (held) boundary%value(:, node) = value
            boundary%held(:, node) = boundary%held(:, node) .or. held
         end do
      end do
   end subroutine add_boundary

   !> Components that a line gives, and their value
   subroutine find_held(cards, line, held, value, good)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The line
      type(line_type), intent(in) :: line
      !> Whether u and v are given
      logical, intent(out) :: held(2)
      !> Their value
      real(wp), intent(out) :: value
      !> Whether it names components; an error if not
      logical, intent(out) :: good

      integer :: first, last

      value = 0.0_wp
      good = .true.
      select case (upper(field_text(line, 2)))
      case ('ENCASTRE', 'PINNED', 'ZASYMM')
         held = .true.
      case ('XSYMM', 'YASYMM')
         held = [.true., .false.]
      case ('YSYMM', 'XASYMM')
         held = [.false., .true.]
      case ('ZSYMM')
         held = .false.
      case default
         good = verify(field_text(line, 2), '123456') == 0 .and. len(field_text(line, 2)) == 1
         held = .false.
         if (.not. good) then
            call fault_of(cards, line, 2, 'this is no component', '1 along r, 2 along z, or ENCASTRE, PINNED, '// &
               'XSYMM, YSYMM, ZSYMM, XASYMM, YASYMM, ZASYMM')
            return
         end if
         first = integer_of(cards, line, 2)
         last = max(first, integer_of(cards, line, 3))
         value = real_of(cards, line, 4)
         held = [first == 1, first <= 2 .and. last >= 2]
      end select
   end subroutine find_held

   !> Cards of what is given: nodes held, nodes moved
   subroutine put_boundary(mesh, boundary, sketch)
      !> The mesh
      type(abaqus_type), intent(in) :: mesh
      !> What is given; that of tied nodes becomes that of those that they are tied to
      type(boundary_type), intent(inout) :: boundary
      !> Takes the cards
      type(sketch_type), intent(inout) :: sketch

      character(len=:), allocatable :: u, v
      logical :: moved(2)
      integer :: k, root

      do k = 1, mesh%n_nodes  ! what was given of nodes before they were tied
         root = root_of(mesh, k)
         if (root == k) cycle
         where (boundary%held(:, k)) boundary%value(:, root) = boundary%value(:, k)
         boundary%held(:, root) = boundary%held(:, root) .or. boundary%held(:, k)
         boundary%held(:, k) = .false.
      end do
      do k = 1, mesh%n_nodes
         if (.not. any(boundary%held(:, k))) cycle
         moved = boundary%held(:, k) .and. abs(boundary%value(:, k)) > 0.0_wp
         if (any(boundary%held(:, k) .and. .not. moved)) call put(sketch%parts(part_restraints), to_text(mesh%node(k))//', '// &
            code(1)//code(2)//'0')
         if (.not. any(moved)) cycle
         u = ''
         v = ''
         if (moved(1)) u = exact(boundary%value(1, k))
         if (moved(2)) v = exact(boundary%value(2, k))
         call put(sketch%parts(part_moved), to_text(mesh%node(k))//', 0, '//u//', '//v)
      end do

   contains

      !> 1 of a component that is held, 0 of one that is not
      character function code(i)
         !> Component
         integer, intent(in) :: i

         code = merge('1', '0', boundary%held(i, k) .and. .not. moved(i))
      end function code

   end subroutine put_boundary

end module axijoint_legacy_abaqus_boundary
