/* Supernodal Cholesky factors behind plain arguments. Matrices come as the lower triangle by rows, counted from one. A plan and
   its factors share the structure, whoever is freed last. */
#include "cholmod_tree.h"
#include <omp.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

/* Here requests for memory may fail, as all are looked at: base/last_words_shim.c */
void axijoint_let_fail(int change);

typedef struct {
   tree_type *tree;
   /* Of a plan: the lower triangle by columns in the order of the factor, and where the value of
      each entry is found. So a factorization gathers its values and has nothing to transpose. */
   int64_t *start;
   int32_t *row, *from;
   /* Of a factor: its numbers, and room for the solution of one right-hand side, so that none is refused for want
      of memory: the unknowns in the order of the factor, and the rows of a supernode */
   double *numbers, *permuted, *rows;
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

static void *integers(int64_t count) { return malloc(sizeof(int64_t) * (size_t)(count + 1)); }

void axijoint_cholmod_free(void *pointer) {
   handle_type *handle = pointer;
   if (!handle) return;
   axijoint_leave_tree(handle->tree);
   omp_destroy_lock(&handle->reserved);
   free(handle->start);
   free(handle->row);
   free(handle->from);
   free(handle->numbers);
   free(handle->permuted);
   free(handle->rows);
   free(handle);
}

/* A handle that is one more user of a tree; null if there is no memory */
static handle_type *new_handle(tree_type *tree) {
   handle_type *handle = calloc(1, sizeof *handle);
   if (!handle) return NULL;
   omp_init_lock(&handle->reserved);
   handle->tree = tree;
   __atomic_add_fetch(&tree->users, 1, __ATOMIC_RELAXED);
   return handle;
}

/* Arrange the pattern by columns in the order of the factor; 1 if there is no memory */
static int arrange(handle_type *plan, const int64_t *start, const int32_t *column) {
   const int64_t *order = plan->tree->order, n = plan->tree->n;
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
static int64_t most_rows(const tree_type *tree) {
   int64_t most = 0;
   for (int64_t s = 0; s < tree->n_supernodes; s++)
      if (tree->first_row[s + 1] - tree->first_row[s] > most) most = tree->first_row[s + 1] - tree->first_row[s];
   return most;
}

/* Plan for a pattern: null if there is no memory, or if it has more entries than a place among them can tell. Gives the entries
   of the factor, the operations of a factorization, and the bytes of the structure, of a factor and of what a factorization
   takes besides */
static handle_type *new_plan(int64_t n, const int64_t *start, const int32_t *column,
                             double *entries, double *operations, int64_t *plan_bytes, int64_t *bytes,
                             int64_t *work_bytes) {
   tree_type *tree = axijoint_find_tree(n, start, column, entries, operations);
   handle_type *plan = tree ? new_handle(tree) : NULL;
   const size_t size = (size_t)start[n];
   axijoint_leave_tree(tree);
   if (!plan) return NULL;
   if (start[n] - 1 > INT32_MAX) {
      axijoint_cholmod_free(plan);
      return NULL;
   }
   plan->start = integers(n);
   plan->row = malloc(sizeof *plan->row * size);
   plan->from = malloc(sizeof *plan->from * size);
   if (!plan->start || !plan->row || !plan->from || arrange(plan, start, column)) {
      axijoint_cholmod_free(plan);
      return NULL;
   }
   *plan_bytes = (int64_t)sizeof(int32_t) * 2 * (int64_t)size
                 + (int64_t)sizeof(int64_t) * (2 * n + tree->first_row[tree->n_supernodes] + 3 * tree->n_supernodes);
   *bytes = (int64_t)sizeof(double) * (tree->first_number[tree->n_supernodes] + n + most_rows(tree));
   *work_bytes = (int64_t)sizeof(int32_t) * (3 * n + 5 * tree->n_supernodes);
   return plan;
}

void *axijoint_cholmod_analyse(int64_t n, const int64_t *start, const int32_t *column,
                               double *entries, double *operations, int64_t *plan_bytes, int64_t *bytes,
                               int64_t *work_bytes) {
   axijoint_let_fail(1);
   handle_type *plan = new_plan(n, start, column, entries, operations, plan_bytes, bytes, work_bytes);
   axijoint_let_fail(-1);
   return plan;
}

/* A factor of the plan, without values, in large pages or not; null if there is no memory */
static handle_type *new_factor(const handle_type *plan, int large) {
   const tree_type *tree = plan->tree;
   const size_t count = (size_t)tree->first_number[tree->n_supernodes];
   handle_type *handle = new_handle(plan->tree);
   if (!handle) return NULL;
   handle->numbers = large ? allocate(sizeof(double) * (count + beyond)) : malloc(sizeof(double) * (count + beyond));
   handle->permuted = malloc(sizeof(double) * (size_t)(tree->n + 1));
   handle->rows = malloc(sizeof(double) * ((size_t)most_rows(tree) + beyond));
   if (!handle->numbers || !handle->permuted || !handle->rows) {
      axijoint_cholmod_free(handle);
      return NULL;
   }
   memset(handle->numbers + count, 0, sizeof(double) * beyond);
   return handle;
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
void axijoint_supernodal_flexibility(const structure_type *structure, const double *l, int64_t n_loads, const int64_t *place,
                                     const double *factor, double *flexibility, int32_t *code);
void axijoint_supernodal_flexibility_operations(const structure_type *structure, int64_t n_loads, const int64_t *place,
                                            double *operations, int32_t *code);

/* Structure of a factor; the pattern of the matrix is known to a plan alone */
static structure_type structure_of(const handle_type *handle) {
   const tree_type *tree = handle->tree;
   structure_type structure = {tree->n, tree->n_supernodes, tree->column, tree->first_row, tree->first_number,
                               tree->row, handle->start, handle->row, handle->from};
   return structure;
}

/* Factor of a matrix of the pattern, given by its values: null if there is no memory. An old
   factor of the plan, if not null, is overwritten and becomes the new one; else the new one takes
   large pages if `large` is not zero. `failed` is zero or the
   equation, counted from one, whose pivot is not positive; `diagonal` takes the diagonal of the
   factor in the order of the equations. */
void *axijoint_cholmod_factorize(const void *pointer, void *old, int large, const double *value,
                                 double *diagonal, int64_t *failed) {
   const handle_type *plan = pointer;
   const tree_type *tree = plan->tree;
   const structure_type structure = structure_of(plan);
   handle_type *handle = old;
   int32_t code;
   axijoint_let_fail(1);
   if (!handle) handle = new_factor(plan, large);
   axijoint_let_fail(-1);
   *failed = 0;
   if (!handle) return NULL;
   axijoint_supernodal_factorize(&structure, value, handle->numbers, failed, &code);
   if (code != 0) {
      *failed = 0;
      axijoint_cholmod_free(handle);
      return NULL;
   }
   *failed = *failed < 0 ? 0 : tree->order[*failed] + 1;
   for (int64_t s = 0; s < tree->n_supernodes && *failed == 0; s++)
      for (int64_t k = tree->column[s]; k < tree->column[s + 1]; k++) {
         const int64_t c = k - tree->column[s], rows = tree->first_row[s + 1] - tree->first_row[s];
         diagonal[tree->order[k]] = handle->numbers[tree->first_number[s] + c * rows + c];
      }
   return handle;
}

/* Solve for a few right-hand sides in place: their unknowns in the order of the factor, and the rows of a supernode,
   take the room given */
static void solve_few(const handle_type *handle, int64_t n_rhs, double *b, double *permuted, double *rows) {
   const int64_t *order = handle->tree->order, n = handle->tree->n;
   const structure_type structure = structure_of(handle);
   int64_t i, k;
   for (i = 0; i < n_rhs; i++)
      for (k = 0; k < n; k++) permuted[k + i * n] = b[order[k] + i * n];
   axijoint_supernodal_solve(&structure, handle->numbers, n_rhs, permuted, rows);
   for (i = 0; i < n_rhs; i++)
      for (k = 0; k < n; k++) b[order[k] + i * n] = permuted[k + i * n];
}

/* So many right-hand sides are solved for at once, while a panel of the factor is at hand; each has the same bits as if it
   were alone */
static const int64_t few = 4;

/* Solve for a few right-hand sides in room of their own; 1 if there is no memory */
static int solve_together(const handle_type *handle, int64_t n_rhs, double *b) {
   axijoint_let_fail(1);
   double *permuted = malloc(sizeof(double) * (size_t)(handle->tree->n * n_rhs));
   double *rows = malloc(sizeof(double) * ((size_t)most_rows(handle->tree) + beyond));
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
   for (int64_t k = 0; k < n_rhs; k += few, b += few * handle->tree->n) {
      const int64_t count = n_rhs - k < few ? n_rhs - k : few;
      if (count > 1 && !solve_together(handle, count, b)) continue;
      omp_set_lock(&handle->reserved);
      for (int64_t i = 0; i < count; i++) solve_few(handle, 1, b + i * handle->tree->n, handle->permuted, handle->rows);
      omp_unset_lock(&handle->reserved);
   }
}

/* Loads on two equations, counted from one, as the factor has them: places of these in its order, the first ascending and none
   beyond the second, what acts on them, and the place of each among the loads as they are given, counted from one. 0; 1 if
   there is no memory */
static int sort_loads(const handle_type *handle, int64_t count, const int32_t *equation, const double *factor, int64_t *sorted,
                      double *acting, int32_t *place) {
   const int64_t *order = handle->tree->order, n = handle->tree->n;
   int64_t k, j, found = 0;
   axijoint_let_fail(1);
   int32_t *rank = malloc(sizeof *rank * ((size_t)n + 1));
   int64_t *first = calloc((size_t)n + 1, sizeof *first); /* load on each place, counted from one */
   int64_t *next = malloc(sizeof *next * ((size_t)count + 1));
   axijoint_let_fail(-1);
   const int code = !rank || !first || !next;
   if (!code) {
      for (k = 0; k < n; k++) rank[order[k]] = (int32_t)k;
      for (j = count; j > 0; j--) {
         const int32_t *pair = equation + 2 * (j - 1), one = rank[pair[0] - 1], other = rank[pair[1] - 1];
         const int32_t lower = one < other ? one : other;
         next[j] = first[lower];
         first[lower] = j;
      }
      for (k = 0; k < n; k++)
         for (j = first[k]; j; j = next[j], found++) {
            const int32_t *pair = equation + 2 * (j - 1);
            const int turned = rank[pair[1] - 1] < rank[pair[0] - 1];
            sorted[2 * found] = rank[pair[turned] - 1];
            sorted[2 * found + 1] = rank[pair[!turned] - 1];
            acting[2 * found] = factor[2 * (j - 1) + turned];
            acting[2 * found + 1] = factor[2 * (j - 1) + !turned];
            place[found] = (int32_t)j;
         }
   }
   free(rank);
   free(first);
   free(next);
   return code;
}

/* The flexibility under loads on two equations, counted from one, whatever the order, half of which is kept; `place` takes the
   place among the loads of each row of it. 0; 1 if there is no memory; 2 if the two do not lie one above the other in the
   elimination tree */
int axijoint_cholmod_flexibility(const void *pointer, int64_t count, const int32_t *equation, const double *factor,
                                 double *flexibility, int32_t *place) {
   const handle_type *handle = pointer;
   const structure_type structure = structure_of(handle);
   int32_t code = 1;
   axijoint_let_fail(1);
   int64_t *sorted = malloc(sizeof *sorted * 2 * (size_t)(count + 1));
   double *acting = malloc(sizeof *acting * 2 * (size_t)(count + 1));
   axijoint_let_fail(-1);
   if (sorted && acting && !sort_loads(handle, count, equation, factor, sorted, acting, place))
      axijoint_supernodal_flexibility(&structure, handle->numbers, count, sorted, acting, flexibility, &code);
   free(sorted);
   free(acting);
   return code;
}

/* Operations that this will take, by the plan; below zero if there is no memory to find out */
double axijoint_cholmod_flexibility_operations(const void *pointer, int64_t count, const int32_t *equation, const double *factor) {
   const handle_type *handle = pointer;
   const structure_type structure = structure_of(handle);
   int32_t code = 1;
   double operations = -1.0;
   axijoint_let_fail(1);
   int64_t *sorted = malloc(sizeof *sorted * 2 * (size_t)(count + 1));
   double *acting = malloc(sizeof *acting * 2 * (size_t)(count + 1));
   int32_t *place = malloc(sizeof *place * (size_t)(count + 1));
   axijoint_let_fail(-1);
   if (sorted && acting && place && !sort_loads(handle, count, equation, factor, sorted, acting, place))
      axijoint_supernodal_flexibility_operations(&structure, count, sorted, &operations, &code);
   free(sorted);
   free(acting);
   free(place);
   return code ? -1.0 : operations;
}
