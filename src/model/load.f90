!> Loads as Fourier amplitudes, supports that yield, load cases and increments
module axijoint_model_load
   use axijoint_base_kinds, only : wp
   use axijoint_fe_circle_function, only : circle_function_type
   use axijoint_fe_mode, only : mode_type
   implicit none
   private
   public :: edge_load_type, ring_load_type, body_load_type, thermal_load_type, prescribed_type, &
      initial_stress_type, edge_support_type, load_case_type, combination_type, increment_type, &
      truncation_type, left_out_type, covers, is_stressed, scaled_stresses, stress_before
   public :: any_body, any_material

   !> An in-situ stress of all bodies, of all materials
   integer, parameter :: any_body = 0, any_material = 0

   !> Traction on one edge of a solid element
   type :: edge_load_type
      !> Harmonic and family
      type(mode_type) :: mode
      !> Load case (index)
      integer :: case = 1
      !> Nodes of the edge: first, last and, on a quadratic edge, middle (else 0)
      integer :: nodes(3) = 0
      !> Amplitudes of t_r, t_z, t_theta at these nodes [stress], shape (3, 3)
      real(wp) :: traction(3, 3) = 0.0_wp
   end type edge_load_type

   !> Load on a nodal circle
   type :: ring_load_type
      !> Harmonic and family
      type(mode_type) :: mode
      !> Load case (index)
      integer :: case = 1
      !> Node
      integer :: node = 0
      !> Generalized nodal forces: the work of the load over the whole circle on
      !> unit amplitudes of u, v, w [force]; a line load q per unit length
      !> gives pi r q (2 pi r q for m = 0)
      real(wp) :: force(3) = 0.0_wp
   end type ring_load_type

   !> Force on the mass of all solids: density times acceleration
   type :: body_load_type
      !> Harmonic and family
      type(mode_type) :: mode
      !> Load case (index)
      integer :: case = 1
      !> Amplitudes along r, z, theta [length/time^2]
      real(wp) :: acceleration(3) = 0.0_wp
      !> Square of the angular velocity: acceleration along r per radius [1/time^2]
      real(wp) :: spin_squared = 0.0_wp
   end type body_load_type

   !> Temperature change of the solids
   type :: thermal_load_type
      !> Harmonic and family: ~ cos or sin(m theta)
      type(mode_type) :: mode
      !> Load case (index)
      integer :: case = 1
      !> Body it is given for; 0 for all
      integer :: body = 0
      !> Amplitude at each node, shape (nodes); interpolated by the elements
      real(wp), allocatable :: temperature(:)
   end type thermal_load_type

   !> Displacement of a component that is held; other modes hold it at zero
   type :: prescribed_type
      !> Harmonic and family
      type(mode_type) :: mode
      !> Load case (index)
      integer :: case = 1
      !> Node, and component: 1 u, 2 v, 3 w
      integer :: node = 0, component = 0
      !> Amplitude [length]
      real(wp) :: value = 0.0_wp
   end type prescribed_type

   !> In-situ stress before all loads, symmetric of harmonic 0
   type :: initial_stress_type
      !> Load case (index)
      integer :: case = 1
      !> Body, or `any_body`; material (index), or `any_material`
      integer :: body = any_body, material = any_material
      !> sigma_r, sigma_z, sigma_theta, tau_rz at z = 0 [stress], and how they
      !> grow with z [stress/length]
      real(wp) :: stress(4) = 0.0_wp, gradient(4) = 0.0_wp
      !> Whether it is meant to be out of balance with weight, supports and joints
      logical :: meant = .false.
      !> Card of the deck that gives it, for messages; 0 if there is none
      integer :: card = 0
   end type initial_stress_type

   !> Springs between one edge of a solid element and the ground, in all modes
   type :: edge_support_type
      !> Nodes of the edge: first, last and, on a quadratic edge, middle (else 0)
      integer :: nodes(3) = 0
      !> Stiffness per area normal to the edge, along it in the meridional plane,
      !> and along theta [stress/length]
      real(wp) :: stiffness(3) = 0.0_wp
   end type edge_support_type

   !> Loads that act together
   type :: load_case_type
      !> The user's number
      integer :: label = 1
      !> The user's name for it; may be empty
      character(len=:), allocatable :: name
   end type load_case_type

   !> Load cases added with factors; each combination is solved and reported
   type :: combination_type
      !> The user's number
      integer :: label = 1
      !> Factor of each load case, shape (cases)
      real(wp), allocatable :: factor(:)
   end type combination_type

   !> What the harmonics in use leave of a load given as a function of theta
   type :: truncation_type
      !> The load in words
      character(len=:), allocatable :: name
      !> Root mean square of what is left out, over that of the load; 1 if the
      !> load is concentrated in points
      real(wp) :: left_out = 0.0_wp
      !> Load case (index)
      integer :: case = 1
      !> How it goes round the circle; not allocated if it is concentrated in points
      type(circle_function_type), allocatable :: course
   end type truncation_type

   !> A harmonic up to M that is not in use, though loads have a part in it
   type :: left_out_type
      integer :: harmonic = 0
      !> Load case (index)
      integer :: case = 1
   end type left_out_type

   !> A load increment in the tradition of Owen and Hinton
   type :: increment_type
      !> Factor on the loads, added to the factors of earlier increments
      real(wp) :: factor = 1.0_wp
      !> Tolerance epsilon on the residual-force ratio of Eq. 17
      real(wp) :: tolerance = 1.0e-6_wp
      !> Most iterations
      integer :: max_iterations = 200
      !> Load case (index) that the factor belongs to; 0 for all
      integer :: case = 0
      !> Multiple of each load case that the factor belongs to, shape (cases); those of the
      !> combination if not allocated
      real(wp), allocatable :: direction(:)
      !> Whether the displacement is given that the factor gives elastic bodies, and the factor found
      logical :: steered = .false.
   end type increment_type

