/* How fast memory is moved: bytes read and written a second by copies of arrays that no cache holds, and bytes of fresh memory that
   are touched first a second, by all threads together; medians of five. */
#define _GNU_SOURCE
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { megabytes = 128, rounds = 5 };

static const size_t size = (size_t)megabytes << 20;

/* The same part of an array for the same thread in all loops */
static void part(char *target, const char *source)
{
#pragma omp parallel
   {
      size_t n = size / (size_t)omp_get_num_threads(), first = n * (size_t)omp_get_thread_num();
      if (source)
         memcpy(target + first, source + first, n);
      else
         memset(target + first, 1, n);
   }
}

static int ascending(const void *a, const void *b)
{
   const double x = *(const double *)a, y = *(const double *)b;
   return (x > y) - (x < y);
}

static char *fresh(void)
{
   char *block = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
   if (block == MAP_FAILED) {
      perror("mmap");
      exit(1);
   }
   madvise(block, size, MADV_HUGEPAGE);
   return block;
}

int main(void)
{
   double copying[rounds], touching[rounds];
   char *source = fresh(), *target = fresh();
   part(source, NULL);
   part(target, NULL);
   for (int k = 0; k < rounds; k++) {
      double begun = omp_get_wtime();
      part(target, source);
      copying[k] = omp_get_wtime() - begun;
   }
   for (int k = 0; k < rounds; k++) {
      char *block = fresh();
      double begun = omp_get_wtime();
      part(block, NULL);
      touching[k] = omp_get_wtime() - begun;
      munmap(block, size);
   }
   qsort(copying, rounds, sizeof *copying, ascending);
   qsort(touching, rounds, sizeof *touching, ascending);
   printf("%g %g\n", 2.0 * (double)size / copying[rounds / 2], (double)size / touching[rounds / 2]);
   return 0;
}
