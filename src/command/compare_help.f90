!> Help on `axijoint compare`
module axijoint_command_compare_help
   implicit none
   private
   public :: compare_help

   !> Line end
   character(len=*), parameter :: nl = new_line('a')
   !> Lines of help
   character(len=*), parameter :: compare_help = &
      'usage: axijoint compare A B [OPTIONS]'//nl// &
      nl// &
      'Compares two listings, two HDF5 result files, or one of each, table by table and'//nl// &
      'column by column. Rows are matched by their places (r, z, theta), whatever the'//nl// &
      'numbers of the nodes. Values are the same if they differ by no more than the largest'//nl// &
      'of the tolerances, and the rounding of the digits printed.'//nl// &
      nl// &
      '  --relative T           of the larger of the two values (default: 1E-6)'//nl// &
      '  --absolute T           in the unit of the value (default: 0)'//nl// &
      '  --of-table T           of the largest of the quantity in the table (default: 1E-9)'//nl// &
      '  --of-file T            of the largest of the quantity in the file (default: 1E-12)'//nl// &
      '  --tolerance NAME=R[,A] relative and absolute, of a quantity or a column'//nl// &
      '  --coordinates T        distance of the same place, of the extent (default: 1E-9)'//nl// &
      '  --exact-digits         printed numbers are exact, not rounded'//nl// &
      '  --allow-missing WHAT   tables, columns, rows or all may be in one file only'//nl// &
      '  --allow-unknown        NaN on both sides or asterisks are no difference'//nl// &
      '  --skip NAME            table, column or quantity that is not compared'//nl// &
      '  --worst N              differences shown for each table (default: 5)'//nl// &
      '  --format-a FILE        description of the format of A; --format-b FILE of B'//nl// &
      '  --print-format         print the description of axijoint''s own listing'//nl// &
      nl// &
      'Exit codes: 0 same; 1 different; 2 a file that cannot be read, or usage.'

end module axijoint_command_compare_help
