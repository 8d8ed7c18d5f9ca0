!> Parameters of the keywords of Abaqus and CalculiX that are translated: those that are read, and those that change nothing that
!> is wanted of a job
module axijoint_legacy_abaqus_parameters
   use axijoint_base_text, only : upper
   use axijoint_legacy_abaqus_lines, only : line_type, next_line, field_text, parameter_of, &
      has_parameter, fault_of, line_data
   use axijoint_legacy_cards, only : cards_type
   use axijoint_legacy_sketch, only : sketch_type, leave_out
   implicit none
   private
   public :: check_parameters, reserve, leave_data, elsewhere, r_and_z

   !> What is wrong with nodes in other coordinates, and what is allowed
   character(len=*), parameter :: elsewhere = 'coordinates that are not r and z are not translated', &
      r_and_z = 'number, r, z on the lines of *NODE'
   !> Length of a parameter with a value
   integer, parameter :: n_letters = 24

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

   !> Why values of a keyword cannot be taken as they stand; empty if they can
   pure function reserve(keyword) result(words)
      !> The keyword
      type(line_type), intent(in) :: keyword
      !> Such as " with AMPLITUDE=RAMP"
      character(len=:), allocatable :: words

      words = ''
      if (parameter_of(keyword, 'AMPLITUDE') /= '') &
         words = ' with AMPLITUDE='//parameter_of(keyword, 'AMPLITUDE')
      if (keyword%keyword /= 'BOUNDARY') return
      if (all(parameter_of(keyword, 'TYPE') /= [character(len=12) :: '', 'DISPLACEMENT'])) &
         words = ' with TYPE='//parameter_of(keyword, 'TYPE')
      if (has_parameter(keyword, 'USER')) words = ' with USER'
      if (has_parameter(keyword, 'SUBMODEL')) words = ' with SUBMODEL'
   end function reserve

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
      case ('EXPANSION')
         known = [character(len=n_letters) :: 'TYPE', 'ZERO']
      case ('INITIAL CONDITIONS')
         known = [character(len=n_letters) :: 'TYPE', 'FILE']
      case ('TEMPERATURE')
         known = [character(len=n_letters) :: 'OP', 'AMPLITUDE', 'FILE']
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
      case ('SURFACE INTERACTION', 'SURFACE BEHAVIOR')
         known = [character(len=n_letters) :: 'NAME', 'PRESSURE-OVERCLOSURE']
      case ('FRICTION')
         known = [character(len=n_letters) :: 'SLIP TOLERANCE', 'ELASTIC SLIP']
      case ('CONTACT PAIR')
         known = [character(len=n_letters) :: 'INTERACTION', 'TYPE', 'SMALL SLIDING', 'ADJUST', 'TRACKING', &
            'MECHANICAL CONSTRAINT', 'OP', 'CPSET']
      case ('TIE')
         known = [character(len=n_letters) :: 'NAME', 'ADJUST', 'POSITION TOLERANCE', 'TYPE', 'NO ROTATION']
      case ('INSTANCE')
         known = [character(len=n_letters) :: 'NAME', 'PART']
      case ('PART', 'ASSEMBLY')
         known = [character(len=n_letters) :: 'NAME']
      case ('HEADING', 'DENSITY', 'END STEP', 'END PART', 'END ASSEMBLY', 'END INSTANCE')
         allocate (known(0))
      end select
   end subroutine get_known

   !> Note that a keyword and its data are not translated
   subroutine leave_data(cards, line, at, sketch)
      !> The file
      type(cards_type), intent(in) :: cards
      !> The keyword
      type(line_type), intent(in) :: line
      !> Its card; the last of its data on return
      integer, intent(inout) :: at
      !> Takes the note
      type(sketch_type), intent(inout) :: sketch

      type(line_type) :: data
      integer :: next

      call leave_out(sketch, line%card, '*'//line%keyword)
      next = at
      do
         call next_line(cards, next, data)
         if (data%kind /= line_data) exit
         at = next
         call leave_out(sketch, at, '*'//line%keyword)
      end do
   end subroutine leave_data

end module axijoint_legacy_abaqus_parameters
