!> Fields of the cards of loads, and of harmonics
module axijoint_deck_text_load_fields
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_common_fields, only : number, last_number, step, components, angle, &
      largest_body, largest_harmonic
   use axijoint_deck_text_field, only : field_type, integer_field, real_field, word_field, text_field
   implicit none
   private
   public :: load_fields, harmonic_range
   public :: name_harmonic, name_family, name_shape, name_last, name_step, name_held

   !> Names by which the fields of the distribution round the circle are found
   character(len=*), parameter :: name_harmonic = 'the harmonic', name_family = 'the family', &
      name_shape = 'the shape'
   !> Names of the fields of a row of nodes
   character(len=*), parameter :: name_last = 'the last node', name_step = 'the step'
   !> Name of the field that says whether a displacement is held in other harmonics, too
   character(len=*), parameter :: name_held = 'where it is held'
   !> Families, kinds of shapes and of resultants; their places are the fields' values
   character(len=1), parameter :: families(2) = ['S', 'A']
   character(len=6), parameter :: shape_kinds(3) = [character(len=6) :: 'PATCH', 'COSINE', 'TABLE']
   character(len=7), parameter :: resultant_kinds(4) = &
      [character(len=7) :: 'LATERAL', 'MOMENT', 'AXIAL', 'TORQUE']

contains

   !> Fields of the cards of a section, in the order of their columns
   pure function load_fields(keyword) result(fields)
      !> Keyword of the section
      character(len=*), intent(in) :: keyword
      !> The fields; none if it is no section of loads
      type(field_type), allocatable :: fields(:)

      select case (keyword)
      case ('HARMONICS')
         fields = [integer_field('the first harmonic', 1, 5, 0, largest_harmonic), &
                   integer_field('the last harmonic', 6, 10, 0, largest_harmonic, default=0), step(11)]
      case ('CASE')
         fields = [number('the load case', 1), text_field('the name of the load case', 6, 80)]
         fields(2)%required = .false.
      case ('COMBINE')
         fields = combination_fields()
      case ('SHAPES')
         fields = shape_fields()
      case ('TRACTIONS')
         fields = [number('the face', 1), harmonic(6), components('t', ' at the first point', 11), &
                   components('t', ' at the last point', 41), family(71), shape_number(76)]
      case ('PRESSURES')
         fields = [number('the face', 1), harmonic(6), real_field('p at the first point', 11, 20), &
                   real_field('p at the last point', 21, 30, default=0.0_wp), family(31), shape_number(36)]
      case ('RESULTANTS')
         fields = [number('the face', 1), word_field('the kind of resultant', 6, 15, resultant_kinds), &
                   real_field('the value', 16, 25), angle('theta0', 26)]
      case ('RINGLOADS')
         fields = [number('the node', 1), harmonic(6), components('q', '', 11), family(41), shape_number(46)]
      case ('POINTLOADS')
         fields = [number('the node', 1), angle('theta', 6), components('F', '', 16)]
         fields(2)%required = .true.
      case ('GRAVITY')
         fields = [real_field('g_z', 1, 10, default=0.0_wp), real_field('the lateral g', 11, 20, default=0.0_wp), &
                   angle('theta0', 21)]
      case ('ROTATION')
         fields = [real_field('the angular velocity', 1, 10)]
      case ('TEMPERATURES')
         fields = [any_body(1), harmonic(6), real_field('T0', 11, 20, default=0.0_wp), &
                   real_field('dT/dr', 21, 30, default=0.0_wp), real_field('dT/dz', 31, 40, default=0.0_wp), &
                   family(41), shape_number(46)]
      case ('NODETEMPS')
         fields = [number('the node', 1), last_number(name_last, 6), step(11), harmonic(16), &
                   real_field('T', 21, 30), family(31), shape_number(36)]
      case ('MOVEDNODES')
         fields = [number('the node', 1), harmonic(6), displacements('', 11), family(41), &
                   last_number(name_last, 46), step(51), held_in(56)]
      case ('MOVEDFACES')
         fields = [number('the face', 1), harmonic(6), displacements(' at the first point', 11), &
                   displacements(' at the last point', 41), family(71), held_in(76)]
      case ('SPRINGS')
         fields = [number('the face', 1), spring('k_n', 6), spring('k_s', 16), spring('k_theta', 26)]
      case ('INSITU')
         fields = [any_body(1), real_field('z_s', 6, 15), real_field('gamma', 16, 25), &
                   real_field('K0', 26, 35, from=0.0_wp, symbol='K0'), &
                   real_field('sigma_z at z_s', 36, 45, default=0.0_wp), last_number('the material', 46), &
                   word_field('the balance', 51, 60, [character(len=5) :: 'CHECK', 'MEANT'], 1)]
      case default
         allocate (fields(0))
      end select
   end function load_fields

   !> Fields of SHAPES: the meaning of the numbers depends on the kind
   pure function shape_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      integer :: i

      fields = [number(name_shape, 1), word_field('the kind of shape', 6, 15, shape_kinds), &
                (real_field('number '//to_text(i)//' of the shape', 6 + 10*i, 15 + 10*i, default=0.0_wp), &
                 i=1, 6)]
      fields(3)%required = .true.
   end function shape_fields

   !> Fields of COMBINE: pairs of load case and factor
   pure function combination_fields() result(fields)
      !> The fields
      type(field_type), allocatable :: fields(:)

      integer :: i

      fields = [number('the combination', 1)]
      do i = 1, 5
         fields = [fields, last_number('load case '//to_text(i), 15*i - 9), &
                   real_field('factor '//to_text(i), 15*i - 4, 15*i + 5, default=0.0_wp)]
      end do
   end function combination_fields

   !> Field of a harmonic, blank if a shape is given
   pure function harmonic(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = integer_field(name_harmonic, first, first + 4, 0, largest_harmonic, default=0)
   end function harmonic

   !> Field of a family
   pure function family(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = word_field(name_family, first, first + 4, families, 1)
   end function family

   !> Fields of the harmonics and the family that a restraint holds in; in all if blank
   pure function harmonic_range(first) result(fields)
      !> First column
      integer, intent(in) :: first
      !> The fields
      type(field_type) :: fields(3)
      fields = [integer_field('the first harmonic', first, first + 4, 0, largest_harmonic, default=0), &
                integer_field('the last harmonic', first + 5, first + 9, 0, largest_harmonic, default=0), &
                family(first + 10)]
   end function harmonic_range

   !> Field that says whether a given displacement is held in every harmonic, at 0 in the others
   pure function held_in(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = word_field(name_held, first, first + 4, [character(len=5) :: 'EVERY', 'ONLY'], 1)
   end function held_in

   !> Field of the number of a shape; blank if a harmonic is given
   pure function shape_number(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = last_number(name_shape, first)
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

      fields = [(real_field(component(i)//place, first + 10*i - 10, first + 10*i - 1, default=0.0_wp), i=1, 3)]
   end function displacements

   !> Field of a spring stiffness
   pure function spring(name, first) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = real_field(name, first, first + 9, from=0.0_wp, default=0.0_wp, symbol=name)
   end function spring

   !> Field of a body; all bodies if blank
   pure function any_body(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = integer_field('the body', first, first + 4, 1, largest_body, default=0)
   end function any_body

end module axijoint_deck_text_load_fields
