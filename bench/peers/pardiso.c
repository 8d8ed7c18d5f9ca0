/* MKL PARDISO, loaded when it runs. Usage: pardiso FILE LIBRARY own|given
   Environment: MKL_THREADING_LAYER=SEQUENTIAL */
#include "peer.h"
#include <dlfcn.h>

typedef void pardiso_type(void *handle, const int *maxfct, const int *mnum, const int *type,
                          const int *phase, const int *n, const double *a, const int *ia,
                          const int *ja, int *perm, const int *nrhs, int *iparm,
                          const int *msglvl, double *b, double *x, int *error);

static pardiso_type *pardiso;
static void *handle[64];
static int n, *ia, *ja, *perm, iparm[64];
static double *values, *b, *x;

static double call(int phase) {
   const int one = 1, type = 2, quiet = 0;
   int error = 0;
   double start = seconds();
   pardiso(handle, &one, &one, &type, &phase, &n, values, ia, ja, perm, &one, iparm, &quiet, b, x,
           &error);
   if (error) {
      fprintf(stderr, "PARDISO: phase %d failed with %d\n", phase, error);
      exit(1);
   }
   return seconds() - start;
}

/* Upper triangle by rows: the transpose of what the file holds */
static void transpose(const matrix_type *a) {
   ia = calloc((size_t)n + 2, sizeof *ia);
   ja = room(sizeof *ja * (size_t)a->entries);
   values = room(8 * (size_t)a->entries);
   for (int64_t k = 0; k < a->entries; k++) ia[a->column[k] + 1]++;
   ia[0] = ia[1] = 1;
   for (int i = 1; i <= n; i++) ia[i + 1] += ia[i];
   for (int i = 0; i < n; i++)
      for (int64_t k = a->start[i] - 1; k < a->start[i + 1] - 1; k++) {
         int place = ia[a->column[k]]++ - 1;
         ja[place] = i + 1;
         values[place] = a->value[k];
      }
}

int main(int count, char **arguments) {
   double analysis, fresh[3], again[3], solution, wall, share = 0;
   void *library;
   int given;
   if (count < 4) fail("usage: pardiso FILE LIBRARY own|given");
   library = dlopen(arguments[2], RTLD_NOW | RTLD_GLOBAL);
   if (!library) fail(dlerror());
   *(void **)&pardiso = dlsym(library, "pardiso_");
   if (!pardiso) fail("the library has no pardiso_");
   matrix_type a = read_matrix(arguments[1]);
   given = !strcmp(arguments[3], "given");
   n = (int)a.n;
   transpose(&a);
   perm = room(sizeof *perm * (size_t)n);
   for (int i = 0; i < n; i++) perm[i] = i + 1;
   b = ones(n);
   x = room(8 * (size_t)n);
   iparm[0] = 1;  /* no defaults */
   iparm[1] = 2;  /* METIS */
   iparm[4] = given;
   iparm[9] = 8;
   iparm[17] = iparm[18] = -1; /* count entries and operations */
   analysis = call(11);
   for (int k = 0; k < 3; k++) {
      if (k) call(0); /* release the factor */
      wall = wall_seconds();
      fresh[k] = call(22);
      share += fresh[k] / (wall_seconds() - wall) / 3;
   }
   for (int k = 0; k < 3; k++) again[k] = call(22);
   solution = call(33);
   printf("pardiso,%s,%g,%g,%g,%g,%g,%g,%g,%g,%g\n", given ? "given" : "own METIS", analysis,
          least3(fresh), least3(again), solution, 1e6 * iparm[18], iparm[16] / 1024.0,
          (double)iparm[17], lapack_ratio(&a, x), share);
   call(-1);
   return 0;
}
