!> Stress that a joint admits at one point (Eq. 15 and 16 of the paper and
!> other laws), and its derivatives
module axijoint_element_joint_law
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: joint_law_type, memory_type, admit_stress, trial_stress, admit, renew, state_of, &
      lost_at_opening, loses_at_opening, cuts_back
   public :: law_elastic, law_paper, slip_components, slip_resultant, opening_reversible, &
      opening_bond
   public :: law_names, slip_names, opening_names
   public :: state_stick, state_slip, state_open
   public :: xi, eta, theta

   !> Joint that neither opens nor slips
   integer, parameter :: law_elastic = 0
   !> Joint that opens in tension and slips at the yield stress
   integer, parameter :: law_paper = 1
   !> Their names on cards and in the listing
   character(len=7), parameter :: law_names(0:1) = [character(len=7) :: 'ELASTIC', 'PAPER']

   !> Each shear stress is cut to the yield stress separately (Eq. 16)
   integer, parameter :: slip_components = 1
   !> The resultant of both shear stresses is cut, its direction kept
   integer, parameter :: slip_resultant = 2
   !> Their names
   character(len=10), parameter :: slip_names(2) = [character(len=10) :: 'COMPONENTS', 'RESULTANT']

   !> A point that closes again has its cohesion as before (the paper)
   integer, parameter :: opening_reversible = 1
   !> A bond holds tension until it breaks for good: then no cohesion is left
   integer, parameter :: opening_bond = 2
   !> Their names
   character(len=10), parameter :: opening_names(2) = [character(len=10) :: 'REVERSIBLE', 'BOND']

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
      !> How it slips and opens, `slip_` and `opening_` parameters
      integer :: slip = slip_components, opening = opening_reversible
      !> Whether slip leaves less strength, and what is left
      logical :: softens = .false.
      real(wp) :: residual_cohesion = 0.0_wp, residual_friction = 0.0_wp
      !> Tangent of the angle of dilation; only for `slip_resultant`
      real(wp) :: dilation = 0.0_wp
      !> Width that the joint stands open before it is loaded [length]
      real(wp) :: gap = 0.0_wp
      !> Normal stress before loading, in equilibrium with what is not modelled
      real(wp) :: initial_stress = 0.0_wp
      !> Tension over which cohesion fades at most where it must, as a share of it: 1, or that of an
      !> opening of C h/E, by which C deforms the bodies beside the joint
      real(wp) :: edge = 1.0_wp
   end type joint_law_type

   !> What a point remembers from the last increment in equilibrium
   type :: memory_type
      !> Relative displacement that is plastic: slip along xi and theta, dilation
      !> along eta
      real(wp) :: slip(3) = 0.0_wp
      !> Whether its bond is broken, and whether it has slipped so that it softened
      logical :: broken = .false., softened = .false.
   end type memory_type

