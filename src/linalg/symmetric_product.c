/* Product of a symmetric matrix in single precision and a vector, each number of half the matrix read once.
 *
 * Points of joints see each other by such products and by little else, at some hundreds of unknowns, where a library's
 * product reads no faster than one of the whole matrix. Eight columns are taken together: their part of the product
 * above the diagonal, and what the rows above give to them, in the same pass. What is added up in which order depends
 * on how many numbers a processor takes at once. */
#include <stdint.h>
#include <string.h>

/* doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

/* Columns that are taken together, and what numbers of rows are a multiple of */
enum { columns = 8, aligned_rows = 16 };

typedef float four __attribute__((vector_size(16), aligned(4)));
typedef float eight __attribute__((vector_size(32), aligned(4)));
typedef float sixteen __attribute__((vector_size(64), aligned(4)));

/* Sums of pairs of neighbours, of twos and of fours of two vectors */
#define PAIRS(a, b) \
   (__builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14) + __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15))
#define TWOS(a, b) \
   (__builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13) + __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15))
#define FOURS(a, b) \
   (__builtin_shufflevector(a, b, 0, 1, 2, 3, 8, 9, 10, 11) + __builtin_shufflevector(a, b, 4, 5, 6, 7, 12, 13, 14, 15))

/* Sums of the numbers of each of eight vectors */
#define SUMS_OF_EIGHT(s)                                                                             \
   FOURS(TWOS(PAIRS(s[0], s[1]), PAIRS(s[2], s[3])), TWOS(PAIRS(s[4], s[5]), PAIRS(s[6], s[7])))

#define ADD_SIXTEEN(s, y)                                                                            \
   {                                                                                                 \
      eight halves[columns];                                                                         \
      _Pragma("GCC unroll 8") for (int c = 0; c < columns; ++c) halves[c] =                          \
         __builtin_shufflevector(s[c], s[c], 0, 1, 2, 3, 4, 5, 6, 7)                                 \
         + __builtin_shufflevector(s[c], s[c], 8, 9, 10, 11, 12, 13, 14, 15);                        \
      *(eight *)(y) += SUMS_OF_EIGHT(halves);                                                        \
   }
#define ADD_EIGHT(s, y) *(eight *)(y) += SUMS_OF_EIGHT(s)
#define ADD_FOUR(s, y) \
   for (int c = 0; c < columns; ++c) (y)[c] += (s[c][0] + s[c][1]) + (s[c][2] + s[c][3])

/* The product by a number of rows at once, for processors that have what `processor` says */
#define PRODUCT(name, processor, vector, add)                                                        \
   processor static void name(int from, int to, const float *a, const float *restrict x, float *restrict y) \
   {                                                                                                 \
      const float *column = a;                                                                       \
      for (int first = from; first < to; first += columns) {                                         \
         const long lead = (first / aligned_rows + 1) * (long)aligned_rows;                          \
         vector sum[columns], at[columns];                                                           \
         _Pragma("GCC unroll 8") for (int c = 0; c < columns; ++c) {                                 \
            sum[c] = (vector){0};                                                                    \
            at[c] = (vector){0} + x[first + c];                                                      \
         }                                                                                           \
         for (int row = 0; row < first + columns; row += (int)(sizeof(vector) / sizeof(float))) {    \
            const vector other = *(const vector *)(x + row);                                         \
            vector even = *(vector *)(y + row), odd = {0};                                           \
            _Pragma("GCC unroll 8") for (int c = 0; c < columns; ++c) {                              \
               const vector part = *(const vector *)(column + c * lead + row);                       \
               if (c % 2 == 0) even += part * at[c];                                                 \
               else odd += part * at[c];                                                             \
               sum[c] += part * other;                                                               \
            }                                                                                        \
            *(vector *)(y + row) = even + odd;                                                       \
         }                                                                                           \
         add(sum, y + first);                                                                        \
         column += columns * lead;                                                                   \
      }                                                                                              \
   }

#if defined(__x86_64__)
PRODUCT(by_sixteen, __attribute__((target("avx512f"))), sixteen, ADD_SIXTEEN)
PRODUCT(by_eight, __attribute__((target("avx2,fma"))), eight, ADD_EIGHT)
#endif
PRODUCT(by_four, , four, ADD_FOUR)

/* What columns from `from`, a multiple of sixteen, to `to` and what mirrors them give to y = a x. There are the columns
 * to the diagonal, which is halved, in groups of eight one after the other: columns of a group have the rows to the last
 * of its diagonals, and zeros on to a multiple of sixteen. Zeros in a and x, and room in y, to a multiple of that beyond
 * `to`. Not more than `most` rows are taken at once. */
void axijoint_symmetric_product(int most, int from, int to, const float *a, const float *x, float *y)
{
   const int there = 2 * axijoint_doubles_at_once(), at_once = most < there ? most : there;
   memset(y, 0, sizeof(float) * (size_t)((to + aligned_rows - 1) / aligned_rows * aligned_rows));
#if defined(__x86_64__)
   if (at_once >= 16) {
      by_sixteen(from, to, a, x, y);
      return;
   }
   if (at_once >= 8) {
      by_eight(from, to, a, x, y);
      return;
   }
#else
   (void)at_once;
#endif
   by_four(from, to, a, x, y);
}
