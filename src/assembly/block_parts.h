/* Blocks of two nodes as block_parts.f90 keeps them */
#ifndef AXIJOINT_BLOCK_PARTS_H
#define AXIJOINT_BLOCK_PARTS_H

/* Numbers of a block, and components of a node */
enum { block_size = 14, components = 3 };

typedef double four __attribute__((vector_size(32), aligned(8)));

#define INLINE static inline __attribute__((always_inline))
#define FOUR(place) (*(const four *)(place))
#define FOR_COMPONENTS _Pragma("GCC unroll 3") for (int r = 0; r < components; ++r)

/* Factors of the parts in K_m, by component of the column: of A or S where the row is that of u or v, or that of w, and of C in the
 * same. A fourth component is none, whatever is read there. */
typedef struct {
   four even, odd, square_even, square_odd;
} factors_type;

/* They, from those of A, S and C */
INLINE factors_type factors_of(const double *factors)
{
   const double a = factors[0], s = factors[1], c = factors[2];
   return (factors_type){{a, a, s}, {s, s, a}, {c, c}, {0, 0, c}};
}

/* A block of K_m from its parts, row by row */
INLINE void evaluate(const factors_type *factors, const double *parts, four block[components])
{
   const four squares = __builtin_shufflevector(FOUR(parts + 10), FOUR(parts + 10), 1, 2, 3, 3);
   block[0] = factors->even * FOUR(parts) + factors->square_even * FOUR(parts + 9);
   block[1] = factors->even * FOUR(parts + 3) + factors->square_even * squares;
   block[2] = factors->odd * FOUR(parts + 6) + factors->square_odd * squares;
}

#endif
