!> What the approximations leave of the error of a job whose bodies yield
module axijoint_analysis_core_yield_errors
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: yield_errors_type, yield_share_type, sum_of_yield_shares, loses_displacement
   public :: yield_sources, yield_mesh, yield_harmonics, yield_planes, yield_iteration

   !> Sources of the errors, and their names
   integer, parameter :: yield_mesh = 1, yield_harmonics = 2, yield_planes = 3, yield_iteration = 4
   character(len=14), parameter :: yield_sources(4) = [character(len=14) :: 'discretization', &
      'harmonics', 'planes', 'iteration']

   !> Errors, relative; negative if not known
   type :: yield_share_type
      !> Of the loads of the last increment, or of what holds the displacements that are given in
      !> it, at the same displacement
      real(wp) :: load = -1.0_wp
      !> Of the displacement that the loads of the last increment do work on, under the same loads.
      !> Where neither loads nor displacements are steered, largest change of any over the largest
      real(wp) :: displacement = -1.0_wp
      !> Whether it is not known for lack of memory
      logical :: no_memory = .false.
   end type yield_share_type

   !> All of it
   type :: yield_errors_type
      !> One a source
      type(yield_share_type) :: shares(size(yield_sources))
      !> Whether the loads were taken back on the way, so that nothing but the iteration is judged
      logical :: turned_back = .false.
      !> Whether the history ended before its loads and these cannot be steered: the displacement
      !> under loads that are almost the last means nothing
      logical :: at_limit = .false.
      !> Whether loads are given, so that a small error of them moves bodies near their limit far
      logical :: loaded = .false.
      !> Growth of the displacement in the last step over that of the load, each over what it came
      !> to: 1 of elastic bodies. Negative if the load grew no more
      real(wp) :: softness = -1.0_wp
      !> Load by which the state found in one step is off, over that of the state, if that is too much; else zero
      real(wp) :: other_way = 0.0_wp
      !> Time that the estimates took [second]
      real(wp) :: seconds = 0.0_wp
   end type yield_errors_type

   !> Most of the displacement that an error of the load is let change: the load-displacement curve
   !> is taken for straight on that way
   real(wp), parameter :: most_moved = 0.5_wp

contains

   !> All shares together, without those that are not known
   pure function sum_of_yield_shares(errors) result(total)
      !> The errors
      type(yield_errors_type), intent(in) :: errors
      !> Their sums; negative if no error is known but that of the iteration, which alone says little
      type(yield_share_type) :: total

      total%load = sum_of((errors%shares%load))
      total%displacement = sum_of((errors%shares%displacement))

   contains

      !> Of one quantity
      pure real(wp) function sum_of(shares)
         !> Its shares
         real(wp), intent(in) :: shares(:)

         sum_of = -1.0_wp
         associate (sought => shares(:yield_iteration - 1))
            if (all(sought >= 0.0_wp) .or. any(sought > 0.0_wp)) sum_of = sum(shares, mask=shares >= 0.0_wp)
         end associate
      end function sum_of

   end function sum_of_yield_shares

   !> Whether the bodies are so near to their limit that nothing can be said of displacements under
   !> the same loads
   pure logical function loses_displacement(errors) result(loses)
      !> The errors
      type(yield_errors_type), intent(in) :: errors

      type(yield_share_type) :: total

      total = sum_of_yield_shares(errors)
      loses = errors%loaded .and. .not. errors%turned_back .and. .not. errors%other_way > 0.0_wp &
         .and. (errors%softness < 0.0_wp .or. errors%softness*total%load > most_moved)
   end function loses_displacement

end module axijoint_analysis_core_yield_errors
