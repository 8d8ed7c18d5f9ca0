/* Supernodal Cholesky factors behind plain arguments. SuiteSparse's CHOLMOD finds their structure; its settings live in
   a large struct that Fortran cannot see. Matrices come as the lower triangle by rows, counted from one. A plan and its
   factors share the structure, whoever is freed last. */
#include <math.h>
#include <omp.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>
#include <sys/mman.h>

/* Here requests for memory may fail, as all are looked at: base/last_words_shim.c */
void axijoint_let_fail(int change);

/* Structure of a factor: a supernode is a set of neighbouring columns with the same rows, kept as one dense panel */
typedef struct {
   int64_t n, n_supernodes;
   int64_t *order;        /* equation of each column of the factor, shape (n) */
   int64_t *column;       /* first column of each supernode, shape (n_supernodes + 1) */
   int64_t *first_row;    /* first of its rows in `row`, same shape */
   int64_t *first_number; /* first of its numbers in the factor, same shape */
   int64_t *row;          /* rows of all supernodes, ascending in each */
   int32_t users;
} tree_type;

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

/* A user of a tree less; the last one frees it */
static void leave(tree_type *tree) {
   if (!tree || __atomic_sub_fetch(&tree->users, 1, __ATOMIC_ACQ_REL) > 0) return;
   free(tree->order);
   free(tree->column);
   free(tree->first_row);
   free(tree->first_number);
   free(tree->row);
   free(tree);
}

