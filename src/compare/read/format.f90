!> How the tables of a listing are printed
module axijoint_compare_read_format
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: format_type, table_format_type, column_format_type, translation_type
   public :: place_free, place_fixed, place_heading, place_constant
   public :: blank_missing, blank_zero, blank_above
   public :: end_blank, end_next, end_heading, end_text

   !> The next value of the line, between blanks
   integer, parameter :: place_free = 0
   !> Fixed columns of the line
   integer, parameter :: place_fixed = 1
   !> Named in the heading, or in a line before it
   integer, parameter :: place_heading = 2
   !> The same in every row
   integer, parameter :: place_constant = 3

   !> A blank field has no value
   integer, parameter :: blank_missing = 0
   !> A blank field is zero
   integer, parameter :: blank_zero = 1
   !> A blank field repeats the value of the row above
   integer, parameter :: blank_above = 2

   !> A blank line ends the table
   integer, parameter :: end_blank = 0
   !> The heading of another table ends it, or the end of the file
   integer, parameter :: end_next = 1
   !> There are no rows but the heading itself
   integer, parameter :: end_heading = 2
   !> A line with a certain text ends it
   integer, parameter :: end_text = 3

   !> A word of the program, and the word that it means
   type :: translation_type
      !> Word that is printed
      character(len=:), allocatable :: from
      !> Word that is compared
      character(len=:), allocatable :: to
   end type translation_type

   !> A column
   type :: column_format_type
      !> Name
      character(len=:), allocatable :: name
      !> One of the `kind_` parameters of `axijoint_compare_table_table`
      integer :: kind = 0
      !> One of the `place_` parameters
      integer :: place = place_free
      !> Fixed columns
      integer :: first = 0, last = 0
      !> Value that is the same in every row
      character(len=:), allocatable :: constant
      !> What printed numbers are multiplied by, and the same for harmonic 0
      real(wp) :: factor = 1.0_wp, factor_m0 = 1.0_wp
      !> One of the `blank_` parameters
      integer :: blank = blank_missing
      !> Words that mean others
      type(translation_type), allocatable :: translations(:)
   end type column_format_type

   !> A table
   type :: table_format_type
      !> Name
      character(len=:), allocatable :: name
      !> Heading, names of parameters in braces
      character(len=:), allocatable :: heading
      !> Lines between heading and rows
      integer :: skip = 0
      !> One of the `end_` parameters
      integer :: ending = end_blank
      !> Text that ends the table
      character(len=:), allocatable :: ending_text
      !> Columns
      type(column_format_type), allocatable :: columns(:)
   end type table_format_type

   !> A text
   type, public :: pattern_type
      !> The text
      character(len=:), allocatable :: text
   end type pattern_type

   !> A listing
   type :: format_type
      !> What program prints it
      character(len=:), allocatable :: name
      !> Line that a listing of this format has; empty: not asked for
      character(len=:), allocatable :: first
      !> Line that a whole listing has behind its tables; empty: not asked for
      character(len=:), allocatable :: last
      !> Whether the first character of each line is for the printer
      logical :: carriage = .false.
      !> Lines that are no rows
      type(pattern_type), allocatable :: ignored(:)
      !> Lines that give parameters to the tables behind them
      type(pattern_type), allocatable :: lines(:)
      !> Tables
      type(table_format_type), allocatable :: tables(:)
   end type format_type

end module axijoint_compare_read_format
