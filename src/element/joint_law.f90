!> Stress that a joint admits at one point (Eq. 15 and 16 of the paper)
module axijoint_element_joint_law
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: joint_law_type, admit_stress, state_of
   public :: law_elastic, law_paper
   public :: state_stick, state_slip, state_open
   public :: xi, eta, theta

   !> Joint that neither opens nor slips
   integer, parameter :: law_elastic = 0
   !> The paper's law: opens in tension, slips in each direction separately
   integer, parameter :: law_paper = 1

   !> Point holds: stress as the elastic joint gives it
   integer, parameter :: state_stick = 0
   !> Point slips: a shear stress stands at the yield stress
   integer, parameter :: state_slip = 1
   !> Point is open: no stress
   integer, parameter :: state_open = 2

   !> Index of the tangential component in the meridional plane
   integer, parameter :: xi = 1
   !> Index of the normal component; positive opens the joint
   integer, parameter :: eta = 2
   !> Index of the circumferential component
   integer, parameter :: theta = 3

   !> Properties of a joint
   type :: joint_law_type
      !> Which law, one of the `law_` parameters
      integer :: kind = law_paper
      !> Stiffness per unit area along xi, eta, theta [stress/length] (Eq. 10)
      real(wp) :: stiffness(3) = 0.0_wp
      !> Cohesion C [stress] (Eq. 16)
      real(wp) :: cohesion = 0.0_wp
      !> Tangent of the friction angle phi (Eq. 16)
      real(wp) :: friction = 0.0_wp
   end type joint_law_type

contains

   !> Stress admitted for a trial stress. Tension releases all stress; otherwise
   !> each shear stress is cut to the yield stress C - sigma tan(phi) (Eq. 16)
   pure function admit_stress(law, trial) result(stress)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Trial stress: tau_xi, sigma (tension positive), tau_theta
      real(wp), intent(in) :: trial(3)
      !> Stress that the law admits, same components
      real(wp) :: stress(3)

      real(wp) :: yield

      stress = trial
      if (law%kind == law_elastic) return
      if (trial(eta) > 0.0_wp) then
         stress = 0.0_wp
      else
         yield = law%cohesion - trial(eta)*law%friction
         stress(xi) = cut(trial(xi), yield)
         stress(theta) = cut(trial(theta), yield)
      end if
   end function admit_stress

   !> State of a point from the stress that it carries and its jump: open if
   !> apart without normal stress, slipping if a shear stress stands at yield
   pure function state_of(law, stress, jump, small) result(state)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Stress that the law admits: tau_xi, sigma, tau_theta
      real(wp), intent(in) :: stress(3)
      !> Relative displacement xi, eta, theta
      real(wp), intent(in) :: jump(3)
      !> Stress that counts as zero
      real(wp), intent(in) :: small
      !> Stick, slip or open
      integer :: state

      state = state_stick
      if (law%kind == law_elastic) return
      if (stress(eta) >= -small .and. jump(eta) > 0.0_wp) then
         state = state_open
      else if (max(abs(stress(xi)), abs(stress(theta))) &
               >= law%cohesion - stress(eta)*law%friction - small &
               .and. maxval(abs(stress)) > small) then
         state = state_slip
      end if
   end function state_of

   !> A shear stress cut to the yield stress, its sign kept
   pure function cut(shear, yield) result(admitted)
      !> Trial shear stress
      real(wp), intent(in) :: shear
      !> Yield stress, not negative
      real(wp), intent(in) :: yield
      !> Shear stress within the yield stress
      real(wp) :: admitted

      admitted = sign(min(abs(shear), yield), shear)
   end function cut

end module axijoint_element_joint_law