void axijoint_cholmod_free(void *pointer) {
   handle_type *handle = pointer;
   if (!handle) return;
   leave(handle->tree);
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

/* Whether a row of the lower triangle is the row before it and its own diagonal, as rows of one node are */
static int repeats(const int64_t *start, const int32_t *column, int64_t i) {
   const int64_t before = i > 0 ? start[i] - start[i - 1] : -1;
   return start[i + 1] - start[i] == before + 1 &&
          memcmp(column + start[i - 1] - 1, column + start[i] - 1, sizeof *column * (size_t)before) == 0;
}

/* Groups of equations, each but the first of which follows the one before it: the two are coupled, and whoever is
   coupled to the second below it is coupled to the first. Eliminating the first then fills the second with all that it
   holds. So it is with the components of a node. Gives the group of each equation, and the first equation of each
   group; their number, or -1 if there is no memory */
static int64_t find_groups(int64_t n, const int64_t *start, const int32_t *column, int32_t *group, int64_t *first) {
   int32_t *alone = calloc((size_t)n + 1, sizeof *alone); /* rows that hold a column and not the one before it */
   int64_t i, k, n_groups = 0;
   if (!alone) return -1;
   for (i = 0; i < n; i++) {
      if (repeats(start, column, i)) continue;
      for (k = start[i] - 1; k < start[i + 1] - 2; k++) /* the diagonal is last */
         if (k == start[i] - 1 || column[k - 1] != column[k] - 1) alone[column[k] - 1]++;
   }
   for (i = 0; i < n; i++) {
      k = start[i + 1] - 2;
      if (alone[i] > 0 || k == start[i] - 1 || column[k - 1] != column[k] - 1) first[n_groups++] = i;
      group[i] = (int32_t)(n_groups - 1);
   }
   first[n_groups] = n;
   free(alone);
   return n_groups;
}

/* Pattern of the groups, lower triangle by rows, counted from zero: a group is coupled to another if any equation is.
   Gives its row starts, and its columns, whose memory grows; 1 if there is none */
static int couple_groups(const int64_t *start, const int32_t *column, int64_t n_groups, const int32_t *group,
                         const int64_t *first, int64_t *group_start, int64_t **group_column) {
   int32_t *seen = malloc(sizeof *seen * (size_t)(n_groups + 1)); /* the last group that was found coupled to it */
   int64_t g, i, k, count = 0, room = 0, *grown;
   *group_column = NULL;
   if (!seen) return 1;
   memset(seen, -1, sizeof *seen * (size_t)(n_groups + 1));
   for (g = 0; g < n_groups; g++) {
      group_start[g] = count;
      for (i = first[g]; i < first[g + 1]; i++) {
         if (i > first[g] && repeats(start, column, i)) continue;
         if (room < count + start[i + 1] - start[i]) {
            room = 2 * room + start[i + 1] - start[i];
            grown = realloc(*group_column, sizeof *grown * (size_t)room);
            if (!grown) break;
            *group_column = grown;
         }
         for (k = start[i] - 1; k < start[i + 1] - 1; k++) {
            const int32_t other = group[column[k] - 1];
            if (seen[other] == g) continue;
            seen[other] = (int32_t)g;
            (*group_column)[count++] = other;
         }
      }
      if (i < first[g + 1]) break;
   }
   group_start[n_groups] = count;
   free(seen);
   return g < n_groups;
}

/* Equations in a group in the mean */
static double mean_size(int64_t n, int64_t n_groups) { return n_groups > 0 ? (double)n / (double)n_groups : 1.0; }

/* Supernodes of the groups by CHOLMOD, which keeps to the order that the caller has chosen but for a postordering of the
   tree; null if there is no memory. Those with few columns are made one at the price of zeros, by its rules for
   equations, of which there are so many in a group */
static cholmod_factor *analyse_groups(int64_t n_groups, int64_t *start, int64_t *column, double in_group,
                                      cholmod_common *common) {
   cholmod_sparse a;
   cholmod_l_start(common);
   common->print = 0;
   common->supernodal = CHOLMOD_SUPERNODAL;
   common->nmethods = 1;
   common->method[0].ordering = CHOLMOD_NATURAL;
   common->postorder = 1;
   for (int k = 0; k < 3; k++) common->nrelax[k] = (size_t)ceil((double)common->nrelax[k] / in_group);
   memset(&a, 0, sizeof a);
   a.nrow = a.ncol = (size_t)n_groups;
   a.nzmax = (size_t)start[n_groups];
   a.p = start;
   a.i = column;
   a.stype = 1; /* the lower triangle by rows is upper by columns */
   a.itype = CHOLMOD_LONG;
   a.xtype = CHOLMOD_PATTERN;
   a.dtype = CHOLMOD_DOUBLE;
   a.packed = 1;
   return cholmod_l_analyze(&a, common);
}

/* column_walk.c */
int axijoint_walk_columns(int64_t n, const int64_t *start, const int64_t *column, int64_t n_supernodes, const int64_t *super,
                          const int64_t *order, int32_t *walked);

/* Rows of the supernodes of groups, as equations: those that belong to one supernode stand together and are put into the new
   order, in which group k of the old one has `place[k]`; `at` is the first equation of each place. 1 if there is no memory */
static int expand_rows(const cholmod_factor *l, const int32_t *place, const int64_t *at, int64_t *expanded) {
   const int64_t *super = l->super, *pi = l->pi, *row = l->s, n_groups = (int64_t)l->n;
   int32_t *owner = malloc(sizeof *owner * (size_t)(n_groups + 1));
   uint64_t *found = calloc((size_t)n_groups / 64 + 1, sizeof *found); /* a bit of each place */
   const int failed = !owner || !found;
   for (size_t s = 0; s < l->nsuper && !failed; s++)
      for (int64_t k = super[s]; k < super[s + 1]; k++) owner[k] = (int32_t)s;
   for (size_t s = 0; s < l->nsuper && !failed; s++)
      for (int64_t k = pi[s]; k < pi[s + 1];) {
         const int64_t begin = super[owner[row[k]]], end = super[owner[row[k]] + 1];
         int64_t low = end, high = begin;
         for (; k < pi[s + 1] && row[k] < end; k++) {
            const int64_t to = place[row[k]];
            found[to / 64] |= (uint64_t)1 << to % 64;
            low = to < low ? to : low;
            high = to > high ? to : high;
         }
         for (int64_t w = low / 64; w <= high / 64; w++)
            for (; found[w]; found[w] &= found[w] - 1) {
               const int64_t to = w * 64 + __builtin_ctzll(found[w]);
               for (int64_t i = at[to]; i < at[to + 1]; i++) *expanded++ = i;
            }
      }
   free(owner);
   free(found);
   return failed;
}

/* The tree of the equations from that of their groups, whose pattern is given; null if there is no memory */
static tree_type *expand(int64_t n, const cholmod_factor *l, const int64_t *first, const int64_t *group_start,
                         const int64_t *group_column) {
   const int64_t *order = l->Perm, *super = l->super, *pi = l->pi, *row = l->s;
   const int64_t n_groups = (int64_t)l->n, n_supernodes = (int64_t)l->nsuper;
   int64_t *at = integers(n_groups), s, k, i, count = 0; /* first equation of each place */
   int32_t *walked = malloc(sizeof *walked * (size_t)(n_groups + 1)), *place = malloc(sizeof *place * (size_t)(n_groups + 1));
   int32_t *place_of = malloc(sizeof *place_of * (size_t)(n_groups + 1)); /* of each group */
   tree_type *tree = calloc(1, sizeof *tree);
   int failed = !at || !walked || !place || !place_of || !tree ||
                axijoint_walk_columns(n_groups, group_start, group_column, n_supernodes, super, order, walked);
   if (tree) {
      tree->n = n;
      tree->n_supernodes = n_supernodes;
      tree->users = 1;
      tree->order = integers(n);
      tree->column = integers(n_supernodes);
      tree->first_row = integers(n_supernodes);
      tree->first_number = integers(n_supernodes);
      failed = failed || !tree->order || !tree->column || !tree->first_row || !tree->first_number;
   }
   if (!failed) {
      for (k = 0; k < n_groups; k++) {
         at[k] = count;
         place_of[walked[k]] = (int32_t)k;
         for (i = first[walked[k]]; i < first[walked[k] + 1]; i++) tree->order[count++] = i;
      }
      at[n_groups] = count;
      for (k = 0; k < n_groups; k++) place[k] = place_of[order[k]];
      count = 0;
      for (s = 0; s < n_supernodes; s++) {
         tree->column[s] = at[super[s]];
         tree->first_row[s] = count;
         for (k = pi[s]; k < pi[s + 1]; k++) count += at[place[row[k]] + 1] - at[place[row[k]]];
      }
      tree->column[n_supernodes] = n;
      tree->first_row[n_supernodes] = count;
      tree->first_number[0] = 0;
      for (s = 0; s < n_supernodes; s++)
         tree->first_number[s + 1] = tree->first_number[s] + (tree->first_row[s + 1] - tree->first_row[s]) *
                                                                (tree->column[s + 1] - tree->column[s]);
      tree->row = integers(count);
      failed = !tree->row || expand_rows(l, place, at, tree->row);
   }
   free(at);
   free(walked);
   free(place);
   free(place_of);
   if (!failed) return tree;
   leave(tree);
   return NULL;
}

/* Entries of the factor without the zeros of supernodes, and operations of a factorization, by the groups in each
   column of the factor: those below a group count as if each had as many equations as they have in the mean */
static void count_entries(int64_t n, const cholmod_factor *l, const int64_t *first, double *entries, double *operations) {
   const int64_t *order = l->Perm, *rows = l->ColCount;
   const double mean = mean_size(n, (int64_t)l->n);
   *entries = *operations = 0.0;
   for (size_t k = 0; k < l->n; k++)
      for (int64_t left = first[order[k] + 1] - first[order[k]]; left > 0; left--) {
         const double height = (double)left + mean * (double)(rows[k] - 1);
         *entries += height;
         *operations += height * height;
      }
}

/* Structure of the factor of a pattern; null if there is no memory */
static tree_type *analyse(int64_t n, const int64_t *start, const int32_t *column, double *entries, double *operations) {
   int32_t *group = malloc(sizeof *group * (size_t)(n + 1));
   int64_t *first = integers(n), *group_start = integers(n), *group_column = NULL, n_groups = -1;
   tree_type *tree = NULL;
   if (group && first && group_start) n_groups = find_groups(n, start, column, group, first);
   if (n_groups >= 0 && !couple_groups(start, column, n_groups, group, first, group_start, &group_column)) {
      cholmod_common common;
      cholmod_factor *l = analyse_groups(n_groups, group_start, group_column, mean_size(n, n_groups), &common);
      if (l) tree = expand(n, l, first, group_start, group_column);
      if (tree) count_entries(n, l, first, entries, operations);
      cholmod_l_free_factor(&l, &common);
      cholmod_l_finish(&common);
   }
   free(group);
   free(first);
   free(group_start);
   free(group_column);
   return tree;
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

/* Plan for a pattern: null if there is no memory. Gives the entries of the factor, the operations of a factorization,
   and the bytes of the structure, of a factor and of what a factorization takes besides */
static handle_type *new_plan(int64_t n, const int64_t *start, const int32_t *column,
                             double *entries, double *operations, int64_t *plan_bytes, int64_t *bytes,
                             int64_t *work_bytes) {
   tree_type *tree = analyse(n, start, column, entries, operations);
   handle_type *plan = tree ? new_handle(tree) : NULL;
   const size_t size = (size_t)start[n];
   leave(tree);
   if (!plan) return NULL;
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
void axijoint_supernodal_inverse(const structure_type *structure, const double *l, int64_t n_loads, const int64_t *place,
                                 double *inverse, int32_t *code);
void axijoint_supernodal_inverse_operations(const structure_type *structure, int64_t n_loads, const int64_t *place,
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

/* Equations of a set, counted from one, as the factor has them: their places in its order, ascending, and the place of each in
   the set, counted from one. 0; 1 if there is no memory */
static int sort_set(const handle_type *handle, int64_t count, const int32_t *set, int64_t *row, int32_t *place) {
   const int64_t *order = handle->tree->order, n = handle->tree->n;
   int64_t k, found = 0;
   axijoint_let_fail(1);
   int32_t *rank = calloc((size_t)n + 1, sizeof *rank);
   axijoint_let_fail(-1);
   if (!rank) return 1;
   for (k = 0; k < count; k++) rank[set[k] - 1] = (int32_t)(k + 1);
   for (k = 0; k < n; k++)
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
   const structure_type structure = structure_of(handle);
   int32_t code = 1;
   axijoint_let_fail(1);
   int64_t *row = malloc(sizeof *row * (size_t)(count + 1));
   axijoint_let_fail(-1);
   if (row && !sort_set(handle, count, set, row, place))
      axijoint_supernodal_inverse(&structure, handle->numbers, count, row, inverse, &code);
   free(row);
   return code;
}

/* Operations that this will take, by the plan; below zero if there is no memory to find out */
double axijoint_cholmod_inverse_operations(const void *pointer, int64_t count, const int32_t *set) {
   const handle_type *handle = pointer;
   const structure_type structure = structure_of(handle);
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
