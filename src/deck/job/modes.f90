!> How the load of a card is distributed round the circle: one mode that the card names, or the
!> Fourier series of a shape
module axijoint_deck_job_modes
   use axijoint_base_kinds, only : wp
   use axijoint_base_number_map, only : find_number
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type
   use axijoint_deck_job_deck, only : looked_at
   use axijoint_deck_job_load_fields, only : name_harmonic, name_family, name_shape
   use axijoint_deck_load_shares, only : share_type, shares_of, add_truncation
   use axijoint_deck_text_diagnostics, only : add_warning
   use axijoint_deck_text_entry, only : is_given, integer_of, real_of, field_named, &
      field_fault, lack_fault, &
      card_fault, is_good, is_sound, first_card
   use axijoint_fe_circle_function, only : circle_function_type, share_left_out
   use axijoint_fe_mode, only : mode_type, family_symmetric
   implicit none
   private
   public :: read_shares, check_components, check_torsion, needs_harmonic

contains

   !> Read the fields harmonic, family and shape. Nothing is set if one is at fault
   subroutine read_shares(card, shares)
      !> The card
      type(card_type), intent(in) :: card
      !> What each mode takes
      type(share_type), allocatable, intent(out) :: shares(:)

      integer :: harmonic, family, shape, k

      allocate (shares(0))
      harmonic = field_named(card, name_harmonic)
      family = field_named(card, name_family)
      shape = field_named(card, name_shape)
      if (.not. is_given(card, shape)) then
         if (.not. is_given(card, harmonic)) then
            if (is_good(card)) call report_no_harmonic(card, harmonic, shape)
            return
         end if
         call check_harmonic(card, harmonic)
         shares = [share_type(mode_type(integer_of(card, harmonic), integer_of(card, family)))]
         return
      end if
      if (is_given(card, harmonic)) call field_fault(card, harmonic, &
         'harmonic and shape are both given', &
         allowed='one of them; the program decomposes the shape')
      if (is_given(card, family)) &
         call field_fault(card, family, 'family and shape are both given', &
         allowed='blank: the program decomposes the shape into both families')
      call find_shape(card, shape, k)
      if (k == 0 .or. .not. is_sound(card)) return
      shares = shares_of(card%deck%shapes%functions(k), looked_at(card%deck))
      call note_truncation(card, shape, card%deck%shapes%functions(k))
   end subroutine read_shares

   !> Report a card with neither harmonic nor shape
   subroutine report_no_harmonic(card, harmonic, shape)
      !> The card
      type(card_type), intent(in) :: card
      !> The fields; shape is 0 if the section has none
      integer, intent(in) :: harmonic, shape

      if (shape > 0) then
         call field_fault(card, harmonic, 'the harmonic is blank', allowed='a harmonic or a shape')
      else
         call field_fault(card, harmonic, 'the harmonic is blank', allowed='a harmonic from 0 to M')
      end if
   end subroutine report_no_harmonic

   !> Check that the job has a card's harmonic
   subroutine check_harmonic(card, field)
      !> The card
      type(card_type), intent(in) :: card
      !> The field of the harmonic
      integer, intent(in) :: field

      character(len=:), allocatable :: name

      if (card%deck%highest < 0) return
      associate (harmonic => integer_of(card, field))
         name = 'harmonic '//to_text(harmonic)
         if (harmonic > card%deck%highest) then
            call field_fault(card, field, &
                             'the load''s '//name//' is above the highest, M = '// &
                             to_text(card%deck%highest), &
                             allowed='0 to '//to_text(card%deck%highest), &
                             mend='raise M on the CONTROL card to '//to_text(harmonic))
         else if (.not. any(card%deck%harmonics == harmonic)) then
            call field_fault(card, field, 'the load''s '//name//' is not in use', &
                             allowed='the harmonics of the HARMONICS cards', &
                             mend='add the harmonic to HARMONICS')
         end if
      end associate
   end subroutine check_harmonic

   !> Check that the job has the harmonic of a load whose card does not name it
   subroutine needs_harmonic(card, harmonic, load)
      !> The card
      type(card_type), intent(in) :: card
      !> The harmonic
      integer, intent(in) :: harmonic
      !> The load in words
      character(len=*), intent(in) :: load

      character(len=:), allocatable :: text

      if (card%deck%highest < 0) return
      if (any(card%deck%harmonics == harmonic)) return
      text = load//' is a load of harmonic '//to_text(harmonic)//', '
      if (harmonic > card%deck%highest) then
         call card_fault(card, text//'and M is '//to_text(card%deck%highest), &
                         mend='raise M on the CONTROL card to '//to_text(harmonic)//' or more')
      else
         call card_fault(card, text//'which is not in use', mend='add the harmonic to HARMONICS')
      end if
   end subroutine needs_harmonic

   !> Find the shape that a field names, or report it
   subroutine find_shape(card, field, shape)
      !> The card
      type(card_type), intent(in) :: card
      !> The field
      integer, intent(in) :: field
      !> Its index; 0 if there is none, or if it is at fault itself
      integer, intent(out) :: shape

      shape = find_number(card%deck%shapes%shape_of, integer_of(card, field))
      if (shape > 0) then
         if (.not. card%deck%shapes%good(shape)) shape = 0
      else if (card%deck%shapes%complete) then
         call lack_fault(card, field, 'shape '//to_text(integer_of(card, field))// &
            ' is not defined', &
                         allowed='a shape of a SHAPES card')
      end if
   end subroutine find_shape

   !> Note what the harmonics leave of a shape
   subroutine note_truncation(card, field, f)
      !> The card
      type(card_type), intent(in) :: card
      !> The field of the shape
      integer, intent(in) :: field
      !> The shape
      type(circle_function_type), intent(in) :: f

      character(len=:), allocatable :: name
      real(wp) :: left_out

      name = trim(card%keyword)
      if (is_given(card, 1)) name = name//', '//trim(card%table%fields(1)%name(5:))//' '// &
                                    to_text(integer_of(card, 1))
      name = name//', shape '//to_text(integer_of(card, field))
      left_out = share_left_out(f, card%deck%harmonics)
      call add_truncation(card%deck%loads%truncations, name, left_out, card%case, f)
      if (left_out < 1.0_wp) return
      call add_warning(card%diagnostics, first_card(card), 0, 0, &
                       'the harmonics in use have no part of the load', &
                       mend='raise M on the CONTROL card, or add harmonics to HARMONICS')
   end subroutine note_truncation

   !> Check that the mode that a card names can have the components that it gives
   subroutine check_components(card, noun, first, n)
      !> The card
      type(card_type), intent(in) :: card
      !> What has the components: a load, a displacement
      character(len=*), intent(in) :: noun
      !> First field of the components, and the number of fields: r, z, theta in turn
      integer, intent(in) :: first, n

      character(len=5), parameter :: along(3) = ['r    ', 'z    ', 'theta']
      integer :: field, component
      logical :: symmetric

      if (.not. is_given(card, field_named(card, name_harmonic))) return
      if (integer_of(card, field_named(card, name_harmonic)) > 0) return
      symmetric = integer_of(card, field_named(card, name_family)) == family_symmetric
      do field = first, first + n - 1
         component = mod(field - first, 3) + 1
         if (symmetric .neqv. component == 3) cycle
         if (.not. abs(real_of(card, field)) > 0.0_wp) cycle
         if (symmetric) then
            call field_fault(card, field, 'a '//noun//' along theta in harmonic 0 is torsion', &
                             allowed='blank or 0 in the symmetric family', &
                             mend='torsion is antisymmetric: write A as the family')
         else
            call field_fault(card, field, 'torsion has no '//noun//' along '// &
               trim(along(component)), &
                             allowed='blank or 0 in the antisymmetric family of harmonic 0', &
                             mend='leave the family blank')
         end if
      end do
   end subroutine check_components

   !> Report a scalar in antisymmetric harmonic 0, which has the theta direction only
   subroutine check_torsion(card, noun)
      !> The card
      type(card_type), intent(in) :: card
      !> The scalar in words: pressure, temperature
      character(len=*), intent(in) :: noun

      integer :: family

      family = field_named(card, name_family)
      if (.not. is_given(card, field_named(card, name_harmonic))) return
      if (integer_of(card, field_named(card, name_harmonic)) > 0) return
      if (integer_of(card, family) == family_symmetric) return
      call field_fault(card, family, 'antisymmetric harmonic 0 is torsion: it has no '//noun, &
                       allowed='blank or S in harmonic 0')
   end subroutine check_torsion

end module axijoint_deck_job_modes
