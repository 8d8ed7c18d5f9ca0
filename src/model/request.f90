!> Where a deck asks for results: along lines, on cuts z = const, on supported faces
module axijoint_model_request
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: line_type, line_point_type, cut_type, supported_face_type

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

   !> A face that restraints, given displacements or springs hold
   type :: supported_face_type
      !> The user's number
      integer :: label = 0
      !> Its nodes, without those of faces before it
      integer, allocatable :: nodes(:)
   end type supported_face_type

end module axijoint_model_request
