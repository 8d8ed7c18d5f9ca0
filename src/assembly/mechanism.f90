!> Bodies that nothing holds, found before any equation is solved
module axijoint_assembly_mechanism
   use axijoint_assembly_resistance, only : free_motions
   use axijoint_assembly_rigid_motion, only : solid_parts, frame_of, motion_name, max_motions
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_error, only : error_type, fatal_error, exit_singular
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_model, only : model_type
   use axijoint_model_restraint, only : any_family
   implicit none
   private
   public :: check_mechanism

contains

   !> Report the rigid motions that neither supports nor joints resist. Joints
   !> count wherever their stiffness is not zero, as if they stick.
   subroutine check_mechanism(model, points, supports, modes, error)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of all joints
      type(model_joint_point_type), intent(in) :: points(:)
      !> Points of all springs
      type(support_point_type), intent(in) :: supports(:)
      !> Modes to be solved; only those of harmonics 0 and 1 have rigid motions
      type(mode_type), intent(in) :: modes(:)
      !> The free motions in words
      type(error_type), allocatable, intent(out) :: error

      integer, allocatable :: part(:)
      character(len=:), allocatable :: message
      integer :: k, last

      call solid_parts(model%mesh, part)
      message = ''
      last = -1
      do k = 1, size(modes)
         if (modes(k)%harmonic > 1) exit
         if (modes(k)%harmonic == 1 .and. last == 1 .and. .not. families_differ(model)) cycle
         last = modes(k)%harmonic
         message = message//text_of(modes(k))
      end do
      if (len(message) == 0) return
      call fatal_error(error, exit_singular, 'the structure can move without resistance:'// &
                       message//new_line('a')//'mend: add a restraint, or a joint with '// &
                       'stiffness in that direction')

   contains

      !> The free rigid motions of one mode, a line each; empty if none
      function text_of(mode) result(text)
         !> Mode of harmonic 0 or 1
         type(mode_type), intent(in) :: mode
         !> The lines
         character(len=:), allocatable :: text

         real(wp), allocatable :: free(:, :)
         integer :: i, place

         call free_motions(model, points, supports, part, frame_of(model%mesh), mode, free)
         text = ''
         do i = 1, size(free, 2)
            place = maxloc(abs(free(:, i)), 1)
            text = text//new_line('a')//'  the part with node '// &
               to_text(model%mesh%node_label(findloc(part, (place - 1)/max_motions + 1, 1)))// &
               motion_name(mode, place, families_differ(model))
         end do
      end function text_of

   end subroutine check_mechanism

   !> Whether supports hold the families differently in harmonic 1; else both move alike
   pure logical function families_differ(model)
      !> The job
      type(model_type), intent(in) :: model

      families_differ = .false.
      if (allocated(model%restraints)) families_differ = any(model%restraints%family /= any_family .and. &
                                                             model%restraints%last > 0)
   end function families_differ

end module axijoint_assembly_mechanism
