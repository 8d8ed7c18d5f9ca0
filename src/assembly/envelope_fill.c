/* Stiffness of a block of nodes that follow each other, put where their factor will be (linalg/node_envelope.c) */
#include "block_parts.h"
#include <stddef.h>
#include <stdint.h>

/* linalg/doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

/* Nodes of an element at most (mesh.f90); what may be said of a node: which components are free, and that w follows -u */
enum { most_nodes = 9, all_free = 7, tied = 8 };

/* Where a block is put: its nodes, how many behind each its columns reach, number of matrices that lie number beside number */
typedef struct {
   int32_t first, last;
   const int32_t *below, *state;
   const int64_t *panel;
   long lanes;
   double *a;
} goal_type;

/* Add what two nodes have of each other, row by row, the row's node not before the column's */
INLINE void add_pair(const goal_type *goal, int32_t i, int32_t j, double block[components][4])
{
   const int32_t at = j - goal->first;
   const long height = components * (1 + (long)goal->below[at]);
   double *const a = goal->a + goal->lanes * (goal->panel[at] + components * (long)(i - j));
   const int32_t row_state = goal->state[i - 1], column_state = goal->state[j - 1];
   if (row_state == all_free && column_state == all_free && i != j) {
      for (int c = 0; c < components; ++c)
         FOR_COMPONENTS a[goal->lanes * (c * height + r)] += block[r][c];
      return;
   }
   if (column_state & tied) FOR_COMPONENTS block[r][0] -= block[r][2];
   if (row_state & tied)
      for (int c = 0; c < components; ++c) block[0][c] -= block[2][c];
   for (int c = 0; c < components; ++c)
      FOR_COMPONENTS if ((i != j || r >= c) && (row_state >> r & 1) && (column_state >> c & 1))
         a[goal->lanes * (c * height + r)] += block[r][c];
}

/* The values of a block of parts; turned if its row is that of the node which comes first */
INLINE void values_of(const factors_type *factors, const double *parts, int turned, double values[components][4])
{
   four block[components];
   evaluate(factors, parts, block);
   if (!turned) {
      FOR_COMPONENTS *(four *)values[r] = block[r];
      return;
   }
   FOR_COMPONENTS for (int c = 0; c < components; ++c) values[c][r] = block[r][c];
}

/* The block: rows of the nodes in the part of the stiffness that is assembled, then elements one by one */
INLINE void fill(const goal_type *goal, const factors_type *factors, const int64_t *start, const int32_t *column,
                 const double *parts, int32_t n_elements, const int32_t *element, const int32_t *row, const int32_t *n_nodes,
                 const int64_t *shape, const double *shape_parts)
{
   double values[components][4];
   const int32_t first = goal->first, last = goal->last;
   for (int32_t i = first; i <= last; ++i)
      for (int64_t k = start[i - 1]; k < start[i]; ++k) {
         values_of(factors, parts + block_size * (k - 1), 0, values);
         add_pair(goal, i, column[k - 1], values);
      }
   for (int32_t e = 0; e < n_elements; ++e) {
      const int32_t n = n_nodes[element[e] - 1], *const rows = row + (size_t)most_nodes * (size_t)(element[e] - 1);
      const double *pair = shape_parts + block_size * (shape[element[e] - 1] - 1);
      for (int32_t j = 0; j < n; pair += block_size * (n - j), ++j) {
         if (rows[j] < first || rows[j] > last) continue;
         for (int32_t i = j; i < n; ++i) {
            if (rows[i] < first || rows[i] > last) continue;
            const int turned = rows[i] < rows[j];
            values_of(factors, pair + block_size * (i - j), turned, values);
            add_pair(goal, turned ? rows[j] : rows[i], turned ? rows[i] : rows[j], values);
         }
      }
   }
}

#define FILL(name, processor)                                                                                            \
   processor static void name(const goal_type *goal, const factors_type *factors, const int64_t *start,                  \
                              const int32_t *column, const double *parts, int32_t n_elements, const int32_t *element,    \
                              const int32_t *row, const int32_t *n_nodes, const int64_t *shape, const double *shape_parts) \
   {                                                                                                                     \
      fill(goal, factors, start, column, parts, n_elements, element, row, n_nodes, shape, shape_parts);                  \
   }

#if defined(__x86_64__)
FILL(fill_by_four, __attribute__((target("avx2,fma"))))
#endif
FILL(fill_by_two, )

/* Add a block of nodes first .. last, from 1, to a matrix of zeros; state: of all nodes; factors: of A, S and C in K_m; start, column,
 * parts as node_blocks.f90 has those of one cluster; element: those of the block; row, n_nodes, shape, shape_parts as
 * congruent_elements.f90 has them */
void axijoint_fill_envelope(int32_t first, int32_t last, const int32_t *below, const int64_t *panel, const int32_t *state,
                            const double *factors, const int64_t *start, const int32_t *column, const double *parts,
                            int32_t n_elements, const int32_t *element, const int32_t *row, const int32_t *n_nodes,
                            const int64_t *shape, const double *shape_parts, int32_t lanes, double *a)
{
   const goal_type goal = {first, last, below, state, panel, lanes, a};
   const factors_type of = factors_of(factors);
#if defined(__x86_64__)
   if (axijoint_doubles_at_once() >= 4) {
      fill_by_four(&goal, &of, start, column, parts, n_elements, element, row, n_nodes, shape, shape_parts);
      return;
   }
#endif
   fill_by_two(&goal, &of, start, column, parts, n_elements, element, row, n_nodes, shape, shape_parts);
}
