/* Sums of harmonics on planes round the circle, and back, by n log n operations: of components of points in double precision, and with
 * slopes of laws between the two in single precision. Points fill vectors of the processor; what is found for one does not depend on
 * its place in them.
 *
 * With n intervals from 0 to pi, harmonics 2 p are harmonics p on half of the planes, mirrored at pi/2. The others on the planes
 * j and n/2 - j are the real and the imaginary part of exp(i theta) times a sum of exp(4 i k theta), k of either sign, whose parts
 * are sums of cosines and of sines on a quarter of the planes (the split radix of Fourier transforms): each operation is a rotation
 * or a sum, which keeps all digits. Few harmonics on few planes are multiplied by their cosines.
 *
 * The file includes itself once for each kind of vector: with VECTOR of numbers of so many DIGITS, which are REAL, for a PROCESSOR, and
 * the SUFFIX of names. */
#ifndef VECTOR
#include <stdint.h>

/* linalg/doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

/* As circle_type of circle_sums.f90: intervals from 0 to pi, planes, the highest harmonic, and the halving at which sums are direct; of
 * each family the places of the modes of harmonics 0 to the highest, from 0 on, -1 where there is none */
struct circle {
   int32_t intervals, planes, top, direct;
   const int32_t *mode;
};

enum { components = 3, points_together = 16 };

/* No less than the highest harmonic that so many halvings leave, nor more than the planes there tell */
static int highest(const struct circle *circle, int halvings)
{
   const int most = circle->intervals >> halvings, left = (circle->top >> halvings) + (halvings > 0);
   return left < most ? left : most;
}

/* Planes, or harmonics, that are taken together */
#define TOGETHER 8
#define FOR_SOME _Pragma("GCC unroll 8") for (int p = 0; p < TOGETHER; ++p)

typedef double double_two __attribute__((vector_size(16), aligned(8)));
typedef double double_four __attribute__((vector_size(32), aligned(8)));
typedef double double_eight __attribute__((vector_size(64), aligned(8)));
typedef float float_four __attribute__((vector_size(16), aligned(4)));
typedef float float_eight __attribute__((vector_size(32), aligned(4)));
typedef float float_sixteen __attribute__((vector_size(64), aligned(4)));

#define JOINED(a, b) a##b
#define JOIN(a, b) JOINED(a, b)
#define NAME(name) JOIN(name, SUFFIX)

#if defined(__x86_64__)
#define PROCESSOR __attribute__((target("avx512f")))
#define DIGITS 6
#define REAL float
#define VECTOR float_sixteen
#define SUFFIX _float_sixteen
#include "circle_sums.c"
#define DIGITS 15
#define REAL double
#define VECTOR double_eight
#define SUFFIX _double_eight
#include "circle_sums.c"
#undef PROCESSOR
#define PROCESSOR __attribute__((target("avx2,fma")))
#define DIGITS 6
#define REAL float
#define VECTOR float_eight
#define SUFFIX _float_eight
#include "circle_sums.c"
#define DIGITS 15
#define REAL double
#define VECTOR double_four
#define SUFFIX _double_four
#include "circle_sums.c"
#undef PROCESSOR
#endif
#define PROCESSOR
#define DIGITS 6
#define REAL float
#define VECTOR float_four
#define SUFFIX _float_four
#include "circle_sums.c"
#define DIGITS 15
#define REAL double
#define VECTOR double_two
#define SUFFIX _double_two
#include "circle_sums.c"

/* Doubles to take at once: no more than `most` */
static int at_once(int most)
{
   const int there = axijoint_doubles_at_once();
   return most < there ? most : there;
}

/* room: vectors of 64 bytes, from a multiple of 64 on */
void axijoint_circle_sums(int most, const struct circle *circle, const double *tables, int back, int odd, int points,
                          long amplitude_step, double *amplitude, long total_step, double *total, void *room)
{
#define SUMS(name) name(circle, tables, back, odd, points, amplitude_step, amplitude, total_step, total, room)
#if defined(__x86_64__)
   if (at_once(most) >= 8) SUMS(sums_double_eight);
   else if (at_once(most) >= 4) SUMS(sums_double_four);
   else
#endif
      SUMS(sums_double_two);
}

