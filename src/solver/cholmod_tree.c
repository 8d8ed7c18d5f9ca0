/* Structure of a supernodal Cholesky factor, found by SuiteSparse's CHOLMOD, whose settings live in a large struct that Fortran
   cannot see. Equations that fill each other, as those of a node, are one for it. */
#include "cholmod_tree.h"
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <suitesparse/cholmod.h>

/* column_walk.c */
int axijoint_walk_columns(int64_t n, const int64_t *start, const int64_t *column, int64_t n_supernodes, const int64_t *super,
                          const int64_t *order, int32_t *walked);

static int64_t *integers(int64_t count) { return malloc(sizeof(int64_t) * (size_t)(count + 1)); }

void axijoint_leave_tree(tree_type *tree) {
   if (!tree || __atomic_sub_fetch(&tree->users, 1, __ATOMIC_ACQ_REL) > 0) return;
   free(tree->order);
   free(tree->column);
   free(tree->first_row);
   free(tree->first_number);
   free(tree->row);
   free(tree);
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
   axijoint_leave_tree(tree);
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

tree_type *axijoint_find_tree(int64_t n, const int64_t *start, const int32_t *column, double *entries, double *operations) {
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
