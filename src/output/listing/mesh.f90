!> Tables of the listing that show the mesh
module axijoint_output_listing_mesh
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_text, only : to_text
   use axijoint_fe_mode, only : family_symmetric
   use axijoint_model_interface, only : interface_name
   use axijoint_model_mesh, only : n_nodes, n_elements, n_joints
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : print_nodes, print_elements, print_joints
   use axijoint_model_restraint, only : restraint_type, any_family
   use axijoint_output_file_headings, only : write_heading, width
   use axijoint_output_file_row, only : row_type
   use axijoint_output_file_text, only : text_file_type
   use axijoint_output_listing_choice, only : chosen_places, none_asked, write_left
   implicit none
   private
   public :: write_nodes, write_restraints, write_elements, write_joints

   !> Columns of a number
   integer, parameter :: label = 10
   !> Joint: number, law, nodes
   character(len=*), parameter :: format_joint = '(2i10, 4x, 6i10)'
   !> Columns of a coordinate
   integer, parameter :: narrow = 14

contains

   !> Nodes with their restraints
   subroutine write_nodes(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      type(row_type) :: row
      logical :: listed(n_nodes(model%mesh))
      integer :: i

      if (none_asked(model, print_nodes)) return
      listed = chosen_places(model, results, print_nodes)
      if (any(listed)) then
         call write_heading(file, "NODES (fixed components u v w: 1)")
         call file%put("      node             r             z   uvw")
      end if
      do i = 1, n_nodes(model%mesh)
         if (.not. listed(i)) cycle
         call row%begin()
         call row%integers([model%mesh%node_label(i)], label)
         call row%reals(model%mesh%coordinates(:, i), narrow)
         if (any(model%fixed(:, i))) then
            call row%words("   ")
            call row%integers(merge(1, 0, model%fixed(:, i)), 1)
         end if
         call row%put(file)
      end do
      call write_left(file, "NODES", count(listed), size(listed))
   end subroutine write_nodes

   !> Restraints that hold in some modes only
   subroutine write_restraints(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=16) :: row
      logical :: there(n_nodes(model%mesh)), listed(n_nodes(model%mesh))
      integer :: k, i

      if (.not. allocated(model%restraints)) return
      if (size(model%restraints) == 0 .or. none_asked(model, print_nodes)) return
      call write_heading(file, "RESTRAINTS IN SOME HARMONICS (fixed components u v w: 1)")
      call file%put("      node   uvw   harmonics")
      do k = 1, size(model%restraints)
         associate (restraint => model%restraints(k))
            there = any(restraint%held, 1)
            listed = chosen_places(model, results, print_nodes, there=there)
            do i = 1, n_nodes(model%mesh)
               if (.not. listed(i)) cycle
               write (row, '(i10, 3x, 3i1)') model%mesh%node_label(i), &
                  merge(1, 0, restraint%held(:, i))
               call file%put(row//"   "//range_text(restraint))
            end do
            call write_left(file, "", count(listed), count(there))
         end associate
      end do
   end subroutine write_restraints

   !> Harmonics and family of a restraint in words
   pure function range_text(restraint) result(text)
      !> The restraint
      type(restraint_type), intent(in) :: restraint
      !> The words
      character(len=:), allocatable :: text

      text = "all"
      if (restraint%last < huge(0)) then
         text = to_text(restraint%first)
         if (restraint%last > restraint%first) text = text//" to "//to_text(restraint%last)
      end if
      if (restraint%family /= any_family) then
         text = text//trim(merge(" symmetric    ", " antisymmetric", &
            restraint%family == family_symmetric))
      end if
   end function range_text

   !> Elements
   subroutine write_elements(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      type(row_type) :: row
      logical :: listed(n_elements(model%mesh))
      integer :: i

      if (none_asked(model, print_elements)) return
      listed = chosen_places(model, results, print_elements)
      if (any(listed)) then
         call write_heading(file, "ELEMENTS (corners counterclockwise, mid-sides, centre)")
         call file%put("   element  material      body         nodes")
      end if
      associate (mesh => model%mesh)
         do i = 1, n_elements(mesh)
            if (.not. listed(i)) cycle
            call row%begin()
            call row%integers([mesh%element_label(i), &
               model%materials(mesh%element_material(i))%label, mesh%element_body(i)], label)
            call row%words("    ")
            call row%integers(mesh%node_label(mesh%element_nodes(:mesh%element_size(i), i)), label)
            call row%put(file)
         end do
      end associate
      call write_left(file, "ELEMENTS", count(listed), size(listed))
   end subroutine write_elements

   !> Joints
   subroutine write_joints(file, model, results)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The job
      type(model_type), intent(in) :: model
      !> Results
      type(results_type), intent(in) :: results

      character(len=width) :: line
      logical :: listed(n_joints(model%mesh))
      integer :: i

      if (n_joints(model%mesh) == 0 .or. none_asked(model, print_joints)) return
      listed = chosen_places(model, results, print_joints)
      if (any(listed)) then
         call write_heading(file, "JOINTS (side 1-2, side 4-3 opposite, mid-sides 5 and 6)")
         call file%put("     joint       law         nodes 1-4 (1-6), name of the interface")
      end if
      associate (mesh => model%mesh)
         do i = 1, n_joints(mesh)
            if (.not. listed(i)) cycle
            write (line, format_joint) mesh%joint_label(i), &
               model%joint_materials(mesh%joint_material(i))%label, &
               mesh%node_label(mesh%joint_nodes(:mesh%joint_size(i), i))
            if (mesh%joint_interface(i) > 0) line = trim(line)//"  "// &
               interface_name(model%interfaces, mesh%joint_interface(i))
            call file%put(trim(line))
         end do
      end associate
      call write_left(file, "JOINTS", count(listed), size(listed))
   end subroutine write_joints

end module axijoint_output_listing_mesh
