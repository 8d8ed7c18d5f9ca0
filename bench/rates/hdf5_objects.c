/* What writing a results file costs whoever writes it: a file with the groups, arrays and attributes of one that is there, of the
   same names, sizes and layout, without values; milliseconds by the clock from creating it to closing it, least and median. */
#include <hdf5.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { most = 4000, rounds = 30 };

/* A group, an array or an attribute of what stands before it: 'g', 'd', 'a' */
typedef struct {
   char kind, *name;
   hid_t type, space, layout;
   size_t bytes;
} object;

static object objects[most];
static int n;
static char *values;
static size_t largest;

static object *add(char kind, const char *name)
{
   if (n == most) exit(1);
   objects[n] = (object){.kind = kind, .name = strdup(name)};
   return &objects[n++];
}

static void measure(object *one, hid_t type, hid_t space)
{
   one->type = type;
   one->space = space;
   one->bytes = H5Tget_size(type) * (size_t)H5Sget_simple_extent_npoints(space);
   if (one->bytes > largest) largest = one->bytes;
}

static herr_t see_attribute(hid_t owner, const char *name, const H5A_info_t *info, void *unused)
{
   hid_t attribute = H5Aopen(owner, name, H5P_DEFAULT);
   object *one = add('a', name);
   (void)info, (void)unused;
   measure(one, H5Aget_type(attribute), H5Aget_space(attribute));
   return H5Aclose(attribute);
}

static herr_t see_object(hid_t file, const char *name, const H5O_info_t *info, void *unused)
{
   (void)unused;
   if (strcmp(name, ".") != 0) {
      object *one = add(info->type == H5O_TYPE_GROUP ? 'g' : 'd', name);
      if (one->kind == 'd') {
         hid_t set = H5Dopen2(file, name, H5P_DEFAULT);
         measure(one, H5Dget_type(set), H5Dget_space(set));
         one->layout = H5Dget_create_plist(set);
         H5Dclose(set);
      }
   }
   hid_t owner = H5Oopen(file, name, H5P_DEFAULT);
   H5Aiterate2(owner, H5_INDEX_NAME, H5_ITER_INC, NULL, see_attribute, NULL);
   return H5Oclose(owner);
}

static void write_all(const char *path, hid_t creation, hid_t access)
{
   hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, creation, access), last = -1;
   for (const object *one = objects; one < objects + n; one++) {
      if (one->kind != 'a' && last >= 0) H5Oclose(last);
      if (one->kind == 'g') last = H5Gcreate2(file, one->name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      if (one->kind == 'd') {
         last = H5Dcreate2(file, one->name, one->type, one->space, H5P_DEFAULT, one->layout, H5P_DEFAULT);
         if (one->bytes > 0) H5Dwrite(last, one->type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values);
      }
      if (one->kind == 'a') {
         hid_t made = H5Acreate2(last >= 0 ? last : file, one->name, one->type, one->space, H5P_DEFAULT, H5P_DEFAULT);
         H5Awrite(made, one->type, values);
         H5Aclose(made);
      }
   }
   if (last >= 0) H5Oclose(last);
   H5Fclose(file);
}

static int ascending(const void *a, const void *b)
{
   const double x = *(const double *)a, y = *(const double *)b;
   return (x > y) - (x < y);
}

int main(int argc, char **argv)
{
   double taken[rounds];
   struct timespec begun, ended;
   if (argc != 3) return 2;
   hid_t access = H5Pcreate(H5P_FILE_ACCESS), like = H5Fopen(argv[1], H5F_ACC_RDONLY, H5P_DEFAULT);
   if (like < 0) return 1;
   H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
   hid_t creation = H5Fget_create_plist(like);
   H5Ovisit2(like, H5_INDEX_NAME, H5_ITER_INC, see_object, NULL, H5O_INFO_BASIC);
   values = calloc(largest + 1, 1);
   for (int k = 0; k < rounds; k++) {
      clock_gettime(CLOCK_MONOTONIC, &begun);
      write_all(argv[2], creation, access);
      clock_gettime(CLOCK_MONOTONIC, &ended);
      taken[k] = 1e3 * (double)(ended.tv_sec - begun.tv_sec) + 1e-6 * (double)(ended.tv_nsec - begun.tv_nsec);
   }
   qsort(taken, rounds, sizeof *taken, ascending);
   int arrays = 0, attributes = 0;
   for (int k = 0; k < n; k++) arrays += objects[k].kind == 'd', attributes += objects[k].kind == 'a';
   printf("%d %d %.2f %.2f\n", arrays, attributes, taken[0], taken[rounds / 2]);
   return 0;
}
