/* Excess stress that slopes on the planes make of jumps, of some points at once in single precision: harmonics are summed on a few
 * planes, multiplied by the slopes there, and what that gives to each harmonic is added up, before the next planes. */
#include <stdint.h>

/* linalg/doubles_at_once.c */
int32_t axijoint_doubles_at_once(void);

/* Planes that are taken together, points that arrays have a multiple of, and components: two that are even and one that is odd in a
 * symmetric mode */
enum { planes_together = 4, points_together = 16, components = 3 };

typedef float four __attribute__((vector_size(16), aligned(4)));
typedef float eight __attribute__((vector_size(32), aligned(4)));
typedef float sixteen __attribute__((vector_size(64), aligned(4)));

#define FOR_PLANES _Pragma("GCC unroll 4") for (int p = 0; p < planes_together; ++p)
#define AT(array, place) (*(vector *)((array) + (place)*lead))
#define GIVEN(array, place) (*(const vector *)((array) + (place)*lead))

/* The product for points that fill a vector of a processor that has what `processor` says */
#define PRODUCT(name, processor, lanes)                                                                      \
   processor static void name(int modes, int planes, long lead, const float *forth, const float *back,       \
                              const float *slope, const float *jump, float *restrict excess)                 \
   {                                                                                                         \
      typedef lanes vector;                                                                                  \
      for (int k = 0; k < components * modes; ++k) AT(excess, k) = (vector){0};                              \
      for (int first = 0; first < planes; first += planes_together) {                                        \
         vector sum[components][planes_together], stress[components][planes_together];                       \
         FOR_PLANES sum[0][p] = sum[1][p] = sum[2][p] = (vector){0};                                         \
         for (int m = 0; m < modes; ++m, forth += 2 * planes_together) {                                     \
            const vector xi = GIVEN(jump, components * m), eta = GIVEN(jump, components * m + 1),            \
                         theta = GIVEN(jump, components * m + 2);                                            \
            FOR_PLANES {                                                                                     \
               sum[0][p] += xi * forth[p];                                                                   \
               sum[1][p] += eta * forth[p];                                                                  \
               sum[2][p] += theta * forth[planes_together + p];                                              \
            }                                                                                                \
         }                                                                                                   \
         FOR_PLANES {                                                                                        \
            /* beyond the last plane nothing goes back */                                                    \
            const float *here = slope + (first + p < planes ? first + p : planes - 1) * 9 * lead;            \
            _Pragma("GCC unroll 3") for (int i = 0; i < components; ++i) stress[i][p] =                      \
               GIVEN(here, i) * sum[0][p] + GIVEN(here, i + 3) * sum[1][p] + GIVEN(here, i + 6) * sum[2][p]; \
         }                                                                                                   \
         for (int m = 0; m < modes; ++m, back += 2 * planes_together) {                                      \
            vector xi = AT(excess, components * m), eta = AT(excess, components * m + 1),                    \
                   theta = AT(excess, components * m + 2);                                                   \
            FOR_PLANES {                                                                                     \
               xi += stress[0][p] * back[p];                                                                 \
               eta += stress[1][p] * back[p];                                                                \
               theta += stress[2][p] * back[planes_together + p];                                            \
            }                                                                                                \
            AT(excess, components * m) = xi;                                                                 \
            AT(excess, components * m + 1) = eta;                                                            \
            AT(excess, components * m + 2) = theta;                                                          \
         }                                                                                                   \
      }                                                                                                      \
   }

#if defined(__x86_64__)
PRODUCT(by_sixteen, __attribute__((target("avx512f"))), sixteen)
PRODUCT(by_eight, __attribute__((target("avx2,fma"))), eight)
#endif
PRODUCT(by_four, , four)

/* The product for sixteen points. forth and back: values of the modes on four planes, of components that are even and then of odd
 * ones, mode by mode, then on the next four; zero beyond the last. slope: shape (lead, 3, 3, planes), jump and excess: (lead, 3, modes),
 * from the first of these points on. Not more than `most` points are taken at once. */
void axijoint_plane_product(int most, int modes, int planes, long lead, const float *forth, const float *back, const float *slope,
                            const float *jump, float *excess)
{
#define BY(name, several)                                                                                            \
   for (int first = 0; first < points_together; first += (several))                                                  \
      name(modes, planes, lead, forth, back, slope + first, jump + first, excess + first)
   const int there = 2 * axijoint_doubles_at_once(), at_once = most < there ? most : there;
#if defined(__x86_64__)
   if (at_once >= 16) {
      BY(by_sixteen, 16);
      return;
   }
   if (at_once >= 8) {
      BY(by_eight, 8);
      return;
   }
#else
   (void)at_once;
#endif
   BY(by_four, 4);
}
