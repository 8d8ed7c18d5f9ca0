!> How far in-situ stress is out of balance: the findings. What the program looks for is in
!> in_situ_balance.f90
module axijoint_analysis_core_in_situ
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: in_situ_type, in_situ_part_type, in_situ_boundary_type, misfit_type
   public :: larger_misfit

   !> What is out of balance by more than the first part is told; by more than the second it is an
   !> error, unless the card says that it is meant
   real(wp), parameter, public :: told_share = 0.01_wp, refused_share = 0.5_wp

   !> Of two alike, by less than this part, the first is told, whatever rounding says
   real(wp), parameter, public :: alike = 1.0e-9_wp

   !> A traction of in-situ stress at a node that no support, joint or load takes
   type :: misfit_type
      !> Relative
      real(wp) :: share = 0.0_wp
      !> The traction [stress]
      real(wp) :: traction = 0.0_wp
      !> Node, and direction: 1 along r, 2 along z
      integer :: node = 0, direction = 0
      !> Increment at whose end it is
      integer :: increment = 0
   end type misfit_type

   !> A part of the mesh that solid elements hold together
   type :: in_situ_part_type
      !> A node of it, and its body
      integer :: node = 0, body = 0
      !> Whether it has in-situ stress of its own, and whether that is meant to be out of balance
      logical :: has_stress = .false., meant = .false.
      !> Card that gives its in-situ stress; 0 if it has none
      integer :: card = 0
      !> Largest in-situ stress, of sigma_r and sigma_z [stress]
      real(wp) :: largest = 0.0_wp
      !> Difference of gamma and weight, over the larger of both; of the material where it is
      !> largest
      real(wp) :: weight_share = 0.0_wp
      !> That material (index), its growth of sigma_z with z and its weight [stress/length],
      !> increment
      integer :: material = 0
      real(wp) :: gamma = 0.0_wp, weight = 0.0_wp
      integer :: weight_increment = 0
      !> Largest traction that nothing takes, over the largest in-situ stress of the part along its
      !> direction; and the largest over the stress at its place
      type(misfit_type) :: on_whole, on_place
      !> Largest in-situ stress with which joints press a part that has none [stress]
      real(wp) :: pressed = 0.0_wp
   end type in_situ_part_type

   !> A common boundary of two materials of a body whose in-situ stresses differ
   type :: in_situ_boundary_type
      !> The bodies, which are one or bonded, the lower first, and the materials (indices) in their order
      integer :: bodies(2) = 0, materials(2) = 0
      !> Largest jump of the traction on it [stress], and r and z of its place
      real(wp) :: jump = 0.0_wp, position(2) = 0.0_wp
      !> Largest traction on it [stress]
      real(wp) :: traction = 0.0_wp
      !> Increment at whose end it is
      integer :: increment = 0
      !> Whether it is meant, and a card that gives a stress beside it
      logical :: meant = .false.
      integer :: card = 0
   contains
      !> Jump over the largest traction
      procedure :: share => boundary_share
   end type in_situ_boundary_type

   !> All findings of one combination of load cases
   type :: in_situ_type
      !> Parts with in-situ stress and those that joints press with that of others; none without any
      type(in_situ_part_type), allocatable :: parts(:)
      !> Boundaries of materials
      type(in_situ_boundary_type), allocatable :: boundaries(:)
   end type in_situ_type

contains

   !> The larger of two tractions that nothing takes
   elemental type(misfit_type) function larger_misfit(a, b) result(larger)
      !> The tractions
      type(misfit_type), intent(in) :: a, b

      larger = a
      if (b%share > (1.0_wp + alike)*a%share) larger = b
   end function larger_misfit

   !> Jump over the largest traction on a boundary; 0 if there is none
   elemental real(wp) function boundary_share(self) result(share)
      !> The boundary
      class(in_situ_boundary_type), intent(in) :: self

      share = 0.0_wp
      if (self%traction > 0.0_wp) share = self%jump/self%traction
   end function boundary_share

end module axijoint_analysis_core_in_situ
