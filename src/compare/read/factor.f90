!> Factors of a format description: products of numbers and pi
module axijoint_compare_read_factor
   use axijoint_base_kinds, only : wp, pi
   use axijoint_base_text, only : lower
   use axijoint_deck_text_token, only : read_real, token_good
   implicit none
   private
   public :: read_factor

contains

   !> A factor such as -1, 1E-3, pi, 1/(2*pi) or -1E3/pi, without blanks
   pure subroutine read_factor(text, value, good)
      !> The text
      character(len=*), intent(in) :: text
      !> Its value; 1 if it is none
      real(wp), intent(out) :: value
      !> Whether it is a factor other than 0
      logical, intent(out) :: good

      integer :: first, last
      real(wp) :: term
      logical :: divided, inside

      value = 1.0_wp
      first = 1
      inside = .false.
      divided = .false.
      do
         if (index(text(first:), '(') == 1 .and. divided .and. .not. inside) then
            inside = .true.
            first = first + 1
         end if
         last = first - 2 + scan(text(first:)//'*', '*/)')
         call read_term(text(first:last), term, good)
         if (.not. good) exit
         value = merge(value/term, value*term, divided)
         first = last + 1
         if (index(text(first:), ')') == 1 .and. inside) then
            inside = .false.
            divided = .false.
            first = first + 1
         end if
         if (first > len(text)) exit
         good = scan(text(first:first), '*/') == 1 .and. first < len(text)
         if (inside) good = good .and. text(first:first) == '*'
         if (.not. good) exit
         if (.not. inside) divided = text(first:first) == '/'
         first = first + 1
      end do
      if (inside) good = .false.
      if (.not. good) value = 1.0_wp
   end subroutine read_factor

   !> One number, or pi
   pure subroutine read_term(text, value, good)
      !> The text
      character(len=*), intent(in) :: text
      !> Its value
      real(wp), intent(out) :: value
      !> Whether it is a number other than 0
      logical, intent(out) :: good

      integer :: fault

      select case (lower(text))
      case ('pi', '+pi')
         value = pi
         good = .true.
      case ('-pi')
         value = -pi
         good = .true.
      case default
         value = 1.0_wp
         good = len(text) > 0
         if (.not. good) return
         call read_real(text, value, fault)
         good = fault == token_good .and. abs(value) > 0.0_wp
         if (.not. good) value = 1.0_wp
      end select
   end subroutine read_term

end module axijoint_compare_read_factor
