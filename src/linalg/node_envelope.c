/* Factors L D L' of small symmetric matrices of nodes with three components, by their envelope, and solutions with them:
 * of one matrix, or of eight of one envelope at once, which lie number beside number.
 *
 * A panel is the three columns of a node, each with the rows of the node itself and of as many nodes behind it as its columns
 * reach; below[] counts those, and no panel ends before the one in front of it. Panels lie one behind the other. What is
 * stored is L D, and 1/D on the diagonal. Every number is made in the same order whatever is taken at once, so that one
 * matrix and eight have the same bits; a compiler that makes vectors of loops by itself would add up products in one of them
 * that it adds up one by one in another. */
#include <stdint.h>

/* doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

enum { components = 3, lanes = 8 };

typedef double four __attribute__((vector_size(32), aligned(8)));
typedef double eight __attribute__((vector_size(64), aligned(8)));

#define INLINE static inline __attribute__((always_inline))

/* Rows of a panel */
INLINE long rows_of(int32_t below)
{
   return components * (1 + (long)below);
}

/* Whether pivots are positive */
INLINE int is_positive(const double *pivot)
{
   return *pivot > 0.0;
}

INLINE int are_positive(const eight *pivots)
{
   int all = 1;
   for (int lane = 0; lane < lanes; ++lane) all &= (*pivots)[lane] > 0.0;
   return all;
}

/* Take from three columns what another three give to them, row by row: c a panel, s what its rows of the columns have over D */
#define TAKE_ROW(type, i)                                                                \
   {                                                                                     \
      const type a = *(const type *)(c[0] + i), b = *(const type *)(c[1] + i), d = *(const type *)(c[2] + i); \
      type x = *(type *)(t[0] + i), y = *(type *)(t[1] + i), z = *(type *)(t[2] + i);    \
      x -= a * s[0][0];                                                                  \
      y -= a * s[1][0];                                                                  \
      z -= a * s[2][0];                                                                  \
      x -= b * s[0][1];                                                                  \
      y -= b * s[1][1];                                                                  \
      z -= b * s[2][1];                                                                  \
      x -= d * s[0][2];                                                                  \
      y -= d * s[1][2];                                                                  \
      z -= d * s[2][2];                                                                  \
      *(type *)(t[0] + i) = x;                                                           \
      *(type *)(t[1] + i) = y;                                                           \
      *(type *)(t[2] + i) = z;                                                           \
   }

INLINE void take_one(long n, const double *const c[components], const double s[components][components], double *const t[components])
{
   long i = 0;
   for (; i + 8 <= n; i += 8) TAKE_ROW(eight, i)
   if (i + 4 <= n) {
      TAKE_ROW(four, i)
      i += 4;
   }
   for (; i < n; ++i) TAKE_ROW(double, i)
}

INLINE void take_some(long n, const eight *const c[components], const eight s[components][components], eight *const t[components])
{
   for (long i = 0; i < n; ++i) TAKE_ROW(eight, i)
}

/* Take from the numbers behind a node what its unknowns give to them */
#define GIVE_ROW(type, from, i) \
   {                            \
      type x = *(type *)(b + i); \
      x -= *(const from *)(c[0] + i) * z[0]; \
      x -= *(const from *)(c[1] + i) * z[1]; \
      x -= *(const from *)(c[2] + i) * z[2]; \
      *(type *)(b + i) = x;     \
   }

INLINE void give_one(long n, const double *const c[components], const double z[components], double *b)
{
   long i = 0;
   for (; i + 8 <= n; i += 8) GIVE_ROW(eight, eight, i)
   if (i + 4 <= n) {
      GIVE_ROW(four, four, i)
      i += 4;
   }
   for (; i < n; ++i) GIVE_ROW(double, double, i)
}

INLINE void give_some(long n, const eight *const c[components], const eight z[components], eight *b)
{
   for (long i = 0; i < n; ++i) GIVE_ROW(eight, eight, i)
}

INLINE void give_with_one(long n, const double *const c[components], const eight z[components], eight *b)
{
   for (long i = 0; i < n; ++i) GIVE_ROW(eight, double, i)
}

/* Factor: 1 if a pivot is not positive */
#define FACTOR(name, type, positive, take)                                               \
   INLINE int name(int32_t n, const int32_t *below, type *a)                             \
   {                                                                                     \
      for (int32_t p = 0; p < n; ++p) {                                                  \
         const long m = rows_of(below[p]);                                               \
         type *const c[components] = {a, a + m, a + 2 * m};                              \
         if (!positive(&c[0][0])) return 1;                                               \
         const type inverse = 1.0 / c[0][0], s = c[0][1] * inverse, t = c[0][2] * inverse; \
         for (long i = 1; i < m; ++i) c[1][i] -= c[0][i] * s;                            \
         if (!positive(&c[1][1])) return 1;                                               \
         const type other = 1.0 / c[1][1];                                               \
         c[2][2] -= c[0][2] * t;                                                         \
         const type u = c[1][2] * other;                                                 \
         c[2][2] -= c[1][2] * u;                                                         \
         for (long i = 3; i < m; ++i) {                                                  \
            type x = c[2][i];                                                            \
            x -= c[0][i] * t;                                                            \
            x -= c[1][i] * u;                                                            \
            c[2][i] = x;                                                                 \
         }                                                                               \
         if (!positive(&c[2][2])) return 1;                                               \
         const type last = 1.0 / c[2][2];                                                \
         type *to = a + components * m;                                                  \
         for (int32_t q = 1; q <= below[p]; ++q) {                                       \
            const long at = components * q, rows = rows_of(below[p + q]);                \
            type *const goal[components] = {to, to + rows, to + 2 * rows};               \
            const type *const from[components] = {c[0] + at, c[1] + at, c[2] + at};      \
            type over[components][components];                                           \
            _Pragma("GCC unroll 3") for (int k = 0; k < components; ++k) {               \
               over[k][0] = from[0][k] * inverse;                                        \
               over[k][1] = from[1][k] * other;                                          \
               over[k][2] = from[2][k] * last;                                           \
            }                                                                            \
            take(m - at, from, over, goal);                                              \
            to += components * rows;                                                     \
         }                                                                               \
         c[0][0] = inverse;                                                              \
         c[1][1] = other;                                                                \
         c[2][2] = last;                                                                 \
         a += components * m;                                                            \
      }                                                                                  \
      return 0;                                                                          \
   }

