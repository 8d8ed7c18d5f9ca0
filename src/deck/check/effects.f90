!> Loads that act on nothing
module axijoint_deck_check_effects
   use axijoint_base_kinds, only : wp
   use axijoint_deck_job_deck, only : deck_type
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_section, only : needs_nothing, needs_density, needs_expansion
   implicit none
   private
   public :: warn_of_lacking_properties

contains

   !> Warn of loads that act on nothing, as no material has the property that they need
   subroutine warn_of_lacking_properties(deck)
      !> The deck with its model
      type(deck_type), intent(inout), target :: deck

      logical :: heavy, expands
      logical, allocatable :: used(:)
      integer :: i, k

      associate (materials => deck%model%materials)
         allocate (used(size(materials)), source=.false.)
         used(deck%model%mesh%element_material) = .true.
         heavy = any(used .and. materials%density > 0.0_wp)
         expands = any([(used(i) .and. any(abs(materials(i)%expansion) > 0.0_wp), i=1, size(used))])
      end associate
      do k = 1, size(deck%sections%tables)
         associate (needs => deck%source%sections(k)%needs, table => deck%sections%tables(k))
            if (table%n == 0 .or. needs == needs_nothing) cycle
            if (needs == needs_density .and. heavy .or. needs == needs_expansion .and. expands) &
               cycle
            call add_warning(deck%diagnostics, table%cards(1, 1), 0, 0, &
                             'the load has no effect: no element has a '//trim(needs), &
                             mend='give it on the MATERIALS card')
         end associate
      end do
   end subroutine warn_of_lacking_properties

end module axijoint_deck_check_effects
