!> Modes that have the same unknowns
module axijoint_assembly_mode_classes
   use axijoint_assembly_dofs, only : kinematic_class
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_model, only : model_type, on_axis
   use axijoint_model_restraint, only : acts_in
   implicit none
   private
   public :: mode_classes

contains

   !> Number the classes of the modes, in the order of their first modes: modes of one class have
   !> the same components, the same conditions on the axis and the same restraints
   pure function mode_classes(model, modes) result(class)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Class of each mode, from 1 on
      integer :: class(size(modes))

      integer :: kinds(size(modes)), k, other

      kinds = kinematic_class(modes, any(on_axis(model%mesh)))
      do k = 1, size(modes)
         class(k) = maxval([0, class(:k - 1)]) + 1
         do other = 1, k - 1
            if (kinds(other) /= kinds(k) .or. .not. same_restraints(model, modes(other), &
               modes(k))) cycle
            class(k) = class(other)
            exit
         end do
      end do
   end function mode_classes

   !> Whether the same restraints hold in two modes
   pure logical function same_restraints(model, a, b)
      !> The job
      type(model_type), intent(in) :: model
      !> The modes
      type(mode_type), intent(in) :: a, b

      same_restraints = .true.
      if (.not. allocated(model%restraints)) return
      same_restraints = all(acts_in(model%restraints, a) .eqv. acts_in(model%restraints, b))
   end function same_restraints

end module axijoint_assembly_mode_classes
