!> Name and version of the program
module axijoint_base_version
   implicit none
   private
   public :: program_name, program_version

   !> Name of the program
   character(len=*), parameter :: program_name = "axijoint"
   !> Version; the same as in fpm.toml
   character(len=*), parameter :: program_version = "0.1.0"

end module axijoint_base_version
