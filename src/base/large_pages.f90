!> Large pages of memory for large arrays
module axijoint_base_large_pages
   use, intrinsic :: iso_c_binding, only : c_double, c_int64_t
   use axijoint_base_kinds, only : wp
   implicit none
   private
   public :: use_large_pages, zero_large_pages

   interface
      !> Ask for large pages; system_shim.c
      subroutine c_use_large_pages(array, count) bind(c, name='axijoint_use_large_pages')
         import :: c_double, c_int64_t
         real(c_double), intent(inout) :: array(*)
         integer(c_int64_t), value :: count
      end subroutine c_use_large_pages
      !> Zeros in large pages; system_shim.c
      subroutine c_zero_large_pages(array, count) bind(c, name='axijoint_zero_large_pages')
         import :: c_double, c_int64_t
         real(c_double), intent(inout) :: array(*)
         integer(c_int64_t), value :: count
      end subroutine c_zero_large_pages
   end interface

   !> Ask for large pages for an array that has just been allocated
   interface use_large_pages
      module procedure for_vector
      module procedure for_matrix
   end interface use_large_pages

contains

   !> Large pages for a vector
   subroutine for_vector(array)
      !> The vector, not yet touched
      real(wp), intent(inout), contiguous :: array(:)

      call c_use_large_pages(array, size(array, kind=c_int64_t))
   end subroutine for_vector

   !> Large pages for a matrix
   subroutine for_matrix(array)
      !> The matrix, not yet touched
      real(wp), intent(inout), contiguous :: array(:, :)

      call c_use_large_pages(array, size(array, kind=c_int64_t))
   end subroutine for_matrix

   !> Zeros in a matrix that has just been allocated; large pages are cleared when they are first
   !> touched
   subroutine zero_large_pages(array)
      !> The matrix, not yet touched
      real(wp), intent(inout), contiguous :: array(:, :)

      call c_zero_large_pages(array, size(array, kind=c_int64_t))
   end subroutine zero_large_pages

end module axijoint_base_large_pages