void axijoint_circle_product(int most, const struct circle *circle, const float *tables, long lead, const float *slope,
                             const float *jump, float *excess, void *room)
{
#define PRODUCT(name) name(circle, tables, lead, slope, jump, excess, room)
#if defined(__x86_64__)
   if (at_once(most) >= 8) PRODUCT(product_float_sixteen);
   else if (at_once(most) >= 4) PRODUCT(product_float_eight);
   else
#endif
      PRODUCT(product_float_four);
}

#else
/* Intervals from 0 to pi; the halving at which, and after which, sums are direct; cosines on the planes, and cosines and sines of
 * both halvings, plane after plane, of one harmonic after the other */
struct NAME(plan) {
   int intervals, direct;
   const REAL *cosine, *of[2][2];
};

static PROCESSOR void NAME(sum_directly)(int n, int top, const REAL *factor, const VECTOR *amplitude, VECTOR *total)
{
   int j = 0;
   for (; j + TOGETHER <= n + 1; j += TOGETHER) {
      VECTOR sum[TOGETHER];
      FOR_SOME sum[p] = (VECTOR){0};
      for (int m = 0; m <= top; ++m) {
         const VECTOR here = amplitude[m];
         const REAL *there = factor + m * (n + 1) + j;
         FOR_SOME sum[p] += here * there[p];
      }
      FOR_SOME total[j + p] = sum[p];
   }
   for (; j <= n; ++j) {
      VECTOR sum = {0};
      for (int m = 0; m <= top; ++m) sum += amplitude[m] * factor[m * (n + 1) + j];
      total[j] = sum;
   }
}

static PROCESSOR void NAME(find_directly)(int n, int top, const REAL *factor, const VECTOR *total, VECTOR *amplitude)
{
   for (int m = 0; m <= top; m += TOGETHER) {
      /* beyond the highest one the same again, which is not kept */
      const REAL *of[TOGETHER];
      VECTOR sum[TOGETHER];
      FOR_SOME of[p] = factor + (m + p < top ? m + p : top) * (n + 1);
      FOR_SOME sum[p] = (VECTOR){0};
      for (int j = 0; j <= n; ++j) {
         const VECTOR here = total[j];
         FOR_SOME sum[p] += here * of[p][j];
      }
      FOR_SOME if (m + p <= top) amplitude[m + p] = sum[p];
   }
}

