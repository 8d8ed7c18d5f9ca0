/* Elimination of the unknowns of a panel of a supernodal factor, and the way back.
 *
 * Panels of a plane mesh are small: calls of a library cost more than they compute, and quotients that wait for each other
 * more than all products. So quotients are found beforehand, all at once, and columns are taken some together in loops over
 * as many rows at once as the processor takes. What is added up in which order depends on that number and on the panel
 * alone.
 *
 * A panel has `height` rows, columns one after the other, its first `width` rows a lower triangle. Rows are read by whole
 * vectors: what is behind the last column is read, too, up to `beyond` numbers, and so many behind the last number of t
 * are written. */
#include <stdint.h>

/* linalg/doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

enum { beyond = 8 };

typedef double two __attribute__((vector_size(16), aligned(8)));
typedef double four __attribute__((vector_size(32), aligned(8)));
typedef double eight __attribute__((vector_size(64), aligned(8)));

#define EACH(c, n) _Pragma("GCC unroll 8") for (int c = 0; c < (n); ++c)

/* The sum of a vector, and the sums of four */
#define SUM_OF_TWO(s) ((s)[0] + (s)[1])
#define SUM_OF_FOUR(s) (((s)[0] + (s)[1]) + ((s)[2] + (s)[3]))
#define SUM_OF_EIGHT(s) SUM_OF_FOUR(HALVES(s))
#define HALVES(s) (__builtin_shufflevector(s, s, 0, 1, 2, 3) + __builtin_shufflevector(s, s, 4, 5, 6, 7))
#define PAIRS(a, b) (__builtin_shufflevector(a, b, 0, 4, 2, 6) + __builtin_shufflevector(a, b, 1, 5, 3, 7))
#define TWOS(a, b) (__builtin_shufflevector(a, b, 0, 1, 4, 5) + __builtin_shufflevector(a, b, 2, 3, 6, 7))
#define SUMS_OF_TWO(s, to) EACH(c, 4) (to)[c] = SUM_OF_TWO((s)[c])
#define SUMS_OF_FOUR(s, to) *(four *)(to) = TWOS(PAIRS((s)[0], (s)[1]), PAIRS((s)[2], (s)[3]))
#define SUMS_OF_EIGHT(s, to) \
   *(four *)(to) = TWOS(PAIRS(HALVES((s)[0]), HALVES((s)[1])), PAIRS(HALVES((s)[2]), HALVES((s)[3])))

#define SOME(n, lanes, processor)                                                                                      \
   processor static __attribute__((noinline)) void eliminate_##n##_##lanes(int height, long lead, const double *panel, double *t) \
   {                                                                                                           \
      eliminate_##lanes(n, height, lead, panel, t);                                                            \
   }                                                                                                           \
   processor static __attribute__((noinline)) void find_##n##_##lanes(int height, long lead, const double *panel, double *t) \
   {                                                                                                           \
      find_##lanes(n, height, lead, panel, t);                                                                 \
   }

