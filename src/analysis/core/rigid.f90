!> Resultants of nodal forces
module axijoint_analysis_core_rigid
   use axijoint_analysis_core_fields, only : axial, lateral, moment, torque, lateral_90, moment_90, n_resultants
   use axijoint_base_kinds, only : wp
   use axijoint_fe_mode, only : mode_type, is_torsion, family_symmetric
   implicit none
   private
   public :: rigid_resultants

contains

   !> Resultants of nodal forces of one mode: their work on unit rigid motions
   pure function rigid_resultants(coordinates, mode, force) result(resultant)
      !> r and z of the nodes, shape (2, nodes); moments are about z = 0
      real(wp), intent(in) :: coordinates(:, :)
      !> The mode
      type(mode_type), intent(in) :: mode
      !> Generalized forces on components, shape (3, nodes)
      real(wp), intent(in) :: force(:, :)
      !> The resultants
      real(wp) :: resultant(n_resultants)

      logical :: symmetric

      resultant = 0.0_wp
      symmetric = mode%family == family_symmetric
      associate (r => coordinates(1, :), z => coordinates(2, :))
         if (is_torsion(mode)) then  ! w = -r turns by one about z
            resultant(torque) = -sum(r*force(3, :))
         else if (mode%harmonic == 0) then
            resultant(axial) = sum(force(2, :))
         else if (mode%harmonic == 1) then
            resultant(merge(lateral, lateral_90, symmetric)) = sum(force(1, :) - force(3, :))
            resultant(merge(moment, moment_90, symmetric)) = &
               sum(r*force(2, :) - z*(force(1, :) - force(3, :)))
         end if
      end associate
   end function rigid_resultants

end module axijoint_analysis_core_rigid
