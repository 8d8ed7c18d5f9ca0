/* Numbers of a panel of a supernodal factor: its part of the matrix, what it takes from a panel before it, and its own elimination.
 *
 * Panels of a plane mesh are small: a library that packs them for its products takes longer to pack than to multiply. So they
 * are read as they stand, some vectors of rows and some columns at once, and what is found goes to its place from the
 * registers. Each number is a sum in the order of the columns, whatever rows are taken together, so that threads may share rows
 * as they like.
 *
 * A panel has columns one after the other, `lead` numbers apart; its first rows are a lower triangle. What is above that is
 * not read, and may be written. The file contains itself, once for each length of the processor's vectors. */
#ifndef LANES
#include <math.h>
#include <stdint.h>
#include <string.h>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define INLINE static inline __attribute__((always_inline))
#define EACH(c, n) _Pragma("GCC unroll 8") for (int c = 0; c < (n); ++c)

/* Vectors of rows that are taken at once, and columns that are asked for before they are wanted */
enum { VECTORS = 3, AHEAD = 4 };

/* Where the rows of a vector go: runs of rows that are neighbours there, too */
typedef struct {
   int count;
   int first[8], rows[8]; /* of each run */
   long to[8];            /* place of its first row less `first` */
} places_type;

static void find_runs(const int32_t *target, int rows, places_type *places)
{
   int n = 0, first = 0;
   while (first < rows) {
      int end = first + 1;
      while (end < rows && target[end] - target[first] == end - first) ++end;
      places->first[n] = first;
      places->rows[n] = end - first;
      places->to[n++] = target[first] - (long)first;
      first = end;
   }
   places->count = n;
}

/* A number in all places of a vector; its first numbers: all, or fewer */
typedef double vector_by_two __attribute__((vector_size(16), aligned(8)));
INLINE vector_by_two spread_by_two(double x) { return (vector_by_two){x, x}; }
INLINE vector_by_two load_by_two(const double *p, int n)
{
   return n >= 2 ? *(const vector_by_two *)p : (vector_by_two){p[0], 0.0};
}
INLINE void store_by_two(double *p, int n, vector_by_two x)
{
   if (n >= 2) *(vector_by_two *)p = x;
   else p[0] = x[0];
}

#if defined(__x86_64__)
#define ON_FOUR __attribute__((target("avx2,fma")))
typedef double vector_by_four __attribute__((vector_size(32), aligned(8)));
ON_FOUR INLINE vector_by_four spread_by_four(double x) { return (vector_by_four){x, x, x, x}; }
ON_FOUR INLINE __m256i first_of_four(int n)
{
   static const int64_t some[8] = {-1, -1, -1, -1};
   return _mm256_loadu_si256((const __m256i *)(some + 4 - n));
}
ON_FOUR INLINE vector_by_four load_by_four(const double *p, int n)
{
   return n >= 4 ? *(const vector_by_four *)p : (vector_by_four)_mm256_maskload_pd(p, first_of_four(n));
}
ON_FOUR INLINE void store_by_four(double *p, int n, vector_by_four x)
{
   if (n >= 4) *(vector_by_four *)p = x;
   else _mm256_maskstore_pd(p, first_of_four(n), (__m256d)x);
}

#define ON_EIGHT __attribute__((target("avx512f")))
typedef double vector_by_eight __attribute__((vector_size(64), aligned(8)));
ON_EIGHT INLINE vector_by_eight spread_by_eight(double x) { return (vector_by_eight){x, x, x, x, x, x, x, x}; }
INLINE __mmask8 first_of_eight(int n) { return (__mmask8)((1u << n) - 1u); }
ON_EIGHT INLINE vector_by_eight load_by_eight(const double *p, int n)
{
   return (vector_by_eight)_mm512_maskz_loadu_pd(first_of_eight(n), p);
}
ON_EIGHT INLINE void store_by_eight(double *p, int n, vector_by_eight x)
{
   _mm512_mask_storeu_pd(p, first_of_eight(n), (__m512d)x);
}
#endif

/* SOME with as many columns as are left of those that are taken together, and with as many vectors as some rows fill */
#define REST_OF_FOUR(n)                                                                                                    \
   switch (n) {                                                                                                            \
   case 1: SOME(1); break;                                                                                                 \
   case 2: SOME(2); break;                                                                                                 \
   case 3: SOME(3); break;                                                                                                 \
   }
