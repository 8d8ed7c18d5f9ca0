!> Stiffness of the joints in proportion to the bodies beside them, k h/E, law by law
module axijoint_model_joint_proportion
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : joint_law_type, law_elastic, eta
   use axijoint_model_joint_sides, only : elements_beside, moduli_beside
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: proportion_type, joint_proportions, side_of, decisive_direction, stiffest
   public :: side_sensible, side_soft, side_stiff

   !> Where k h/E is sensible: softer joints give way more than the bodies, stiffer ones are rigid
   !> beside them and cost digits and iterations
   real(wp), parameter :: sensible(2) = [1.0e-3_wp, 1.0e2_wp]
   !> On which side of that a law lies
   integer, parameter :: side_sensible = 0, side_soft = -1, side_stiff = 1

   !> The joints of a law
   type :: proportion_type
      !> Number of joints
      integer :: n_joints = 0
      !> Least and largest k h/E of them, along xi, eta, theta: with the length h of a joint and
      !> the modulus E of the softer body beside it
      real(wp) :: least(3) = huge(1.0_wp), largest(3) = 0.0_wp
   end type proportion_type

contains

   !> Proportions of all laws
   pure function joint_proportions(model) result(proportions)
      !> The job
      type(model_type), intent(in) :: model
      !> One for each law
      type(proportion_type), allocatable :: proportions(:)

      real(wp) :: ratio(3), modulus(3, size(model%mesh%joint_label))
      integer :: joint

      allocate (proportions(size(model%joint_materials)))
      if (size(model%mesh%joint_label) == 0) return
      modulus = moduli_beside(model, elements_beside(model%mesh))
      do joint = 1, size(model%mesh%joint_label)
         associate (of_law => proportions(model%mesh%joint_material(joint)), &
                    law => model%joint_materials(model%mesh%joint_material(joint))%law, &
                    nodes => model%mesh%joint_nodes(:, joint))
            ratio = law%stiffness*norm2(model%mesh%coordinates(:, nodes(2)) - &
               model%mesh%coordinates(:, nodes(1)))/modulus(:, joint)
            of_law%n_joints = of_law%n_joints + 1
            of_law%least = min(of_law%least, ratio)
            of_law%largest = max(of_law%largest, ratio)
         end associate
      end do
   end function joint_proportions

   !> Whether the joints of a law are soft or stiff out of proportion
   pure integer function side_of(law, proportion) result(side)
      !> The law
      type(joint_law_type), intent(in) :: law
      !> Its joints
      type(proportion_type), intent(in) :: proportion

      side = side_sensible
      if (proportion%n_joints == 0) return
      associate (value => proportion%largest(decisive_direction(law, proportion)))
         if (value > 0.0_wp .and. value < sensible(1)) side = side_soft
         if (value > sensible(2)) side = side_stiff
      end associate
   end function side_of

   !> The direction that decides: the stiffest if that is out of proportion, else the softest. The
   !> stiffest joint counts, as fine meshes have joints of any length at corners. Directions without
   !> stiffness stand free, and a law without strength in shear bears none whatever its stiffness
   pure integer function decisive_direction(law, proportion) result(direction)
      !> The law
      type(joint_law_type), intent(in) :: law
      !> Its joints
      type(proportion_type), intent(in) :: proportion

      logical :: counts(3)

      counts = counted(law)
      direction = maxloc(proportion%largest, 1, mask=counts)
      if (direction > 0) then
         if (proportion%largest(direction) <= sensible(2)) &
            direction = minloc(proportion%largest, 1, mask=counts)
      end if
      direction = max(1, direction)
   end function decisive_direction

   !> Directions in which the stiffness of a law matters
   pure function counted(law)
      !> The law
      type(joint_law_type), intent(in) :: law
      !> xi, eta, theta
      logical :: counted(3)

      counted = law%stiffness > 0.0_wp
      if (law%kind /= law_elastic .and. .not. max(law%cohesion, law%friction) > 0.0_wp) &
         counted = counted .and. [1, 2, 3] == eta
   end function counted

   !> Largest k h/E of joints that can open or slip; zero if there are none
   pure real(wp) function stiffest(model)
      !> The job
      type(model_type), intent(in) :: model

      type(proportion_type), allocatable :: proportions(:)
      integer :: k

      stiffest = 0.0_wp
      proportions = joint_proportions(model)
      do k = 1, size(proportions)
         associate (law => model%joint_materials(k)%law)
            if (law%kind == law_elastic .or. proportions(k)%n_joints == 0) cycle
            stiffest = max(stiffest, maxval(proportions(k)%largest, mask=counted(law)))
         end associate
      end do
   end function stiffest

end module axijoint_model_joint_proportion
