/* Supernodal Cholesky factorization by SuiteSparse's CHOLMOD, behind plain arguments: its
   settings live in a large struct that Fortran cannot see. Matrices come as the lower triangle
   by rows, counted from one, which is the upper triangle by columns. Every handle owns its
   settings, so that several factorizations may run at once. */
#include <omp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

typedef struct {
   cholmod_common common;
   cholmod_factor *factor; /* symbolic for a plan, numeric for a factor */
   int64_t n;
} handle_type;

static void choose(cholmod_common *common) {
   cholmod_l_start(common);
   common->print = 0;
   common->supernodal = CHOLMOD_SUPERNODAL;
   common->final_ll = 1;
   common->nmethods = 1;
   common->method[0].ordering = CHOLMOD_NATURAL; /* the order is chosen by the caller */
   common->postorder = 1;
   /* fewer and larger supernodes than by default: faster for two to three unknowns a node */
   common->nrelax[0] = 16;
   common->nrelax[1] = 48;
   common->nrelax[2] = 96;
   common->zrelax[0] = 0.8;
   common->zrelax[1] = 0.3;
   common->zrelax[2] = 0.15;
}

/* CHOLMOD shares its loops among four threads if it may; here a thread works on a harmonic of its
   own, and threads inside it would only wait for each other. Gives what to restore afterwards. */
static int forbid_threads(void) {
   int levels = omp_get_max_active_levels();
   omp_set_max_active_levels(omp_get_active_level());
   return levels;
}

/* A matrix of our arrays, counted from zero; its indices are the caller's to free */
static cholmod_sparse view(int64_t n, const int64_t *start, const int32_t *column,
                           const double *value, int64_t *p, int64_t *i) {
   cholmod_sparse a;
   int64_t k, entries = start[n] - 1;
   for (k = 0; k <= n; k++) p[k] = start[k] - 1;
   for (k = 0; k < entries; k++) i[k] = (int64_t)column[k] - 1;
   memset(&a, 0, sizeof a);
   a.nrow = a.ncol = (size_t)n;
   a.nzmax = (size_t)entries;
   a.p = p;
   a.i = i;
   a.x = (void *)value;
   a.stype = 1; /* upper triangle */
   a.itype = CHOLMOD_LONG;
   a.xtype = value ? CHOLMOD_REAL : CHOLMOD_PATTERN;
   a.dtype = CHOLMOD_DOUBLE;
   a.sorted = 1;
   a.packed = 1;
   return a;
}

void axijoint_cholmod_free(void *pointer) {
   handle_type *handle = pointer;
   if (!handle) return;
   cholmod_l_free_factor(&handle->factor, &handle->common);
   cholmod_l_finish(&handle->common);
   free(handle);
}

/* Plan for a pattern: null if there is no memory. Gives the entries of the factor, the
   operations of a factorization and the bytes of a factor. */
void *axijoint_cholmod_analyse(int64_t n, const int64_t *start, const int32_t *column,
                               double *entries, double *operations, int64_t *bytes) {
   handle_type *plan = malloc(sizeof *plan);
   int64_t *p = malloc(sizeof *p * (size_t)(n + 1));
   int64_t *i = malloc(sizeof *i * (size_t)(start[n] > 1 ? start[n] - 1 : 1));
   cholmod_sparse a;
   if (!plan || !p || !i) {
      free(plan);
      plan = NULL;
   } else {
      choose(&plan->common);
      plan->n = n;
      a = view(n, start, column, NULL, p, i);
      plan->factor = cholmod_l_analyze(&a, &plan->common);
      *entries = plan->common.lnz;
      *operations = plan->common.fl;
      if (!plan->factor) {
         axijoint_cholmod_free(plan);
         plan = NULL;
      } else {
         *bytes = (int64_t)sizeof(double) * (int64_t)plan->factor->xsize
                  + (int64_t)sizeof(int64_t) * ((int64_t)plan->factor->ssize + 3 * n);
      }
   }
   free(p);
   free(i);
   return plan;
}

/* Factor of a matrix of the pattern: null if there is no memory. `failed` is zero or the
   equation, counted from one, whose pivot is not positive; `diagonal` takes the diagonal of the
   factor in the order of the equations. */
