!> The manual page, in the language of man
module axijoint_command_man_page
   use axijoint_base_version, only : program_name, program_version
   use axijoint_command_manual, only : topic_type
   implicit none
   private
   public :: man_page

   !> Line end
   character(len=*), parameter :: nl = new_line('a')

contains

   !> The page
   pure function man_page(topics) result(text)
      !> The commands
      type(topic_type), intent(in) :: topics(:)
      !> Its source
      character(len=:), allocatable :: text

      integer :: k, i

      text = '.TH AXIJOINT 1 "" "'//program_name//' '//program_version//'"'//nl// &
         '.SH NAME'//nl//program_name//' \- Fourier finite element analysis of axisymmetric '// &
         'bodies with joints'//nl//'.SH SYNOPSIS'
      do k = 1, size(topics)
         text = text//nl//'.B '//program_name//' '//trim(topics(k)%name)//nl// &
                '.RI "'//trim(topics(k)%arguments)//' [" OPTIONS ]'//nl//'.br'
      end do
      text = text//nl//'.B '//program_name//' help card'//nl//'.RI [ NAME ]'//nl//'.br'//nl// &
         '.B '//program_name//' \-\-version'//nl//'.SH COMMANDS'
      do k = 1, size(topics)
         text = text//nl//'.SS '//trim(topics(k)%name)//nl//plain(trim(topics(k)%description))
         do i = 1, size(topics(k)%options)
            associate (option => topics(k)%options(i))
               text = text//nl//'.TP'//nl//'.BI '//plain(trim(option%name))//' "'// &
                  trim(' '//option%value)//'"'//nl//plain(trim(option%meaning))
            end associate
         end do
         if (len_trim(topics(k)%exit_codes) > 0) &
            text = text//nl//'.PP'//nl//'Exit codes: '//plain(trim(topics(k)%exit_codes))
      end do
      text = text//nl//'.SH ENVIRONMENT'//nl// &
         '.TP'//nl//'.B OMP_NUM_THREADS'//nl//'Harmonics at once.'//nl// &
         '.TP'//nl//'.B OMP_WAIT_POLICY, GOMP_SPINCOUNT, OPENBLAS_NUM_THREADS, OPENBLAS_CORETYPE'//nl// &
         'Set by the program where they are not set: PASSIVE, 5000 (with PASSIVE alone), 1, and the kernel for '// &
         'processors with AVX\-512.'//nl// &
         '.SH EXAMPLES'//nl//'.nf'//nl// &
         program_name//' run first.dat \-o out'//nl// &
         'sed "s/30.0/25.0/" first.dat | '//program_name//' run \- \-o out/phi25'//nl// &
         program_name//' help card BLOCKS'//nl//'.fi'
   end function man_page

   !> Text with what means something in the language masked
   pure function plain(text) result(masked)
      !> The text
      character(len=*), intent(in) :: text
      !> The same
      character(len=:), allocatable :: masked

      integer :: i

      masked = ''
      do i = 1, len(text)
         select case (text(i:i))
         case ('-')
            masked = masked//'\-'
         case ('\')
            masked = masked//'\e'
         case ('`')
            masked = masked//'\(ga'
         case default
            if (i == 1 .and. scan(text(1:1), '.''') == 1) masked = '\&'
            masked = masked//text(i:i)
         end select
      end do
   end function plain

end module axijoint_command_man_page
