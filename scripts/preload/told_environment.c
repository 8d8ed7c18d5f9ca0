/* What libraries are told of their environment: to be preloaded. Asks for four variables as a
   library does that is being loaded, and prints those that have a value. */
#include <stdio.h>
#include <stdlib.h>

__attribute__((constructor)) static void ask(void)
{
   const char *const names[] = {"OMP_WAIT_POLICY", "GOMP_SPINCOUNT", "OPENBLAS_NUM_THREADS", "OPENBLAS_CORETYPE"};
   for (size_t i = 0; i < sizeof names / sizeof names[0]; ++i) {
      const char *value = getenv(names[i]);
      if (value) fprintf(stderr, "%s=%s\n", names[i], value);
   }
}
