!> Restraints that hold in some harmonics and families only
module axijoint_model_restraint
   use axijoint_fe_mode, only : mode_type
   implicit none
   private
   public :: restraint_type, acts_in, hold_in

   !> Either family
   integer, parameter, public :: any_family = 0

   !> Components that are held in a range of harmonics
   type :: restraint_type
      !> First and last harmonic
      integer :: first = 0, last = huge(0)
      !> Family, or `any_family`
      integer :: family = any_family
      !> Whether u, v, w of a node are held, shape (3, nodes)
      logical, allocatable :: held(:, :)
   end type restraint_type

contains

   !> Whether a restraint holds in a mode
   elemental logical function acts_in(restraint, mode)
      !> The restraint
      type(restraint_type), intent(in) :: restraint
      !> The mode
      type(mode_type), intent(in) :: mode

      acts_in = mode%harmonic >= restraint%first .and. mode%harmonic <= restraint%last &
         .and. (restraint%family == any_family .or. restraint%family == mode%family)
   end function acts_in

   !> Hold components of nodes in a range of harmonics: those of one range are one restraint
   pure subroutine hold_in(restraints, range, n_nodes, nodes, components)
      !> The restraints
      type(restraint_type), allocatable, intent(inout) :: restraints(:)
      !> The range
      type(restraint_type), intent(in) :: range
      !> Nodes of the mesh
      integer, intent(in) :: n_nodes
      !> The nodes
      integer, intent(in) :: nodes(:)
      !> Whether u, v, w are held
      logical, intent(in) :: components(3)

      integer :: k, i

      do k = size(restraints), 1, -1
         if (restraints(k)%first == range%first .and. restraints(k)%last == range%last &
             .and. restraints(k)%family == range%family) exit
      end do
      if (k == 0) then
         restraints = [restraints, range]
         k = size(restraints)
         allocate (restraints(k)%held(3, n_nodes), source=.false.)
      end if
      do i = 1, 3
         if (components(i)) restraints(k)%held(i, nodes) = .true.
      end do
   end subroutine hold_in

end module axijoint_model_restraint