#define PANEL(lanes, processor, vector, SUM, SUMS)                                                             \
   /* Eliminate n columns: their unknowns, and from the rows below them */                                     \
   processor static inline __attribute__((always_inline)) void eliminate_##lanes(                              \
      const int n, int height, long lead, const double *restrict panel, double *restrict t)                    \
   {                                                                                                           \
      double over[8], x[8];                                                                                    \
      vector at[8];                                                                                            \
      EACH(c, n) over[c] = 1.0 / panel[c * lead + c];                                                          \
      EACH(c, n) x[c] = t[c];                                                                                  \
      EACH(c, n)                                                                                               \
      {                                                                                                        \
         t[c] = x[c] *= over[c];                                                                               \
         EACH(d, n) if (d > c) x[d] -= panel[c * lead + d] * x[c];                                             \
      }                                                                                                        \
      EACH(c, n) at[c] = (vector){0} + x[c];                                                                   \
      for (int row = n; row < height; row += (int)(sizeof(vector) / sizeof(double))) {                         \
         vector even = *(vector *)(t + row), odd = {0};                                                        \
         EACH(c, n)                                                                                            \
         {                                                                                                     \
            const vector part = *(const vector *)(panel + c * lead + row);                                     \
            if (c % 2 == 0) even -= part * at[c];                                                              \
            else odd += part * at[c];                                                                          \
         }                                                                                                     \
         *(vector *)(t + row) = even - odd;                                                                    \
      }                                                                                                        \
   }                                                                                                           \
                                                                                                               \
   /* Find the unknowns of n columns from those of the rows below them */                                      \
   processor static inline __attribute__((always_inline)) void find_##lanes(                                   \
      const int n, int height, long lead, const double *restrict panel, double *restrict t)                    \
   {                                                                                                           \
      double over[8], x[8], total[8];                                                                          \
      vector sum[8];                                                                                           \
      EACH(c, n) over[c] = 1.0 / panel[c * lead + c];                                                          \
      EACH(c, n) sum[c] = (vector){0};                                                                         \
      for (int row = n; row < height; row += (int)(sizeof(vector) / sizeof(double))) {                         \
         const vector below = *(const vector *)(t + row);                                                      \
         EACH(c, n) sum[c] += *(const vector *)(panel + c * lead + row) * below;                               \
      }                                                                                                        \
      if (n >= 4) SUMS(sum, total);                                                                            \
      if (n == 8) SUMS(sum + 4, total + 4);                                                                    \
      if (n < 4) EACH(c, n) total[c] = SUM(sum[c]);                                                            \
      EACH(c, n) x[c] = t[c] - total[c];                                                                       \
      EACH(k, n)                                                                                               \
      {                                                                                                        \
         const int d = n - 1 - k;                                                                              \
         t[d] = x[d] *= over[d];                                                                               \
         EACH(c, n) if (c < d) x[c] -= panel[c * lead + d] * x[d];                                             \
      }                                                                                                        \
   }                                                                                                           \
                                                                                                               \
   /* Of so many columns. Not inlined, or addresses of all of them are laid out before the first is used */           \
   SOME(1, lanes, processor) SOME(2, lanes, processor) SOME(3, lanes, processor) SOME(4, lanes, processor)        \
   SOME(8, lanes, processor)                                                                                       \
                                                                                                               \
   processor static void forward_##lanes(int height, int width, const double *panel, double *t)                \
   {                                                                                                           \
      const long lead = height, step = lead + 1;                                                               \
      int k = 0;                                                                                               \
      for (; k + 8 <= width; k += 8) eliminate_8_##lanes(height - k, lead, panel + k * step, t + k);           \
      if (k + 4 <= width) {                                                                                    \
         eliminate_4_##lanes(height - k, lead, panel + k * step, t + k);                                       \
         k += 4;                                                                                               \
      }                                                                                                        \
      if (width - k == 3) eliminate_3_##lanes(height - k, lead, panel + k * step, t + k);                      \
      if (width - k == 2) eliminate_2_##lanes(height - k, lead, panel + k * step, t + k);                      \
      if (width - k == 1) eliminate_1_##lanes(height - k, lead, panel + k * step, t + k);                      \
   }                                                                                                           \
                                                                                                               \
   processor static void backward_##lanes(int height, int width, const double *panel, double *t)               \
   {                                                                                                           \
      const long lead = height, step = lead + 1;                                                               \
      int k = width / 4 * 4;                                                                                   \
      for (int j = 0; j < beyond; ++j) t[height + j] = 0.0;                                                    \
      if (width - k == 3) find_3_##lanes(height - k, lead, panel + k * step, t + k);                           \
      if (width - k == 2) find_2_##lanes(height - k, lead, panel + k * step, t + k);                           \
      if (width - k == 1) find_1_##lanes(height - k, lead, panel + k * step, t + k);                           \
      if (k % 8 == 4) {                                                                                        \
         k -= 4;                                                                                               \
         find_4_##lanes(height - k, lead, panel + k * step, t + k);                                            \
      }                                                                                                        \
      for (k -= 8; k >= 0; k -= 8) find_8_##lanes(height - k, lead, panel + k * step, t + k);                  \
   }

#if defined(__x86_64__)
PANEL(by_eight, __attribute__((target("avx512f"))), eight, SUM_OF_EIGHT, SUMS_OF_EIGHT)
PANEL(by_four, __attribute__((target("avx2,fma"))), four, SUM_OF_FOUR, SUMS_OF_FOUR)
#endif
PANEL(by_two, , two, SUM_OF_TWO, SUMS_OF_TWO)

/* Rows that are taken at once, at most `most` */
int32_t axijoint_rows_at_once(int32_t most)
{
   const int32_t there = axijoint_doubles_at_once();
   return most < there ? most : there;
}

/* Eliminate the unknowns of a panel: t is the right-hand side at its rows, then the unknowns and what they leave */
void axijoint_panel_forward(int32_t at_once, int32_t height, int32_t width, const double *panel, double *t)
{
#if defined(__x86_64__)
   if (at_once >= 8) {
      forward_by_eight(height, width, panel, t);
      return;
   }
   if (at_once >= 4) {
      forward_by_four(height, width, panel, t);
      return;
   }
#endif
   forward_by_two(height, width, panel, t);
}

/* Find the unknowns of a panel: t is what is left to them, then they, and behind these the unknowns of the rows below */
void axijoint_panel_backward(int32_t at_once, int32_t height, int32_t width, const double *panel, double *t)
{
#if defined(__x86_64__)
   if (at_once >= 8) {
      backward_by_eight(height, width, panel, t);
      return;
   }
   if (at_once >= 4) {
      backward_by_four(height, width, panel, t);
      return;
   }
#endif
   backward_by_two(height, width, panel, t);
}
