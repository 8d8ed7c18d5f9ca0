/* Supernodal Cholesky factorization by SuiteSparse's CHOLMOD, behind plain arguments: its
   settings live in a large struct that Fortran cannot see. Matrices come as the lower triangle
   by rows, counted from one, which is the upper triangle by columns. Every handle owns its
   settings, so that several factorizations may run at once. */
#include <omp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>
#include <sys/mman.h>

/* Here requests for memory may fail, as all are looked at: base/last_words_shim.c */
void axijoint_let_fail(int change);

typedef struct {
   cholmod_common common;
   cholmod_factor *factor; /* symbolic for a plan, numeric for a factor */
   int64_t n;
   /* Of a plan: the lower triangle by columns in the order of the factor, and where the value of
      each entry is found. So a factorization gathers its values and has nothing to transpose. */
   int64_t *start;
   int32_t *row, *from;
   /* Of a factor: room for the solution of one right-hand side, so that none is refused for want
      of memory: the unknowns in the order of the factor, and the rows of a supernode */
   double *permuted, *rows;
   omp_lock_t reserved;
} handle_type;

/* Memory that is used again and again: large pages are cleared on first touch with far fewer
   faults, and are found faster. Factors that are kept do without: many at once take memory that
   nobody used before, and large pages of that were measured to cost more than small ones. */
static void *allocate(size_t bytes) {
#ifdef MADV_HUGEPAGE
   const size_t page = (size_t)1 << 21;
   void *memory;
   if (bytes >= 8 * page) {
      if (posix_memalign(&memory, page, bytes)) return NULL;
      madvise(memory, bytes / page * page, MADV_HUGEPAGE);
      return memory;
   }
#endif
   return malloc(bytes);
}

/* Numbers behind a factor, and behind the rows of a supernode, that the solution may reach (panel.f90) */
static const size_t beyond = 8;

/* A handle with the settings of all factorizations; null if there is no memory */
static handle_type *new_handle(int64_t n) {
   handle_type *handle = calloc(1, sizeof *handle);
   cholmod_common *common;
   if (!handle) return NULL;
   handle->n = n;
   omp_init_lock(&handle->reserved);
   common = &handle->common;
   cholmod_l_start(common);
   common->print = 0;
   common->supernodal = CHOLMOD_SUPERNODAL;
   common->final_ll = 1;
   common->nmethods = 1;
   common->method[0].ordering = CHOLMOD_NATURAL; /* the order is chosen by the caller */
   common->postorder = 1;
   return handle;
}

/* A view of a triangle by columns */
static cholmod_sparse view(int64_t n, int64_t *start, int64_t *row, double *value, int stype) {
   cholmod_sparse a;
   memset(&a, 0, sizeof a);
   a.nrow = a.ncol = (size_t)n;
   a.nzmax = (size_t)start[n];
   a.p = start;
   a.i = row;
   a.x = value;
   a.stype = stype;
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
   omp_destroy_lock(&handle->reserved);
   free(handle->start);
   free(handle->row);
   free(handle->from);
   free(handle->permuted);
   free(handle->rows);
   free(handle);
}

/* Whether a column of the lower triangle tells nothing that the column before it does not tell: the two equations are
   coupled, and whoever is coupled to the second below it is coupled to the first. Eliminating the first then fills the
   second with all that it holds. So it is with the second and third component of a node. Null if there is no memory */
static char *find_followers(int64_t n, const int64_t *start, const int32_t *column) {
   int32_t *alone = calloc((size_t)n + 1, sizeof *alone); /* rows that hold a column and not the one before it */
   char *follows = malloc((size_t)n + 1);
   int64_t i, k;
   if (alone && follows) {
      for (i = 0; i < n; i++)
         for (k = start[i] - 1; k < start[i + 1] - 2; k++) /* the diagonal is last */
            if (k == start[i] - 1 || column[k - 1] != column[k] - 1) alone[column[k] - 1]++;
      for (i = 0; i < n; i++) {
         k = start[i + 1] - 2;
         follows[i] = alone[i] == 0 && k > start[i] - 1 && column[k - 1] == column[k] - 1;
      }
   } else {
      free(follows);
      follows = NULL;
   }
   free(alone);
   return follows;
}

