!> Stress that a solid admits at one point, and its derivatives. Stresses are ordered r, z, theta,
!> rz, r-theta, z-theta
module axijoint_element_yield_stress
   use axijoint_base_kinds, only : wp
   use axijoint_element_drucker, only : drucker_planes
   use axijoint_element_mises, only : mises_planes
   use axijoint_element_mohr, only : mohr_planes
   use axijoint_element_principal, only : principal_axes
   use axijoint_element_tresca, only : tresca_planes
   use axijoint_element_yield_law, only : yield_law_type, yield_none, yield_tresca, yield_mises, &
      yield_mohr, yield_drucker
   use axijoint_element_yield_planes, only : yield_planes_type, return_to_planes
   implicit none
   private
   public :: admit_solid, admit_stress, criterion_planes, holds_for_sure, root_j2, cartesian

   !> Order of `principal_axes`, xx, yy, zz, xy, yz, xz
   integer, parameter :: cartesian(6) = [1, 2, 3, 4, 6, 5]
   !> Axes of the components
   integer, parameter :: row(6) = [1, 2, 3, 1, 1, 2], column(6) = [1, 2, 3, 2, 3, 3]
   !> Share of the stress below which two trial stresses count as equal
   real(wp), parameter :: equal = 1.0e-9_wp