FACTOR(factor_one, double, is_positive, take_one)
FACTOR(factor_some, eight, are_positive, take_some)

/* Solve: b the right-hand side, then the solution */
#define SOLVE(name, type, side, give)                                                    \
   INLINE void name(int32_t n, const int32_t *below, const type *a, side *b)             \
   {                                                                                     \
      for (int32_t p = 0; p < n; ++p) {                                                  \
         const long m = rows_of(below[p]);                                               \
         const type *const c[components] = {a + 3, a + m + 3, a + 2 * m + 3};            \
         side z[components];                                                             \
         z[0] = b[0] * a[0];                                                             \
         z[1] = b[1];                                                                    \
         z[1] -= a[1] * z[0];                                                            \
         z[1] *= a[m + 1];                                                               \
         z[2] = b[2];                                                                    \
         z[2] -= a[2] * z[0];                                                            \
         z[2] -= a[m + 2] * z[1];                                                        \
         z[2] *= a[2 * m + 2];                                                           \
         _Pragma("GCC unroll 3") for (int k = 0; k < components; ++k) b[k] = z[k];       \
         give(m - components, c, z, b + components);                                     \
         a += components * m;                                                            \
         b += components;                                                                \
      }                                                                                  \
      for (int32_t p = n - 1; p >= 0; --p) {                                             \
         const long m = rows_of(below[p]);                                               \
         a -= components * m;                                                            \
         b -= components;                                                                \
         side x[components] = {0};                                                       \
         for (long i = components; i < m; ++i) {                                         \
            x[0] += a[i] * b[i];                                                         \
            x[1] += a[m + i] * b[i];                                                     \
            x[2] += a[2 * m + i] * b[i];                                                 \
         }                                                                               \
         b[2] -= x[2] * a[2 * m + 2];                                                    \
         x[1] += a[m + 2] * b[2];                                                        \
         b[1] -= x[1] * a[m + 1];                                                        \
         x[0] += a[1] * b[1];                                                            \
         x[0] += a[2] * b[2];                                                            \
         b[0] -= x[0] * a[0];                                                            \
      }                                                                                  \
   }

SOLVE(solve_one, double, double, give_one)
SOLVE(solve_some, eight, eight, give_some)
SOLVE(solve_with_one, double, eight, give_with_one)

#if defined(__GNUC__) && !defined(__clang__)
#define AS_WRITTEN __attribute__((optimize("no-tree-loop-vectorize", "no-tree-slp-vectorize")))
#else
#define AS_WRITTEN
#endif

/* All of them, for processors that have what `processor` says */
#define ALL(name, processor)                                                                           \
   AS_WRITTEN processor static int factor_##name(int32_t at_once, int32_t n, const int32_t *below, double *a)     \
   {                                                                                                   \
      return at_once == 1 ? factor_one(n, below, a) : factor_some(n, below, (eight *)a);               \
   }                                                                                                   \
                                                                                                       \
   AS_WRITTEN processor static void solve_##name(int32_t at_once, int32_t sides, int32_t n, const int32_t *below, const double *a, double *b) \
   {                                                                                                   \
      if (sides == 1) solve_one(n, below, a, b);                                                       \
      else if (at_once == 1) solve_with_one(n, below, a, (eight *)b);                                  \
      else solve_some(n, below, (const eight *)a, (eight *)b);                                         \
   }

#if defined(__x86_64__)
ALL(by_eight, __attribute__((target("avx512f,avx2,fma"))))
ALL(by_four, __attribute__((target("avx2,fma"))))
#endif
ALL(by_two, )

/* Factor one matrix, or eight; 1 if a pivot of one is not positive */
int axijoint_factor_envelope(int32_t at_once, int32_t n, const int32_t *below, double *a)
{
#if defined(__x86_64__)
   const int there = axijoint_doubles_at_once();
   if (there >= 8) return factor_by_eight(at_once, n, below, a);
   if (there >= 4) return factor_by_four(at_once, n, below, a);
#endif
   return factor_by_two(at_once, n, below, a);
}

/* Solve with one factor, or eight, for one right-hand side or for eight */
void axijoint_solve_envelope(int32_t at_once, int32_t sides, int32_t n, const int32_t *below, const double *a, double *b)
{
#if defined(__x86_64__)
   const int there = axijoint_doubles_at_once();
   if (there >= 8) {
      solve_by_eight(at_once, sides, n, below, a, b);
      return;
   }
   if (there >= 4) {
      solve_by_four(at_once, sides, n, below, a, b);
      return;
   }
#endif
   solve_by_two(at_once, sides, n, below, a, b);
}