contains

   !> Whether an in-situ stress is one of the elements of a body and a material
   elemental logical function covers(state, body, material)
      !> The in-situ stress
      type(initial_stress_type), intent(in) :: state
      !> Body, and material (index)
      integer, intent(in) :: body, material

      covers = (state%body == any_body .or. state%body == body) &
         .and. (state%material == any_material .or. state%material == material)
   end function covers

   !> Whether an in-situ stress is not zero
   elemental logical function is_stressed(state)
      !> The in-situ stress
      type(initial_stress_type), intent(in) :: state

      is_stressed = any(abs(state%stress) > 0.0_wp) .or. any(abs(state%gradient) > 0.0_wp)
   end function is_stressed

   !> In-situ stresses times the factors of their load cases
   pure function scaled_stresses(states, factor) result(scaled)
      !> The in-situ stresses
      type(initial_stress_type), intent(in) :: states(:)
      !> Factor of each load case
      real(wp), intent(in) :: factor(:)
      !> The same, factors in them
      type(initial_stress_type) :: scaled(size(states))

      integer :: k

      scaled = states
      do k = 1, size(states)
         scaled(k)%stress = factor(states(k)%case)*states(k)%stress
         scaled(k)%gradient = factor(states(k)%case)*states(k)%gradient
      end do
   end function scaled_stresses

   !> In-situ stress of a body and a material at a height z
   pure function stress_before(states, body, material, z) result(stress)
      !> The in-situ stresses, factors of the load cases in them
      type(initial_stress_type), intent(in) :: states(:)
      !> Body, and material (index)
      integer, intent(in) :: body, material
      !> z
      real(wp), intent(in) :: z
      !> sigma_r, sigma_z, sigma_theta, tau_rz
      real(wp) :: stress(4)

      integer :: k

      stress = 0.0_wp
      do k = 1, size(states)
         if (covers(states(k), body, material)) &
            stress = stress + states(k)%stress + z*states(k)%gradient
      end do
   end function stress_before

end module axijoint_model_load