/* Sums of cosines, or of sines if `odd`, of harmonics 0 to `top` on the planes 0 to n that so many halvings leave */
static PROCESSOR void NAME(sum)(const struct NAME(plan) *plan, int halvings, int odd, int top, const VECTOR *amplitude, VECTOR *total,
                                VECTOR *room)
{
   const int n = plan->intervals >> halvings, half = n / 2, quarter = n / 4, few = (top + 1) / 4;
   if (halvings >= plan->direct) {
      NAME(sum_directly)(n, top, plan->of[halvings - plan->direct][odd], amplitude, total);
      return;
   }
   for (int p = 0; p <= top / 2; ++p) room[p] = amplitude[2 * p];
   NAME(sum)(plan, halvings + 1, odd, top / 2, room, total, room + top / 2 + 1);

   VECTOR *of_cosines = room, *of_sines = of_cosines + few + 1, *real = of_sines + few + 1, *imaginary = real + quarter + 1;
   of_cosines[0] = top > 0 ? amplitude[1] : (VECTOR){0};
   of_sines[0] = (VECTOR){0};
   for (int k = 1; k <= few; ++k) {
      const VECTOR below = odd ? -amplitude[4 * k - 1] : amplitude[4 * k - 1],
                   above = 4 * k + 1 <= top ? amplitude[4 * k + 1] : (VECTOR){0};
      of_cosines[k] = above + below;
      of_sines[k] = above - below;
   }
   NAME(sum)(plan, halvings + 2, 0, few, of_cosines, real, imaginary + quarter + 1);
   NAME(sum)(plan, halvings + 2, 1, few, of_sines, imaginary, imaginary + quarter + 1);

   const REAL *cosine = plan->cosine, *sine = plan->cosine + plan->intervals / 2;
   if (odd) {
      total[0] = total[n] = (VECTOR){0};
      total[half] = real[0];
      for (int j = 1; j < quarter; ++j) {
         const REAL c = cosine[j << halvings], s = sine[-(j << halvings)];
         const VECTOR even = total[j], mirrored = total[half - j], here = s * real[j] + c * imaginary[j],
                      there = c * real[j] - s * imaginary[j];
         total[j] = here + even;
         total[n - j] = here - even;
         total[half - j] = there + mirrored;
         total[half + j] = there - mirrored;
      }
      const VECTOR even = total[quarter], here = sine[-(quarter << halvings)] * real[quarter];
      total[quarter] = here + even;
      total[n - quarter] = here - even;
   } else {
      const VECTOR first = total[0];
      total[0] = first + real[0];
      total[n] = first - real[0];
      for (int j = 1; j < quarter; ++j) {
         const REAL c = cosine[j << halvings], s = sine[-(j << halvings)];
         const VECTOR even = total[j], mirrored = total[half - j], here = c * real[j] - s * imaginary[j],
                      there = s * real[j] + c * imaginary[j];
         total[j] = even + here;
         total[n - j] = even - here;
         total[half - j] = mirrored + there;
         total[half + j] = mirrored - there;
      }
      const VECTOR even = total[quarter], here = cosine[quarter << halvings] * real[quarter];
      total[quarter] = even + here;
      total[n - quarter] = even - here;
   }
}

/* What planes give back, the transpose of `sum`; the values on them are lost */
static PROCESSOR void NAME(find)(const struct NAME(plan) *plan, int halvings, int odd, int top, VECTOR *total, VECTOR *amplitude,
                                 VECTOR *room)
{
   const int n = plan->intervals >> halvings, half = n / 2, quarter = n / 4, few = (top + 1) / 4;
   if (halvings >= plan->direct) {
      NAME(find_directly)(n, top, plan->of[halvings - plan->direct][odd], total, amplitude);
      return;
   }
   VECTOR *real = room, *imaginary = real + quarter + 1, *found = imaginary + quarter + 1, *rest = found + 2 * (few + 1);
   const REAL *cosine = plan->cosine, *sine = plan->cosine + plan->intervals / 2;
   imaginary[0] = imaginary[quarter] = (VECTOR){0};
   if (odd) {
      real[0] = total[half];
      for (int j = 1; j < quarter; ++j) {
         const REAL c = cosine[j << halvings], s = sine[-(j << halvings)];
         const VECTOR a = total[j], b = total[n - j], p = total[half - j], q = total[half + j], here = a + b, there = p + q;
         total[j] = a - b;
         total[half - j] = p - q;
         real[j] = s * here + c * there;
         imaginary[j] = c * here - s * there;
      }
      const VECTOR a = total[quarter], b = total[n - quarter];
      total[quarter] = a - b;
      real[quarter] = sine[-(quarter << halvings)] * (a + b);
   } else {
      const VECTOR first = total[0], last = total[n];
      total[0] = first + last;
      real[0] = first - last;
      for (int j = 1; j < quarter; ++j) {
         const REAL c = cosine[j << halvings], s = sine[-(j << halvings)];
         const VECTOR a = total[j], b = total[n - j], p = total[half - j], q = total[half + j], here = a - b, there = p - q;
         total[j] = a + b;
         total[half - j] = p + q;
         real[j] = c * here + s * there;
         imaginary[j] = c * there - s * here;
      }
      const VECTOR a = total[quarter], b = total[n - quarter];
      total[quarter] = a + b;
      real[quarter] = cosine[quarter << halvings] * (a - b);
   }
   NAME(find)(plan, halvings + 2, 0, few, real, found, rest);
   NAME(find)(plan, halvings + 2, 1, few, imaginary, found + few + 1, rest);
   if (top > 0) amplitude[1] = found[0];
   for (int k = 1; k <= few; ++k) {
      const VECTOR of_cosines = found[k], of_sines = found[few + 1 + k], below = of_cosines - of_sines;
      amplitude[4 * k - 1] = odd ? -below : below;
      if (4 * k + 1 <= top) amplitude[4 * k + 1] = of_cosines + of_sines;
   }
   NAME(find)(plan, halvings + 1, odd, top / 2, total, room, room + top / 2 + 1);
   for (int p = 0; p <= top / 2; ++p) amplitude[2 * p] = room[p];
}


