/* Product of a stiffness in blocks of two nodes and a vector: each block is read once, for what the node of its column gives to
 * that of its row and the other way round. */
#include "block_parts.h"
#include <stdint.h>
#include <string.h>

/* linalg/doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

/* The three components of a node */
#define OF_NODE(x) ((four){(x)[0], (x)[1], (x)[2], 0.0})

/* The stiffness: first block of each row in either part of it, columns, all from one on; numbers of the blocks */
typedef struct {
   const int64_t *start[2];
   const int32_t *column;
   const double *parts;
} stiffness_type;

/* What the node of the row, each of whose components fills a vector, gives to that of the column */
INLINE void give(const four block[components], const four x[components], double *y)
{
   const four sum = OF_NODE(y) + ((block[0] * x[0] + block[1] * x[1]) + block[2] * x[2]);
   FOR_COMPONENTS y[r] = sum[r];
}

/* Rows of the product, without what they add to rows before the first */
INLINE void find_rows(int from, int to, stiffness_type k, factors_type factors, const double *x, double *restrict y)
{
   memset(y + components * (from - 1), 0, components * (size_t)(to - from + 1) * sizeof *y);
   for (int i = from - 1; i < to; ++i) {
      if (k.start[1][i] == k.start[1][i + 1]) continue; /* not even one with itself */
      double *const here = y + components * i;
      four own[components], total[components];
      FOR_COMPONENTS {
         own[r] = (four){0} + x[components * i + r];
         total[r] = (four){0};
      }
      for (int part = 0; part < 2; ++part)
         for (int64_t l = k.start[part][i] - 1; l < k.start[part][i + 1] - 1; ++l) {
            const int j = k.column[l] - 1;
            four block[components];
            evaluate(&factors, k.parts + block_size * l, block);
            if (j < i) {
               const four other = OF_NODE(x + components * j);
               FOR_COMPONENTS total[r] += block[r] * other;
            }
            if (j >= from - 1) give(block, own, y + components * j);
         }
      FOR_COMPONENTS here[r] += (total[r][0] + total[r][1]) + total[r][2];
   }
}

/* What they add to those */
INLINE void find_coupling(int from, int to, stiffness_type k, factors_type factors, const double *x, double *restrict y)
{
   for (int i = from - 1; i < to; ++i)
      for (int part = 0; part < 2; ++part)
         for (int64_t l = k.start[part][i] - 1; l < k.start[part][i + 1] - 1; ++l) {
            const int j = k.column[l] - 1;
            if (j >= from - 1) break; /* columns ascend */
            four own[components], block[components];
            FOR_COMPONENTS own[r] = (four){0} + x[components * i + r];
            evaluate(&factors, k.parts + block_size * l, block);
            give(block, own, y + components * j);
         }
}

INLINE void find(int coupling, int from, int to, stiffness_type k, factors_type factors, const double *x, double *y)
{
   if (coupling) find_coupling(from, to, k, factors, x, y);
   else find_rows(from, to, k, factors, x, y);
}

#if defined(__x86_64__)
__attribute__((target("avx2,fma")))
static void find_by_four(int coupling, int from, int to, stiffness_type k, factors_type factors, const double *x,
                         double *y)
{
   find(coupling, from, to, k, factors, x, y);
}
#endif

/* Rows from .. to of y = K_m x without what they add to rows before them, or that. outer, inner: first block of each row in either
 * part of it; factors: of A, S and C in K_m. Not more than `most` numbers are taken at once. */
void axijoint_block_product(int most, int coupling, int from, int to, const int64_t *outer, const int64_t *inner,
                            const int32_t *column, const double *parts, const double *factors, const double *x, double *y)
{
   const stiffness_type k = {{outer, inner}, column, parts};
   const factors_type of = factors_of(factors);
#if defined(__x86_64__)
   if (most >= 4 && axijoint_doubles_at_once() >= 4) {
      find_by_four(coupling, from, to, k, of, x, y);
      return;
   }
#else
   (void)most;
#endif
   find(coupling, from, to, k, of, x, y);
}