#define REST_OF_EIGHT(n)                                                                                                   \
   switch (n) {                                                                                                            \
   case 4: SOME(4); break;                                                                                                 \
   case 5: SOME(5); break;                                                                                                 \
   case 6: SOME(6); break;                                                                                                 \
   case 7: SOME(7); break;                                                                                                 \
   default: REST_OF_FOUR(n)                                                                                                \
   }
#define VECTORS_OF(rows)                                                                                                   \
   switch (((rows) - 1) / LANES) {                                                                                         \
   case 0: SOME(1); break;                                                                                                 \
   case 1: SOME(2); break;                                                                                                 \
   default: SOME(3);                                                                                                       \
   }

#if defined(__x86_64__)
#define LANES 8
#define COLUMNS 8
#define REST REST_OF_EIGHT
#define PROCESSOR ON_EIGHT
#define NAME(x) x##_by_eight
#include "panel_factor.c"
#define LANES 4
#define COLUMNS 4
#define REST REST_OF_FOUR
#define PROCESSOR ON_FOUR
#define NAME(x) x##_by_four
#include "panel_factor.c"
#endif
#define LANES 2
#define COLUMNS 4
#define REST REST_OF_FOUR
#define PROCESSOR
#define NAME(x) x##_by_two
#include "panel_factor.c"

#if defined(__x86_64__)
#define BY_LANES(call)                                                                                                     \
   if (at_once >= 8) return call(eight);                                                                                   \
   if (at_once >= 4) return call(four);                                                                                    \
   return call(two);
#else
#define BY_LANES(call) return call(two);
#endif

/* Put rows `low` to `high` of the matrix into a panel, whose columns begin at `start` in the list of entries: the row of each, which
   goes to its `place`, and which value it has */
void axijoint_panel_load(int32_t low, int32_t high, int32_t height, int32_t width, const int64_t *start, const int32_t *row,
                         const int32_t *which, const double *value, const int32_t *place, double *panel)
{
   enum { soon = 16 }; /* values come from all over the matrix */
   const int64_t end = start[width] - 1;
   if (high > low)
      for (int32_t j = 0; j < width; ++j) memset(panel + (long)j * height + low, 0, sizeof *panel * (size_t)(high - low));
   for (int32_t j = 0; j < width; ++j, panel += height)
      for (int64_t k = start[j]; k < start[j + 1]; ++k) {
         const int32_t i = place[row[k]];
         __builtin_prefetch(value + which[k + soon < end ? k + soon : end]);
         if (i >= low && i < high) panel[i] = value[which[k]];
      }
}

/* Subtract from a panel what one before it leaves: the product of its rows from `low` to `high` with its first `columns` rows,
   the lower triangle, at `target`. `before` begins with the first row */
void axijoint_panel_take(int32_t at_once, int32_t low, int32_t high, int32_t columns, int32_t rank, int32_t lead,
                         const double *before, const int32_t *target, int32_t height, double *panel)
{
#define TAKE(lanes) take_rows_by_##lanes(low, high, columns, rank, lead, before, target, height, panel)
   BY_LANES(TAKE)
}

/* Columns of the triangle of a panel from `first` to `last`, once those before them are factored, and one over its diagonal; gives
   zero, or the column, counted from one, whose pivot is not positive */
int32_t axijoint_panel_triangle(int32_t at_once, int32_t first, int32_t last, int32_t lead, double *panel, double *over)
{
#define TRIANGLE(lanes) triangle_by_##lanes(first, last, lead, panel, over)
   BY_LANES(TRIANGLE)
}

/* The same columns of some rows below the triangle, once it is factored so far */
void axijoint_panel_below(int32_t at_once, int32_t rows, int32_t first, int32_t last, int32_t lead, const double *panel,
                          const double *over, double *below)
{
#define BELOW(lanes) below_by_##lanes(rows, first, last, lead, panel, over, below)
   BY_LANES(BELOW)
}

#else

/* ---- What follows is there for each length of vectors ---- */

#define VECTOR NAME(vector)

