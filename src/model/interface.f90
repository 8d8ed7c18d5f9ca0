!> Interfaces: joints, or shared nodes, along two coinciding faces
module axijoint_model_interface
   implicit none
   private
   public :: interface_type, interface_name, name_length

   !> Longest name
   integer, parameter :: name_length = 20

   !> An interface. Side 1-2 of its joints lies on face a, side 4-3 on face b
   type :: interface_type
      !> Name, for figures and tables
      character(len=name_length) :: name = ''
      !> Law of its joints (index)
      integer :: law = 0
      !> The user's numbers of face a and face b; 0 of joints along a curve of a mesh file
      integer :: faces(2) = 0
      !> Bodies of side 1-2 and side 4-3
      integer :: bodies(2) = 0
   end type interface_type

contains

   !> Name of an interface: as given, or "interface 3" of the third
   pure function interface_name(interfaces, k) result(name)
      !> All interfaces
      type(interface_type), intent(in) :: interfaces(:)
      !> Which, from 1
      integer, intent(in) :: k
      !> The name
      character(len=:), allocatable :: name

      character(len=10) :: digits

      name = trim(interfaces(k)%name)
      if (len(name) > 0) return
      write (digits, '(i0)') k
      name = 'interface '//trim(digits)
   end function interface_name

end module axijoint_model_interface