/* Symbolic factor of the pattern: that of the columns that follow none, a third of the entries, is the same */
static void analyse(handle_type *plan, const int64_t *start, const int32_t *column) {
   int64_t i, k, n = plan->n, kept = 0, *row = NULL;
   char *follows = find_followers(n, start, column);
   cholmod_sparse a;
   if (!follows) return;
   for (i = 0; i < n; i++) {
      plan->start[i] = kept;
      for (k = start[i] - 1; k < start[i + 1] - 1; k++) kept += !follows[column[k] - 1] || column[k] - 1 >= i - 1;
   }
   plan->start[n] = kept;
   row = malloc(sizeof *row * (size_t)(kept + 1));
   if (row) {
      kept = 0;
      for (i = 0; i < n; i++)
         for (k = start[i] - 1; k < start[i + 1] - 1; k++)
            if (!follows[column[k] - 1] || column[k] - 1 >= i - 1) row[kept++] = (int64_t)column[k] - 1;
      a = view(n, plan->start, row, NULL, 1); /* the lower triangle by rows is upper by columns */
      plan->factor = cholmod_l_analyze(&a, &plan->common);
   }
   free(row);
   free(follows);
}

/* Arrange the pattern by columns in the order of the factor; 1 if there is no memory */
static int arrange(handle_type *plan, const int64_t *start, const int32_t *column) {
   const int64_t *order = plan->factor->Perm, n = plan->n;
   int32_t *place = malloc(sizeof *place * (size_t)(n + 1));
   int64_t *next = calloc((size_t)n + 1, sizeof *next), i, k;
   const int ok = place && next;
   if (ok) {
      for (k = 0; k < n; k++) place[order[k]] = (int32_t)k;
      for (i = 0; i < n; i++)
         for (k = start[i] - 1; k < start[i + 1] - 1; k++) {
            const int32_t a = place[i], b = place[column[k] - 1];
            next[a < b ? a : b]++;
         }
      plan->start[0] = 0;
      for (k = 0; k < n; k++) {
         plan->start[k + 1] = plan->start[k] + next[k];
         next[k] = plan->start[k];
      }
      for (i = 0; i < n; i++)
         for (k = start[i] - 1; k < start[i + 1] - 1; k++) {
            const int32_t a = place[i], b = place[column[k] - 1];
            const int64_t to = next[a < b ? a : b]++;
            plan->row[to] = a < b ? b : a;
            plan->from[to] = (int32_t)k;
         }
   }
   free(place);
   free(next);
   return !ok;
}

/* Rows of the supernode that has most */
static size_t most_rows(const cholmod_factor *l) {
   const int64_t *pi = l->pi;
   int64_t most = 0;
   for (size_t s = 0; s < l->nsuper; s++)
      if (pi[s + 1] - pi[s] > most) most = pi[s + 1] - pi[s];
   return (size_t)most;
}

/* Plan for a pattern: null if there is no memory. Gives the entries of the factor, the
   operations of a factorization, and the bytes of a factor and of what a factorization takes
   besides. */
static handle_type *new_plan(int64_t n, const int64_t *start, const int32_t *column,
                             double *entries, double *operations, int64_t *bytes,
                             int64_t *work_bytes) {
   handle_type *plan = new_handle(n);
   size_t size = (size_t)start[n];
   if (!plan) return NULL;
   plan->start = malloc(sizeof *plan->start * (size_t)(n + 1));
   plan->row = malloc(sizeof *plan->row * size);
   plan->from = malloc(sizeof *plan->from * size);
   if (plan->start && plan->row && plan->from) analyse(plan, start, column);
   *entries = plan->common.lnz;
   *operations = plan->common.fl;
   if (!plan->factor || arrange(plan, start, column)) {
      axijoint_cholmod_free(plan);
      return NULL;
   }
   *bytes = (int64_t)sizeof(double) * (int64_t)plan->factor->xsize
            + (int64_t)sizeof(int64_t) * ((int64_t)plan->factor->ssize + 3 * n)
            + (int64_t)sizeof(double) * (n + (int64_t)most_rows(plan->factor));
   *work_bytes = (int64_t)sizeof(int32_t) * (3 * n + 5 * (int64_t)plan->factor->nsuper);
   return plan;
}

void *axijoint_cholmod_analyse(int64_t n, const int64_t *start, const int32_t *column,
                               double *entries, double *operations, int64_t *bytes,
                               int64_t *work_bytes) {
   axijoint_let_fail(1);
   handle_type *plan = new_plan(n, start, column, entries, operations, bytes, work_bytes);
   axijoint_let_fail(-1);
   return plan;
}