contains

   !> Stress that is admitted for a trial stress, derivatives, and plastic strain that hardens
   pure subroutine admit_solid(law, gained, trial, stress, tangent, growth)
      !> Constants of the solid
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened it
      real(wp), intent(in) :: gained
      !> Trial stress
      real(wp), intent(in) :: trial(6)
      !> Stress that is admitted
      real(wp), intent(out) :: stress(6)
      !> Its derivatives by the trial stress
      real(wp), intent(out) :: tangent(6, 6)
      !> What is added to the plastic strain that hardens
      real(wp), intent(out) :: growth

      integer :: i

      select case (law%criterion)
      case (yield_tresca, yield_mohr)
         call admit_principal(criterion_planes(law, gained), trial, stress, growth, tangent)
      case (yield_mises, yield_drucker)
         call admit_invariants(criterion_planes(law, gained), trial, stress, growth, tangent)
      case default
         stress = trial
         growth = 0.0_wp
         tangent = 0.0_wp
         do i = 1, 6
            tangent(i, i) = 1.0_wp
         end do
      end select
   end subroutine admit_solid

   !> The same without derivatives
   pure subroutine admit_stress(law, gained, trial, stress, growth)
      !> Constants of the solid
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened it
      real(wp), intent(in) :: gained
      !> Trial stress
      real(wp), intent(in) :: trial(6)
      !> Stress that is admitted
      real(wp), intent(out) :: stress(6)
      !> What is added to the plastic strain that hardens
      real(wp), intent(out) :: growth

      stress = trial
      growth = 0.0_wp
      select case (law%criterion)
      case (yield_tresca, yield_mohr)
         call admit_principal(criterion_planes(law, gained), trial, stress, growth)
      case (yield_mises, yield_drucker)
         call admit_invariants(criterion_planes(law, gained), trial, stress, growth)
      end select
   end subroutine admit_stress

   !> The planes of a criterion
   pure function criterion_planes(law, gained) result(planes)
      !> Constants of the solid
      type(yield_law_type), intent(in) :: law
      !> Plastic strain that has hardened it
      real(wp), intent(in) :: gained
      !> The planes; none of a solid that stays elastic
      type(yield_planes_type) :: planes

      select case (law%criterion)
      case (yield_tresca)
         planes = tresca_planes(law, gained)
      case (yield_mises)
         planes = mises_planes(law, gained)
      case (yield_mohr)
         planes = mohr_planes(law, gained)
      case (yield_drucker)
         planes = drucker_planes(law, gained)
      end select
   end function criterion_planes

   !> A criterion of the principal stresses: the axes stay those of the trial stress
   pure subroutine admit_principal(planes, trial, stress, growth, tangent)
      !> The criterion
      type(yield_planes_type), intent(in) :: planes
      !> Trial stress
      real(wp), intent(in) :: trial(6)
      !> Stress that is admitted, plastic strain that hardens
      real(wp), intent(out) :: stress(6), growth
      !> Derivatives of the stress
      real(wp), intent(out), optional :: tangent(6, 6)

      real(wp) :: principal(3), axes(3, 3), returned(3), derivative(3, 3), direction(6, 3), ratio
      real(wp) :: both(6)
      integer :: i, j

      call principal_axes(trial(cartesian), principal, axes)
      call return_to_planes(planes, principal, returned, derivative, growth)
      do i = 1, 3
         direction(:, i) = axes(row, i)*axes(column, i)
      end do
      stress = matmul(direction, returned)
      if (maxval(abs(returned - principal)) <= 0.0_wp) stress = trial  ! without rounding
      if (.not. present(tangent)) return
      tangent = 0.0_wp
      do j = 1, 3
         do i = 1, 3
            tangent = tangent + derivative(i, j)*outer(direction(:, i), twice(direction(:, j)))
         end do
         do i = 1, j - 1  ! shear stress in the axes turns them
            ratio = turning(principal, returned, derivative, i, j)
            both = axes(row, i)*axes(column, j) + axes(column, i)*axes(row, j)
            tangent = tangent + 0.5_wp*ratio*outer(both, twice(both))
         end do
      end do
   end subroutine admit_principal

   !> What a small shear stress between two axes becomes: (si - sj)/(trial si - trial sj), and its
   !> limit where these are equal
   pure real(wp) function turning(trial, stress, derivative, i, j) result(ratio)
      !> Principal stresses, trial and admitted
      real(wp), intent(in) :: trial(3), stress(3)
      !> Derivatives of these by those
      real(wp), intent(in) :: derivative(3, 3)
      !> The axes
      integer, intent(in) :: i, j

      if (abs(trial(i) - trial(j)) > equal*maxval(abs(trial))) then
         ratio = (stress(i) - stress(j))/(trial(i) - trial(j))
      else
         ratio = 0.5_wp*(derivative(i, i) - derivative(i, j) + derivative(j, j) - derivative(j, i))
      end if
   end function turning

   !> A criterion of sqrt(J2) and the mean stress: the deviator keeps its direction
   pure subroutine admit_invariants(planes, trial, stress, growth, tangent)
      !> The criterion
      type(yield_planes_type), intent(in) :: planes
      !> Trial stress
      real(wp), intent(in) :: trial(6)
      !> Stress that is admitted, plastic strain that hardens
      real(wp), intent(out) :: stress(6), growth
      !> Derivatives of the stress
      real(wp), intent(out), optional :: tangent(6, 6)

      real(wp), parameter :: volume(6) = [1.0_wp, 1.0_wp, 1.0_wp, 0.0_wp, 0.0_wp, 0.0_wp]
      real(wp) :: deviator(6), direction(6), by(6), invariants(3), returned(3), slope(3, 3), share
      integer :: i

      invariants = [root_j2(trial), sum(trial(1:3))/3.0_wp, 0.0_wp]
      call return_to_planes(planes, invariants, returned, slope, growth)
      deviator = trial - invariants(2)*volume
      share = slope(1, 1)
      direction = 0.0_wp
      if (invariants(1) > 0.0_wp) then
         share = returned(1)/invariants(1)
         direction = deviator/invariants(1)
      end if
      by = 0.5_wp*twice(direction)  ! the derivative of sqrt(J2)
      stress = share*deviator + returned(2)*volume
      if (maxval(abs(returned - invariants)) <= 0.0_wp) stress = trial  ! without rounding
      if (.not. present(tangent)) return
      tangent = outer(direction, (slope(1, 1) - share)*by + slope(1, 2)/3.0_wp*volume) &
         + outer(volume, slope(2, 1)*by + (slope(2, 2) - share)/3.0_wp*volume)
      do i = 1, 6
         tangent(i, i) = tangent(i, i) + share
      end do
   end subroutine admit_invariants

   !> Whether a criterion holds for sure where no more is known than bounds: of sqrt(J2), and of the
   !> mean stress from above. In sextants of the principal stresses s1 - s3 is 2 sqrt(J2) cos w and
   !> s1 + s3 is 2 p - 2 sqrt(J2/3) sin w
   pure logical function holds_for_sure(law, root, mean)
      !> Constants of the solid; it has not hardened
      type(yield_law_type), intent(in) :: law
      !> The bounds
      real(wp), intent(in) :: root, mean

      type(yield_planes_type) :: planes
      real(wp) :: friction

      holds_for_sure = law%criterion == yield_none
      if (holds_for_sure) return
      planes = criterion_planes(law, 0.0_wp)
      select case (law%criterion)
      case (yield_tresca, yield_mohr)
         friction = sin(law%friction)
         if (law%criterion == yield_tresca) friction = 0.0_wp
         holds_for_sure = 2.0_wp*root*sqrt(1.0_wp + friction**2/3.0_wp) + 2.0_wp*mean*friction &
            < planes%limit(1) .and. mean + 2.0_wp*root/sqrt(3.0_wp) < law%tension
      case default
         holds_for_sure = root + planes%normal(2, 1)*mean < planes%limit(1) &
            .and. mean < law%tension
      end select
   end function holds_for_sure

   !> The root of the second invariant of the deviator
   pure real(wp) function root_j2(stress)
      !> The stress
      real(wp), intent(in) :: stress(6)

      root_j2 = sqrt(0.5_wp)*norm2([stress(1:3) - sum(stress(1:3))/3.0_wp, &
                                    sqrt(2.0_wp)*stress(4:6)])
   end function root_j2

   !> Shear components twice: what a double contraction takes
   pure function twice(tensor) result(doubled)
      !> Components of a symmetric tensor
      real(wp), intent(in) :: tensor(6)
      !> The same
      real(wp) :: doubled(6)

      doubled = tensor
      doubled(4:6) = 2.0_wp*tensor(4:6)
   end function twice

   !> Columns times row
   pure function outer(left, right) result(product)
      !> The two
      real(wp), intent(in) :: left(6), right(6)
      !> The matrix
      real(wp) :: product(6, 6)

      integer :: i

      do i = 1, 6
         product(:, i) = left*right(i)
      end do
   end function outer

end module axijoint_element_yield_stress
