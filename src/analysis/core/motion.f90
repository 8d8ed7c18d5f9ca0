!> The motion in which a structure runs away, in words
module axijoint_analysis_core_motion
   use axijoint_assembly_rigid_motion, only : solid_parts
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric, is_torsion, mode_name
   use axijoint_model_mesh, only : mesh_type
   implicit none
   private
   public :: motion_text

   !> Rigid motions below this share of the largest displacement are none
   real(wp), parameter :: rigid_share = 0.1_wp
   !> Parts move as one body where they are no farther from doing so than this share
   real(wp), parameter :: alike = 0.1_wp

   !> Name of a motion
   character(len=*), parameter :: tilting = 'tilts'

   !> A rigid motion of a part
   type :: motion_type
      !> Largest displacement in it
      real(wp) :: size = 0.0_wp
      !> Its part, mode, and name
      integer :: part = 0, mode = 0
      character(len=16) :: name = ''
   end type motion_type

contains

   !> Which part moves most, and how; or which parts, where some tilt as one: what is far from where they do slides by itself
   function motion_text(mesh, modes, displacement) result(text)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacements that ran away, shape (3, nodes, modes)
      real(wp), intent(in) :: displacement(:, :, :)
      !> Such as 'the part with node 5 slides sideways (harmonic 1 symmetric)'
      character(len=:), allocatable :: text

      type(motion_type) :: largest
      real(wp), allocatable :: turned(:, :, :)
      logical, allocatable :: moves(:)
      integer, allocatable :: part(:), nodes(:)
      integer :: p, k, place(3)

      turned = displacement
      call turn_sideways(modes, turned)
      call solid_parts(mesh, part)
      do p = 1, maxval(part)
         nodes = pack([(k, k=1, size(part))], part == p)
         do k = 1, size(modes)
            call compare(p, k, mesh%coordinates(:, nodes), modes(k), turned(:, nodes, k), &
               largest)
         end do
      end do
      if (largest%size > rigid_share*maxval(abs(turned)) .and. modes(max(1, largest%mode))%harmonic == 1) then
         moves = moves_with(mesh%coordinates, part, turned(:, :, largest%mode), largest)
         if (count(moves) > 1) then
            nodes = pack([(k, k=1, size(part))], moves(part))
            k = largest%mode
            largest = motion_type()
            call compare(0, k, mesh%coordinates(:, nodes), modes(k), turned(:, nodes, k), largest)
            text = 'the parts with nodes '//nodes_of(mesh, part, moves)//' '// &
               trim(merge('tilt          ', 'slide sideways', largest%name == tilting))//' as one (harmonic '// &
               mode_name(modes(k))//')'
            return
         end if
      end if
      place = maxloc(abs(turned))
      if (largest%size > rigid_share*maxval(abs(turned))) then
         place(2) = findloc(part, largest%part, 1)
         place(3) = largest%mode
      else
         largest%name = 'gives way'
      end if
      text = 'the part with node '//to_text(mesh%node_label(place(2)))//' '//trim(largest%name)// &
         ' (harmonic '//mode_name(modes(place(3)))//')'
   end function motion_text

   !> Turn both families of harmonic 1 to the direction of the motion, which one of them has alone then: what moves a part most
   !> does not hang on where theta = 0 is
   pure subroutine turn_sideways(modes, displacement)
      !> The modes
      type(mode_type), intent(in) :: modes(:)
      !> Displacements, shape (3, nodes, modes)
      real(wp), intent(inout) :: displacement(:, :, :)

      real(wp), allocatable :: along(:, :)
      real(wp) :: scale, angle
      integer :: s, a

      s = findloc(modes%harmonic == 1 .and. modes%family == family_symmetric, .true., 1)
      a = findloc(modes%harmonic == 1 .and. modes%family == family_antisymmetric, .true., 1)
      if (s == 0 .or. a == 0) return
      associate (x => displacement(:, :, s), y => displacement(:, :, a))
         ! the antisymmetric amplitude is the symmetric one of theta - 90 degrees: along an angle there is cos x + sin y, whose
         ! square over all nodes is largest here; nearest to the family that has more, the angle keeps its name
         scale = max(maxval(abs(x)), maxval(abs(y)))
         if (.not. scale > 0.0_wp) return
         angle = 0.5_wp*atan2(2.0_wp*sum((x/scale)*(y/scale)), sum((x/scale)**2) - sum((y/scale)**2))
         if (abs(angle) > 0.25_wp*acos(-1.0_wp)) angle = angle - sign(0.5_wp*acos(-1.0_wp), angle)
         along = cos(angle)*x + sin(angle)*y
         y = cos(angle)*y - sin(angle)*x
         x = along
      end associate
   end subroutine turn_sideways

   !> Parts that move with the one that moves most as one body does, sideways and tilting
   function moves_with(x, part, displacement, largest) result(moves)
      !> r and z of the nodes, shape (2, nodes), and their parts
      real(wp), intent(in) :: x(:, :)
      integer, intent(in) :: part(:)
      !> Displacement amplitudes of a mode of harmonic 1, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> The largest motion
      type(motion_type), intent(in) :: largest
      !> Shape (parts)
      logical, allocatable :: moves(:)

      real(wp), dimension(maxval(part)) :: middle, along, turn, reach
      integer, allocatable :: nodes(:)
      integer :: k, p

      do p = 1, size(middle)
         nodes = pack([(k, k=1, size(part))], part == p)
         associate (r => x(1, nodes), z => x(2, nodes), u => displacement(:, nodes))
            middle(p) = sum(z)/size(nodes)
            along(p) = sum(u(1, :) - u(3, :))/(2*size(nodes))
            turn(p) = sum(r*u(2, :) - (z - middle(p))*(u(1, :) - u(3, :)))/max(tiny(1.0_wp), sum(r**2 + 2.0_wp*(z - middle(p))**2))
            reach(p) = maxval(hypot(r, z - middle(p)))
         end associate
      end do
      associate (q => largest%part, most => alike*largest%size)
         moves = abs(turn - turn(q))*reach <= most .and. abs(along - (along(q) - turn(q)*(middle - middle(q)))) <= most &
            .and. abs(turn)*reach > most
         moves(q) = .true.
      end associate
   end function moves_with

   !> A node of each of some parts, in words
   pure function nodes_of(mesh, part, chosen) result(text)
      !> The mesh
      type(mesh_type), intent(in) :: mesh
      !> Parts of the nodes, and which of them
      integer, intent(in) :: part(:)
      logical, intent(in) :: chosen(:)
      !> Such as '5, 17 and 23'
      character(len=:), allocatable :: text

      integer :: p, left

      text = ''
      left = count(chosen)
      do p = 1, size(chosen)
         if (.not. chosen(p)) cycle
         text = text//to_text(mesh%node_label(findloc(part, p, 1)))
         left = left - 1
         if (left > 1) text = text//', '
         if (left == 1) text = text//' and '
      end do
   end function nodes_of

   !> Keep the largest of the rigid motions of a part in a mode: those that fit its
   !> displacements best, tilting about its middle
   subroutine compare(part, k, x, mode, displacement, largest)
      !> The part, and place of the mode
      integer, intent(in) :: part, k
      !> r and z of its nodes, shape (2, nodes)
      real(wp), intent(in) :: x(:, :)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Displacement amplitudes, shape (3, nodes)
      real(wp), intent(in) :: displacement(:, :)
      !> The largest so far
      type(motion_type), intent(inout) :: largest

      real(wp) :: z(size(x, 2))

      z = x(2, :) - sum(x(2, :))/size(x, 2)
      associate (r => x(1, :), u => displacement(1, :), v => displacement(2, :), &
         w => displacement(3, :))
         if (is_torsion(mode)) then
            call keep('turns about z', maxval(r)*ratio_of(sum(r*w), sum(r**2)))
         else if (mode%harmonic == 0) then
            call keep('moves along z', sum(v)/size(r))
         else if (mode%harmonic == 1) then
            call keep('slides sideways', sum(u - w)/(2*size(r)))
            call keep(tilting, maxval(hypot(r, z))*ratio_of(sum(r*v - z*(u - w)), &
               sum(r**2 + 2.0_wp*z**2)))
         end if
      end associate

   contains

      !> Keep a motion if it is larger
      subroutine keep(name, amount)
         !> Its name
         character(len=*), intent(in) :: name
         !> Largest displacement in it
         real(wp), intent(in) :: amount

         if (abs(amount) > largest%size) largest = motion_type(abs(amount), part, k, name)
      end subroutine keep

      !> Quotient, zero of a single point on the axis
      pure real(wp) function ratio_of(a, b)
         !> Parts
         real(wp), intent(in) :: a, b

         ratio_of = 0.0_wp
         if (b > 0.0_wp) ratio_of = a/b
      end function ratio_of

   end subroutine compare

end module axijoint_analysis_core_motion
