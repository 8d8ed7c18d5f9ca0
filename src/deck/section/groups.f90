!> GROUPS: what the physical groups of the mesh file mean
module axijoint_deck_section_groups
   use axijoint_base_text, only : to_text, count_of, did_you_mean
   use axijoint_deck_gmsh_import, only : gmsh_import_type, group_use_type, use_body, use_joint, &
      name_number, name_group
   use axijoint_deck_job_card, only : card_type, cards_of, next_card
   use axijoint_deck_job_deck, only : deck_type, read_section_type, stage_properties
   use axijoint_deck_property_properties, only : properties_type, find_material, find_law
   use axijoint_deck_text_common_fields, only : number, largest_body
   use axijoint_deck_text_diagnostics, only : add_error
   use axijoint_deck_text_entry, only : is_given, integer_of, text_of, is_good, field_fault, &
      card_fault
   use axijoint_deck_text_field, only : word_field, text_field, described
   use axijoint_gmsh_mesh, only : gmsh_mesh_type, find_group, group_text
   implicit none
   private
   public :: groups_section
   public :: keyword_groups

   !> The keyword
   character(len=*), parameter :: keyword_groups = 'GROUPS'
   !> Fields
   integer, parameter :: field_kind = 1, field_number = 2, field_material = 3, field_name = 4
   !> Kinds of groups, by the `use_` parameters; the dimension of each, and their names in messages
   character(len=5), parameter :: kinds(3) = [character(len=5) :: 'BODY', 'FACE', 'JOINT']
   integer, parameter :: dimension_of(3) = [2, 1, 1]
   character(len=7), parameter :: noun_of(2) = ['curve  ', 'surface']

