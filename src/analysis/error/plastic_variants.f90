!> A job whose bodies yield, with more planes, more harmonics, fewer harmonics: what is found again on
!> these tells what they leave of the error
module axijoint_analysis_error_plastic_variants
   use axijoint_model_model, only : model_type
   use axijoint_model_modes, only : used_modes, highest_loaded
   implicit none
   private
   public :: take_more_planes, take_more_harmonics, take_fewer_harmonics, mesh_harmonics

   !> Harmonics that are enough to see what the mesh leaves
   integer, parameter :: few = 3

contains

   !> Twice as many intervals between planes
   subroutine take_more_planes(model, denser)
      !> The job
      type(model_type), intent(in) :: model
      !> With more planes
      type(model_type), intent(out) :: denser

      integer :: least

      denser = model
      call forget_history(denser)
      associate (modes => used_modes(model))
         least = 0  ! all may be multiples of it
         if (any(modes%harmonic > 0)) least = minval(modes%harmonic, mask=modes%harmonic > 0)
      end associate
      denser%n_body_planes = more_planes(max(model%max_harmonic, 2*least), model%n_body_planes)
   end subroutine take_more_planes

   !> Twice as many intervals, or the usual planes of twice as many harmonics and one more
   pure integer function more_planes(harmonic, n)
      !> Highest harmonic, and number of planes; 0 for the usual
      integer, intent(in) :: harmonic, n

      more_planes = 4*max(2, harmonic) + 3
      if (n > 0) more_planes = max(more_planes, 2*n - 1)
   end function more_planes

   !> Twice as many harmonics and one more, on more planes
   subroutine take_more_harmonics(model, richer)
      !> The job
      type(model_type), intent(in) :: model
      !> With more harmonics
      type(model_type), intent(out) :: richer

      call take_more_planes(model, richer)
      call set_harmonics(2*model%max_harmonic + 1, richer)
      if (size(used_modes(richer)) == size(used_modes(model))) &  ! odd multiples alone
         call set_harmonics(3*model%max_harmonic, richer)
   end subroutine take_more_harmonics

   !> Harmonics up to some, on the usual planes of these if they are fewer
   subroutine take_fewer_harmonics(model, highest, plain)
      !> The job
      type(model_type), intent(in) :: model
      !> Highest harmonic
      integer, intent(in) :: highest
      !> With fewer harmonics
      type(model_type), intent(out) :: plain

      plain = model
      call forget_history(plain)
      if (.not. model%max_harmonic > highest) return
      call set_harmonics(highest, plain)
      plain%n_body_planes = 0
   end subroutine take_fewer_harmonics

   !> Highest harmonics by which to see what the mesh leaves. What that is of loads hardly depends on
   !> them: no more are taken than the loads have, or, for displacements, a few
   pure subroutine mesh_harmonics(model, of_loads, first, second)
      !> The job
      type(model_type), intent(in) :: model
      !> Whether the error of loads is asked for
      logical, intent(in) :: of_loads
      !> What to begin with, and what else to try if that says nothing
      integer, intent(out) :: first, second

      first = min(model%max_harmonic, max(1, highest_loaded(model)))
      second = min(model%max_harmonic, max(few, first))
      if (of_loads) return
      first = second
      second = min(model%max_harmonic, max(1, highest_loaded(model)))
   end subroutine mesh_harmonics

   !> Let a job have one increment: what is found in one step keeps no states of others
   pure subroutine forget_history(model)
      !> The job
      type(model_type), intent(inout) :: model

      model%increments = model%increments(size(model%increments):)
   end subroutine forget_history

   !> Let a job have other harmonics
   pure subroutine set_harmonics(highest, model)
      !> Highest harmonic
      integer, intent(in) :: highest
      !> The job
      type(model_type), intent(inout) :: model

      integer :: m

      model%max_harmonic = highest
      model%harmonics = [(m, m=0, highest)]
   end subroutine set_harmonics

end module axijoint_analysis_error_plastic_variants
