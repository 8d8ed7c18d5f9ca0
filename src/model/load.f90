!> Loads as Fourier amplitudes, and load increments
module axijoint_model_load
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: edge_load_type, ring_load_type, increment_type
   public :: family_symmetric, family_antisymmetric

   !> u, v ~ cos(m theta), w ~ sin(m theta)
   integer, parameter :: family_symmetric = 1
   !> u, v ~ sin(m theta), w ~ -cos(m theta)
   integer, parameter :: family_antisymmetric = 2

   !> Traction on one edge of a solid element
   type :: edge_load_type
      !> Harmonic m
      integer :: harmonic = 0
      !> Fourier family
      integer :: family = family_symmetric
      !> Nodes of the edge: first, last and, on a quadratic edge, middle (else 0)
      integer :: nodes(3) = 0
      !> Amplitudes of t_r, t_z, t_theta at these nodes [stress], shape (3, 3)
      real(wp) :: traction(3, 3) = 0.0_wp
   end type edge_load_type

   !> Load on a nodal circle
   type :: ring_load_type
      !> Harmonic m
      integer :: harmonic = 0
      !> Fourier family
      integer :: family = family_symmetric
      !> Node
      integer :: node = 0
      !> Generalized nodal forces: the work of the load over the whole circle on
      !> unit amplitudes of u, v, w [force]; a line load q per unit length
      !> gives pi r q (2 pi r q for m = 0)
      real(wp) :: force(3) = 0.0_wp
   end type ring_load_type

   !> A load increment in the tradition of Owen and Hinton
   type :: increment_type
      !> Factor on the loads, added to the factors of earlier increments
      real(wp) :: factor = 1.0_wp
      !> Tolerance epsilon on the residual-force ratio of Eq. 17
      real(wp) :: tolerance = 1.0e-6_wp
      !> Most iterations
      integer :: max_iterations = 200
   end type increment_type

end module axijoint_model_load
