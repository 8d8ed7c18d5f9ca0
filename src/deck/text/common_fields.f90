!> Fields that the cards of several sections have
module axijoint_deck_text_common_fields
   use axijoint_base_kinds, only : wp
   use axijoint_base_text, only : to_text
   use axijoint_deck_text_field, only : field_type, integer_field, real_field, described, &
      largest_number
   implicit none
   private
   public :: number, node, nodes, face, last_number, last_node, body, step, length, ratio, &
      components, angle
   public :: largest_body, largest_division, largest_harmonic
   public :: name_node, name_last, name_step

   !> Largest numbers of a body, of elements along a side of a block, of a harmonic
   integer, parameter :: largest_body = 9999, largest_division = 100000, largest_harmonic = 9999
   !> Names of the fields of a row of nodes
   character(len=*), parameter :: name_node = 'the node', name_last = 'the last node', &
      name_step = 'the step'
   !> Greatest grading of a block or a line, and its inverse
   real(wp), parameter :: largest_ratio = 1.0e6_wp

contains

   !> Field of the number of a thing
   pure function number(name, first, of) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> What has the number, as far as others need to know: node, face, shape
      character(len=*), intent(in), optional :: of
      !> The field
      type(field_type) :: field
      field = integer_field(name, first, first + 4, 1, largest_number)
      if (present(of)) field%refers_to = of
   end function number

   !> Field of a node
   pure function node(name, first) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = number(name, first, of='node')
   end function node

   !> Field of a face that a card refers to
   pure function face(first, name) result(field)
      !> First column
      integer, intent(in) :: first
      !> Name, if it is not simply the face
      character(len=*), intent(in), optional :: name
      !> The field
      type(field_type) :: field
      field = number('the face', first, of='face')
      if (present(name)) field%name = name
   end function face

   !> Fields of several nodes, the first of which are required
   pure function nodes(name, n, n_required, first) result(fields)
      !> Name of one
      character(len=*), intent(in) :: name
      !> How many, and how many at least
      integer, intent(in) :: n, n_required
      !> First column
      integer, intent(in) :: first
      !> The fields
      type(field_type) :: fields(n)

      integer :: i

      do i = 1, n
         fields(i) = node(name//' '//to_text(i), first + 5*(i - 1))
         fields(i)%required = i <= n_required
      end do
   end function nodes

   !> Field of a body
   pure function body(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = integer_field('the body', first, first + 4, 1, largest_body, default=1)
   end function body

   !> Field of a step between numbers
   pure function step(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(integer_field(name_step, first, first + 4, 1, largest_number, default=1), &
                        'step', &
                        limits='divides the difference')
   end function step

   !> Field of a coordinate
   pure function length(name, first, from) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> Smallest value
      real(wp), intent(in), optional :: from
      !> The field
      type(field_type) :: field
      field = real_field(name, first, from=from, symbol=name(1:1))
   end function length

   !> Field of the ratio of the last to the first interval
   pure function ratio(name, first) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = real_field(name, first, from=1.0_wp/largest_ratio, to=largest_ratio, &
                         default=1.0_wp, symbol='ratio')
   end function ratio

   !> Fields of the components of a load along r, z and theta, 0 if blank
   pure function components(symbol, place, first) result(fields)
      !> Symbol of the load
      character(len=*), intent(in) :: symbol
      !> Where it acts, for the names
      character(len=*), intent(in) :: place
      !> First column
      integer, intent(in) :: first
      !> The fields
      type(field_type) :: fields(3)

      fields = [real_field(symbol//'_r'//place, first, default=0.0_wp), &
                real_field(symbol//'_z'//place, first + 10, default=0.0_wp), &
                real_field(symbol//'_theta'//place, first + 20, default=0.0_wp)]
   end function components

   !> Field of the last of a row of numbers, that of the first alone if blank
   pure function last_number(name, first) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = integer_field(name, first, first + 4, 1, largest_number, default=0)
   end function last_number

   !> Field of the last of a row of nodes
   pure function last_node(first) result(field)
      !> First column
      integer, intent(in) :: first
      !> The field
      type(field_type) :: field
      field = described(last_number(name_last, first), 'last node: node, node + step, …', &
                        blank='the node alone')
      field%refers_to = 'node'
   end function last_node

   !> Field of an angle theta
   pure function angle(name, first) result(field)
      !> Name
      character(len=*), intent(in) :: name
      !> First column
      integer, intent(in) :: first
      !> The field; 0 if blank
      type(field_type) :: field
      field = real_field(name, first, from=-360.0_wp, to=360.0_wp, default=0.0_wp, &
                         symbol='theta')
   end function angle

end module axijoint_deck_text_common_fields
