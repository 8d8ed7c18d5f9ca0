/* Product of the stiffness of elements and a vector, element by element: the matrix of a shape is made once for all elements of it
 * that follow each other, and its columns are read once for some of them. */
#include "block_parts.h"
#include <stdint.h>
#include <string.h>

/* linalg/doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

/* Nodes of an element at most (mesh.f90), rows of its matrix with zeros behind the last, and elements taken at once */
enum { most_nodes = 9, most_rows = 32, most_at_once = 4, most_vectors = most_rows / 8 };

typedef double eight __attribute__((vector_size(64), aligned(8)));

/* Elements as congruent_elements.f90 has them */
typedef struct {
   const int32_t *row, *goal, *n_nodes;
   const int64_t *start;
   const double *parts;
} elements_type;

/* The matrix of a shape in K_m, column by column, each of so many vectors */
INLINE void make_matrix(int n, int vectors, const factors_type *factors, const double *parts, double *matrix)
{
   const int rows = 8 * vectors;
   memset(matrix, 0, (size_t)(components * n * rows) * sizeof *matrix);
   for (int j = 0; j < n; ++j)
      for (int i = j; i < n; ++i, parts += block_size) {
         four block[components];
         evaluate(factors, parts, block);
         FOR_COMPONENTS for (int c = 0; c < components; ++c) {
            matrix[(components * j + c) * rows + components * i + r] = block[r][c];
            matrix[(components * i + r) * rows + components * j + c] = block[r][c];
         }
      }
}

/* What some elements of one shape add to y; so many vectors a column */
INLINE void take_elements(const int vectors, const int count, int n, const double *matrix, const int32_t *row, const int32_t *goal,
                          int n_rows, const double *x, double *y, double *sums)
{
   double own[most_at_once][most_rows];
   eight total[most_at_once][most_vectors];
   for (int e = 0; e < count; ++e)
      for (int i = 0; i < n; ++i) memcpy(own[e] + components * i, x + components * (row[most_nodes * e + i] - 1), components * sizeof *x);
   _Pragma("GCC unroll 4") for (int e = 0; e < count; ++e)
      _Pragma("GCC unroll 4") for (int v = 0; v < vectors; ++v) total[e][v] = (eight){0};
   for (int j = 0; j < components * n; ++j, matrix += 8 * vectors)
      _Pragma("GCC unroll 4") for (int v = 0; v < vectors; ++v) {
         const eight column = *(const eight *)(matrix + 8 * v);
         _Pragma("GCC unroll 4") for (int e = 0; e < count; ++e) total[e][v] += column * own[e][j];
      }
   for (int e = 0; e < count; ++e) {
      memcpy(own[e], total[e], 8 * vectors * sizeof(double));
      for (int i = 0; i < n; ++i) {
         const int to = goal[most_nodes * e + i] - 1;
         double *const there = to < n_rows ? y + components * to : sums + components * (to - n_rows);
         FOR_COMPONENTS there[r] += own[e][components * i + r];
      }
   }
}

/* What a run of elements of one shape adds to y */
INLINE void take_run(const int vectors, const int at_once, int n, int elements, const factors_type *factors, const double *parts,
                     const int32_t *row, const int32_t *goal, int n_rows, const double *x, double *y, double *sums)
{
   double matrix[components * most_nodes * most_rows] __attribute__((aligned(64)));
   make_matrix(n, vectors, factors, parts, matrix);
   for (; elements >= at_once; elements -= at_once, row += most_nodes * at_once, goal += most_nodes * at_once)
      take_elements(vectors, at_once, n, matrix, row, goal, n_rows, x, y, sums);
   for (; elements > 0; --elements, row += most_nodes, goal += most_nodes)
      take_elements(vectors, 1, n, matrix, row, goal, n_rows, x, y, sums);
}

/* What all add, run by run */
INLINE void take_all(const int at_once, int from, int to, elements_type k, const factors_type *factors, int n_rows, const double *x,
                     double *y, double *sums)
{
   for (int first = from - 1, next; first < to; first = next) {
      const int n = k.n_nodes[first];
      for (next = first + 1; next < to && k.start[next] == k.start[first]; ++next) continue;
      const double *const parts = k.parts + block_size * (k.start[first] - 1);
      const int32_t *const row = k.row + (size_t)most_nodes * first, *const goal = k.goal + (size_t)most_nodes * first;
      if (components * n <= 16) take_run(2, at_once, n, next - first, factors, parts, row, goal, n_rows, x, y, sums);
      else if (components * n <= 24) take_run(3, at_once, n, next - first, factors, parts, row, goal, n_rows, x, y, sums);
      else take_run(4, at_once, n, next - first, factors, parts, row, goal, n_rows, x, y, sums);
   }
}

#if defined(__x86_64__)
__attribute__((target("avx512f")))
static void take_by_eight(int from, int to, elements_type k, const factors_type *factors, int n_rows, const double *x, double *y,
                          double *sums)
{
   take_all(most_at_once, from, to, k, factors, n_rows, x, y, sums);
}

__attribute__((target("avx2,fma")))
static void take_by_four(int from, int to, elements_type k, const factors_type *factors, int n_rows, const double *x, double *y,
                         double *sums)
{
   take_all(1, from, to, k, factors, n_rows, x, y, sums);
}
#endif

/* Add to y = K_m x what elements from .. to give to it: row, goal, n_nodes, start, parts as congruent_elements.f90 has them; factors: of
 * A, S and C in K_m; goals beyond the n rows are sums of their own. Not more than `most` numbers are taken at once. */
void axijoint_congruent_product(int most, int from, int to, const int32_t *row, const int32_t *goal, const int32_t *n_nodes,
                                const int64_t *start, const double *parts, const double *factors, int n, const double *x, double *y,
                                double *sums)
{
   const elements_type k = {row, goal, n_nodes, start, parts};
   const factors_type of = factors_of(factors);
#if defined(__x86_64__)
   const int at_once = axijoint_doubles_at_once();
   if (most >= 8 && at_once >= 8) {
      take_by_eight(from, to, k, &of, n, x, y, sums);
      return;
   }
   if (most >= 4 && at_once >= 4) {
      take_by_four(from, to, k, &of, n, x, y, sums);
      return;
   }
#else
   (void)most;
#endif
   take_all(1, from, to, k, &of, n, x, y, sums);
}