void *axijoint_cholmod_factorize(const void *pointer, const int64_t *start, const int32_t *column,
                                 const double *value, double *diagonal, int64_t *failed) {
   const handle_type *plan = pointer;
   int64_t n = plan->n;
   handle_type *handle = malloc(sizeof *handle);
   int64_t *p = malloc(sizeof *p * (size_t)(n + 1));
   int64_t *i = malloc(sizeof *i * (size_t)(start[n] > 1 ? start[n] - 1 : 1));
   *failed = 0;
   if (!handle || !p || !i) {
      free(handle);
      handle = NULL;
   } else {
      cholmod_sparse a = view(n, start, column, value, p, i);
      int ok, levels = forbid_threads();
      choose(&handle->common);
      handle->n = n;
      handle->factor = cholmod_l_copy_factor(plan->factor, &handle->common);
      ok = handle->factor && cholmod_l_factorize(&a, handle->factor, &handle->common);
      omp_set_max_active_levels(levels);
      if (!ok || handle->common.status == CHOLMOD_OUT_OF_MEMORY) {
         axijoint_cholmod_free(handle);
         handle = NULL;
      } else {
         cholmod_factor *l = handle->factor;
         const int64_t *order = l->Perm, *super = l->super, *pi = l->pi, *px = l->px;
         const double *x = l->x;
         int64_t s, k;
         if (handle->common.status == CHOLMOD_NOT_POSDEF) *failed = order[l->minor] + 1;
         for (s = 0; s < (int64_t)l->nsuper && *failed == 0; s++)
            for (k = super[s]; k < super[s + 1]; k++) {
               int64_t c = k - super[s], rows = pi[s + 1] - pi[s];
               diagonal[order[k]] = x[px[s] + c * rows + c];
            }
      }
   }
   free(p);
   free(i);
   return handle;
}

/* Solve for a block of right-hand sides in place; 0, or 1 if there is no memory */
int axijoint_cholmod_solve(void *pointer, int64_t n_rhs, double *b) {
   handle_type *handle = pointer;
   cholmod_dense right, *x;
   int levels;
   memset(&right, 0, sizeof right);
   right.nrow = right.d = (size_t)handle->n;
   right.ncol = (size_t)n_rhs;
   right.nzmax = right.nrow * right.ncol;
   right.x = b;
   right.xtype = CHOLMOD_REAL;
   right.dtype = CHOLMOD_DOUBLE;
   levels = forbid_threads();
   x = cholmod_l_solve(CHOLMOD_A, handle->factor, &right, &handle->common);
   omp_set_max_active_levels(levels);
   if (!x) return 1;
   memcpy(b, x->x, sizeof(double) * right.nzmax);
   cholmod_l_free_dense(&x, &handle->common);
   return 0;
}

/* The columns of the factor at a set of equations, counted from one, as a dense lower triangle:
   its Schur complement is the product of that triangle and its transpose, if no entry of the
   columns lies outside the set. That is so where the set is ordered last, and stays so whatever
   order the elimination tree then asks for. `place` takes the place in the set of each row of the
   triangle. 0; 1 if there is no memory; 2 if entries lie outside the set. */
int axijoint_cholmod_trailing(const void *pointer, int64_t count, const int32_t *set,
                              double *triangle, int32_t *place) {
   const handle_type *handle = pointer;
   const cholmod_factor *l = handle->factor;
   const int64_t *order = l->Perm, *super = l->super, *pi = l->pi, *px = l->px, *rows = l->s;
   const double *x = l->x;
   int64_t k, s, c, n = handle->n, found = 0;
   int64_t *rank = malloc(sizeof *rank * (size_t)(n + 1)); /* by equation, then by row of L */
   int64_t *by_row = malloc(sizeof *by_row * (size_t)(n + 1));
   int code = !rank || !by_row;
   if (!code) {
      for (k = 0; k < n; k++) rank[k] = -1;
      for (k = 0; k < count; k++) rank[set[k] - 1] = k;
      for (k = 0; k < n; k++) {
         int64_t member = rank[order[k]];
         by_row[k] = member < 0 ? -1 : found;
         if (member >= 0) place[found++] = (int32_t)(member + 1);
      }
      for (s = 0; s < (int64_t)l->nsuper && !code; s++) {
         int64_t height = pi[s + 1] - pi[s];
         for (c = super[s]; c < super[s + 1] && !code; c++) {
            const double *column = x + px[s] + (c - super[s]) * height;
            if (by_row[c] < 0) continue;
            for (k = c - super[s]; k < height && !code; k++) {
               int64_t row = by_row[rows[pi[s] + k]];
               if (row >= 0) triangle[by_row[c] * count + row] = column[k];
               else if (column[k] != 0.0) code = 2;
            }
         }
      }
   }
   free(rank);
   free(by_row);
   return code;
}
