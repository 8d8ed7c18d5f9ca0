!> What two files may differ by
module axijoint_compare_tolerances
   use axijoint_base_kinds, only : wp
   use axijoint_compare_table_cell, only : cell_type
   implicit none
   private
   public :: tolerances_type, special_type, allowed_difference, floor_difference, is_skipped

   !> Tolerances of one quantity or column
   type :: special_type
      !> Name of the quantity or of the column
      character(len=:), allocatable :: name
      !> Relative and absolute tolerance
      real(wp) :: relative = 0.0_wp, absolute = 0.0_wp
   end type special_type

   !> A name
   type, public :: name_type
      !> The name
      character(len=:), allocatable :: text
   end type name_type

   !> All tolerances and permissions
   type :: tolerances_type
      !> Of the larger of the two values
      real(wp) :: relative = 1.0e-6_wp
      !> In the unit of the value
      real(wp) :: absolute = 0.0_wp
      !> Of the largest value of the quantity in the table
      real(wp) :: of_table = 1.0e-9_wp
      !> Of the largest value of the quantity in the file
      real(wp) :: of_file = 1.0e-12_wp
      !> Distance of places that are the same, of the largest coordinate in the table
      real(wp) :: coordinates = 1.0e-9_wp
      !> Tolerances of single quantities and columns
      type(special_type), allocatable :: special(:)
      !> Whether printed numbers stand for all that round to them
      logical :: rounded = .true.
      !> Whether tables, columns, rows may be in one of the files only
      logical :: missing_tables = .false., missing_columns = .false., missing_rows = .false.
      !> Whether values that cannot be compared are passed over
      logical :: unknown = .false.
      !> Tables, columns and quantities that are not compared
      type(name_type), allocatable :: skipped(:)
      !> How many of the worst differences of a table are shown
      integer :: n_worst = 5
   end type tolerances_type

   !> Multiple of the spacing of reals that factors and decimals may cost
   real(wp), parameter :: rounding = 8.0_wp*epsilon(1.0_wp)

contains

   !> Difference that two values may have
   pure real(wp) function allowed_difference(tolerances, special, floor, a, b) result(allowed)
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Index of the special tolerance of the column; 0 if there is none
      integer, intent(in) :: special
      !> Difference that is allowed whatever the values
      real(wp), intent(in) :: floor
      !> The values
      type(cell_type), intent(in) :: a, b

      real(wp) :: size

      size = max(abs(a%value), abs(b%value))
      allowed = max(floor, relative_of(tolerances, special)*size) + rounding*size
      if (tolerances%rounded) allowed = allowed + 0.5_wp*(a%unit + b%unit)*(1.0_wp + 1.0e-6_wp)
   end function allowed_difference

   !> Difference that is allowed whatever the values
   pure real(wp) function floor_difference(tolerances, special, table_scale, &
      file_scale) result(floor)
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Index of the special tolerance of the column; 0 if there is none
      integer, intent(in) :: special
      !> Largest values of the quantity in the table and in the file
      real(wp), intent(in) :: table_scale, file_scale

      floor = max(tolerances%of_table*table_scale, tolerances%of_file*file_scale)
      if (special > 0) then
         floor = max(floor, tolerances%special(special)%absolute)
      else
         floor = max(floor, tolerances%absolute)
      end if
   end function floor_difference

   !> Relative tolerance of a column
   pure real(wp) function relative_of(tolerances, special) result(relative)
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Index of the special tolerance of the column; 0 if there is none
      integer, intent(in) :: special

      relative = tolerances%relative
      if (special > 0) relative = tolerances%special(special)%relative
   end function relative_of

   !> Whether a table, column or quantity is not compared
   pure logical function is_skipped(tolerances, name)
      !> Tolerances
      type(tolerances_type), intent(in) :: tolerances
      !> Name
      character(len=*), intent(in) :: name

      integer :: k

      is_skipped = .false.
      do k = 1, size(tolerances%skipped)
         if (tolerances%skipped(k)%text == name) is_skipped = .true.
      end do
   end function is_skipped

end module axijoint_compare_tolerances
