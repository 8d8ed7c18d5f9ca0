/* Columns of a supernode in the order of a walk through the mesh.
 *
 * Any order of the columns of a supernode leaves its panel as it is, but supernodes before it fill rows of it that lie side by
 * side in the mesh. Where these are neighbours in the panel, too, what they take goes there by whole vectors. METIS orders the
 * equations of a separator as it came by them. */
#include <stdint.h>
#include <stdlib.h>

/* Neighbours of each equation from the lower triangle by rows, counted from zero, with its diagonal; 1 if there is no memory */
static int find_neighbours(int64_t n, const int64_t *start, const int64_t *column, int64_t *first, int32_t **neighbour) {
   int64_t i, k;
   for (i = 0; i <= n; i++) first[i] = 0;
   for (i = 0; i < n; i++)
      for (k = start[i]; k < start[i + 1]; k++)
         if (column[k] != i) {
            first[i]++;
            first[column[k]]++;
         }
   for (i = 1; i <= n; i++) first[i] += first[i - 1]; /* ends of the lists, which are filled from behind */
   *neighbour = malloc(sizeof **neighbour * (size_t)(first[n] + 1));
   if (!*neighbour) return 1;
   for (i = 0; i < n; i++)
      for (k = start[i]; k < start[i + 1]; k++)
         if (column[k] != i) {
            (*neighbour)[--first[i]] = (int32_t)column[k];
            (*neighbour)[--first[column[k]]] = (int32_t)i;
         }
   return 0;
}

/* Walk from one equation to all of its supernode that can be reached, nearest first; gives how many these are. They are seen
   `times` times then */
static int64_t walk_from(int32_t at, const int64_t *first, const int32_t *neighbour, const int32_t *supernode, int8_t times,
                         int8_t *seen, int32_t *reached) {
   int64_t n = 0;
   reached[n++] = at;
   seen[at] = times;
   for (int64_t i = 0; i < n; i++)
      for (int64_t k = first[reached[i]]; k < first[reached[i] + 1]; k++) {
         const int32_t next = neighbour[k];
         if (supernode[next] != supernode[at] || seen[next] >= times) continue;
         seen[next] = times;
         reached[n++] = next;
      }
   return n;
}

/* Arrange equations of a pattern, lower triangle by rows counted from zero, within each of the supernodes, which begin at
   `super` in `order`: from an end of what hangs together to the other end. `walked` takes the equations in the new order.
   1 if there is no memory */
int axijoint_walk_columns(int64_t n, const int64_t *start, const int64_t *column, int64_t n_supernodes, const int64_t *super,
                          const int64_t *order, int32_t *walked) {
   int64_t *first = malloc(sizeof *first * (size_t)(n + 1));
   int32_t *supernode = malloc(sizeof *supernode * (size_t)(n + 1)), *neighbour = NULL;
   int8_t *seen = calloc((size_t)n + 1, sizeof *seen);
   const int failed = !first || !supernode || !seen || find_neighbours(n, start, column, first, &neighbour);
   for (int64_t s = 0; s < n_supernodes && !failed; s++)
      for (int64_t k = super[s]; k < super[s + 1]; k++) supernode[order[k]] = (int32_t)s;
   for (int64_t s = 0, count = 0; s < n_supernodes && !failed; s++)
      for (int64_t k = super[s]; k < super[s + 1]; k++) {
         if (seen[order[k]]) continue;
         int64_t reached = walk_from((int32_t)order[k], first, neighbour, supernode, 1, seen, walked + count);
         count += walk_from(walked[count + reached - 1], first, neighbour, supernode, 2, seen, walked + count);
      }
   free(first);
   free(supernode);
   free(neighbour);
   free(seen);
   return failed;
}
