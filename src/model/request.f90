!> Where a deck asks for results: along lines, on cuts z = const, on supported faces,
!> on the body swept through a range of theta
module axijoint_model_request
   use axijoint_base_kinds, only : wp, pi
   use axijoint_model_strips, only : strip_type
   implicit none
   private
   public :: line_type, line_point_type, point_type, cut_type, supported_face_type, sweep_type, &
      error_goal_type, refinement_type, keep_type, default_keep, is_kept, cards_about, rows_expected
   public :: keep_series, keep_displacement, keep_joints, keep_stress, keep_names
   public :: which_all, which_every, which_last, which_only, which_names
   public :: print_type, print_names, usual_rows
   public :: print_deck, print_nodes, print_elements, print_joints, print_loads, print_path, &
      print_amplitude, print_totals, print_stresses, print_nodal, print_states, print_reactions, &
      print_orders, print_all
   public :: rows_all, rows_every, rows_upto, rows_none, rows_names
   public :: old_output, most_output
   public :: goal_joints, goal_displacement, goal_energy, goal_points, goal_cuts, goal_sections, &
      goal_names
   public :: division_graded, division_uniform, division_names

   !> What the error of a job may be asked of: of joint stress, of displacements, of the
   !> stresses in the energy norm, of displacements at points with names, of resultants on cuts, of stresses along lines
   integer, parameter :: goal_joints = 1, goal_displacement = 2, goal_energy = 3, goal_points = 4, goal_cuts = 5, &
      goal_sections = 6
   !> Their names on the card
   character(len=8), parameter :: goal_names(6) = [character(len=8) :: 'JOINTS', 'DISPL', 'ENERGY', 'POINTS', 'CUTS', 'SECTIONS']
   !> How BLOCKS are refined: elements where the error is; all alike
   integer, parameter :: division_graded = 1, division_uniform = 2
   !> Their words in a deck
   character(len=7), parameter :: division_names(2) = [character(len=7) :: 'GRADED', 'UNIFORM']

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

   !> What is kept of increments: resultants and energies, displacements, joints, stresses
   integer, parameter :: keep_series = 1, keep_displacement = 2, keep_joints = 3, keep_stress = 4
   !> Their names on cards
   character(len=8), parameter :: keep_names(4) = &
      [character(len=8) :: 'SERIES', 'DISPLACE', 'JOINTS', 'STRESSES']
   !> Of which increments: all, every n-th, the last, those named; always of the last, too
   integer, parameter :: which_all = 1, which_every = 2, which_last = 3, which_only = 4
   !> Their names on cards
   character(len=5), parameter :: which_names(4) = &
      [character(len=5) :: 'ALL', 'EVERY', 'LAST', 'ONLY']

   !> Of which increments something is kept
   type :: keep_type
      !> One of the `which_` parameters
      integer :: which = which_all
      !> Every so many increments
      integer :: every = 1
      !> Those that are named
      integer, allocatable :: named(:)
   end type keep_type

   !> Tables of the listing that grow with the job: deck, mesh, loads, convergence path, amplitudes
   !> of displacement, totals at angles, stresses at Gauss points and nodes, joint points on planes,
   !> reactions; orders of the nodes side by side, whose rows are the nodes; all of them
   integer, parameter :: print_deck = 1, print_nodes = 2, print_elements = 3, print_joints = 4, &
      print_loads = 5, print_path = 6, print_amplitude = 7, print_totals = 8, print_stresses = 9, &
      print_nodal = 10, print_states = 11, print_reactions = 12, print_orders = 13, print_all = 14
   !> Their names on cards: no keywords, which cards of data must not begin with
   character(len=10), parameter :: print_names(print_all) = [character(len=10) :: 'DECK', &
      'COORDS', 'INCIDENCE', 'JOINTNODES', 'LOADS', 'PATH', 'AMPLITUDE', 'TOTALS', 'STRESSES', &
      'NODAL', 'STATES', 'REACTIONS', 'ORDERS', 'TABLES']
   !> Rows of a table that are listed: all, every n-th, all if they are n at most, none
   integer, parameter :: rows_all = 1, rows_every = 2, rows_upto = 3, rows_none = 4
   !> Their names on cards
   character(len=5), parameter :: rows_names(4) = &
      [character(len=5) :: 'ALL', 'EVERY', 'UPTO', 'NONE']
   !> Rows of a table that is listed whole unless the deck says otherwise
   integer, parameter :: usual_rows = 1000

   !> Rows of a table of the listing that are wanted
   type :: print_type
      !> The table, one of the `print_` parameters, and its rows, one of the `rows_` parameters
      integer :: what = print_all, which = rows_upto
      !> n of every n-th row, or most rows
      integer :: n = usual_rows
      !> Body that they belong to; 0 for any
      integer :: body = 0
      !> Least and largest r and z of their places
      real(wp) :: least(2) = -huge(1.0_wp), largest(2) = huge(1.0_wp)
   end type print_type

   !> Most that a listing in an old layout shows of an increment: NOUTP 0 nothing, 1 displacements,
   !> 2 reactions, too, 3 stresses, too
   integer, parameter :: most_output = 3

   !> A point with a name, whose displacements are followed
   type :: point_type
      !> The user's number
      integer :: label = 0
      !> The name
      character(len=16) :: name = ''
      !> r and z
      real(wp) :: position(2) = 0.0_wp
      !> Body; 0 for any
      integer :: body = 0
      !> Nodes of the element that it is in, and their shape functions there
      integer, allocatable :: nodes(:)
      real(wp), allocatable :: shape(:)
   end type point_type

   !> A cut z = const, whose resultants are wanted
   type :: cut_type
      !> The user's number
      integer :: label = 0
      !> Where
      real(wp) :: z = 0.0_wp
      !> Body that is cut; 0 for all
      integer :: body = 0
      !> The card that asks for it, from 1
      integer :: card = 0
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
      !> Whether the mesh can be refined, too; how, one of the `division_` parameters
      logical :: mesh_too = .false.
      integer :: division = division_graded
      !> Whether all of the mesh is of a mesh file, so that a mesh with other sizes of elements would
      !> be the same job; the file of its geometry for Gmsh, empty if the deck names none
      logical :: remesh = .false.
      character(len=:), allocatable :: geometry
   end type error_goal_type

   !> How a job is refined beyond what its deck says
   type :: refinement_type
      !> Elements of BLOCKS along each side, times so many; on the average, if they are graded
      real(wp) :: mesh = 1.0_wp
      !> How strips of BLOCKS are divided; not allocated if as the cards say, times `mesh`
      type(strip_type), allocatable :: strips(:)
      !> Whether BLOCKS of 4-node elements are made of 8-node elements
      logical :: quadratic = .false.
      !> Size of elements wanted at each node of the mesh that was solved; not allocated if the mesh
      !> is not to be made anew
      real(wp), allocatable :: sizes(:)
      !> File of the mesh and its hash; not allocated for that of the deck
      character(len=:), allocatable :: mesh_file, mesh_hash
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

