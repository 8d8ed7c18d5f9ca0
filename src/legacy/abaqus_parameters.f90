!> Parameters of the keywords of Abaqus and CalculiX that are translated: those that are read, and those that change nothing that
!> is wanted of a job
module axijoint_legacy_abaqus_parameters
   use axijoint_base_text, only : upper
   use axijoint_legacy_abaqus_lines, only : line_type, field_text, parameter_of, fault_of
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_sketch, only : sketch_type, leave_out
   implicit none
   private
   public :: check_parameters, elsewhere, r_and_z

   !> What is wrong with nodes in other coordinates, and what is allowed
   character(len=*), parameter :: elsewhere = 'coordinates that are not r and z are not translated', &
      r_and_z = 'number, r, z on the lines of *NODE'
   !> Length of a parameter with a value
   integer, parameter :: n_letters = 20

contains

   !> Note parameters of a keyword that are not translated; nodes and elements that they put elsewhere are an error
   subroutine check_parameters(cards, line, sketch)
      !> The file
      type(cards_type), intent(inout) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Takes the notes
      type(sketch_type), intent(inout) :: sketch

      character(len=n_letters), allocatable :: known(:)
      character(len=:), allocatable :: text, name
      integer :: k

      call get_known(line%keyword, known)
      if (.not. allocated(known)) return
      do k = 2, size(line%place, 2)
         text = upper(field_text(line, k))
         name = trim(text(:index(text//'=', '=') - 1))
         if (any(known == name)) cycle
         if (any(known == name//'='//parameter_of(line, name))) cycle
         if (name == 'INPUT') then
            call fault_of(cards, line, k, 'another file is not read', 'the lines of the file itself')
         else if (line%keyword == 'NODE' .and. name == 'SYSTEM') then
            call fault_of(cards, line, k, elsewhere, r_and_z)
         else
            call leave_out(sketch, line%home(1, k), text//' of *'//line%keyword)
         end if
      end do
   end subroutine check_parameters

   !> Parameters of a keyword that are read, or change nothing: with a value where this is so of that value alone
   pure subroutine get_known(keyword, known)
      !> The keyword
      character(len=*), intent(in) :: keyword
      !> The parameters; not allocated for a keyword that is left out as a whole
      character(len=n_letters), allocatable, intent(out) :: known(:)

      select case (keyword)
      case ('NODE')
         known = [character(len=n_letters) :: 'NSET', 'SYSTEM=R']
      case ('ELEMENT')
         known = [character(len=n_letters) :: 'TYPE', 'ELSET']
      case ('NSET', 'ELSET')
         known = [character(len=n_letters) :: 'NSET', 'ELSET', 'GENERATE', 'INSTANCE', 'INTERNAL', 'UNSORTED']
      case ('SURFACE')
         known = [character(len=n_letters) :: 'NAME', 'TYPE', 'INTERNAL']
      case ('MATERIAL')
         known = [character(len=n_letters) :: 'NAME']
      case ('ELASTIC')
         known = [character(len=n_letters) :: 'TYPE', 'MODULI=LONG TERM']
      case ('PLASTIC')
         known = [character(len=n_letters) :: 'HARDENING']
      case ('SOLID SECTION')
         known = [character(len=n_letters) :: 'ELSET', 'MATERIAL']
      case ('BOUNDARY')
         known = [character(len=n_letters) :: 'OP', 'AMPLITUDE', 'TYPE', 'USER', 'SUBMODEL']
      case ('CLOAD', 'DLOAD', 'DSLOAD')
         known = [character(len=n_letters) :: 'OP', 'AMPLITUDE', 'FOLLOWER=NO', 'REAL']
      case ('STEP')
         known = [character(len=n_letters) :: 'NAME', 'INC', 'INCF', 'NLGEOM=NO', 'AMPLITUDE', 'CONVERT SDI', 'EXTRAPOLATION', &
            'UNSYMM']
      case ('STATIC')
         known = [character(len=n_letters) :: 'DIRECT', 'SOLVER', 'TIME RESET', 'TOTAL TIME AT START']
      case ('HEADING', 'DENSITY', 'END STEP')
         allocate (known(0))
      end select
   end subroutine get_known

end module axijoint_legacy_abaqus_parameters
