/* How many numbers kernels of the program take at once, which decides in what order sums are made and so their last bits.
 *
 * Not more than the kernels that OpenBLAS is asked for: OPENBLAS_CORETYPE makes processors of several kinds compute the same
 * bits, which processes that solve one job need. */
#include <stdint.h>
#include <stdlib.h>
#include <strings.h>

/* Numbers of double precision that the kernels asked for take at once: as many as there are where nothing is asked for, or
 * something unknown that may be newer; those that are as old as none that take four */
static int32_t asked_for(void)
{
   static const char *const of_four[] = {"Haswell", "Zen"};
   static const char *const of_two[] = {"Prescott", "Core2", "Penryn", "Dunnington", "Atom", "Nano", "Nehalem", "Sandybridge",
                                        "Opteron", "Opteron_SSE3", "Barcelona", "Bobcat", "Bulldozer", "Piledriver",
                                        "Steamroller", "Excavator", "Katmai", "Coppermine", "Northwood", "Banias", "Athlon"};
   const char *name = getenv("OPENBLAS_CORETYPE");
   if (!name) return 8;
   for (size_t i = 0; i < sizeof of_four / sizeof *of_four; ++i)
      if (strcasecmp(name, of_four[i]) == 0) return 4;
   for (size_t i = 0; i < sizeof of_two / sizeof *of_two; ++i)
      if (strcasecmp(name, of_two[i]) == 0) return 2;
   return 8;
}

static int32_t at_hand(void)
{
#if defined(__x86_64__)
   if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return 2;
   return __builtin_cpu_supports("avx512f") ? 8 : 4;
#else
   return 2;
#endif
}

/* 2, 4 or 8. A process keeps to what it finds first */
int32_t axijoint_doubles_at_once(void)
{
   static int32_t kept;
   int32_t found = __atomic_load_n(&kept, __ATOMIC_RELAXED);
   if (!found) {
      const int32_t asked = asked_for(), there = at_hand();
      found = asked < there ? asked : there;
      __atomic_store_n(&kept, found, __ATOMIC_RELAXED);
   }
   return found;
}
