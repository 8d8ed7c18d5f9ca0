/* SuiteSparse CHOLMOD with its own settings and METIS on the unknowns. Usage: cholmod FILE */
#include "peer.h"
#include <suitesparse/cholmod.h>

int main(int count, char **arguments) {
   cholmod_common common;
   cholmod_sparse view;
   cholmod_factor *factor = NULL;
   cholmod_dense *b, *x;
   double start, wall, analysis, fresh[3], again[3], solution, share = 0;
   if (count < 2) fail("usage: cholmod FILE");
   matrix_type a = read_matrix(arguments[1]);
   int64_t *p = room(8 * (size_t)(a.n + 1)), *i = room(8 * (size_t)a.entries);
   for (int64_t k = 0; k <= a.n; k++) p[k] = a.start[k] - 1;
   for (int64_t k = 0; k < a.entries; k++) i[k] = a.column[k] - 1;
   memset(&view, 0, sizeof view);
   view.nrow = view.ncol = (size_t)a.n;
   view.nzmax = (size_t)a.entries;
   view.p = p;
   view.i = i;
   view.x = a.value;
   view.stype = 1;
   view.itype = CHOLMOD_LONG;
   view.xtype = CHOLMOD_REAL;
   view.dtype = CHOLMOD_DOUBLE;
   view.sorted = view.packed = 1;
   cholmod_l_start(&common);
   common.nmethods = 1;
   common.method[0].ordering = CHOLMOD_METIS;
   for (int k = 0; k < 3; k++) {
      cholmod_l_free_factor(&factor, &common);
      start = seconds();
      factor = cholmod_l_analyze(&view, &common);
      analysis = seconds() - start;
      start = seconds();
      wall = wall_seconds();
      cholmod_l_factorize(&view, factor, &common);
      fresh[k] = seconds() - start;
      share += fresh[k] / (wall_seconds() - wall) / 3;
   }
   for (int k = 0; k < 3; k++) {
      start = seconds();
      cholmod_l_factorize(&view, factor, &common);
      again[k] = seconds() - start;
   }
   if (common.status != CHOLMOD_OK) fail("CHOLMOD failed");
   b = cholmod_l_ones((size_t)a.n, 1, CHOLMOD_REAL, &common);
   start = seconds();
   x = cholmod_l_solve(CHOLMOD_A, factor, b, &common);
   solution = seconds() - start;
   printf("cholmod,own METIS,%g,%g,%g,%g,%g,%g,%g,%g,%g\n", analysis, least3(fresh),
          least3(again), solution, common.fl, (double)factor->xsize * 8 / 1048576, common.lnz,
          lapack_ratio(&a, x->x), share);
   return 0;
}
