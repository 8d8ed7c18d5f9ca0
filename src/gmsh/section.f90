!> Lines of a section between $Name and $EndName
module axijoint_gmsh_section
   use axijoint_base_text, only : to_text
   use axijoint_gmsh_scanner, only : scanner_type, fault_type, next_line, next_token, token_text, &
      line_fault, token_fault, read_integer, end_line
   implicit none
   private
   public :: data_line, end_section, skip_section, read_count, count_fault

   !> Mend for a file that is not whole
   character(len=*), parameter :: write_again = &
      'the file is damaged or was cut off: save the mesh again'

contains

   !> Go to the next line of a section. Nothing is done after a fault
   pure subroutine data_line(scanner, section, noun, n_read, n_wanted, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> Name of the section
      character(len=*), intent(in) :: section
      !> What is counted, in the plural
      character(len=*), intent(in) :: noun
      !> How many of them were read, and how many the section announces
      integer, intent(in) :: n_read, n_wanted
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      logical :: found
      character(len=:), allocatable :: text

      if (allocated(fault)) return
      call next_line(scanner, found)
      text = '$'//section//' announces '//to_text(n_wanted)//' '//noun//', but '
      if (.not. found) then
         fault = line_fault(scanner, text//'the file ends after '//to_text(n_read), &
            mend=write_again)
      else if (begins_with_dollar(scanner)) then
         fault = line_fault(scanner, text//'has '//to_text(n_read), mend=write_again)
      end if
   end subroutine data_line

   !> Whether the line is the beginning or the end of a section
   pure logical function begins_with_dollar(scanner)
      !> The scanner
      type(scanner_type), intent(in) :: scanner

      begins_with_dollar = verify(scanner%bytes(scanner%first:scanner%last), ' ') &
                           == index(scanner%bytes(scanner%first:scanner%last), '$')
   end function begins_with_dollar

   !> Read the line that ends a section. Nothing is done after a fault
   pure subroutine end_section(scanner, section, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> Name of the section
      character(len=*), intent(in) :: section
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      logical :: found

      if (allocated(fault)) return
      call next_line(scanner, found)
      if (.not. found) then
         fault = line_fault(scanner, 'the file ends inside the section $'//section, &
            mend=write_again)
         return
      end if
      call next_token(scanner)
      if (token_text(scanner) == '$End'//section) then
         call end_line(scanner, '$End'//section, fault)
      else if (begins_with_dollar(scanner)) then
         fault = token_fault(scanner, 'the section $'//section//' is not ended', &
                             allowed='$End'//section, mend=write_again)
      else
         fault = line_fault(scanner, '$'//section//' has more lines than it announces', &
                            allowed='$End'//section, mend=write_again)
      end if
   end subroutine end_section

   !> Pass over a section. Nothing is done after a fault
   pure subroutine skip_section(scanner, section, fault)
      !> The scanner, on the line that begins the section
      type(scanner_type), intent(inout) :: scanner
      !> Name of the section
      character(len=*), intent(in) :: section
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      logical :: found

      if (allocated(fault)) return
      do
         call next_line(scanner, found)
         if (.not. found) exit
         if (.not. begins_with_dollar(scanner)) cycle
         call next_token(scanner)
         if (token_text(scanner) == '$End'//section) return
      end do
      fault = line_fault(scanner, 'the file ends inside the section $'//section, mend=write_again)
   end subroutine skip_section

   !> Read a number of things, which cannot be larger than the file. Nothing is done after a fault
   pure subroutine read_count(scanner, name, n, fault)
      !> The scanner
      type(scanner_type), intent(inout) :: scanner
      !> What is read, for messages
      character(len=*), intent(in) :: name
      !> The number
      integer, intent(out) :: n
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      call read_integer(scanner, name, 0, huge(n), n, fault)
      if (allocated(fault)) return
      if (n <= len(scanner%bytes)) return
      n = 0
      fault = token_fault(scanner, name//' is more than the file can hold', mend=write_again)
   end subroutine read_count

   !> See that blocks hold as many things as their section announces. Nothing is done after a fault
   pure subroutine count_fault(scanner, section, noun, n_read, n_wanted, fault)
      !> The scanner
      type(scanner_type), intent(in) :: scanner
      !> Name of the section
      character(len=*), intent(in) :: section
      !> What is counted, in the plural
      character(len=*), intent(in) :: noun
      !> How many of them were read, and how many the section announces
      integer, intent(in) :: n_read, n_wanted
      !> What is wrong
      type(fault_type), allocatable, intent(inout) :: fault

      if (allocated(fault) .or. n_read == n_wanted) return
      fault = line_fault(scanner, '$'//section//' announces '//to_text(n_wanted)//' '//noun// &
                         ', but its blocks have '//to_text(n_read), mend=write_again)
   end subroutine count_fault

end module axijoint_gmsh_section
