!> Parts of a mesh and their rigid motions
module axijoint_assembly_rigid_motion
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, is_torsion, mode_name
   use axijoint_model_mesh, only : mesh_type, n_elements, n_nodes
   implicit none
   private
   public :: solid_parts, frame_of, rigid_motion, motion_name

   !> Rigid motions of a part in harmonic 1: sideways and tilting; in harmonic 0
   !> only the first is in use: along z, or about z in torsion
   integer, parameter, public :: max_motions = 2

contains

   !> Number the parts of the mesh that solid elements hold together
   subroutine solid_parts(mesh, part)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Part of each node, from 1; a node of no element is a part of its own
      integer, allocatable, intent(out) :: part(:)

      integer :: element, k, node, root(n_nodes(mesh)), count

      root = [(node, node = 1, n_nodes(mesh))]
      do element = 1, n_elements(mesh)
         associate (nodes => mesh%element_nodes(:mesh%element_size(element), element))
            do k = 2, size(nodes)
               root(find(nodes(k))) = find(nodes(1))
            end do
         end associate
      end do
      allocate (part(n_nodes(mesh)), source=0)
      count = 0
      do node = 1, n_nodes(mesh)
         associate (top => find(node))
            if (part(top) == 0) then
               count = count + 1
               part(top) = count
            end if
            part(node) = part(top)
         end associate
      end do

   contains

      !> Root of a node; halves the path on its way
      integer function find(start)
         !> Node
         integer, intent(in) :: start

         find = start
         do while (root(find) /= find)
            root(find) = root(root(find))
            find = root(find)
         end do
      end function find

   end subroutine solid_parts


   !> Height z that motions tilt about, and the length that heights and radii are measured in
   pure function frame_of(mesh) result(frame)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Both
      real(wp) :: frame(2)

      associate (x => mesh%coordinates)
         frame(1) = 0.5_wp*(minval(x(2, :)) + maxval(x(2, :)))
         frame(2) = max(maxval(x(1, :)), maxval(x(2, :)) - minval(x(2, :)))
      end associate
   end function frame_of

   !> A rigid motion in words
   pure function motion_name(mode, place, with_family) result(name)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Place of the motion in the resistance matrix
      integer, intent(in) :: place
      !> Whether the family matters
      logical, intent(in) :: with_family
      !> Words
      character(len=:), allocatable :: name

      if (is_torsion(mode)) then
         name = ' is free to turn about z (torsion)'
      else if (mode%harmonic == 0) then
         name = ' is free to move along z (harmonic 0)'
      else
         name = ' is free to '//trim(merge('move sideways', 'tilt         ', &
            mod(place, max_motions) == 1))
         if (with_family) then
            name = name//' (harmonic '//mode_name(mode)//')'
         else
            name = name//' (harmonic 1)'
         end if
      end if
   end function motion_name


   !> Displacement components of a node in the rigid motions of its part
   pure function rigid_motion(mesh, frame, mode, node) result(motion)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> As `frame_of` gives it
      real(wp), intent(in) :: frame(2)
      !> Mode of harmonic 0 or 1
      type(mode_type), intent(in) :: mode
      !> Node
      integer, intent(in) :: node
      !> u, v, w in each motion, shape (3, max_motions); lengths are made
      !> dimensionless with the extent of the mesh
      real(wp) :: motion(3, max_motions)

      motion = 0.0_wp
      if (is_torsion(mode)) then
         motion(3, 1) = mesh%coordinates(1, node)/frame(2)
      else if (mode%harmonic == 0) then
         motion(2, 1) = 1.0_wp
      else
         associate (x => (mesh%coordinates(:, node) - [0.0_wp, frame(1)])/frame(2))
            motion(:, 1) = [1.0_wp, 0.0_wp, -1.0_wp]
            motion(:, 2) = [-x(2), x(1), x(2)]
         end associate
      end if
   end function rigid_motion


end module axijoint_assembly_rigid_motion