/* Room for the solution of one right-hand side; 1 if there is no memory */
static int reserve(handle_type *handle) {
   handle->permuted = malloc(sizeof(double) * (size_t)(handle->n + 1));
   handle->rows = malloc(sizeof(double) * (most_rows(handle->factor) + beyond));
   return !handle->permuted || !handle->rows;
}

/* A factor of the plan, without values, in large pages or not; null if there is no memory */
static handle_type *new_factor(const handle_type *plan, int large) {
   handle_type *handle = new_handle(plan->n);
   if (!handle) return NULL;
   handle->factor = cholmod_l_copy_factor(plan->factor, &handle->common);
   if (handle->factor) { /* CHOLMOD frees the memory by free, too */
      cholmod_factor *l = handle->factor;
      size_t bytes = sizeof(double) * (l->xsize + beyond);
      l->x = large ? allocate(bytes) : malloc(bytes);
      if (l->x) {
         memset((double *)l->x + l->xsize, 0, sizeof(double) * beyond);
         l->xtype = CHOLMOD_REAL;
         if (!reserve(handle)) return handle;
      }
   }
   axijoint_cholmod_free(handle);
   return NULL;
}

/* supernodal.f90, supernodal_factorize.f90 */
typedef struct {
   int64_t n, n_supernodes;
   const void *column, *first_row, *first_number, *row, *matrix_start, *matrix_row, *from;
} structure_type;
void axijoint_supernodal_factorize(const structure_type *structure, const double *value, double *l,
                                   int64_t *failed, int32_t *code);

/* supernodal_solve.f90 */
void axijoint_supernodal_solve(const structure_type *structure, const double *l, int64_t n_sides, double *x,
                               double *work);
void axijoint_supernodal_inverse(const structure_type *structure, const double *l, int64_t n_loads, const int64_t *place,
                                 double *inverse, int32_t *code);
void axijoint_supernodal_inverse_operations(const structure_type *structure, int64_t n_loads, const int64_t *place,
                                            double *operations, int32_t *code);

/* Structure of a factor; the pattern of the matrix is known to a plan alone */
static structure_type structure_of(const handle_type *plan, const cholmod_factor *l) {
   structure_type structure = {plan->n, (int64_t)l->nsuper, l->super, l->pi, l->px, l->s,
                               plan->start, plan->row, plan->from};
   return structure;
}

/* Numeric factor in the order of the plan; 0 if there is no memory */
static int factorize(const handle_type *plan, const double *value, handle_type *handle,
                     int64_t *failed) {
   cholmod_factor *l = handle->factor;
   int32_t code;
   structure_type structure = structure_of(plan, l);
   axijoint_supernodal_factorize(&structure, value, l->x, failed, &code);
   l->is_ll = 1;
   l->minor = (size_t)plan->n;
   return code == 0;
}

/* Factor of a matrix of the pattern, given by its values: null if there is no memory. An old
   factor of the plan, if not null, is overwritten and becomes the new one; else the new one takes
   large pages if `large` is not zero. `failed` is zero or the
   equation, counted from one, whose pivot is not positive; `diagonal` takes the diagonal of the
   factor in the order of the equations. */
void *axijoint_cholmod_factorize(const void *pointer, void *old, int large, const double *value,
                                 double *diagonal, int64_t *failed) {
   const handle_type *plan = pointer;
   handle_type *handle = old;
   axijoint_let_fail(1);
   if (!handle) handle = new_factor(plan, large);
   axijoint_let_fail(-1);
   *failed = 0;
   if (!handle) return NULL;
   if (!factorize(plan, value, handle, failed)) {
      axijoint_cholmod_free(handle);
      return NULL;
   }
   const cholmod_factor *l = handle->factor;
   const int64_t *order = l->Perm, *super = l->super, *pi = l->pi, *px = l->px;
   const double *x = l->x;
   int64_t s, k;
   *failed = *failed < 0 ? 0 : order[*failed] + 1;
   for (s = 0; s < (int64_t)l->nsuper && *failed == 0; s++)
      for (k = super[s]; k < super[s + 1]; k++) {
         int64_t c = k - super[s], rows = pi[s + 1] - pi[s];
         diagonal[order[k]] = x[px[s] + c * rows + c];
      }
   return handle;
}

/* Solve for a few right-hand sides in place: their unknowns in the order of the factor, and the rows of a supernode,
   take the room given */
