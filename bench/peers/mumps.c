/* MUMPS, sequential, on the order that the matrix comes in. Usage: mumps FILE */
#include "peer.h"
#include <dmumps_c.h>

#define ICNTL(k) icntl[(k) - 1]
#define INFOG(k) infog[(k) - 1]
#define RINFOG(k) rinfog[(k) - 1]

static DMUMPS_STRUC_C m;

static double call(int job) {
   double start = seconds();
   m.job = job;
   dmumps_c(&m);
   if (m.INFOG(1) < 0) {
      fprintf(stderr, "MUMPS: job %d failed with %d %d\n", job, m.INFOG(1), m.INFOG(2));
      exit(1);
   }
   return seconds() - start;
}

static double large(int value) { /* a negative count is in millions */
   return value < 0 ? -1e6 * value : value;
}

int main(int count, char **arguments) {
   double analysis, fresh[3], solution, wall, share = 0;
   if (count < 2) fail("usage: mumps FILE");
   matrix_type a = read_matrix(arguments[1]);
   m.par = 1;
   m.sym = 1; /* positive definite */
   m.comm_fortran = -987654;
   call(-1);
   m.ICNTL(1) = m.ICNTL(2) = m.ICNTL(3) = -1;
   m.ICNTL(4) = 0;
   m.ICNTL(7) = 1; /* order given */
   m.ICNTL(16) = 1;
   m.n = (MUMPS_INT)a.n;
   m.nnz = a.entries;
   m.jcn = a.column;
   m.irn = room(4 * (size_t)a.entries);
   m.perm_in = room(4 * (size_t)a.n);
   m.a = a.value;
   for (int64_t i = 0; i < a.n; i++) {
      m.perm_in[i] = (MUMPS_INT)i + 1;
      for (int64_t k = a.start[i] - 1; k < a.start[i + 1] - 1; k++) m.irn[k] = (MUMPS_INT)i + 1;
   }
   analysis = call(1);
   for (int k = 0; k < 3; k++) { /* it frees and takes the memory of the factor itself */
      wall = wall_seconds();
      fresh[k] = call(2);
      share += fresh[k] / (wall_seconds() - wall) / 3;
   }
   m.rhs = ones(a.n);
   solution = call(3);
   printf("mumps,given,%g,%g,,%g,%g,%g,%g,%g,%g\n", analysis, least3(fresh), solution,
          m.RINFOG(3), large(m.INFOG(9)) * 8 / 1048576, large(m.INFOG(29)),
          lapack_ratio(&a, m.rhs), share);
   call(-2);
   return 0;
}
