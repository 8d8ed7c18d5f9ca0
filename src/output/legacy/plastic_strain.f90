!> The effective plastic strain of the old program: the plastic work over the effective stress of the
!> criterion, summed over the increments (Owen and Hinton, Finite Elements in Plasticity, 7.2.3)
module axijoint_output_legacy_plastic_strain
   use axijoint_analysis_core_fields, only : fields_type
   use axijoint_base_kinds, only : wp
   use axijoint_element_principal, only : principal_stresses
   use axijoint_element_yield_law, only : yield_law_type, yield_tresca, yield_mises, yield_mohr, &
      yield_drucker
   use axijoint_model_model, only : model_type
   implicit none
   private
   public :: add_plastic_strain

contains

   !> Add what an increment brings. What the flow rule does with the stress at its end is exact of
   !> implicit increments, all planes that bear together
   subroutine add_plastic_strain(model, now, before, strain)
      !> The job
      type(model_type), intent(in) :: model
      !> Fields of the increment
      class(fields_type), intent(in) :: now
      !> Plastic strain at the end of the one before, r, z, theta, rz, then that of this one, shape
      !> (4, points)
      real(wp), intent(inout) :: before(:, :)
      !> Effective plastic strain, shape (points)
      real(wp), intent(inout) :: strain(:)

      real(wp) :: plastic(4), effective, work
      integer :: point

      if (.not. allocated(now%plastic%amplitude)) return
      do point = 1, size(strain)
         associate (stress => now%stress(:4, point, 1), material => model%materials( &
                    model%mesh%element_material(now%point_element(point))))
            plastic = now%plastic%amplitude(:4, point, 1)
            work = dot_product(stress, plastic - before(:, point))
            effective = effective_stress(material%yield, stress)
            if (work > 0.0_wp .and. effective > 0.0_wp) &
               strain(point) = strain(point) + work/effective
            before(:, point) = plastic
         end associate
      end do
   end subroutine add_plastic_strain

   !> What the criteria of the old program compare with the uniaxial yield stress, with c cos(phi)
   !> and with 6 c cos(phi)/(sqrt(3) (3 - sin(phi)))
   pure real(wp) function effective_stress(law, stress) result(effective)
      !> Constants
      type(yield_law_type), intent(in) :: law
      !> r, z, theta, rz
      real(wp), intent(in) :: stress(4)

      real(wp) :: principal(3), mean, root_j2, sine

      principal = principal_stresses([stress, 0.0_wp, 0.0_wp])
      mean = sum(principal)/3.0_wp
      root_j2 = norm2(principal - mean)/sqrt(2.0_wp)
      sine = sin(law%friction)
      effective = 0.0_wp
      select case (law%criterion)
      case (yield_tresca)
         effective = principal(1) - principal(3)
      case (yield_mises)
         effective = sqrt(3.0_wp)*root_j2
      case (yield_mohr)
         effective = 0.5_wp*(principal(1) - principal(3) + sine*(principal(1) + principal(3)))
      case (yield_drucker)
         effective = root_j2 + 6.0_wp*mean*sine/(sqrt(3.0_wp)*(3.0_wp - sine))
      end select
   end function effective_stress

end module axijoint_output_legacy_plastic_strain