enum { NAME(lanes) = sizeof(VECTOR) / sizeof(REAL) };

/* The tables, one behind the other, as circle_sums.f90 has made them */
static PROCESSOR struct NAME(plan) NAME(planned)(const struct circle *circle, const REAL *tables)
{
   struct NAME(plan) plan = {circle->intervals, circle->direct, tables, {{0}}};
   const REAL *next = tables + circle->intervals + 1;
   for (int level = 0; level < 2; ++level) {
      const int halvings = circle->direct + level, n = circle->intervals >> halvings, top = highest(circle, halvings);
      for (int odd = 0; odd < 2; ++odd, next += (top + 1) * (n + 1)) plan.of[level][odd] = next;
   }
   return plan;
}

/* Values of points that fill a vector, or of fewer */
static PROCESSOR VECTOR NAME(get)(const REAL *from, int points)
{
   VECTOR values = {0};
   if (points >= NAME(lanes)) return *(const VECTOR *)from;
   for (int i = 0; i < points; ++i) values[i] = from[i];
   return values;
}

static PROCESSOR void NAME(put)(VECTOR values, REAL *to, int points)
{
   if (points >= NAME(lanes)) {
      *(VECTOR *)to = values;
      return;
   }
   for (int i = 0; i < points; ++i) to[i] = values[i];
}

/* A component of the points on all planes, from its amplitudes, mode after mode `step` apart */
static PROCESSOR void NAME(to_planes)(const struct circle *circle, const struct NAME(plan) *plan, int odd, int points, long step,
                                      const REAL *amplitude, VECTOR *total, VECTOR *room)
{
   const int n = circle->intervals, top = circle->top, whole = circle->planes > n + 1;
   VECTOR *of_harmonics = room, *sines = of_harmonics + top + 1, *rest = sines + n + 1;
   for (int turn = 0; turn < 2; ++turn) {  /* cosines and sines */
      const int family = turn ^ odd, *mode = circle->mode + family * (top + 1);
      if (!whole && family == 1) continue;  /* no mode is antisymmetric */
      for (int m = 0; m <= top; ++m) {
         of_harmonics[m] = mode[m] < 0 ? (VECTOR){0} : NAME(get)(amplitude + mode[m] * step, points);
         if (odd && turn == 0) of_harmonics[m] = -of_harmonics[m];
      }
      NAME(sum)(plan, 0, turn, top, of_harmonics, turn == 0 || !whole ? total : sines, rest);
   }
   if (!whole) return;
   for (int j = 1; j < n; ++j) {
      const VECTOR even = total[j];
      total[j] = even + sines[j];
      total[2 * n - j] = even - sines[j];
   }
}

