!> Stress that a joint admits at one point (Eq. 15 and 16 of the paper)
module axijoint_element_joint_law
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: joint_law_type, admit_stress
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

   !> Stress admitted for a trial stress, with the state of the point.
   !> Tension releases all stress; otherwise each shear stress is cut to the
   !> yield stress C - sigma tan(phi) (Eq. 16)
   pure subroutine admit_stress(law, trial, stress, state)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Trial stress: tau_xi, sigma (tension positive), tau_theta
      real(wp), intent(in) :: trial(3)
      !> Stress that the law admits, same components
      real(wp), intent(out) :: stress(3)
      !> Stick, slip or open
      integer, intent(out) :: state

      real(wp) :: yield

      stress = trial
      state = state_stick
      if (law%kind == law_elastic) return

      if (trial(eta) > 0.0_wp) then
         stress = 0.0_wp
         state = state_open
         return
      end if

      yield = law%cohesion - trial(eta)*law%friction
      if (abs(trial(xi)) > yield .or. abs(trial(theta)) > yield) state = state_slip
      stress(xi) = cut(trial(xi), yield)
      stress(theta) = cut(trial(theta), yield)
   end subroutine admit_stress

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
