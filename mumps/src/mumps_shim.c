/* MUMPS for symmetric positive definite matrices in the order in which they come, scaled to ones on
   the diagonal, so that a pivot is its ratio to the diagonal entry that it started from */
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <dmumps_c.h>

#define ICNTL(k) icntl[(k) - 1]
#define CNTL(k) cntl[(k) - 1]
#define INFOG(k) infog[(k) - 1]
#define RINFOG(k) rinfog[(k) - 1]

typedef struct {
   DMUMPS_STRUC_C m;
   double *scale;
   int started;
} handle_type;

/* A call of MUMPS; its code, zero or less: a warning is none */
static int call(handle_type *h, int job) {
   h->m.job = job;
   dmumps_c(&h->m);
   return h->m.INFOG(1) < 0 ? h->m.INFOG(1) : 0;
}

static double large(int value) { /* a negative count is in millions */
   return value < 0 ? -1e6 * value : value;
}

void axijoint_mumps_free(void *pointer) {
   handle_type *h = pointer;
   if (!h) return;
   if (h->started) call(h, -2);
   free(h->m.irn);
   free(h->m.jcn);
   free(h->m.perm_in);
   free(h->m.a);
   free(h->scale);
   free(h);
}

/* Start an instance for a pattern and analyse it; of use only if the code is zero */
void *axijoint_mumps_new(int64_t n, const int64_t *start, const int32_t *column, double *entries,
                         double *operations, int64_t *bytes, int32_t *code) {
   int64_t count = start[n] - 1;
   handle_type *h = calloc(1, sizeof *h);
   *code = -13;
   if (!h) return NULL;
   h->m.par = 1;
   h->m.sym = 1; /* positive definite: pivots on the diagonal, one after the other */
   h->m.comm_fortran = -987654;
   if ((*code = call(h, -1)) != 0) return h;
   h->started = 1;
   *code = -13;
   h->m.irn = malloc(sizeof(MUMPS_INT) * (size_t)(count + 1));
   h->m.jcn = malloc(sizeof(MUMPS_INT) * (size_t)(count + 1));
   h->m.perm_in = malloc(sizeof(MUMPS_INT) * (size_t)(n + 1));
   h->m.a = malloc(sizeof(double) * (size_t)(count + 1));
   h->scale = malloc(sizeof(double) * (size_t)(n + 1));
   if (!h->m.irn || !h->m.jcn || !h->m.perm_in || !h->m.a || !h->scale) {
      return h;
   }
   for (int64_t i = 0; i < n; i++) {
      h->m.perm_in[i] = (MUMPS_INT)(i + 1);
      for (int64_t k = start[i] - 1; k < start[i + 1] - 1; k++) {
         h->m.irn[k] = (MUMPS_INT)(i + 1);
         h->m.jcn[k] = column[k];
      }
   }
   h->m.ICNTL(1) = h->m.ICNTL(2) = h->m.ICNTL(3) = -1; /* silent */
   h->m.ICNTL(4) = 0;
   h->m.ICNTL(7) = 1;  /* the order is given */
   h->m.ICNTL(8) = 0;  /* so is the scaling */
   h->m.ICNTL(14) = 30;
   h->m.ICNTL(16) = 1; /* one thread */
   h->m.n = (MUMPS_INT)n;
   h->m.nnz = count;
   *code = call(h, 1);
   *entries = large(h->m.INFOG(20));
   *operations = h->m.RINFOG(1);
   *bytes = (int64_t)h->m.INFOG(17) * 1000000 + 24 * count;
   return h;
}

/* Numerical factorization, with more room if what was expected does not do */
static int factorize(handle_type *h) {
   int code;
   do {
      code = call(h, 2);
      if (code == -8 || code == -9) h->m.ICNTL(14) *= 2;
   } while ((code == -8 || code == -9) && h->m.ICNTL(14) < 1000);
   return code;
}

/* Factor a matrix of the pattern, a share added to its diagonal; `smallest`: the smallest pivot, of the
   scaled matrix, zero if one is not positive */
int32_t axijoint_mumps_factorize(void *pointer, const double *value, double shift, double *smallest) {
   handle_type *h = pointer;
   int32_t code;
   for (int64_t k = 0; k < h->m.nnz; k++)
      if (h->m.irn[k] == h->m.jcn[k]) h->scale[h->m.irn[k] - 1] = value[k] > 0 ? 1 / sqrt(value[k]) : 1;
   for (int64_t k = 0; k < h->m.nnz; k++) {
      h->m.a[k] = value[k] * h->scale[h->m.irn[k] - 1] * h->scale[h->m.jcn[k] - 1];
      if (h->m.irn[k] == h->m.jcn[k]) h->m.a[k] += shift;
   }
   code = factorize(h);
   *smallest = h->m.RINFOG(19);
   if (code == -10 || h->m.INFOG(12) > 0) *smallest = 0;
   return code == -10 ? 0 : code;
}

/* Solve in place */
int32_t axijoint_mumps_solve(void *pointer, int64_t n_rhs, double *b) {
   handle_type *h = pointer;
   int64_t n = h->m.n;
   int32_t code;
   for (int64_t j = 0; j < n_rhs; j++)
      for (int64_t i = 0; i < n; i++) b[j * n + i] *= h->scale[i];
   h->m.nrhs = (MUMPS_INT)n_rhs;
   h->m.lrhs = (MUMPS_INT)n;
   h->m.rhs = b;
   code = call(h, 3);
   h->m.rhs = NULL;
   for (int64_t j = 0; j < n_rhs; j++)
      for (int64_t i = 0; i < n; i++) b[j * n + i] *= h->scale[i];
   return code;
}
