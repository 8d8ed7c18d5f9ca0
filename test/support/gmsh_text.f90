!> A mesh written as a Gmsh file: each body a physical surface "body N", the joints of each law a
!> physical curve "law N", the lowest and the highest edges the curves "bottom" and "top"
module axijoint_test_gmsh_text
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_model_mesh, only : mesh_type
   implicit none
   private
   public :: gmsh_text, lf

   !> End of a line
   character(len=1), parameter :: lf = new_line('a')
   !> Numbers of the groups: bodies and laws are added to the first two
   integer, parameter :: tag_body = 10, tag_law = 20, tag_bottom = 31, tag_top = 32

   !> Elements as the file lists them
   type :: list_type
      !> Number of them
      integer :: n = 0
      !> Gmsh's type, group, number of nodes, nodes; shape (12, elements)
      integer, allocatable :: elements(:, :)
   end type list_type

contains

   !> The text of the file
   function gmsh_text(mesh, version, separate, turned) result(text)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> 2 for format 2.2, 4 for format 4.1
      integer, intent(in) :: version
      !> Whether bodies have nodes of their own; else those at one place are one
      logical, intent(in) :: separate
      !> Whether every other element runs clockwise
      logical, intent(in) :: turned
      !> The text
      character(len=:), allocatable :: text

      type(list_type) :: list
      integer, allocatable :: node(:)
      integer :: i, k

      node = [(i, i=1, size(mesh%node_label))]
      do i = 1, size(node)
         do k = 1, merge(0, i - 1, separate)
            if (norm2(mesh%coordinates(:, i) - mesh%coordinates(:, k)) < 1.0e-9_wp) exit
         end do
         if (k < i .and. .not. separate) node(i) = k
      end do
      call list_elements(mesh, node, turned, list)
      text = '$MeshFormat'//lf//merge('2.2', '4.1', version == 2)//' 0 8'//lf//'$EndMeshFormat'// &
         lf &
             //names(list)
      if (version == 4) text = text//entities(list)
      text = text//nodes_text(mesh, node, version)//elements_text(list, version)
   end function gmsh_text

   !> List elements and lines
   subroutine list_elements(mesh, node, turned, list)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Node of the file for each node
      integer, intent(in) :: node(:)
      !> Whether every other element runs clockwise
      logical, intent(in) :: turned
      !> The list
      type(list_type), intent(out) :: list

      integer, parameter :: type_of(9) = [0, 0, 2, 3, 0, 9, 0, 16, 10]
      integer, parameter :: other_way(9) = [1, 4, 3, 2, 8, 7, 6, 5, 9], &
         triangle(6) = [1, 3, 2, 6, 5, 4]
      integer :: i, n, order(9)

      allocate (list%elements(12, 16*size(mesh%element_label)), source=0)
      call list_level(mesh, node, minval(mesh%coordinates(2, :)), tag_bottom, list)
      do i = 1, size(mesh%joint_label)
         n = merge(3, 2, mesh%joint_size(i) == 6)
         associate (nodes => mesh%joint_nodes([1, 2, 5], i))
            call add(merge(8, 1, n == 3), tag_law + mesh%joint_material(i), node(nodes(:n)))
         end associate
      end do
      do i = 1, size(mesh%element_label)
         n = mesh%element_size(i)
         order = [1, 2, 3, 4, 5, 6, 7, 8, 9]
         if (turned .and. mod(i, 2) == 0) order = other_way
         if (turned .and. mod(i, 2) == 0 .and. any(n == [3, 6])) order(:6) = triangle
         call add(type_of(n), tag_body + mesh%element_body(i), &
            node(mesh%element_nodes(order(:n), i)))
      end do
      call list_level(mesh, node, maxval(mesh%coordinates(2, :)), tag_top, list)

   contains

      !> Add an element
      subroutine add(kind, group, nodes)
         !> Type and group
         integer, intent(in) :: kind, group
         !> Nodes
         integer, intent(in) :: nodes(:)
         list%n = list%n + 1
         list%elements(:3, list%n) = [kind, group, size(nodes)]
         list%elements(4:3 + size(nodes), list%n) = nodes
      end subroutine add
   end subroutine list_elements

   !> List the edges at a level of z as lines
   subroutine list_level(mesh, node, level, group, list)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Node of the file for each node
      integer, intent(in) :: node(:)
      !> z
      real(wp), intent(in) :: level
      !> Number of the group
      integer, intent(in) :: group
      !> The list
      type(list_type), intent(inout) :: list

      integer :: i, side, n, ends(2), corners

      do i = 1, size(mesh%element_label)
         n = mesh%element_size(i)
         corners = merge(3, 4, any(n == [3, 6]))
         do side = 1, corners
            ends = mesh%element_nodes([side, mod(side, corners) + 1], i)
            if (any(abs(mesh%coordinates(2, ends) - level) > 1.0e-9_wp)) cycle
            list%n = list%n + 1
            list%elements(:5, list%n) = [merge(8, 1, n > corners), group, &
               merge(3, 2, n > corners), node(ends)]
            if (n > corners) list%elements(6, list%n) = node(mesh%element_nodes(corners + side, i))
         end do
      end do
   end subroutine list_level

   !> The section of the names
   function names(list) result(text)
      !> Elements
      type(list_type), intent(in) :: list
      !> The text
      character(len=:), allocatable :: text

      integer :: tag, n

      n = 0
      text = ''
      do tag = 1, tag_top
         if (.not. any(list%elements(2, :list%n) == tag)) cycle
         n = n + 1
         select case (tag)
         case (tag_bottom)
            text = text//'1 31 "bottom"'//lf
         case (tag_top)
            text = text//'1 32 "top"'//lf
         case (tag_body + 1:tag_law)
            text = text//'2 '//to_text(tag)//' "body '//to_text(tag - tag_body)//'"'//lf
         case default
            text = text//'1 '//to_text(tag)//' "law '//to_text(tag - tag_law)//'"'//lf
         end select
      end do
      text = '$PhysicalNames'//lf//to_text(n)//lf//text//'$EndPhysicalNames'//lf
   end function names

   !> The section of the entities: one for each group, of its number
   function entities(list) result(text)
      !> Elements
      type(list_type), intent(in) :: list
      !> The text
      character(len=:), allocatable :: text

      character(len=:), allocatable :: of_dimension
      integer :: tag, dimension, n(2)

      text = ''
      do dimension = 1, 2
         n(dimension) = 0
         of_dimension = ''
         do tag = 1, tag_top
            if (.not. any(list%elements(2, :list%n) == tag)) cycle
            if ((tag <= tag_law) .neqv. (dimension == 2)) cycle
            n(dimension) = n(dimension) + 1
            of_dimension = of_dimension//to_text(tag)//' 0 0 0 1 1 0 1 '//to_text(tag)//' 0 '//lf
         end do
         text = text//of_dimension
      end do
      text = '$Entities'//lf//'0 '//to_text(n(1))//' '//to_text(n(2))//' 0'//lf//text// &
         '$EndEntities'//lf
   end function entities

   !> The section of the nodes
   function nodes_text(mesh, node, version) result(text)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Node of the file for each node
      integer, intent(in) :: node(:)
      !> Format
      integer, intent(in) :: version
      !> The text
      character(len=:), allocatable :: text

      character(len=64) :: place
      character(len=:), allocatable :: tags, places
      integer :: i, n

      tags = ''
      places = ''
      n = 0
      do i = 1, size(node)
         if (node(i) < i) cycle
         n = n + 1
         write (place, '(es25.17, 1x, es25.17, a)') mesh%coordinates(:, i), ' 0'
         if (version == 2) places = places//to_text(i)//' '
         places = places//trim(adjustl(place))//lf
         tags = tags//to_text(i)//lf
      end do
      if (version == 2) text = '$Nodes'//lf//to_text(n)//lf//places//'$EndNodes'//lf
      if (version == 4) text = '$Nodes'//lf//'1 '//to_text(n)//' 1 '//to_text(size(node))//lf &
                               //'2 11 0 '//to_text(n)//lf//tags//places//'$EndNodes'//lf
   end function nodes_text

   !> The section of the elements
   function elements_text(list, version) result(text)
      !> Elements
      type(list_type), intent(in) :: list
      !> Format
      integer, intent(in) :: version
      !> The text
      character(len=:), allocatable :: text

      integer :: i, k, n_blocks

      text = ''
      n_blocks = 0
      do i = 1, list%n
         associate (e => list%elements(:, i))
            if (version == 4) then
               k = 0
               if (i > 1) k = merge(1, 0, all(list%elements(:2, i - 1) == e(:2)))
               if (k == 0) then
                  n_blocks = n_blocks + 1
                  do k = i, list%n
                     if (any(list%elements(:2, k) /= e(:2))) exit
                  end do
                  text = text//to_text(merge(2, 1, e(2) <= tag_law))//' '//to_text(e(2))//' '// &
                         to_text(e(1))//' '//to_text(k - i)//lf
               end if
               text = text//to_text(i)
            else
               text = text//to_text(i)//' '//to_text(e(1))//' 2 '//to_text(e(2))//' '//to_text(e(2))
            end if
            do k = 4, 3 + e(3)
               text = text//' '//to_text(e(k))
            end do
            text = text//lf
         end associate
      end do
      text = to_text(list%n)//lf//text//'$EndElements'//lf
      if (version == 4) text = to_text(n_blocks)//' '//to_text(list%n)//' 1 '//text
      text = '$Elements'//lf//text
   end function elements_text

end module axijoint_test_gmsh_text