/* Sums over k < rank of a[row + k lead] b[column + k lead]: v vectors of rows, `last` rows in the last, and n columns */
PROCESSOR INLINE void NAME(sum)(const int v, const int n, int last, long rank, long lead, const double *a, const double *b,
                                VECTOR sum[VECTORS][COLUMNS])
{
   VECTOR s[VECTORS][COLUMNS];
   EACH(i, v) EACH(c, n) s[i][c] = (VECTOR){0};
   for (long k = 0; k < rank; ++k, a += lead, b += lead) {
      VECTOR row[VECTORS];
      EACH(i, v) row[i] = NAME(load)(a + i * LANES, i == v - 1 ? last : LANES);
      EACH(c, n)
      {
         const VECTOR by = NAME(spread)(b[c]);
         EACH(i, v) s[i][c] += row[i] * by;
      }
      EACH(i, v) __builtin_prefetch(a + AHEAD * lead + i * LANES);
      __builtin_prefetch(b + AHEAD * lead);
   }
   EACH(i, v) EACH(c, n) sum[i][c] = s[i][c];
}

/* Subtract the rows of a vector from a column, each at its place */
PROCESSOR INLINE void NAME(subtract)(const places_type *places, VECTOR x, double *column)
{
   if (places->count == 1) {
      column += places->to[0];
      NAME(store)(column, places->rows[0], NAME(load)(column, places->rows[0]) - x);
      return;
   }
#if LANES == 8
   __m512d old = _mm512_setzero_pd();
   for (int k = 0; k < places->count; ++k)
      old = _mm512_mask_loadu_pd(old, (__mmask8)(first_of_eight(places->rows[k]) << places->first[k]), column + places->to[k]);
   for (int k = 0; k < places->count; ++k)
      _mm512_mask_storeu_pd(column + places->to[k], (__mmask8)(first_of_eight(places->rows[k]) << places->first[k]),
                            old - (__m512d)x);
#else
   double found[LANES];
   NAME(store)(found, LANES, x);
   for (int k = 0; k < places->count; ++k)
      for (int i = places->first[k]; i < places->first[k] + places->rows[k]; ++i) column[places->to[k] + i] -= found[i];
#endif
}

/* Take n columns of some rows from a panel */
PROCESSOR INLINE void NAME(take)(const int v, const int n, int last, long rank, long lead, const double *a, const double *b,
                                 const places_type *places, const int32_t *column, long height, double *panel)
{
   VECTOR sum[VECTORS][COLUMNS];
   NAME(sum)(v, n, last, rank, lead, a, b, sum);
   EACH(i, v) EACH(c, n) NAME(subtract)(places + i, sum[i][c], panel + column[c] * height);
}

/* Take all columns of some rows from a panel */
PROCESSOR INLINE void NAME(take_columns)(const int v, int n, int rows, long rank, long lead, const double *a, const double *b,
                                         const int32_t *row, const int32_t *column, long height, double *panel)
{
   const int last = rows - (v - 1) * LANES;
   places_type places[VECTORS];
   EACH(i, v) find_runs(row + i * LANES, i == v - 1 ? last : LANES, places + i);
#define SOME(n) NAME(take)(v, n, last, rank, lead, a, b, places, column, height, panel)
   for (; n >= COLUMNS; n -= COLUMNS, b += COLUMNS, column += COLUMNS) SOME(COLUMNS);
   REST(n)
#undef SOME
}

/* Rows that are taken next of so many: three vectors, or two of four that are left */
INLINE int NAME(rows_of)(int left)
{
   if (left <= VECTORS * LANES) return left;
   return left > 4 * LANES ? VECTORS * LANES : 2 * LANES;
}

PROCESSOR static void NAME(take_rows)(int low, int high, int columns, long rank, long lead, const double *before,
                                      const int32_t *target, long height, double *panel)
{
   for (int i = low, rows; i < high; i += rows) {
      rows = NAME(rows_of)(high - i);
      const int n = columns < i + rows ? columns : i + rows;
#define SOME(v) NAME(take_columns)(v, n, rows, rank, lead, before + i, before, target + i, target, height, panel)
      VECTORS_OF(rows)
#undef SOME
   }
}

/* Some rows of n columns: subtract what the k columns before them leave, and divide by the triangle. `a` are these rows of
   the first column, `b` the rows of the triangle */