contains

   !> Whether the stress admitted is the trial stress, cut back: then it may be accumulated over
   !> iterations, as in the paper. A law whose stress follows from the whole jump in another way
   !> must be iterated on total jumps
   elemental logical function cuts_back(law)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law

      cuts_back = law%kind == law_elastic .or. law%kind == law_paper
   end function cuts_back

   !> Whether a point loses shear stress at once when it opens, for all its tension is released then
   elemental logical function loses_at_opening(law) result(loses)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law

      loses = law%kind == law_paper .and. law%cohesion > 0.0_wp .and. &
         law%opening == opening_reversible .and. .not. law%dilation > 0.0_wp
   end function loses_at_opening

   !> Stress admitted by a point that has no memory
   pure function admit_stress(law, trial) result(stress)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Trial stress: tau_xi, sigma (tension positive), tau_theta
      real(wp), intent(in) :: trial(3)
      !> Stress that the law admits, same components
      real(wp) :: stress(3)

      real(wp) :: tangent(3, 3)

      call admit(law, memory_type(), trial, stress, tangent)
   end function admit_stress

   !> Elastic stress of a relative displacement, less what is plastic of it; the
   !> gap must close before there is pressure
   pure function trial_stress(law, memory, jump) result(trial)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Memory of the point
      type(memory_type), intent(in) :: memory
      !> Relative displacement xi, eta, theta
      real(wp), intent(in) :: jump(3)
      !> tau_xi, sigma, tau_theta
      real(wp) :: trial(3)

      trial(xi) = law%stiffness(xi)*(jump(xi) - memory%slip(xi))
      trial(eta) = law%stiffness(eta)*(jump(eta) - memory%slip(eta) + law%gap) + law%initial_stress
      trial(theta) = law%stiffness(theta)*(jump(theta) - memory%slip(theta))
   end function trial_stress

   !> Stress admitted for a trial stress, and its derivatives. Tension releases all
   !> stress unless a bond holds it; otherwise shear is cut to the yield stress
   !> C - sigma tan(phi) (Eq. 16), C under tension. Dilation may press a point whose
   !> trial stress is tension: it slides up on its asperities. A law that loses its
   !> cohesion at once may have no state with equilibrium; then cohesion fades over
   !> a small tension of the trial stress, and with it no normal stress is left.
   pure subroutine admit(law, memory, trial, stress, tangent, fading)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Memory of the point
      type(memory_type), intent(in) :: memory
      !> Trial stress: tau_xi, sigma (tension positive), tau_theta
      real(wp), intent(in) :: trial(3)
      !> Stress that the law admits, same components
      real(wp), intent(out) :: stress(3)
      !> Derivatives of the stress by the trial stress
      real(wp), intent(out) :: tangent(3, 3)
      !> Tension over which cohesion fades, as a share of the `edge`; at once if absent
      real(wp), intent(in), optional :: fading

      real(wp) :: friction, cohesion, span
      logical :: tension

      span = 0.0_wp
      if (present(fading) .and. loses_at_opening(law)) span = fading*law%edge*law%cohesion
      call strength(law, memory, cohesion, friction)
      tension = trial(eta) > 0.0_wp
      if (tension .and. law%dilation > 0.0_wp) then
         call cut(law, cohesion, friction, trial, stress, tangent)
         tension = stress(eta) > 0.0_wp
      end if
      if (law%kind == law_elastic .or. .not. tension) then
         call cut(law, cohesion, friction, trial, stress, tangent)
      else if (trial(eta) < span .and. .not. memory%broken) then
         call cut(law, cohesion, cohesion/span, trial, stress, tangent)
         stress(eta) = 0.0_wp
         tangent(eta, :) = 0.0_wp
      else if (law%opening == opening_reversible .or. memory%broken) then
         stress = 0.0_wp
         tangent = 0.0_wp
      else
         call cut(law, cohesion, 0.0_wp, trial, stress, tangent)  ! the bond in tension
      end if
   end subroutine admit

   !> Cut the shear stress to the yield stress, by the rule of the law
   pure subroutine cut(law, cohesion, friction, trial, stress, tangent)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> C and tan(phi)
      real(wp), intent(in) :: cohesion, friction
      !> Trial stress
      real(wp), intent(in) :: trial(3)
      !> Stress and derivatives
      real(wp), intent(out) :: stress(3), tangent(3, 3)

      integer :: i

      stress = trial
      tangent = reshape([1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp, 1.0_wp], &
         [3, 3])
      if (law%kind == law_elastic) return
      if (law%slip == slip_resultant) then
         call cut_resultant(law, cohesion, friction, trial, stress, tangent)
      else
         do i = xi, theta, theta - xi
            call cut_component(i, cohesion, friction, trial, stress, tangent)
         end do
      end if
   end subroutine cut

   !> Cohesion and tangent of the friction angle that are left to a point
   pure subroutine strength(law, memory, cohesion, friction)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Memory of the point
      type(memory_type), intent(in) :: memory
      !> C and tan(phi)
      real(wp), intent(out) :: cohesion, friction

      cohesion = law%cohesion
      friction = law%friction
      if (memory%softened) then
         cohesion = law%residual_cohesion
         friction = law%residual_friction
      end if
      if (memory%broken) cohesion = 0.0_wp
   end subroutine strength

   !> Shear stress that a point loses at once when it opens: what its cohesion carries then
   pure real(wp) function lost_at_opening(law, memory, trial) result(lost)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Memory of the point
      type(memory_type), intent(in) :: memory
      !> Trial stress
      real(wp), intent(in) :: trial(3)

      real(wp) :: cohesion, friction

      call strength(law, memory, cohesion, friction)
      lost = min(cohesion, maxval(abs(trial([xi, theta]))))
   end function lost_at_opening

   !> Cut one shear stress to the yield stress, its sign kept
   pure subroutine cut_component(i, cohesion, friction, trial, stress, tangent)
      !> Component
      integer, intent(in) :: i
      !> C and tan(phi)
      real(wp), intent(in) :: cohesion, friction
      !> Trial stress
      real(wp), intent(in) :: trial(3)
      !> Stress and derivatives, changed in this component
      real(wp), intent(inout) :: stress(3), tangent(3, 3)

      real(wp) :: yield

      yield = cohesion - trial(eta)*friction
      if (abs(trial(i)) <= yield) return
      stress(i) = sign(yield, trial(i))
      tangent(i, :) = 0.0_wp
      tangent(i, eta) = -sign(friction, trial(i))
   end subroutine cut_component

   !> Cut the resultant T of both shear stresses: tau = l T with l T = C - sigma
   !> tan(phi). Slip (1 - l) T/k widens the joint by tan(psi) times its length,
   !> which presses it: sigma falls by k_eta tan(psi) (1 - l) g, g = |T/k|.
   pure subroutine cut_resultant(law, cohesion, friction, trial, stress, tangent)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> C and tan(phi)
      real(wp), intent(in) :: cohesion, friction
      !> Trial stress
      real(wp), intent(in) :: trial(3)
      !> Stress and derivatives
      real(wp), intent(inout) :: stress(3), tangent(3, 3)

      real(wp) :: resultant, slip, widening, l, denominator
      real(wp), dimension(3) :: direction, slip_by, l_by
      integer, parameter :: shear(2) = [xi, theta]

      resultant = sqrt(trial(xi)**2 + trial(theta)**2)
      if (resultant <= max(0.0_wp, cohesion - trial(eta)*friction)) return
      direction = trial/resultant
      direction(eta) = 0.0_wp
      slip = 0.0_wp
      slip_by = 0.0_wp
      widening = law%stiffness(eta)*law%dilation
      if (widening > 0.0_wp) then
         where (law%stiffness(shear) > 0.0_wp)  ! along others there is no stress
            slip_by(shear) = trial(shear)/law%stiffness(shear)**2
         end where
         slip = sqrt(dot_product(slip_by, trial))
         if (slip > 0.0_wp) slip_by = slip_by/slip
      end if
      denominator = resultant + widening*friction*slip
      l = (cohesion - trial(eta)*friction + widening*friction*slip)/denominator
      l_by = (widening*friction*slip_by*(1.0_wp - l) - l*direction)/denominator
      l_by(eta) = -friction/denominator
      stress(shear) = l*trial(shear)
      stress(eta) = trial(eta) - widening*(1.0_wp - l)*slip
      tangent(xi, :) = trial(xi)*l_by
      tangent(theta, :) = trial(theta)*l_by
      tangent(xi, xi) = tangent(xi, xi) + l
      tangent(theta, theta) = tangent(theta, theta) + l
      tangent(eta, :) = widening*(slip*l_by - (1.0_wp - l)*slip_by)
      tangent(eta, eta) = tangent(eta, eta) + 1.0_wp
   end subroutine cut_resultant

   !> Memory after an increment in equilibrium: what is not elastic of the
   !> displacement is plastic. A point that is open remembers where it stands, so
   !> that it carries no shear when it closes, but no opening.
   pure subroutine renew(law, trial, stress, memory)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Trial stress, and stress that was admitted
      real(wp), intent(in) :: trial(3), stress(3)
      !> The memory
      type(memory_type), intent(inout) :: memory

      integer :: i

      if (law%kind == law_elastic) return
      do i = xi, theta
         if (.not. law%stiffness(i) > 0.0_wp) cycle
         if (i == eta .and. trial(eta) > 0.0_wp .and. .not. abs(stress(eta)) > 0.0_wp) cycle
         memory%slip(i) = memory%slip(i) + (trial(i) - stress(i))/law%stiffness(i)
      end do
   end subroutine renew

   !> State of a point from the stress that it carries and its jump: open if
   !> apart without normal stress, slipping if a shear stress stands at yield
   pure function state_of(law, stress, jump, small, memory) result(state)
      !> Properties of the joint
      type(joint_law_type), intent(in) :: law
      !> Stress that the law admits: tau_xi, sigma, tau_theta
      real(wp), intent(in) :: stress(3)
      !> Relative displacement xi, eta, theta
      real(wp), intent(in) :: jump(3)
      !> Stress that counts as zero
      real(wp), intent(in) :: small
      !> Memory of the point; none if absent
      type(memory_type), intent(in), optional :: memory
      !> Stick, slip or open
      integer :: state

      type(memory_type) :: past
      real(wp) :: cohesion, friction, shear, yield

      state = state_stick
      if (law%kind == law_elastic) return
      if (present(memory)) past = memory
      call strength(law, past, cohesion, friction)
      shear = max(abs(stress(xi)), abs(stress(theta)))
      if (law%slip == slip_resultant) shear = sqrt(stress(xi)**2 + stress(theta)**2)
      yield = cohesion - min(stress(eta), 0.0_wp)*friction
      if (abs(stress(eta)) <= small .and. shear <= small .and. jump(eta) + law%gap > 0.0_wp) then
         state = state_open
      else if (shear >= yield - small .and. maxval(abs(stress)) > small) then
         state = state_slip
      end if
   end function state_of

end module axijoint_element_joint_law