/* Amplitudes of a component from its values on all planes, which are lost */
static PROCESSOR void NAME(from_planes)(const struct circle *circle, const struct NAME(plan) *plan, int odd, int points, long step,
                                        VECTOR *total, REAL *amplitude, VECTOR *room)
{
   const int n = circle->intervals, top = circle->top, whole = circle->planes > n + 1;
   VECTOR *of_harmonics = room, *sines = of_harmonics + top + 1, *rest = sines + n + 1;
   if (whole) {
      sines[0] = sines[n] = (VECTOR){0};
      for (int j = 1; j < n; ++j) {
         const VECTOR here = total[j], beyond = total[2 * n - j];
         total[j] = here + beyond;
         sines[j] = here - beyond;
      }
   } else {  /* trapezium rule */
      total[0] *= (REAL)0.5;
      total[n] *= (REAL)0.5;
   }
   for (int turn = 0; turn < 2; ++turn) {
      const int family = turn ^ odd, *mode = circle->mode + family * (top + 1);
      if (!whole && family == 1) continue;
      NAME(find)(plan, 0, turn, top, turn == 0 || !whole ? total : sines, of_harmonics, rest);
      for (int m = 0; m <= top; ++m) {
         if (mode[m] < 0) continue;
         const REAL weight = (REAL)(odd && turn == 0 ? -1 : 1) * (m == 0 || m == n ? (REAL)0.5 : (REAL)1) * (whole ? 1 : 2) / n;
         NAME(put)(weight * of_harmonics[m], amplitude + mode[m] * step, points);
      }
   }
}

#if DIGITS == 15
/* Sums of a component of some points on all planes, or back. Amplitudes of a mode and values on a plane are so far apart from the
 * next, those of points lie together */
static PROCESSOR void NAME(sums)(const struct circle *circle, const REAL *tables, int back, int odd, int points, long amplitude_step,
                                 REAL *amplitude, long total_step, REAL *total, VECTOR *room)
{
   const struct NAME(plan) plan = NAME(planned)(circle, tables);
   VECTOR *values = room, *rest = room + circle->planes;
   for (int first = 0; first < points; first += NAME(lanes)) {
      if (!back) NAME(to_planes)(circle, &plan, odd, points - first, amplitude_step, amplitude + first, values, rest);
      for (int j = 0; j < circle->planes; ++j) {
         REAL *place = total + j * total_step + first;
         if (back) values[j] = NAME(get)(place, points - first);
         else NAME(put)(values[j], place, points - first);
      }
      if (back) NAME(from_planes)(circle, &plan, odd, points - first, amplitude_step, values, amplitude + first, rest);
   }
}

#else
/* Excess stress that slopes make of jumps, of `points_together` points. slope: shape (lead, 3, 3, planes); jump and excess: (lead, 3,
 * modes), from the first of these points on */
static PROCESSOR void NAME(product)(const struct circle *circle, const REAL *tables, long lead, const REAL *slope, const REAL *jump,
                                    REAL *excess, VECTOR *room)
{
   const struct NAME(plan) plan = NAME(planned)(circle, tables);
   VECTOR *xi = room, *eta = xi + circle->planes, *theta = eta + circle->planes, *rest = theta + circle->planes;
   for (int first = 0; first < points_together; first += NAME(lanes)) {
      for (int i = 0; i < components; ++i)
         NAME(to_planes)(circle, &plan, i == 2, NAME(lanes), components * lead, jump + i * lead + first, room + i * circle->planes, rest);
      for (int j = 0; j < circle->planes; ++j) {
         const REAL *here = slope + 9 * j * lead + first;
         VECTOR stress[components];
#pragma GCC unroll 3
         for (int i = 0; i < components; ++i)
            stress[i] = *(const VECTOR *)(here + i * lead) * xi[j] + *(const VECTOR *)(here + (i + 3) * lead) * eta[j] +
                        *(const VECTOR *)(here + (i + 6) * lead) * theta[j];
         xi[j] = stress[0];
         eta[j] = stress[1];
         theta[j] = stress[2];
      }
      for (int i = 0; i < components; ++i)
         NAME(from_planes)(circle, &plan, i == 2, NAME(lanes), components * lead, room + i * circle->planes, excess + i * lead + first, rest);
   }
}

#endif

#undef REAL
#undef VECTOR
#undef SUFFIX
#undef DIGITS
#endif
