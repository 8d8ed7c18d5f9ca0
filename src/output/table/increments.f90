!> What is followed from increment to increment: in the listing and the summary
module axijoint_output_table_increments
   use axijoint_analysis_core_series, only : series_type
   use axijoint_output_file_columns, only : columns
   use axijoint_output_file_headings, only : write_heading
   use axijoint_output_file_json, only : json_number
   use axijoint_output_file_text, only : text_file_type
   implicit none
   private
   public :: write_increment_table, increments_json

   !> Increment, iterations
   character(len=*), parameter :: format_increment = '(2i10)'
   !> Columns of reals
   integer, parameter :: wide = 15

contains

   !> Table of the listing, of jobs of several increments
   subroutine write_increment_table(file, series)
      !> The listing
      class(text_file_type), intent(inout) :: file
      !> The series
      type(series_type), intent(in) :: series

      !> Behind a row, where there is no room for words
      character(len=*), parameter :: mark = "***"
      character(len=20) :: numbers
      integer :: i

      if (series%n < 2) return
      call write_heading(file, "INCREMENTS")
      call file%put("  (largest displacement; largest pressure in joints; work of "// &
         "loads and given displacements, elastic energy,")
      call file%put("  work dissipated by sliding and plastic strain: forces by the mean of both ends)")
      if (any(series%equilibrium /= 1)) call file%put("  "//mark//": not in equilibrium")
      call file%put(" increment iterations   load factor       residual   displacement       "// &
         "pressure           work         energy     dissipated")
      do i = 1, series%n
         write (numbers, format_increment) series%increment(i), series%iterations(i)
         call file%put(numbers//columns([series%load_factor(i), series%residual(i), &
            series%displacement(i), series%pressure(i), series%work(i), series%energy(i), &
            series%dissipated(i)], wide)//merge("    ", " "//mark, series%equilibrium(i) == 1))
      end do
   end subroutine write_increment_table

   !> The same in the summary, of all jobs
   pure function increments_json(series) result(json)
      !> The series
      type(series_type), intent(in) :: series
      !> A JSON array
      character(len=:), allocatable :: json

      integer :: i

      json = "["
      do i = 1, series%n
         if (i > 1) json = json//", "
         json = json//'{"increment": '//json_number(series%increment(i))// &
            ', "equilibrium": '//trim(merge('true ', 'false', series%equilibrium(i) == 1))// &
            ', "load_factor": '//json_number(series%load_factor(i))// &
            ', "iterations": '//json_number(series%iterations(i))// &
            ', "residual": '//json_number(series%residual(i))// &
            ', "largest_displacement": '//json_number(series%displacement(i))// &
            ', "largest_pressure": '//json_number(series%pressure(i))// &
            ', "largest_shear": '//json_number(series%shear(i))// &
            ', "slip": '//json_number(series%n_slip(i))// &
            ', "open": '//json_number(series%n_open(i))// &
            ', "work": '//json_number(series%work(i))// &
            ', "energy": '//json_number(series%energy(i))// &
            ', "dissipated": '//json_number(series%dissipated(i))//'}'
      end do
      json = json//"]"
   end function increments_json

end module axijoint_output_table_increments
