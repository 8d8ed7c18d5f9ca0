!> Cards of GROUPS: what the physical groups of the mesh file mean
module axijoint_deck_gmsh_groups
   use axijoint_base_text, only : to_text, count_of, nearest_word
   use axijoint_deck_gmsh_import, only : gmsh_import_type, group_use_type, use_body, use_joint
   use axijoint_deck_property_properties, only : properties_type, find_property
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error
   use axijoint_deck_text_source, only : source_type
   use axijoint_deck_text_table, only : table_type, integer_value, text_value, field_error, entry_error
   use axijoint_gmsh_mesh, only : gmsh_mesh_type, find_group, group_text
   implicit none
   private
   public :: read_groups

   !> Fields of GROUPS
   integer, parameter :: field_kind = 1, field_number = 2, field_material = 3, field_name = 4
   !> Dimension of the groups of each kind, and their names in messages
   integer, parameter :: dimension_of(3) = [2, 1, 1]
   character(len=5), parameter :: kind_name(3) = ['BODY ', 'FACE ', 'JOINT']
   character(len=7), parameter :: noun_of(2) = ['curve  ', 'surface']
   !> Largest number of a body
   integer, parameter :: largest_body = 9999

contains

   !> Read the cards of GROUPS
   subroutine read_groups(source, table, properties, import, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> GROUPS
      type(table_type), intent(in) :: table
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(gmsh_import_type), intent(inout) :: import
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: entry, errors_before

      allocate (import%uses(0))
      errors_before = diagnostics%n_errors
      if (table%n > 0 .and. .not. import%given) then
         import%given = .true.
         call entry_error(diagnostics, table, 1, 'GROUPS speaks of a mesh file, but the deck names none', &
                          mend='name it on a card GMSH, from column 11')
      end if
      do entry = 1, table%n
         call read_use(source, table, entry, properties, import, diagnostics)
      end do
      if (.not. import%given) return
      if (import%sound .and. .not. any(nint(table%values(field_kind, :table%n)) == use_body)) then
         call add_error(diagnostics, source%mesh_card, 0, 0, &
                        'no BODY of GROUPS takes elements from the mesh file', &
                        found=group_list(import%mesh, 2), &
                        mend='below GROUPS, name the physical surfaces that are bodies')
      end if
      if (import%sound) call check_overlap(table, import, diagnostics)
      import%sound = import%sound .and. diagnostics%n_errors == errors_before .and. all(table%good(:table%n))
   end subroutine read_groups

   !> Read one card
   subroutine read_use(source, table, entry, properties, import, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> GROUPS, and the entry
      type(table_type), intent(in) :: table
      integer, intent(in) :: entry
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(gmsh_import_type), intent(inout) :: import
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      type(group_use_type) :: use

      if (.not. table%given(field_kind, entry)) return
      use%entry = entry
      use%kind = integer_value(table, field_kind, entry)
      use%number = integer_value(table, field_number, entry)
      if (use%kind == use_joint) then
         call find_property(source, table, entry, field_number, properties%law_of, &
                            properties%laws_complete, 'law', use%number, diagnostics)
      end if
      if (use%kind == use_body) then
         if (use%number > largest_body) then
            call field_error(diagnostics, source, table, entry, field_number, 'the body is too large', &
                             allowed='an integer, 1 to '//to_text(largest_body))
         end if
         if (.not. table%given(field_material, entry) .and. table%good(entry)) then
            call field_error(diagnostics, source, table, entry, field_material, 'the material is blank', &
                             allowed='a material of MATERIALS')
         end if
         call find_property(source, table, entry, field_material, properties%material_of, &
                            properties%materials_complete, 'material', use%material, diagnostics)
      else if (table%given(field_material, entry)) then
         call field_error(diagnostics, source, table, entry, field_material, 'a '// &
                          trim(kind_name(use%kind))//' has no material', allowed='blank')
      end if
      if (import%sound .and. table%given(field_name, entry)) then
         call seek_group(source, table, entry, import%mesh, dimension_of(use%kind), use%group, diagnostics)
      end if
      import%uses = [import%uses, use]
   end subroutine read_use

   !> Find the group that a card names, or report it
   subroutine seek_group(source, table, entry, mesh, dimension, group, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> GROUPS, and the entry
      type(table_type), intent(in) :: table
      integer, intent(in) :: entry
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> Dimension that the group must have
      integer, intent(in) :: dimension
      !> Its index; 0 if there is none
      integer, intent(out) :: group
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: name
      integer :: i, n_same

      name = text_value(source, table, entry, field_name)
      if (len(name) > 2 .and. name(1:1) == '"' .and. name(len(name):) == '"') name = name(2:len(name) - 1)
      group = 0
      n_same = 0
      do i = 1, size(mesh%groups)
         if (mesh%groups(i)%dimension /= dimension .or. mesh%groups(i)%name /= name) cycle
         if (len(mesh%groups(i)%name) == 0) cycle
         group = i
         n_same = n_same + 1
      end do
      if (n_same > 1) then
         call field_error(diagnostics, source, table, entry, field_name, 'the mesh file has '// &
                          count_of(n_same, 'physical '//trim(noun_of(dimension)))//' of this name', &
                          mend='write the number of the group instead')
         group = 0
      else if (n_same == 0) then
         if (verify(name, '0123456789') == 0 .and. len(name) <= 9) then
            read (name, *) i
            group = find_group(mesh, dimension, i)
         end if
         if (group == 0) call report_group(source, table, entry, mesh, dimension, name, diagnostics)
      end if
      if (group == 0) return
      if (count_elements(mesh, group) > 0) return
      call field_error(diagnostics, source, table, entry, field_name, 'the '// &
                       group_text(mesh%groups(group))//' has no elements in the mesh file', &
                       mend='mesh it and save the mesh again; with Mesh.SaveAll=1, format 2.2 has no groups')
   end subroutine seek_group

   !> Report a group that the mesh does not have
   subroutine report_group(source, table, entry, mesh, dimension, name, diagnostics)
      !> The deck
      type(source_type), intent(in) :: source
      !> GROUPS, and the entry
      type(table_type), intent(in) :: table
      integer, intent(in) :: entry
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> Dimension that the group must have, and its name
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: noun, mend
      integer :: i, nearest

      noun = 'physical '//trim(noun_of(dimension))
      do i = 1, size(mesh%groups)
         if (mesh%groups(i)%name /= name .and. to_text(mesh%groups(i)%tag) /= name) cycle
         call field_error(diagnostics, source, table, entry, field_name, group_text(mesh%groups(i)) &
                          //' is no '//noun, allowed='a '//noun//' for '// &
                          trim(kind_name(integer_value(table, field_kind, entry)))//': '// &
                          group_list(mesh, dimension))
         return
      end do
      mend = ''
      nearest = nearest_name(mesh, dimension, name)
      if (nearest > 0) mend = 'did you mean '//mesh%groups(nearest)%name//'?'
      call field_error(diagnostics, source, table, entry, field_name, 'the mesh file has no such '//noun, &
                       allowed=group_list(mesh, dimension), mend=mend)
   end subroutine report_group

   !> Group that a misspelt name most likely means; 0 if none
   pure integer function nearest_name(mesh, dimension, name) result(nearest)
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> Dimension of the group, and the name
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name

      character(len=80) :: names(size(mesh%groups))
      integer :: i

      names = ''
      do i = 1, size(names)
         if (mesh%groups(i)%dimension == dimension) names(i) = mesh%groups(i)%name
      end do
      nearest = nearest_word(name, names)
   end function nearest_name

   !> Names of all groups of a dimension, with their numbers where they have none
   pure function group_list(mesh, dimension) result(list)
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> The dimension
      integer, intent(in) :: dimension
      !> The list
      character(len=:), allocatable :: list

      integer, parameter :: most_shown = 20
      integer :: i, n

      list = ''
      n = 0
      do i = 1, size(mesh%groups)
         if (mesh%groups(i)%dimension /= dimension) cycle
         n = n + 1
         if (n > most_shown) cycle
         if (n > 1) list = list//', '
         if (len(mesh%groups(i)%name) > 0) then
            list = list//mesh%groups(i)%name
         else
            list = list//to_text(mesh%groups(i)%tag)
         end if
      end do
      if (n > most_shown) list = list//' and '//to_text(n - most_shown)//' more'
      if (n == 0) list = 'the file has no physical '//trim(noun_of(dimension))//'s'
   end function group_list

   !> Number of elements of a group
   pure integer function count_elements(mesh, group) result(n)
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> The group
      integer, intent(in) :: group

      integer :: set

      n = 0
      do set = 1, size(mesh%sets)
         if (any(abs(mesh%sets(set)%groups) == group)) then
            n = n + count(mesh%element_set(:mesh%n_elements) == set)
         end if
      end do
   end function count_elements

   !> Report groups of two bodies that share elements
   subroutine check_overlap(table, import, diagnostics)
      !> GROUPS
      type(table_type), intent(in) :: table
      !> The mesh
      type(gmsh_import_type), intent(in) :: import
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      integer :: i, k, set, n

      do i = 2, size(import%uses)
         do k = 1, i - 1
            associate (a => import%uses(k), b => import%uses(i))
               if (any([a%kind, b%kind] /= use_body) .or. any([a%group, b%group] == 0)) cycle
               n = 0
               do set = 1, size(import%mesh%sets)
                  associate (groups => abs(import%mesh%sets(set)%groups))
                     if (any(groups == a%group) .and. any(groups == b%group)) &
                        n = n + count(import%mesh%element_set(:import%mesh%n_elements) == set)
                  end associate
               end do
               if (n == 0) cycle
               if (a%group == b%group) then
                  call entry_error(diagnostics, table, b%entry, group_text(import%mesh%groups(a%group))// &
                                   ' is on two BODY cards', allowed='each group on one BODY card')
               else
                  call entry_error(diagnostics, table, b%entry, 'the groups of two BODY cards overlap', &
                                   found=group_text(import%mesh%groups(a%group))//' and '// &
                                   group_text(import%mesh%groups(b%group))//' share '// &
                                   count_of(n, 'element'), &
                                   allowed='each element in the group of one BODY card')
               end if
            end associate
         end do
      end do
   end subroutine check_overlap

end module axijoint_deck_gmsh_groups
