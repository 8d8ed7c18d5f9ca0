/* Rounding as another processor, or another library, might have it: to be preloaded. Sines, cosines, tangents, exponentials and logarithms differ
   from those of the system by one in the last digit, or do not, by chance of the number SHUFFLE and of the argument, and so does
   all that is made of them. Zero and one stay. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { of_sine = 1, of_cosine, of_tangent, of_exponential, of_logarithm };

/* A value with another last digit */
static double rounded(double argument, double value, uint64_t function)
{
   const char *seed = getenv("SHUFFLE");
   uint64_t x;
   if (value == 0.0 || fabs(value) == 1.0 || !isfinite(value)) return value;
   memcpy(&x, &argument, sizeof x);
   x = (x ^ function) * 0xD1342543DE82EF95u + (seed ? strtoull(seed, NULL, 10) : 0) * 0x9E3779B97F4A7C15u;
   x = (x ^ x >> 29) * 0xBF58476D1CE4E5B9u;
   x ^= x >> 32;
   return x % 3 == 0 ? value : nextafter(value, x % 3 == 1 ? 2.0 * value : 0.0);
}

static double called(const char *name, double argument, uint64_t function)
{
   double (*system)(double);
   *(void **)&system = dlsym(RTLD_NEXT, name);
   if (!system) abort();
   return rounded(argument, system(argument), function);
}

double sin(double x) { return called("sin", x, of_sine); }
double cos(double x) { return called("cos", x, of_cosine); }
double tan(double x) { return called("tan", x, of_tangent); }
double exp(double x) { return called("exp", x, of_exponential); }
double log(double x) { return called("log", x, of_logarithm); }

void sincos(double x, double *sine, double *cosine)
{
   *sine = sin(x);
   *cosine = cos(x);
}
