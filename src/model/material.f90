!> Properties of solids and joints
module axijoint_model_material
   use axijoint_base_kinds, only : wp
   use axijoint_element_elasticity, only : isotropic_elasticity, orthotropic_elasticity, &
      directional_expansion
   use axijoint_element_joint_law, only : joint_law_type
   use axijoint_element_yield_law, only : yield_law_type
   implicit none
   private
   public :: solid_material_type, joint_material_type, elasticity, thermal_strain
   public :: rule_centroid, rule_gauss, rule_lobatto, rule_names

   !> One point at the middle of a joint (Eq. 13, the paper's rule)
   integer, parameter :: rule_centroid = 1
   !> Gauss points along a joint
   integer, parameter :: rule_gauss = 2
   !> Points at the nodes of a joint
   integer, parameter :: rule_lobatto = 3
   !> Their names on cards and in the listing
   character(len=8), parameter :: rule_names(3) = &
      [character(len=8) :: 'CENTROID', 'GAUSS', 'LOBATTO']

   !> Elastic solid. Directions 1 and 2 lie in the meridional plane, 3 is theta
   type :: solid_material_type
      !> The user's number
      integer :: label = 0
      !> Whether the constants differ with the direction
      logical :: orthotropic = .false.
      !> Young's modulus E and Poisson's ratio of an isotropic solid [stress, 1]
      real(wp) :: young = 0.0_wp, poisson = 0.0_wp
      !> E_1, E_2, E_3 of an orthotropic solid [stress]
      real(wp) :: moduli(3) = 0.0_wp
      !> nu_12, nu_23, nu_13: contraction along the second direction under stress
      !> along the first, nu_ij/E_i = nu_ji/E_j
      real(wp) :: ratios(3) = 0.0_wp
      !> G_12, G_23, G_13 [stress]
      real(wp) :: shears(3) = 0.0_wp
      !> Angle from r to direction 1, counterclockwise in the (r, z) plane [radian]
      real(wp) :: angle = 0.0_wp
      !> Mass density [mass/volume]
      real(wp) :: density = 0.0_wp
      !> Thermal expansion along 1, 2, 3 [1/temperature]
      real(wp) :: expansion(3) = 0.0_wp
      !> How it yields; not, unless a card says so
      type(yield_law_type) :: yield
   end type solid_material_type

   !> Joint: its law and the points where the law is checked
   type :: joint_material_type
      !> The user's number
      integer :: label = 0
      !> Integration rule, one of the `rule_` parameters
      integer :: rule = rule_gauss
      !> Law with its constants
      type(joint_law_type) :: law
      !> k h/E, with the softer of the bodies beside a joint, from which on one that can yield counts as rigid: more
      !> moves the bodies by next to nothing, and takes the digits that tell how joints open
      real(wp) :: rigid = 1.0e5_wp
   end type joint_material_type

contains

   !> Elasticity matrix of a solid: stress = D strain, both in the order r, z,
   !> theta, rz, r-theta, z-theta
   pure function elasticity(material) result(d)
      !> The solid
      type(solid_material_type), intent(in) :: material
      !> The matrix [stress]
      real(wp) :: d(6, 6)

      if (material%orthotropic) then
         d = orthotropic_elasticity(material%moduli, material%ratios, material%shears, &
                                    material%angle)
      else
         d = isotropic_elasticity(material%young, material%poisson)
      end if
   end function elasticity

   !> Strain of a solid per degree of temperature, in the same order
   pure function thermal_strain(material) result(strain)
      !> The solid
      type(solid_material_type), intent(in) :: material
      !> The strain [1/temperature]; r-theta and z-theta are zero
      real(wp) :: strain(6)

      strain = directional_expansion(material%expansion, material%angle)
   end function thermal_strain

end module axijoint_model_material
