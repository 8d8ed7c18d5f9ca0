!> How a load is shared out among the modes, and what they leave of it
module axijoint_deck_load_shares
   use axijoint_base_kinds, only : wp
   use axijoint_fe_circle_function, only : circle_function_type, fourier_coefficients, mean_square
   use axijoint_fe_fourier, only : cosine_of_degrees, sine_of_degrees
   use axijoint_fe_mode, only : mode_type, family_symmetric, family_antisymmetric
   use axijoint_model_load, only : truncation_type
   implicit none
   private
   public :: share_type, shares_of, directed_shares, truncation_list_type, add_truncation

   !> What a mode takes of a load: its amplitudes are these factors times the load
   type :: share_type
      !> The mode
      type(mode_type) :: mode
      !> Factors of the r, z and theta components. A scalar goes with r and z
      real(wp) :: factor(3) = 1.0_wp
   end type share_type

   !> What the harmonics leave of the loads
   type :: truncation_list_type
      !> Number of entries
      integer :: n = 0
      !> The entries, at least n
      type(truncation_type), allocatable :: entries(:)
   end type truncation_list_type

   !> A Fourier coefficient below this part of the root mean square is rounding: the
   !> family or harmonic that has no other is not excited
   real(wp), parameter :: least_share = 64.0_wp*epsilon(1.0_wp)

contains

   !> Fourier series of a shape. With f = sum of a_m cos + b_m sin, the r and z components
   !> have a_m in the symmetric and b_m in the antisymmetric family, the theta component
   !> b_m and -a_m there: it goes with sin(m theta) and -cos(m theta)
   pure function shares_of(f, harmonics) result(shares)
      !> The shape
      type(circle_function_type), intent(in) :: f
      !> Harmonics
      integer, intent(in) :: harmonics(:)
      !> What each mode takes; modes that take nothing are left out
      type(share_type), allocatable :: shares(:)

      real(wp) :: a, b, least
      integer :: i

      allocate (shares(0))
      least = least_share*sqrt(mean_square(f))
      do i = 1, size(harmonics)
         call fourier_coefficients(f, harmonics(i), a, b)
         if (abs(a) <= least) a = 0.0_wp
         if (abs(b) <= least) b = 0.0_wp
         if (.not. max(abs(a), abs(b)) > 0.0_wp) cycle
         shares = [shares, share_type(mode_type(harmonics(i), family_symmetric), [a, a, b]), &
                   share_type(mode_type(harmonics(i), family_antisymmetric), [b, b, -a])]
      end do
   end function shares_of

   !> Add what the harmonics leave of a load
   pure subroutine add_truncation(truncations, name, left_out, case, course)
      !> The list
      type(truncation_list_type), intent(inout) :: truncations
      !> The load in words
      character(len=*), intent(in) :: name
      !> Root mean square of what is left out, over that of the load
      real(wp), intent(in) :: left_out
      !> Load case (index)
      integer, intent(in) :: case
      !> How it goes round the circle; absent if it is concentrated in points
      type(circle_function_type), intent(in), optional :: course

      type(truncation_type), allocatable :: larger(:)
      integer :: k

      if (.not. allocated(truncations%entries)) allocate (truncations%entries(16))
      if (truncations%n == size(truncations%entries)) then
         allocate (larger(2*truncations%n))
         do k = 1, truncations%n
            call move_alloc(truncations%entries(k)%name, larger(k)%name)
            larger(k)%left_out = truncations%entries(k)%left_out
            larger(k)%case = truncations%entries(k)%case
            call move_alloc(truncations%entries(k)%course, larger(k)%course)
         end do
         call move_alloc(larger, truncations%entries)
      end if
      truncations%n = truncations%n + 1
      truncations%entries(truncations%n) = truncation_type(name, left_out, case)
      if (present(course)) truncations%entries(truncations%n)%course = course
   end subroutine add_truncation

   !> Shares of a load in harmonic 1 along the direction theta0: the symmetric load turned
   !> by theta0
   pure function directed_shares(angle) result(shares)
      !> theta0 [degree]
      real(wp), intent(in) :: angle
      !> What each family takes
      type(share_type) :: shares(2)

      shares = [share_type(mode_type(1, family_symmetric), &
         spread(cosine_of_degrees(angle), 1, 3)), &
                share_type(mode_type(1, family_antisymmetric), &
                spread(sine_of_degrees(angle), 1, 3))]
   end function directed_shares

end module axijoint_deck_load_shares
