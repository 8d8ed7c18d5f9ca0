!> Room for the buffers of the BLAS
module axijoint_linalg_blas_buffers
   use, intrinsic :: iso_c_binding, only : c_int
   implicit none
   private
   public :: reserve_blas_buffers

   interface
      !> Take and give back buffers; blas_shim.c
      subroutine c_reserve_buffers(count) bind(c, name='axijoint_reserve_buffers')
         import :: c_int
         integer(c_int), value :: count
      end subroutine c_reserve_buffers
   end interface

contains

   !> Where the address space is limited, let the BLAS take the buffers of all threads, so that what is free afterwards
   !> is free for data
   subroutine reserve_blas_buffers(n_threads)
      !> Threads that call it at once
      integer, intent(in) :: n_threads

      call c_reserve_buffers(int(n_threads, c_int))
   end subroutine reserve_blas_buffers

end module axijoint_linalg_blas_buffers