static void solve_few(const handle_type *handle, int64_t n_rhs, double *b, double *permuted, double *rows) {
   const cholmod_factor *l = handle->factor;
   const int64_t *order = l->Perm, n = handle->n;
   structure_type structure = structure_of(handle, l);
   int64_t i, k;
   for (i = 0; i < n_rhs; i++)
      for (k = 0; k < n; k++) permuted[k + i * n] = b[order[k] + i * n];
   axijoint_supernodal_solve(&structure, l->x, n_rhs, permuted, rows);
   for (i = 0; i < n_rhs; i++)
      for (k = 0; k < n; k++) b[order[k] + i * n] = permuted[k + i * n];
}

/* So many right-hand sides are solved for at once, while a panel of the factor is at hand; each has the same bits as if it
   were alone */
static const int64_t few = 4;

/* Solve for a few right-hand sides in room of their own; 1 if there is no memory */
static int solve_together(const handle_type *handle, int64_t n_rhs, double *b) {
   axijoint_let_fail(1);
   double *permuted = malloc(sizeof(double) * (size_t)(handle->n * n_rhs));
   double *rows = malloc(sizeof(double) * (most_rows(handle->factor) + beyond));
   axijoint_let_fail(-1);
   int code = !permuted || !rows;
   if (!code) solve_few(handle, n_rhs, b, permuted, rows);
   free(permuted);
   free(rows);
   return code;
}

/* Solve for right-hand sides in place: a few at once, or if there is no memory for that, one after the other in the room
   reserved, one thread at a time */
void axijoint_cholmod_solve(void *pointer, int64_t n_rhs, double *b) {
   handle_type *handle = pointer;
   for (int64_t k = 0; k < n_rhs; k += few, b += few * handle->n) {
      const int64_t count = n_rhs - k < few ? n_rhs - k : few;
      if (count > 1 && !solve_together(handle, count, b)) continue;
      omp_set_lock(&handle->reserved);
      for (int64_t i = 0; i < count; i++) solve_few(handle, 1, b + i * handle->n, handle->permuted, handle->rows);
      omp_unset_lock(&handle->reserved);
   }
}

/* Equations of a set, counted from one, as the factor has them: their places in its order, ascending, and the place of each in
   the set, counted from one. 0; 1 if there is no memory */
static int sort_set(const handle_type *handle, int64_t count, const int32_t *set, int64_t *row, int32_t *place) {
   const int64_t *order = handle->factor->Perm;
   int64_t k, found = 0;
   axijoint_let_fail(1);
   int32_t *rank = calloc((size_t)handle->n + 1, sizeof *rank);
   axijoint_let_fail(-1);
   if (!rank) return 1;
   for (k = 0; k < count; k++) rank[set[k] - 1] = (int32_t)(k + 1);
   for (k = 0; k < handle->n; k++)
      if (rank[order[k]]) {
         row[found] = k;
         place[found++] = rank[order[k]];
      }
   free(rank);
   return 0;
}

/* The lower triangle of the inverse at a set of equations, counted from one, whatever the order; `place` takes the place in
   the set of each row of it. 0; 1 if there is no memory */
int axijoint_cholmod_inverse(const void *pointer, int64_t count, const int32_t *set, double *inverse, int32_t *place) {
   const handle_type *handle = pointer;
   structure_type structure = structure_of(handle, handle->factor);
   int32_t code = 1;
   axijoint_let_fail(1);
   int64_t *row = malloc(sizeof *row * (size_t)(count + 1));
   axijoint_let_fail(-1);
   if (row && !sort_set(handle, count, set, row, place))
      axijoint_supernodal_inverse(&structure, handle->factor->x, count, row, inverse, &code);
   free(row);
   return code;
}

/* Operations that this will take, by the plan; below zero if there is no memory to find out */
double axijoint_cholmod_inverse_operations(const void *pointer, int64_t count, const int32_t *set) {
   const handle_type *handle = pointer;
   structure_type structure = structure_of(handle, handle->factor);
   int32_t code = 1;
   double operations = -1.0;
   axijoint_let_fail(1);
   int64_t *row = malloc(sizeof *row * (size_t)(count + 1));
   int32_t *place = malloc(sizeof *place * (size_t)(count + 1));
   axijoint_let_fail(-1);
   if (row && place && !sort_set(handle, count, set, row, place))
      axijoint_supernodal_inverse_operations(&structure, count, row, &operations, &code);
   free(row);
   free(place);
   return code ? -1.0 : operations;
}
