!> Where a deck asks for results: along lines, on cuts z = const, on supported faces,
!> on the body swept through a range of theta
module axijoint_model_request
   use axijoint_base_kinds, only : wp, pi
   implicit none
   private
   public :: line_type, line_point_type, cut_type, supported_face_type, sweep_type, &
      error_goal_type, refinement_type
   public :: goal_joints, goal_displacement, goal_energy, goal_names

   !> What the error of a job may be asked of: of joint stress, of displacements, of the
   !> stresses in the energy norm
   integer, parameter :: goal_joints = 1, goal_displacement = 2, goal_energy = 3
   !> Their names on the card
   character(len=6), parameter :: goal_names(3) = [character(len=6) :: 'JOINTS', 'DISPL', 'ENERGY']

   !> A point of a line in an element
   type :: line_point_type
      !> Number of the point along the line, from 1
      integer :: number = 0
      !> r and z
      real(wp) :: position(2) = 0.0_wp
      !> Element (index), and natural coordinates in it
      integer :: element = 0
      real(wp) :: natural(2) = 0.0_wp
   end type line_point_type

   !> Equidistant points on a straight line in the meridional plane (a section)
   type :: line_type
      !> The user's number
      integer :: label = 0
      !> r and z of its ends
      real(wp) :: first(2) = 0.0_wp, last(2) = 0.0_wp
      !> Number of points
      integer :: n_points = 0
      !> Angles at which results are wanted [radian]
      real(wp), allocatable :: angles(:)
      !> The points that lie in elements, ascending by number. A point where bodies
      !> or materials meet is there once for each of them
      type(line_point_type), allocatable :: points(:)
   end type line_type

   !> A cut z = const, whose resultants are wanted
   type :: cut_type
      !> The user's number
      integer :: label = 0
      !> Where
      real(wp) :: z = 0.0_wp
      !> Body that is cut; 0 for all
      integer :: body = 0
   end type cut_type

   !> Range of theta that the bodies are swept through, for pictures
   type :: sweep_type
      !> Whether that is wanted
      logical :: wanted = .false.
      !> First and last angle [radian]
      real(wp) :: from = 0.0_wp, to = 2.0_wp*pi
      !> Number of sectors; 0 if the highest harmonic is to tell
      integer :: n_sectors = 0
   end type sweep_type

   !> The error that a job may have, and how far it may be refined for that
   type :: error_goal_type
      !> Whether there is one
      logical :: wanted = .false.
      !> Largest sum of the error budget, relative
      real(wp) :: target = 0.0_wp
      !> Of what, one of the `goal_` parameters
      integer :: quantity = 0
      !> Most rounds, and most unknowns in all
      integer :: most_rounds = 0, most_unknowns = 0
      !> Whether the mesh can be refined, too
      logical :: mesh_too = .false.
   end type error_goal_type

   !> How a job is refined beyond what its deck says
   type :: refinement_type
      !> Elements of BLOCKS along each side, times so many
      real(wp) :: mesh = 1.0_wp
      !> Whether BLOCKS of 4-node elements are made of 8-node elements
      logical :: quadratic = .false.
      !> Whether joints are brought to equilibrium by Newton's method, whatever CONTROL says
      logical :: newton = .false.
      !> M and the planes of CONTROL; zero for those of the deck
      integer :: harmonic = 0, planes = 0
      !> Factor on the tolerances of INCREMENTS
      real(wp) :: tolerance = 1.0_wp
   end type refinement_type

   !> A face that restraints, given displacements or springs hold
   type :: supported_face_type
      !> The user's number
      integer :: label = 0
      !> Its nodes, without those of faces before it
      integer, allocatable :: nodes(:)
   end type supported_face_type

end module axijoint_model_request
