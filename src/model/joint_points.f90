!> Integration points of all joints of a model
module axijoint_model_joint_points
   use axijoint_base_kinds, only : wp
   use axijoint_element_joint, only : joint_point_type, new_joint_point, lower_node
   use axijoint_element_joint_law, only : joint_law_type, law_elastic
   use axijoint_fe_quadrature, only : gauss_rule, lobatto_rule
   use axijoint_model_joint_sides, only : elements_beside, moduli_beside, least_modulus
   use axijoint_model_material, only : joint_material_type, rule_centroid, rule_gauss
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: model_joint_point_type, new_joint_points, joint_rule, stiffness_ratio, law_at, stiffest_whole, stiffest_sliding, &
      in_structure

   !> k h/E up to which joints that can yield act in the structure with their whole stiffness, and what stiffer ones have there. What
   !> these do beyond that is left to the iteration on their laws: a structure that is condensed with stiff joints loses what the
   !> bodies do when these open to rounding. Joints that are a little stiffer than their part of the structure would cost as much as
   !> rigid ones: the linear solutions are of all points then, not of those alone that slip or open
   real(wp), parameter :: stiffest_whole = 1.0e4_wp, stiffest_base = 1.0e3_wp
   !> k h/E up to which estimates of errors follow how joints slide; stiffer ones move too little on their own
   real(wp), parameter :: stiffest_sliding = 1.0e3_wp

   !> A joint point in its model
   type, extends(joint_point_type) :: model_joint_point_type
      !> Joint (index) and its material (index)
      integer :: joint = 0, material = 0
      !> Nodes of the joint, the first 2 n_pairs of which are in use
      integer :: nodes(6) = 0
      !> Stiffness of its law along xi, eta, theta; where that is as good as rigid, as much of it as counts [stress/length]
      real(wp) :: stiffness(3) = 0.0_wp
      !> The same in proportion to the bodies, k h/E
      real(wp) :: proportion = 0.0_wp
      !> Stiffness along xi, eta, theta that the structure has there: k of the law or, of a joint
      !> that can yield and is much stiffer than the bodies, less [stress/length]
      real(wp) :: base(3) = 0.0_wp
      !> Elements at side 1-2 and at side 4-3
      integer :: elements(2) = 0
   end type model_joint_point_type

contains

   !> Points of all joints, joint by joint
   pure function new_joint_points(model, rule) result(points)
      !> The job
      type(model_type), intent(in) :: model
      !> Rule in place of those of the laws
      integer, intent(in), optional :: rule
      !> The points
      type(model_joint_point_type), allocatable :: points(:)

      real(wp) :: x(3), w(3), side(2, 3), length, least
      real(wp) :: modulus(3, size(model%mesh%joint_label))
      integer :: elements(2, size(model%mesh%joint_label))
      integer :: joint, k, n, n_pairs, count

      allocate (points(3*size(model%mesh%joint_label)))
      count = 0
      elements = elements_beside(model%mesh)
      modulus = moduli_beside(model, elements)
      least = least_modulus(model)
      do joint = 1, size(model%mesh%joint_label)
         n_pairs = model%mesh%joint_size(joint)/2
         associate (nodes => model%mesh%joint_nodes(:, joint), &
                    material => model%mesh%joint_material(joint))
            side(:, :n_pairs) = model%mesh%coordinates(:, nodes(lower_node(:n_pairs)))
            if (present(rule)) then
               call joint_rule(rule, n_pairs, n, x, w)
            else
               call joint_rule(model%joint_materials(material)%rule, n_pairs, n, x, w)
            end if
            length = norm2(side(:, 2) - side(:, 1))
            do k = 1, n
               count = count + 1
               points(count)%joint_point_type = new_joint_point(side(:, :n_pairs), x(k), w(k))
               points(count)%joint = joint
               points(count)%material = material
               points(count)%nodes = nodes
               points(count)%elements = elements(:, joint)
               call set_stiffness(model%joint_materials(material), &
                  modulus(:, joint)/length, length/least, points(count))
            end do
         end associate
      end do
      points = points(:count)
   end function new_joint_points

   !> Points along a joint: as many as it has pairs of nodes, or one
   pure subroutine joint_rule(rule, n_pairs, n, x, w)
      !> One of the `rule_` parameters
      integer, intent(in) :: rule
      !> Pairs of nodes
      integer, intent(in) :: n_pairs
      !> Number of points
      integer, intent(out) :: n
      !> Points and weights on [-1, 1], the first n
      real(wp), intent(out) :: x(3), w(3)

      n = merge(1, n_pairs, rule == rule_centroid)
      if (rule == rule_centroid .or. rule == rule_gauss) then
         call gauss_rule(n, x, w)
      else
         call lobatto_rule(n, x, w)
      end if
   end subroutine joint_rule

   !> Stiffness of a joint that counts, what it is in proportion to the bodies, and in the structure
   pure subroutine set_stiffness(material, beside, flexibility, point)
      !> Material of the joint
      type(joint_material_type), intent(in) :: material
      !> Moduli of the softer body beside the joint over its length, E/h along xi, eta, theta, and its length over the least modulus
      !> of all bodies
      real(wp), intent(in) :: beside(3), flexibility
      !> The point
      type(model_joint_point_type), intent(inout) :: point

      logical :: can_yield

      can_yield = material%law%kind /= law_elastic
      point%stiffness = material%law%stiffness
      if (can_yield) point%stiffness = min(point%stiffness, material%rigid*beside)
      point%proportion = maxval(point%stiffness)*flexibility
      point%base = point%stiffness
      if (can_yield .and. point%proportion > stiffest_whole) &
         point%base = in_structure(point%proportion)/point%proportion*point%stiffness
   end subroutine set_stiffness

   !> k h/E that a joint which can yield has in the structure
   elemental real(wp) function in_structure(proportion)
      !> k h/E of the joint
      real(wp), intent(in) :: proportion

      in_structure = merge(stiffest_base, proportion, proportion > stiffest_whole)
   end function in_structure

   !> Law of a joint point, with the stiffness that counts
   elemental function law_at(point, material) result(law)
      !> The point
      type(model_joint_point_type), intent(in) :: point
      !> Material of its joint
      type(joint_material_type), intent(in) :: material
      !> The law
      type(joint_law_type) :: law

      law = material%law
      law%stiffness = point%stiffness
   end function law_at

   !> Stiffness of the joints in proportion to the bodies: the largest k h/E, with
   !> the length h of a joint and the least modulus E of the elements
   pure real(wp) function stiffness_ratio(points) result(ratio)
      !> Joint points
      type(model_joint_point_type), intent(in) :: points(:)

      ratio = maxval([0.0_wp, points%proportion])
   end function stiffness_ratio

end module axijoint_model_joint_points
