/* What all drivers of peers share: the matrix that `solvers --dump` wrote, clocks, and the line of
   comma-separated values that each prints:
   name,order,analysis_s,factorization_s,repeated_s,solve_s,operations,factor_mb,factor_entries,
   lapack_ratio,processor_share
   `factorization_s` is the least of three in fresh memory, `repeated_s` of three into memory that
   the solver kept, where it can; its share is the processor's time in the wall clock's. */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

typedef struct { /* lower triangle by rows, counted from one */
   int64_t n, entries, *start;
   int32_t *column;
   double *value;
} matrix_type;

static void fail(const char *text) {
   fprintf(stderr, "%s\n", text);
   exit(1);
}

static void *room(size_t bytes) {
   void *p = malloc(bytes ? bytes : 1);
   if (!p) fail("out of memory");
   return p;
}

static void take(void *to, size_t size, size_t count, FILE *file) {
   if (fread(to, size, count, file) != count) fail("the file of the matrix ends too early");
}

static matrix_type read_matrix(const char *path) {
   matrix_type a;
   FILE *file = fopen(path, "rb");
   if (!file) fail("the file of the matrix cannot be read");
   take(&a.n, 8, 1, file);
   take(&a.entries, 8, 1, file);
   a.start = room(8 * (size_t)(a.n + 1));
   a.column = room(4 * (size_t)a.entries);
   a.value = room(8 * (size_t)a.entries);
   take(a.start, 8, (size_t)a.n + 1, file);
   take(a.column, 4, (size_t)a.entries, file);
   take(a.value, 8, (size_t)a.entries, file);
   fclose(file);
   return a;
}

static double clock_of(clockid_t id) {
   struct timespec t;
   clock_gettime(id, &t);
   return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Processor time: on one thread the wall clock's, but for what other processes take */
static double seconds(void) { return clock_of(CLOCK_PROCESS_CPUTIME_ID); }
static double wall_seconds(void) { return clock_of(CLOCK_MONOTONIC); }

static double least3(const double *t) { return fmin(t[0], fmin(t[1], t[2])); }

static double *ones(int64_t n) {
   double *b = room(8 * (size_t)n);
   for (int64_t i = 0; i < n; i++) b[i] = 1.0;
   return b;
}

/* |b - A x|/(|A||x| n eps) in maximum norms, b all ones */
static double lapack_ratio(const matrix_type *a, const double *x) {
   double *r = ones(a->n), *sum = calloc((size_t)a->n, 8), norm = 0, most = 0, residual = 0;
   for (int64_t i = 0; i < a->n; i++)
      for (int64_t k = a->start[i] - 1; k < a->start[i + 1] - 1; k++) {
         int64_t j = a->column[k] - 1;
         r[i] -= a->value[k] * x[j];
         sum[i] += fabs(a->value[k]);
         if (i != j) {
            r[j] -= a->value[k] * x[i];
            sum[j] += fabs(a->value[k]);
         }
      }
   for (int64_t i = 0; i < a->n; i++) {
      norm = fmax(norm, sum[i]);
      most = fmax(most, fabs(x[i]));
      residual = fmax(residual, fabs(r[i]));
   }
   free(r);
   free(sum);
   return residual / (norm * most * (double)a->n * 2.220446049250313e-16);
}
