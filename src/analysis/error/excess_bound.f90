!> Bounds of what a change of the excess stress of joints does to the displacements, without a solution
!>
!> The forces f of the stress and the displacements u = K^-1 f that they make do the work f.u, which
!> the flexibility of the joints alone gives. A component of u is e.K^-1 f for a unit vector e, so its
!> square is at most e.K^-1 e f.K^-1 f (Cauchy and Schwarz), and the first factor is at most the norm of
!> K^-1. The energy in a spring of the structure is at most that work, too.
module axijoint_analysis_error_excess_bound
   use axijoint_analysis_core_structure, only : structure_type
   use axijoint_base_kinds, only : wp
   use axijoint_fe_fourier, only : circle_integral
   use axijoint_joints_scene, only : scene_type, jumps
   implicit none
   private
   public :: bound_excess_effect

   !> The norm of an inverse is an estimate, seldom more than three times too small
   real(wp), parameter :: safety = 10.0_wp

contains

   !> Bound the largest displacement vector, and the largest stress of elastic joints
   subroutine bound_excess_effect(structure, scene, excess, elastic, displacement, stress)
      !> The structure, condensed, the norms of whose inverses are known
      type(structure_type), intent(in) :: structure
      !> Modes and planes
      type(scene_type), intent(in) :: scene
      !> Amplitudes of the stress, shape (3, points, modes)
      real(wp), intent(in), contiguous :: excess(:, :, :)
      !> Places of points of elastic joints among all
      integer, intent(in) :: elastic(:)
      !> The bounds
      real(wp), intent(out) :: displacement, stress

      real(wp), allocatable :: jump(:, :, :)
      real(wp) :: work, stiffest
      integer :: k, p

      stiffest = 0.0_wp
      do k = 1, size(elastic)
         associate (point => structure%joint_points(elastic(k)))
            stiffest = max(stiffest, maxval(point%base)/point%weight)
         end associate
      end do
      jump = jumps(structure%condensed, scene, excess, free=.false.)
      displacement = 0.0_wp
      stress = 0.0_wp
      do k = 1, size(structure%modes)
         work = 0.0_wp
         do p = 1, size(excess, 2)
            work = work + structure%condensed%points(p)%weight*sum(excess(:, p, k)*jump(:, p, k))
         end do
         work = abs(work)  ! but for rounding it is positive
         associate (system => structure%equations%systems(structure%equations%system(k)), &
                    c => circle_integral(structure%modes(k)%harmonic))
            displacement = displacement &
               + sqrt(3.0_wp*safety*c*work*system%condition/max(system%norm, tiny(1.0_wp)))
            stress = stress + sqrt(stiffest*work)  ! c k d^2 w <= c work
         end associate
      end do
   end subroutine bound_excess_effect

end module axijoint_analysis_error_excess_bound
