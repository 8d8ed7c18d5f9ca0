!> Fields that the cards of several loads and supports have
module axijoint_deck_job_load_fields
   use axijoint_base_kinds, only : wp
   use axijoint_deck_text_common_fields, only : last_number, largest_body, largest_harmonic
   use axijoint_deck_text_field, only : field_type, integer_field, real_field, word_field, described
   implicit none
   private
   public :: harmonic, sole_harmonic, family, sole_family, shape_number, harmonic_range, held_in, &
      displacements, any_body
   public :: name_harmonic, name_first, name_family, name_shape, name_held

   !> Names by which the fields of the distribution round the circle are found
   character(len=*), parameter :: name_harmonic = 'the harmonic', name_family = 'the family', &
      name_shape = 'the shape'
   !> Name of the first field of a range of harmonics
   character(len=*), parameter :: name_first = 'the first harmonic'
   !> Name of the field that says whether a displacement is held in other harmonics, too
   character(len=*), parameter :: name_held = 'where it is held'
   !> Families; their places are the fields' values
   character(len=1), parameter :: families(2) = ['S', 'A']

contains

   !> Field of a harmonic, blank if a shape is given
   pure function harmonic(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(integer_field(name_harmonic, first, first + 4, 0, largest_harmonic, &
         default=0), &
                        'harmonic m', blank='given by the shape', &
                        limits='of those in use; blank if a shape is given')
   end function harmonic

   !> Field of a harmonic where no shape can be given
   pure function sole_harmonic(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(harmonic(first), 'harmonic m', blank='must be given', &
         limits='of those in use')
   end function sole_harmonic

   !> Field of a family where no shape can be given
   pure function sole_family(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(family(first), 'family S or A', limits='S, A')
   end function sole_family

   !> Field of a family
   pure function family(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(word_field(name_family, first, first + 4, families, 1), 'family S or A', &
                        limits='blank if a shape is given')
   end function family

   !> Fields of the harmonics and the family that a restraint holds in; in all if blank
   pure function harmonic_range(first) result(fields)
      !> First column
      integer, intent(in) :: first
      !> The fields
      type(field_type) :: fields(3)
      fields = [described(integer_field(name_first, first, first + 4, 0, largest_harmonic, &
         default=0), &
                          'first harmonic that it holds in', blank='every harmonic', &
                          limits='0 … M'), &
                described(integer_field('the last harmonic', first + 5, first + 9, 0, &
                largest_harmonic, default=0), &
                          'last harmonic; it may be above M', blank='the first', &
                          limits='first … 9999'), &
                described(family(first + 10), 'family S or A', blank='both', limits='S, A')]
   end function harmonic_range

   !> Field that says whether a given displacement is held in every harmonic, at 0 in the others
   pure function held_in(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(word_field(name_held, first, first + 4, &
                                   [character(len=5) :: 'EVERY', 'ONLY'], 1), &
                        'EVERY: held in all harmonics; ONLY: in this harmonic and family')
   end function held_in

   !> Field of the number of a shape; blank if a harmonic is given
   pure function shape_number(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(last_number(name_shape, first), 'shape', blank='none', limits='of SHAPES')
      field%refers_to = 'shape'
   end function shape_number

   !> Fields of displacements u, v, w; a blank one says nothing
   pure function displacements(place, first) result(fields)
      !> Where, for the names
      character(len=*), intent(in) :: place
      !> First column
      integer, intent(in) :: first
      !> The fields
      type(field_type) :: fields(3)

      character(len=1), parameter :: component(3) = ['u', 'v', 'w']
      integer :: i

      fields = [(real_field(component(i)//place, first + 10*i - 10, default=0.0_wp), i=1, 3)]
   end function displacements

   !> Field of a body; all bodies if blank
   pure function any_body(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(integer_field('the body', first, first + 4, 1, largest_body, default=0), &
                        'body', &
                        blank='all')
   end function any_body

end module axijoint_deck_job_load_fields
