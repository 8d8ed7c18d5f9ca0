!> Elements that a file has several times: format 2.2 repeats an element for each of its groups
module axijoint_gmsh_unite
   use axijoint_base_number_map, only : number_map_type, find_number, insert_number
   use axijoint_base_text, only : to_text
   use axijoint_gmsh_mesh, only : gmsh_mesh_type, nodes_of_type, dimension_of_type, set_index
   use axijoint_gmsh_scanner, only : fault_type
   implicit none
   private
   public :: unite_elements

contains

   !> Let elements with the same nodes become one that belongs to the groups of all; two in the same
   !> group, and two elements of one number, are a fault
   pure subroutine unite_elements(mesh, fault)
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      type(number_map_type) :: seen
      integer, allocatable :: first(:), next(:)
      integer :: element, known, kept, node

      allocate (first(mesh%n_nodes), next(mesh%n_elements), source=0)
      kept = 0
      do element = 1, mesh%n_elements
         known = find_number(seen, mesh%element_tag(element))
         if (known > 0) then
            fault = fault_of(mesh, element, 'is given twice, first on line '// &
                             to_text(known))
            return
         end if
         call insert_number(seen, mesh%element_tag(element), mesh%element_line(element))
         call keep_element(mesh, element, kept + 1)
         node = minval(mesh%element_nodes(:nodes_of_type(mesh%element_type(kept + 1)), kept + 1))
         known = first(node)
         do while (known > 0)
            if (same_nodes(mesh, known, kept + 1)) exit
            known = next(known)
         end do
         if (known > 0) then
            call join_sets(mesh, known, kept + 1, fault)
            if (allocated(fault)) return
         else
            kept = kept + 1
            next(kept) = first(node)
            first(node) = kept
         end if
      end do
      mesh%n_elements = kept
   end subroutine unite_elements

   !> Move an element
   pure subroutine keep_element(mesh, from, to)
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> Index, and new index
      integer, intent(in) :: from, to

      if (from == to) return
      mesh%element_tag(to) = mesh%element_tag(from)
      mesh%element_type(to) = mesh%element_type(from)
      mesh%element_line(to) = mesh%element_line(from)
      mesh%element_set(to) = mesh%element_set(from)
      mesh%element_nodes(:, to) = mesh%element_nodes(:, from)
   end subroutine keep_element

   !> Whether two elements have the same nodes, in whatever order
   pure logical function same_nodes(mesh, a, b)
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> The elements
      integer, intent(in) :: a, b

      integer :: i

      same_nodes = mesh%element_type(a) == mesh%element_type(b)
      if (.not. same_nodes) return
      associate (n => nodes_of_type(mesh%element_type(a)))
         do i = 1, n
            same_nodes = any(mesh%element_nodes(:n, b) == mesh%element_nodes(i, a))
            if (.not. same_nodes) return
         end do
      end associate
   end function same_nodes

   !> Add the groups of an element to those of another with the same nodes
   pure subroutine join_sets(mesh, known, repeated, fault)
      !> The mesh
      type(gmsh_mesh_type), intent(inout) :: mesh
      !> Element that stays, and element that goes
      integer, intent(in) :: known, repeated
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      integer, allocatable :: groups(:), more(:)
      integer :: i

      allocate (groups(0), more(0))
      if (mesh%element_set(known) > 0) groups = mesh%sets(mesh%element_set(known))%groups
      if (mesh%element_set(repeated) > 0) more = mesh%sets(mesh%element_set(repeated))%groups
      if (dimension_of_type(mesh%element_type(known)) == 1 .and. &
          mesh%element_nodes(1, known) /= mesh%element_nodes(1, repeated)) more = -more
      if (size(groups) == 0 .or. size(more) == 0 &
          .or. any([(any(abs(groups) == abs(more(i))), i=1, size(more))])) then
         fault = fault_of(mesh, repeated, 'has the same nodes as element '// &
                          to_text(mesh%element_tag(known))//' on line '// &
                          to_text(mesh%element_line(known)))
         return
      end if
      call set_index(mesh, [groups, more], mesh%element_set(known))
   end subroutine join_sets

   !> A fault of an element
   pure function fault_of(mesh, element, text) result(fault)
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> The element
      integer, intent(in) :: element
      !> What is wrong
      character(len=*), intent(in) :: text
      !> The fault
      type(fault_type) :: fault

      fault%line = mesh%element_line(element)
      fault%text = 'element '//to_text(mesh%element_tag(element))//' '//text
      fault%allowed = ''
      fault%mend = 'save the mesh again'
   end function fault_of

end module axijoint_gmsh_unite
