!> Where a deck asks for results: along lines, on cuts z = const, on supported faces,
!> on the body swept through a range of theta
module axijoint_model_request
   use axijoint_base_kinds, only : wp, pi
   implicit none
   private
   public :: line_type, line_point_type, cut_type, supported_face_type, sweep_type

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

   !> A face that restraints, given displacements or springs hold
   type :: supported_face_type
      !> The user's number
      integer :: label = 0
      !> Its nodes, without those of faces before it
      integer, allocatable :: nodes(:)
   end type supported_face_type

end module axijoint_model_request
