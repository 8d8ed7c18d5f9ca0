!> Properties of solids and joints
module axijoint_model_material
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint_law, only : joint_law_type
   implicit none
   private
   public :: solid_material_type, joint_material_type
   public :: rule_centroid, rule_gauss, rule_lobatto

   !> One point at the middle of a joint (Eq. 13, the paper's rule)
   integer, parameter :: rule_centroid = 1
   !> Gauss points along a joint
   integer, parameter :: rule_gauss = 2
   !> Points at the nodes of a joint
   integer, parameter :: rule_lobatto = 3

   !> Isotropic elastic solid
   type :: solid_material_type
      !> The user's number
      integer :: label = 0
      !> Young's modulus E [stress]
      real(wp) :: young = 0.0_wp
      !> Poisson's ratio
      real(wp) :: poisson = 0.0_wp
   end type solid_material_type

   !> Joint: its law and the points where the law is checked
   type :: joint_material_type
      !> The user's number
      integer :: label = 0
      !> Integration rule, one of the `rule_` parameters
      integer :: rule = rule_gauss
      !> Law with its constants
      type(joint_law_type) :: law
   end type joint_material_type

end module axijoint_model_material
