!> What RESTRAINTS and FIXEDFACES share: displacements that are held, in all harmonics or some
module axijoint_deck_job_holds
   use axijoint_base_text, only : to_text
   use axijoint_deck_job_card, only : card_type
   use axijoint_deck_job_load_fields, only : name_first
   use axijoint_deck_text_entry, only : is_given, integer_of, is_good, field_named, field_fault
   use axijoint_deck_text_field, only : field_type, code_field, described
   use axijoint_model_restraint, only : restraint_type, hold_in
   implicit none
   private
   public :: code, hold

   !> Name of the field of the code
   character(len=*), parameter :: name_code = 'the code'

contains

   !> Field of the code
   pure function code(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field

      field = described(code_field(name_code, first, first + 4), &
                        'code: three digits for u, v, w; 1 fixed, 0 free')
   end function code

   !> Hold the nodes of one card
   subroutine hold(card, nodes)
      !> The card
      type(card_type), intent(in) :: card
      !> The nodes
      integer, intent(in) :: nodes(:)

      type(restraint_type) :: range
      logical :: components(3)
      integer :: i, field_range

      if (.not. is_good(card)) return
      field_range = field_named(card, name_first)
      associate (digits => integer_of(card, field_named(card, name_code)))
         components = [btest(digits, 2), btest(digits, 1), btest(digits, 0)]
      end associate
      if (any(card%table%given(field_range:field_range + 2, card%entry))) then
         call read_range(card, field_range, range)
         call hold_in(card%deck%model%restraints, range, card%deck%draft%n_nodes, nodes, components)
         return
      end if
      do i = 1, 3
         if (.not. components(i)) cycle
         card%deck%model%fixed(i, nodes) = .true.
         card%deck%model%held_by_default(i, nodes) = .false.
      end do
   end subroutine hold

   !> In which harmonics and families a card holds
   subroutine read_range(card, field, range)
      !> The card, and the field of its first harmonic; the last and the family follow
      type(card_type), intent(in) :: card
      integer, intent(in) :: field
      !> Takes them; every harmonic, either family if the card does not say
      type(restraint_type), intent(inout) :: range

      integer, parameter :: last = 1, family = 2

      if (is_given(card, field + family)) range%family = integer_of(card, field + family)
      if (.not. is_given(card, field)) then
         if (is_given(card, field + last)) call field_fault(card, field + last, &
            'the first harmonic is blank', allowed='both harmonics, the first alone, or none')
         return
      end if
      range%first = integer_of(card, field)
      range%last = range%first
      if (is_given(card, field + last)) range%last = integer_of(card, field + last)
      if (range%last < range%first) then
         call field_fault(card, field + last, &
                          'the last harmonic is below the first', allowed=to_text(range%first)// &
                          ' or more')
      else if (card%deck%highest >= 0 .and. range%first > card%deck%highest) then
         call field_fault(card, field, &
                          'harmonic '//to_text(range%first)//' is above the highest, M = '// &
                          to_text(card%deck%highest), &
                          allowed='0 to '//to_text(card%deck%highest), &
                          mend='what holds in every harmonic needs no harmonic on its card')
      end if
   end subroutine read_range

end module axijoint_deck_job_holds
