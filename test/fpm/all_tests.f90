!> What `fpm test` runs: fpm cannot convert pFUnit files, so a script converts them, lets fpm build
!> them beside this program, with fpm's default options, and runs them
program all_tests
   implicit none

   integer :: status

   call execute_command_line('scripts/pfunit/fpm_test', exitstat=status)
   if (status /= 0) stop 1, quiet=.true.
end program all_tests
