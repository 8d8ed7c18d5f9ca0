!> Rigid motions of parts that nothing holds but joints which can open or slip
module axijoint_joints_floating
   use axijoint_assembly_force, only : joint_jump
   use axijoint_assembly_resistance, only : free_motions
   use axijoint_assembly_rigid_motion, only : solid_parts, frame_of, rigid_motion, max_motions
   use axijoint_assembly_support, only : support_point_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type
   use axijoint_model_joint_points, only : model_joint_point_type
   use axijoint_model_mesh, only : mesh_type, n_nodes
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: floating_motion_type, new_floating_motions, add_motions

   !> A rigid motion
   type :: floating_motion_type
      !> Place of its mode
      integer :: mode = 0
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), allocatable :: displacement(:, :)
      !> Relative displacements at the joint points that can yield, shape (3, points)
      real(wp), allocatable :: jump(:, :)
   end type floating_motion_type

contains

   !> Find the motions of all modes
   subroutine new_floating_motions(model, elastic, supports, modes, points, motions)
      !> The job
      type(model_type), intent(in) :: model
      !> Points of the joints that cannot yield, and of springs
      type(model_joint_point_type), intent(in) :: elastic(:)
      type(support_point_type), intent(in) :: supports(:)
      !> The modes; only those of harmonics 0 and 1 have rigid motions
      type(mode_type), intent(in) :: modes(:)
      !> Points of the joints that can yield
      type(model_joint_point_type), intent(in) :: points(:)
      !> The motions
      type(floating_motion_type), allocatable, intent(out) :: motions(:)

      type(floating_motion_type) :: motion
      real(wp), allocatable :: free(:, :)
      integer, allocatable :: part(:)
      integer :: k, i

      call solid_parts(model%mesh, part)
      allocate (motions(0))
      do k = 1, size(modes)
         if (modes(k)%harmonic > 1) exit
         call free_motions(model, elastic, supports, part, frame_of(model%mesh), modes(k), free)
         do i = 1, size(free, 2)
            motion%mode = k
            motion%displacement = displacement_of(model%mesh, part, modes(k), free(:, i))
            motion%jump = joint_jump(points, motion%displacement)
            motions = [motions, motion]
         end do
      end do
   end subroutine new_floating_motions

   !> Add motions to displacements
   pure subroutine add_motions(motions, multiple, displacement)
      !> The motions
      type(floating_motion_type), intent(in) :: motions(:)
      !> Multiple of each
      real(wp), intent(in) :: multiple(:)
      !> Displacement amplitudes, shape (3, nodes, modes)
      real(wp), intent(inout) :: displacement(:, :, :)

      integer :: k

      do k = 1, size(motions)
         associate (motion => motions(k))
            displacement(:, :, motion%mode) = displacement(:, :, motion%mode) + &
               multiple(k)*motion%displacement
         end associate
      end do
   end subroutine add_motions

   !> Displacements of a rigid motion
   pure function displacement_of(mesh, part, mode, multiple) result(displacement)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Part of each node
      integer, intent(in) :: part(:)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Multiples of the motions of all parts, shape (max_motions parts)
      real(wp), intent(in) :: multiple(:)
      !> u, v, w, shape (3, nodes)
      real(wp), allocatable :: displacement(:, :)

      real(wp) :: frame(2)
      integer :: node

      frame = frame_of(mesh)
      allocate (displacement(3, n_nodes(mesh)))
      do node = 1, n_nodes(mesh)
         associate (first => max_motions*(part(node) - 1))
            displacement(:, node) = matmul(rigid_motion(mesh, frame, mode, node), &
                                           multiple(first + 1:first + max_motions))
         end associate
      end do
   end function displacement_of

end module axijoint_joints_floating