PROCESSOR INLINE void NAME(eliminate)(const int v, const int n, int last, long k, long lead, const double *over, double *a,
                                      const double *b)
{
   const double *triangle = b + k * lead;
   double *to = a + k * lead;
   VECTOR x[VECTORS][COLUMNS];
   NAME(sum)(v, n, last, k, lead, a, b, x);
   EACH(c, n) EACH(i, v) x[i][c] = NAME(load)(to + c * lead + i * LANES, i == v - 1 ? last : LANES) - x[i][c];
   EACH(c, n)
   {
      const VECTOR scale = NAME(spread)(over[c]);
      EACH(i, v) x[i][c] *= scale;
      EACH(d, n) if (d > c)
      {
         const VECTOR by = NAME(spread)(triangle[c * lead + d]);
         EACH(i, v) x[i][d] -= x[i][c] * by;
      }
   }
   EACH(c, n) EACH(i, v) NAME(store)(to + c * lead + i * LANES, i == v - 1 ? last : LANES, x[i][c]);
}

/* Columns k to `end` of some rows */
PROCESSOR INLINE void NAME(eliminate_columns)(const int v, int rows, int k, int end, long lead, const double *triangle,
                                              const double *over, double *a)
{
   const int last = rows - (v - 1) * LANES;
#define SOME(n) NAME(eliminate)(v, n, last, k, lead, over + k, a, triangle + k)
   for (; k + COLUMNS <= end; k += COLUMNS) SOME(COLUMNS);
   REST(end - k)
#undef SOME
}

PROCESSOR static void NAME(below)(int rows, int first, int end, long lead, const double *triangle, const double *over,
                                  double *below)
{
   for (int i = 0, some; i < rows; i += some) {
      some = NAME(rows_of)(rows - i);
#define SOME(v) NAME(eliminate_columns)(v, some, first, end, lead, triangle, over, below + i)
      VECTORS_OF(some)
#undef SOME
   }
}

/* A few columns of the triangle, from what stands in it now; gives zero, or the column whose pivot is not positive */
INLINE int NAME(corner)(const int n, long lead, double *corner, double *over)
{
   double l[COLUMNS][COLUMNS];
   EACH(c, n) EACH(r, n) if (r >= c) l[c][r] = corner[c * lead + r];
   EACH(c, n)
   {
      if (!(l[c][c] > 0.0)) return c + 1;
      l[c][c] = sqrt(l[c][c]);
      over[c] = 1.0 / l[c][c];
      EACH(r, n) if (r > c) l[c][r] *= over[c];
      EACH(d, n) if (d > c) EACH(r, n) if (r >= d) l[d][r] -= l[c][d] * l[c][r];
   }
   EACH(c, n) EACH(r, n) if (r >= c) corner[c * lead + r] = l[c][r];
   return 0;
}

/* n columns of the triangle, from column k on */
PROCESSOR INLINE int NAME(factor_columns)(const int n, int k, int end, long lead, double *triangle, double *over)
{
   const int needed = (n + LANES - 1) / LANES;
   double *at = triangle + k, *corner = at + k * lead;
   VECTOR sum[VECTORS][COLUMNS];
   NAME(sum)(needed, n, n - (needed - 1) * LANES, k, lead, at, at, sum);
   EACH(c, n) EACH(i, needed)
   {
      const int rows = i == needed - 1 ? n - i * LANES : LANES;
      double *to = corner + c * lead + i * LANES;
      NAME(store)(to, rows, NAME(load)(to, rows) - sum[i][c]);
   }
   const int failed = NAME(corner)(n, lead, corner, over + k);
   if (failed) return k + failed;
   for (int i = k + n, rows; i < end; i += rows) {
      rows = NAME(rows_of)(end - i);
#define SOME(v) NAME(eliminate)(v, n, rows - (v - 1) * LANES, k, lead, over + k, triangle + i, at)
      VECTORS_OF(rows)
#undef SOME
   }
   return 0;
}

PROCESSOR static int NAME(triangle)(int k, int end, long lead, double *triangle, double *over)
{
   int failed = 0;
#define SOME(n) failed = NAME(factor_columns)(n, k, end, lead, triangle, over)
   for (; k + COLUMNS <= end && !failed; k += COLUMNS) SOME(COLUMNS);
   if (failed) return failed;
   REST(end - k)
#undef SOME
   return failed;
}

#undef LANES
#undef COLUMNS
#undef REST
#undef PROCESSOR
#undef NAME
#undef VECTOR
#endif
