!> Elements at the axis against those beside them, and nodes that are almost on it
module axijoint_deck_check_axis
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_mesh_draft, only : draft_type
   use axijoint_deck_text_diagnostics, only : diagnostics_type, add_error, add_warning
   use axijoint_fe_shape, only : n_corners
   implicit none
   private
   public :: check_slivers, check_holes

   !> How many times wider the elements beside one at the axis may be without a warning
   real(wp), parameter :: largest_jump = 100.0_wp
   !> Radius of a hole in widths of the elements at it: one below the first is a slip of rounding,
   !> of one below the second the elements see little
   real(wp), parameter :: no_hole = 1.0e-7_wp, coarse_hole = 0.1_wp

contains

   !> Warn of elements at the axis that are far narrower than those beside them. The strain
   !> u/r in them is the displacement error of their large neighbours over a small radius
   subroutine check_slivers(draft, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      real(wp), allocatable :: reach(:)
      real(wp) :: beside
      integer :: element, n, first

      reach = largest_radii(draft)
      n = 0
      first = 0
      do element = 1, draft%n_elements
         if (.not. draft%element_good(element)) cycle
         associate (nodes => draft%element_nodes(:draft%element_size(element), element))
            if (any(draft%position(1, nodes) > 0.0_wp) &
               .and. any(.not. draft%position(1, nodes) > 0.0_wp)) then
               beside = maxval(reach(nodes)) - width(draft, element)
               if (beside > largest_jump*width(draft, element)) then
                  n = n + 1
                  if (first == 0) first = element
               end if
            end if
         end associate
      end do
      if (n == 0) return
      call add_warning(diagnostics, draft%element_card(first), 0, 0, &
                       count_of(n, 'element')// &
                       ' at the axis: far narrower than those beside them', &
                       found='element '//to_text(draft%element_label(first))//' ends at r = '// &
                       to_text(width(draft, first)), &
                       mend='do not use their stresses in harmonics above 0, or let the '// &
                       'elements grow gradually')
   end subroutine check_slivers

   !> Report nodes that are almost on the axis, and warn of holes in coarse elements. Elements far
   !> wider than the hole do not see it, but the conditions on the axis are lacking: in harmonics 1
   !> and above displacements near the axis are off by 1 to 50 %, whatever the radius below a
   !> hundredth of their width
   subroutine check_holes(draft, diagnostics)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> Messages
      type(diagnostics_type), intent(inout) :: diagnostics

      character(len=:), allocatable :: found
      real(wp), allocatable :: width_at(:), ratio(:)
      integer :: node

      width_at = least_widths(draft)
      ratio = draft%position(1, :draft%n_nodes)/width_at
      where (.not. ratio > 0.0_wp) ratio = huge(1.0_wp)
      node = findloc(ratio < coarse_hole, .true., 1)
      if (any(ratio < no_hole)) node = findloc(ratio < no_hole, .true., 1)
      if (node == 0) return
      found = 'node '//to_text(draft%node_label(node))//' at r = '// &
         to_text(draft%position(1, node))// &
              ', elements there '//to_text(width_at(node))//' wide'
      if (ratio(node) < no_hole) then
         call add_error(diagnostics, draft%node_card(node), 0, 0, &
                        count_of(count(ratio < no_hole), 'node')//' almost on the axis', &
                        found=found, &
                        allowed='r = 0, or a hole with narrow elements at it', mend='write r = 0')
      else
         call add_warning(diagnostics, draft%node_card(node), 0, 0, &
                          count_of(count(ratio < coarse_hole), 'node')// &
                          ' at a hole that the elements there '// &
                          'hardly see', found=found, &
                          mend='write r = 0, or let the elements be about as wide as the hole '// &
                          'and grow gradually')
      end if
   end subroutine check_holes

   !> Extent along r of the narrowest of the elements at each node; huge without elements
   pure function least_widths(draft) result(least)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The widths, shape (nodes)
      real(wp), allocatable :: least(:)

      integer :: element, n

      allocate (least(draft%n_nodes), source=huge(1.0_wp))
      do element = 1, draft%n_elements
         if (.not. draft%element_good(element)) cycle
         n = draft%element_size(element)
         associate (nodes => draft%element_nodes(:n, element), &
                    r => draft%position(1, draft%element_nodes(:n_corners(n), element)))
            least(nodes) = min(least(nodes), maxval(r) - minval(r))
         end associate
      end do
   end function least_widths

   !> Largest r of the elements at each node
   pure function largest_radii(draft) result(reach)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The radii, shape (nodes)
      real(wp), allocatable :: reach(:)

      integer :: element

      allocate (reach(draft%n_nodes), source=0.0_wp)
      do element = 1, draft%n_elements
         if (.not. draft%element_good(element)) cycle
         associate (nodes => draft%element_nodes(:draft%element_size(element), element))
            reach(nodes) = max(reach(nodes), width(draft, element))
         end associate
      end do
   end function largest_radii

   !> Largest r of the nodes of an element: its width, if it lies at the axis
   pure real(wp) function width(draft, element)
      !> The mesh
      type(draft_type), intent(in) :: draft
      !> The element
      integer, intent(in) :: element

      width = maxval(draft%position(1, draft%element_nodes(:draft%element_size(element), element)))
   end function width

end module axijoint_deck_check_axis
