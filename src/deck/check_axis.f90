!> Elements at the axis against those beside them
module axijoint_deck_check_axis
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text, count_of
   use axijoint_deck_diagnostics, only : diagnostics_type, add_warning
   use axijoint_deck_draft, only : draft_type
   implicit none
   private
   public :: check_slivers

   !> How many times wider the elements beside one at the axis may be without a warning
   real(wp), parameter :: largest_jump = 100.0_wp

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
            if (any(draft%position(1, nodes) > 0.0_wp) .and. any(.not. draft%position(1, nodes) > 0.0_wp)) then
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
                       count_of(n, 'element')//' at the axis: far narrower than those beside them', &
                       found='element '//to_text(draft%element_label(first))//' ends at r = '// &
                       to_text(width(draft, first)), &
                       mend='do not use their stresses in harmonics above 0, or let the elements grow gradually')
   end subroutine check_slivers

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
