#ifndef AXIJOINT_CHOLMOD_TREE_H
#define AXIJOINT_CHOLMOD_TREE_H
#include <stdint.h>

/* Structure of a factor: a supernode is a set of neighbouring columns with the same rows, kept as one dense panel */
typedef struct {
   int64_t n, n_supernodes;
   int64_t *order;        /* equation of each column of the factor, shape (n) */
   int64_t *column;       /* first column of each supernode, shape (n_supernodes + 1) */
   int64_t *first_row;    /* first of its rows in `row`, same shape */
   int64_t *first_number; /* first of its numbers in the factor, same shape */
   int64_t *row;          /* rows of all supernodes, ascending in each */
   int32_t users;
} tree_type;

/* Structure of the factor of a pattern, given as the lower triangle by rows, counted from one, with its first user; entries of the
   factor and operations of a factorization. Null if there is no memory */
tree_type *axijoint_find_tree(int64_t n, const int64_t *start, const int32_t *column, double *entries, double *operations);

/* A user of a tree less; the last one frees it */
void axijoint_leave_tree(tree_type *tree);

#endif