contains

   !> What is kept unless the job says otherwise: all, stresses of the last increment alone
   pure function default_keep() result(keep)
      !> In the order of `keep_names`
      type(keep_type) :: keep(size(keep_names))

      keep%which = which_all
      keep%every = 1
      keep(keep_stress)%which = which_last
   end function default_keep

   !> Whether something of an increment is kept
   elemental logical function is_kept(keep, increment, last)
      !> Of which increments it is
      type(keep_type), intent(in) :: keep
      !> The increment, and the last
      integer, intent(in) :: increment, last

      is_kept = increment == last
      select case (keep%which)
       case (which_all)
         is_kept = .true.
       case (which_every)
         is_kept = is_kept .or. mod(increment, keep%every) == 0
       case (which_only)
         is_kept = is_kept .or. any(keep%named == increment)
      end select
   end function is_kept

   !> What a listing in an old layout shows of an increment, NOUTP; all unless the deck says less
   pure integer function old_output(asked, increment)
      !> What the deck says, one value an increment; nothing if absent
      integer, intent(in), optional :: asked(:)
      !> The increment
      integer, intent(in) :: increment

      old_output = most_output
      if (present(asked)) old_output = asked(increment)
   end function old_output

   !> What a deck says of a table of the listing, else of all tables, else what is usual: orders that no solver takes
   !> are for who asks for them
   pure function cards_about(print, what) result(cards)
      !> What it says of all tables; nothing if absent
      type(print_type), intent(in), optional :: print(:)
      !> The table, one of the `print_` parameters
      integer, intent(in) :: what
      !> At least one
      type(print_type), allocatable :: cards(:)

      allocate (cards(0))
      if (present(print)) then
         cards = pack(print, print%what == what)
         if (size(cards) == 0) cards = pack(print, print%what == print_all)
      end if
      if (size(cards) == 0) cards = [print_type(what, merge(rows_none, rows_upto, what == print_orders), usual_rows)]
   end function cards_about

   !> Rows of a table that are listed, at most: those of a body or a rectangle are counted as if it
   !> were all there is
   pure real(wp) function rows_expected(print, what, n) result(rows)
      !> What the deck says of all tables; nothing if absent
      type(print_type), intent(in), optional :: print(:)
      !> The table, one of the `print_` parameters
      integer, intent(in) :: what
      !> Its rows
      real(wp), intent(in) :: n

      type(print_type), allocatable :: cards(:)
      integer :: k

      cards = cards_about(print, what)
      rows = 0.0_wp
      do k = 1, size(cards)
         select case (cards(k)%which)
          case (rows_all)
            rows = n
          case (rows_every)
            rows = max(rows, n/cards(k)%n)
          case (rows_upto)
            if (n <= cards(k)%n) rows = n
         end select
      end do
   end function rows_expected

end module axijoint_model_request
