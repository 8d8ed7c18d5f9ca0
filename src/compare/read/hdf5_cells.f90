!> Arrays of a result file as values of tables
module axijoint_compare_read_hdf5_cells
   use, intrinsic :: ieee_arithmetic, only : ieee_is_nan, ieee_is_finite, ieee_is_negative, &
      ieee_value, ieee_quiet_nan
   use axijoint_base_kinds, only : wp
   use axijoint_compare_read_hdf5_arrays, only : result_file_type
   use axijoint_compare_table_cell, only : cell_type, cell_number, cell_word, cell_not_a_number, &
      cell_infinite
   use axijoint_compare_table_table, only : words_type, column_type, word_index, kind_coordinate
   implicit none
   private
   public :: array_type, array, at, number, word_cell, new_column, columns_of, coordinates

   !> An array of the file
   type :: array_type
      !> Values, the first index fastest
      real(wp), allocatable :: value(:)
      !> Extents, 1 beyond the rank
      integer :: extent(4) = 0
   end type array_type

contains

   !> Read an array
   function array(file, name)
      !> The file
      type(result_file_type), intent(inout) :: file
      !> Absolute path in the file
      character(len=*), intent(in) :: name
      !> The array
      type(array_type) :: array

      call file%read(name, array%value, array%extent)
   end function array

   !> One value of an array; none, NaN, beyond what a damaged file holds of it
   pure real(wp) function at(array, i, j, k, l)
      !> The array
      type(array_type), intent(in) :: array
      !> Indices; those that are absent are 1
      integer, intent(in) :: i
      integer, intent(in), optional :: j, k, l

      integer :: place

      place = i
      if (present(j)) place = place + array%extent(1)*(j - 1)
      if (present(k)) place = place + product(array%extent(:2))*(k - 1)
      if (present(l)) place = place + product(array%extent(:3))*(l - 1)
      if (place >= 1 .and. place <= size(array%value)) then
         at = array%value(place)
      else
         at = ieee_value(at, ieee_quiet_nan)
      end if
   end function at

   !> A number as a value
   elemental type(cell_type) function number(value) result(cell)
      !> The number
      real(wp), intent(in) :: value

      cell = cell_type(0.0_wp, 0.0_wp, cell_number)
      if (ieee_is_nan(value)) then
         cell%state = cell_not_a_number
      else if (.not. ieee_is_finite(value)) then
         cell%state = cell_infinite
         cell%value = merge(-1.0_wp, 1.0_wp, ieee_is_negative(value))
      else
         cell%value = value
      end if
   end function number

   !> A word as a value
   function word_cell(words, text) result(cell)
      !> Words of both files
      type(words_type), intent(inout) :: words
      !> The word
      character(len=*), intent(in) :: text
      !> The value
      type(cell_type) :: cell

      integer :: word

      call word_index(words, text, word)
      cell = cell_type(real(word, wp), 0.0_wp, cell_word)
   end function word_cell

   !> A column
   pure function new_column(name, kind) result(column)
      !> Name
      character(len=*), intent(in) :: name
      !> One of the `kind_` parameters
      integer, intent(in) :: kind
      !> The column
      type(column_type) :: column

      column%name = name
      column%kind = kind
   end function new_column

   !> Columns r and z
   pure function coordinates() result(columns)
      !> The columns
      type(column_type) :: columns(2)

      columns(1) = new_column('r', kind_coordinate)
      columns(2) = new_column('z', kind_coordinate)
   end function coordinates

   !> Columns of the components of a quantity
   pure function columns_of(names, kind) result(columns)
      !> Names of the components, and their quantity
      character(len=*), intent(in) :: names(:)
      integer, intent(in) :: kind
      !> The columns
      type(column_type) :: columns(size(names))

      integer :: k

      columns = [(new_column(trim(names(k)), kind), k=1, size(names))]
   end function columns_of

end module axijoint_compare_read_hdf5_cells
