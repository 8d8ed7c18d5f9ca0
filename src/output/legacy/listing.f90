!> The listing in the layout of the axisymmetric plasticity program of Owen and Hinton (Finite
!> Elements in Plasticity, 1980, 7.8): NAME.owen-hinton.lis. The first character of a line is for
!> the printer
module axijoint_output_legacy_listing
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_analysis_core_results, only : results_type
   use axijoint_base_error, only : error_type
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_model_model, only : model_type
   use axijoint_model_request, only : old_output
   use axijoint_output_legacy_echo, only : echo_job
   use axijoint_output_legacy_page, only : page_type, most_noted
   use axijoint_output_legacy_plastic_strain, only : add_plastic_strain
   use axijoint_output_legacy_states, only : put_head, put_displacements, put_reactions, &
      put_stresses
   implicit none
   private
   public :: old_listing_type, begin_old_listing, put_old_listing, end_old_listing

   !> NOUTP: what is shown of an increment, each with what stands before it
   integer, parameter :: with_displacements = 1, with_reactions = 2, with_stresses = 3

   !> The listing under way
   type :: old_listing_type
      !> Whether there is one
      logical :: wanted = .false.
      !> Its lines
      type(page_type) :: page
      !> Plastic strain at the end of the increment before, shape (4, points), and the effective
      !> one, shape (points)
      real(wp), allocatable, private :: plastic(:, :), effective(:)
   end type old_listing_type

contains

   !> Begin it: what the deck says
   subroutine begin_old_listing(path, model, results, listing, error)
      !> Final path of the file
      character(len=*), intent(in) :: path
      !> The job
      type(model_type), intent(in) :: model
      !> Results at the end
      type(results_type), intent(in) :: results
      !> The listing
      type(old_listing_type), intent(inout) :: listing
      !> It cannot be created
      type(error_type), allocatable, intent(out) :: error

      call listing%page%file%open(path, error)
      if (allocated(error)) return
      listing%wanted = .true.
      allocate (listing%plastic(4, size(results%point_element)), source=0.0_wp)
      allocate (listing%effective(size(results%point_element)), source=0.0_wp)
      call echo_job(listing%page, model, results)
   end subroutine begin_old_listing

   !> Show an increment
   subroutine put_old_listing(listing, model, results, i, now)
      !> The listing
      type(old_listing_type), intent(inout) :: listing
      !> The job
      type(model_type), intent(in) :: model
      !> Its results at the end, with all states
      type(results_type), intent(in) :: results
      !> The increment, a place among the states
      integer, intent(in) :: i
      !> Its fields
      class(fields_type), intent(in) :: now

      integer :: amount

      if (.not. listing%wanted) return
      call add_plastic_strain(model, now, listing%plastic, listing%effective)
      amount = old_output(model%old_output, results%states(i)%increment)
      associate (page => listing%page)
         call put_head(page, model, results, i, amount)
         if (amount >= with_displacements) call put_displacements(page, model, now)
         if (amount >= with_reactions) call put_reactions(page, model, now)
         if (amount >= with_stresses) call put_stresses(page, model, now, listing%effective)
      end associate
   end subroutine put_old_listing

   !> End it: what had no room, with six digits
   subroutine end_old_listing(listing, error)
      !> The listing
      type(old_listing_type), intent(inout) :: listing
      !> It cannot be written
      type(error_type), allocatable, intent(out) :: error

      integer :: k

      if (.not. listing%wanted) return
      associate (page => listing%page)
         if (page%n_noted > 0) then
            call page%put('0     VALUES WITHOUT ROOM IN THEIR FIELDS: '//to_text(page%n_noted))
            do k = 1, min(page%n_noted, most_noted)
               call page%put('      '//trim(page%noted(k)))
            end do
            if (page%n_noted > most_noted) call page%put('      AND '// &
               to_text(page%n_noted - most_noted)//' MORE')
         end if
         call page%file%finish(error)
      end associate
   end subroutine end_old_listing

end module axijoint_output_legacy_listing