contains

   !> GROUPS
   function groups_section() result(section)
      !> The section
      type(read_section_type) :: section

      section%name = keyword_groups
      section%purpose = 'bodies, faces and joints of the physical groups of the mesh file'
      section%stage = stage_properties
      section%read => read_groups
      section%fields = &
         [described(word_field('the kind of group', 1, 10, kinds), 'kind'), &
          described(number(name_number, 11), 'number of the body or face; law of the joints', &
                    limits='body: 1 … 9999; law: of LAWS'), &
          described(number('the material', 16), 'material', blank='none', &
                    limits='BODY: of MATERIALS or ORTHOTROPIC; else blank'), &
          described(text_field(name_group, 21, 80), 'name of the physical group, or its number', &
                    limits='the name may have blanks inside, and stand in quotation marks')]
      section%fields(field_material)%required = .false.
   end function groups_section

   !> Read the cards
   subroutine read_groups(deck)
      !> The deck
      type(deck_type), intent(inout), target :: deck

      type(card_type) :: card
      integer :: errors_before

      card = cards_of(deck, keyword_groups)
      associate (import => deck%import, diagnostics => deck%diagnostics, table => card%table)
         allocate (import%uses(0))
         errors_before = diagnostics%n_errors
         if (table%n > 0 .and. .not. import%given) then
            import%given = .true.
            card%entry = 1
            call card_fault(card, 'GROUPS speaks of a mesh file, but the deck names none', &
                            mend='name it on a card GMSH, from column 11')
            card%entry = 0
         end if
         do while (next_card(card))
            call read_use(card, deck%properties, import)
         end do
         if (.not. import%given) return
         if (import%sound .and. .not. any(nint(table%values(field_kind, &
            :table%n)) == use_body)) then
            call add_error(diagnostics, deck%source%mesh_card, 0, 0, &
                           'no BODY of GROUPS takes elements from the mesh file', &
                           found=group_list(import%mesh, 2), &
                           mend='below GROUPS, name the physical surfaces that are bodies')
         end if
         if (import%sound) call check_overlap(card, import)
         import%sound = import%sound .and. diagnostics%n_errors == errors_before &
            .and. all(table%good(:table%n))
      end associate
   end subroutine read_groups

   !> Read one card
   subroutine read_use(card, properties, import)
      !> The card
      type(card_type), intent(in) :: card
      !> Materials and laws
      type(properties_type), intent(in) :: properties
      !> The mesh
      type(gmsh_import_type), intent(inout) :: import

      type(group_use_type) :: use

      if (.not. is_given(card, field_kind)) return
      use%entry = card%entry
      use%kind = integer_of(card, field_kind)
      use%number = integer_of(card, field_number)
      if (use%kind == use_joint) then
         call find_law(card, field_number, properties, use%number)
      end if
      if (use%kind == use_body) then
         if (use%number > largest_body) then
            call field_fault(card, field_number, 'the body is too large', &
                             allowed='an integer, 1 to '//to_text(largest_body))
         end if
         if (.not. is_given(card, field_material) .and. is_good(card)) then
            call field_fault(card, field_material, 'the material is blank', &
                             allowed='a material of MATERIALS')
         end if
         call find_material(card, field_material, properties, use%material)
      else if (is_given(card, field_material)) then
         call field_fault(card, field_material, 'a '// &
                          trim(kinds(use%kind))//' has no material', allowed='blank')
      end if
      if (import%sound .and. is_given(card, field_name)) then
         call seek_group(card, import%mesh, dimension_of(use%kind), use%group)
      end if
      import%uses = [import%uses, use]
   end subroutine read_use

   !> Find the group that a card names, or report it
   subroutine seek_group(card, mesh, dimension, group)
      !> The card
      type(card_type), intent(in) :: card
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> Dimension that the group must have
      integer, intent(in) :: dimension
      !> Its index; 0 if there is none
      integer, intent(out) :: group

      character(len=:), allocatable :: name
      integer :: i, n_same

      name = text_of(card, field_name)
      if (len(name) > 2 .and. name(1:1) == '"' &
          .and. name(len(name):) == '"') name = name(2:len(name) - 1)
      group = 0
      n_same = 0
      do i = 1, size(mesh%groups)
         if (mesh%groups(i)%dimension /= dimension .or. mesh%groups(i)%name /= name) cycle
         if (len(mesh%groups(i)%name) == 0) cycle
         group = i
         n_same = n_same + 1
      end do
      if (n_same > 1) then
         call field_fault(card, field_name, 'the mesh file has '// &
                          count_of(n_same, 'physical '//trim(noun_of(dimension)))// &
                          ' of this name', &
                          mend='write the number of the group instead')
         group = 0
      else if (n_same == 0) then
         if (verify(name, '0123456789') == 0 .and. len(name) <= 9) then
            read (name, *) i
            group = find_group(mesh, dimension, i)
         end if
         if (group == 0) call report_group(card, mesh, dimension, name)
      end if
      if (group == 0) return
      if (count_elements(mesh, group) > 0) return
      call field_fault(card, field_name, 'the '// &
                       group_text(mesh%groups(group))//' has no elements in the mesh file', &
                       mend='mesh it and save the mesh again; with Mesh.SaveAll=1, format 2.2 '// &
                       'has no groups')
   end subroutine seek_group

   !> Report a group that the mesh does not have
   subroutine report_group(card, mesh, dimension, name)
      !> The card
      type(card_type), intent(in) :: card
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> Dimension that the group must have, and its name
      integer, intent(in) :: dimension
      character(len=*), intent(in) :: name

      character(len=:), allocatable :: noun
      integer :: i

      noun = 'physical '//trim(noun_of(dimension))
      do i = 1, size(mesh%groups)
         if (mesh%groups(i)%name /= name .and. to_text(mesh%groups(i)%tag) /= name) cycle
         call field_fault(card, field_name, group_text(mesh%groups(i)) &
                          //' is no '//noun, allowed='a '//noun//' for '// &
                          trim(kinds(integer_of(card, field_kind)))//': '// &
                          group_list(mesh, dimension))
         return
      end do
      call field_fault(card, field_name, 'the mesh file has no such '//noun, &
                       allowed=group_list(mesh, dimension), &
                       mend=did_you_mean(name, names_of(mesh, dimension)))
   end subroutine report_group

   !> Names of the groups of a dimension; blank for the others
   pure function names_of(mesh, dimension) result(names)
      !> The mesh
      type(gmsh_mesh_type), intent(in) :: mesh
      !> The dimension
      integer, intent(in) :: dimension
      !> The names
      character(len=80) :: names(size(mesh%groups))

      integer :: i

      names = ''
      do i = 1, size(names)
         if (mesh%groups(i)%dimension == dimension) names(i) = mesh%groups(i)%name
      end do
   end function names_of

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
   subroutine check_overlap(cards, import)
      !> The cards
      type(card_type), intent(in) :: cards
      !> The mesh
      type(gmsh_import_type), intent(in) :: import

      type(card_type) :: card
      integer :: i, k, set, n

      card = cards
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
               card%entry = b%entry
               if (a%group == b%group) then
                  call card_fault(card, group_text(import%mesh%groups(a%group))// &
                                   ' is on two BODY cards', allowed='each group on one BODY card')
               else
                  call card_fault(card, 'the groups of two BODY cards overlap', &
                                   found=group_text(import%mesh%groups(a%group))//' and '// &
                                   group_text(import%mesh%groups(b%group))//' share '// &
                                   count_of(n, 'element'), &
                                   allowed='each element in the group of one BODY card')
               end if
            end associate
         end do
      end do
   end subroutine check_overlap

end module axijoint_deck_section_groups
