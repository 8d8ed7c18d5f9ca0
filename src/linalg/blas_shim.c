/* OpenBLAS's buffers. Each thread that calls it takes one of 128 MiB of address space, which stays; if there is no
   room it tries again for ever. So where the address space is limited they are taken before the work, and what is
   planned with the rest holds. Other libraries of the same routines have no such function. */
#include <sys/resource.h>

enum { most = 256 };

void *blas_memory_alloc(int position) __attribute__((weak));
void blas_memory_free(void *buffer) __attribute__((weak));

void axijoint_reserve_buffers(int count)
{
   struct rlimit space;
   void *buffers[most];
   if (!blas_memory_alloc || !blas_memory_free) return;
   if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY) return;
   if (count > most) count = most;
   for (int k = 0; k < count; k++) buffers[k] = blas_memory_alloc(0);
   for (int k = 0; k < count; k++) blas_memory_free(buffers[k]);
}
