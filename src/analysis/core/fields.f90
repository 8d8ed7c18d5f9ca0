!> The fields of one state: displacements, and all that follows from them and the joints
module axijoint_analysis_core_fields
   use axijoint_analysis_core_plastic_fields, only : plastic_fields_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   implicit none
   private
   public :: fields_type, peak_type, nodal_stress_type
   public :: axial, lateral, moment, torque, lateral_90, moment_90, n_resultants

   !> Index of a resultant: force along z
   integer, parameter :: axial = 1
   !> Index of a resultant: force along theta = 0
   integer, parameter :: lateral = 2
   !> Index of a resultant: moment about the line theta = pi/2 through the
   !> origin; positive lifts the side theta = 0 towards +z, as the MOMENT load
   integer, parameter :: moment = 3
   !> Index of a resultant: moment about z
   integer, parameter :: torque = 4
   !> Indices of resultants: force along theta = 90 degrees, and the moment that
   !> lifts that side
   integer, parameter :: lateral_90 = 5, moment_90 = 6
   !> Number of resultants
   integer, parameter :: n_resultants = 6

   !> An extreme value and where it stands
   type :: peak_type
      !> The value; negative if there is none
      real(wp) :: value = -1.0_wp
      !> Index of the node or joint point; 0 if there is none
      integer :: place = 0
      !> Angle theta [radian]
      real(wp) :: angle = 0.0_wp
   end type peak_type

   !> Stresses smoothed to the nodes. A node has a value for each material that it
   !> touches: stresses jump from one to the other. Joints have nodes of their own
   !> on both sides
   type :: nodal_stress_type
      !> Node and material (indices) of each value, ascending
      integer, allocatable :: node(:), material(:)
      !> Value of each node of each element, shape (max_element_nodes, elements);
      !> zeros beyond
      integer, allocatable :: value_of(:, :)
      !> Amplitudes in the order of the stresses at the Gauss points, shape
      !> (6, values, modes)
      real(wp), allocatable :: amplitude(:, :, :)
   end type nodal_stress_type

   !> The fields. Amplitudes belong to a mode: u, v ~ cos(m theta),
   !> w ~ sin(m theta) in the symmetric family, ~ sin and -cos in the other.
   type :: fields_type
      !> Modes that were solved, ascending
      type(mode_type), allocatable :: modes(:)
      !> Displacement amplitudes u, v, w, shape (3, nodes, modes) [length]
      real(wp), allocatable :: displacement(:, :, :)
      !> Generalized reactions of fixed components and springs, shape (3, nodes, modes):
      !> work over the whole circle on unit amplitudes [force]
      real(wp), allocatable :: reaction(:, :, :)
      !> Loads on the nodes and reactions of fixed components, without those of springs: what does
      !> work, shape (3, nodes, modes) [force]
      real(wp), allocatable :: acting(:, :, :)
      !> Nodal forces that solids and springs take, in-situ stress and temperature included, same
      !> shape [force]
      real(wp), allocatable :: taken(:, :, :)
      !> Elastic energy of joints, beyond that of their stress in situ [force length]
      real(wp) :: joint_energy = 0.0_wp
      !> Element (index) of each solid Gauss point, ascending
      integer, allocatable :: point_element(:)
      !> r and z of each solid Gauss point, shape (2, points)
      real(wp), allocatable :: point_position(:, :)
      !> Stress amplitudes at solid Gauss points, shape (6, points, modes), in
      !> the order r, z, theta, rz (they go with u, v); r-theta, z-theta (with w)
      real(wp), allocatable :: stress(:, :, :)
      !> The same smoothed to the nodes
      type(nodal_stress_type) :: nodal
      !> Plastic strain and yield margin, if bodies can yield
      type(plastic_fields_type) :: plastic
      !> Angles of the planes of the joint results [radian]
      real(wp), allocatable :: plane_angles(:)
      !> Joint (index) of each joint point, ascending
      integer, allocatable :: joint_point_joint(:)
      !> r and z of each joint point, shape (2, joint points)
      real(wp), allocatable :: joint_point_position(:, :)
      !> Relative displacement xi, eta, theta, shape (3, joint points, planes) [length]
      real(wp), allocatable :: joint_jump(:, :, :)
      !> Its amplitudes, from those of the displacements, shape (3, joint points, modes) [length]
      real(wp), allocatable :: joint_amplitude(:, :, :)
      !> Joint stress tau_xi, sigma, tau_theta, shape (3, joint points, planes)
      real(wp), allocatable :: joint_stress(:, :, :)
      !> Stick, slip or open, shape (joint points, planes); `state_` parameters
      integer, allocatable :: joint_state(:, :)
      !> Largest pressure and largest shear stress of joints: on the planes of joints that open or slip; if there are none,
      !> anywhere round the circle
      type(peak_type) :: pressure, shear
      !> Residual-force ratio at the end (Eq. 17), from the whole structure
      real(wp) :: residual_ratio = 0.0_wp
      !> Resultants of the applied loads and of the reactions
      real(wp) :: applied(n_resultants) = 0.0_wp, reacted(n_resultants) = 0.0_wp
      !> Resultants of the stresses on the cuts of the deck, shape (n_resultants, cuts): of
      !> the part above a cut on the part below, moments about r = 0 at the cut
      real(wp), allocatable :: cut_resultants(:, :)
      !> Motions of the sections there, rotations with the signs of the moments, same shape [length,
      !> radian]
      real(wp), allocatable :: cut_motion(:, :)
      !> Resultants of what the body at side 4-3 of each joint exerts on that at side 1-2, moments
      !> about r = 0 at the middle of its height, shape (n_resultants, joints)
      real(wp), allocatable :: joint_resultants(:, :)
      !> Resultants of the reactions of each supported face, shape (n_resultants, faces)
      real(wp), allocatable :: face_reactions(:, :)
      !> A node of each part of the mesh that solid elements hold together
      integer, allocatable :: part_node(:)
      !> Resultants of the forces on each part that nothing balances, shape (n_resultants, parts)
      real(wp), allocatable :: part_unbalance(:, :)
      !> Largest sum of applied and reacted resultants, over those of the loads
      real(wp) :: equilibrium_error = 0.0_wp
      !> Largest unbalance of a part, over the resultants of the loads. Joint
      !> forces out of balance cancel in the whole, but not on the parts
      real(wp) :: part_error = 0.0_wp
   end type fields_type

end module axijoint_analysis_core_fields
