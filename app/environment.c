/* The environment of the numerical libraries: threads that wait leave their processor to others, but not for the
   fraction of a millisecond between the products of an iteration, since waking them takes longer than that; threads are for
   harmonics and not for the matrices inside one, and OpenBLAS 0.3.21 takes newer AMD processors for Haswell, whose
   kernels leave their AVX-512 units idle, and newer Intel ones for Prescott, whose kernels take five times as long. The libraries ask for these variables when they are loaded, before any code of
   the program; but what stands in the program itself goes before the same names in the system's library, for all
   libraries that are loaded. So they ask here, and are told what is right where the user has set nothing. This file is a
   part of programs only, never of the library. scripts/environment sets the same for programs that are not this one. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

/* Elsewhere the libraries are left to themselves, and where sanitizers are, which begin before all else */
#if defined(__linux__) && defined(__GLIBC__) && (defined(__PIE__) || !defined(__PIC__)) && \
   !defined(__SANITIZE_ADDRESS__)

/* Value of a variable as it is set; NULL if it is not */
static char *value_set(const char *name)
{
   const size_t length = strlen(name);
   for (char **entry = environ; entry && *entry; ++entry)
      if (strncmp(*entry, name, length) == 0 && (*entry)[length] == '=') return *entry + length + 1;
   return NULL;
}

/* The kernels of OpenBLAS for this processor where it may not know it; NULL for those that it chooses */
static char *kernels(void)
{
#ifdef __x86_64__
   static char skylake[] = "SKYLAKEX", haswell[] = "HASWELL";
   __builtin_cpu_init();
   if (__builtin_cpu_supports("avx512f")) return skylake;
   if (__builtin_cpu_is("intel") && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return haswell;
#endif
   return NULL;
}

/* In place of the system's function: what is set, if empty, stays */
char *getenv(const char *name)
{
   static char passive[] = "PASSIVE", turns[] = "5000", one[] = "1";
   char *value = value_set(name);
   if (value) return value;
   if (strcmp(name, "OMP_WAIT_POLICY") == 0) return passive;
   if (strcmp(name, "GOMP_SPINCOUNT") == 0 && !value_set("OMP_WAIT_POLICY")) return turns;
   if (strcmp(name, "OPENBLAS_NUM_THREADS") == 0) return one;
   return strcmp(name, "OPENBLAS_CORETYPE") == 0 ? kernels() : NULL;
}

/* A standard input or output that is closed is no number for the first file that is opened: the words for the screen
   would get into it. What is read from or written to this one is an error. */
static void occupy_standard_files(int argc, char **argv, char **environment)
{
   (void)argc, (void)argv, (void)environment;
   for (int file = 0; file <= 2; ++file)
      if (fcntl(file, F_GETFD) == -1) open("/dev/null", file == 0 ? O_WRONLY : O_RDONLY);
}

/* Large pages begin at multiples of their size, the heap anywhere: so it begins a little before one, by what the
   constructors of libraries take. Without this a small job fetches half of its memory in small pages */
static void place_heap(int argc, char **argv, char **environment)
{
   enum { large_page = 2 << 20, taken_at_start = 192 << 10 };
   (void)argc, (void)argv, (void)environment;
   const uintptr_t end = (uintptr_t)sbrk(0);
   const uintptr_t begin = (end + taken_at_start + large_page - 1) / large_page * large_page - taken_at_start;
   sbrk((intptr_t)(begin - end));
}

/* .preinit_array runs before the constructors of all libraries */
__attribute__((section(".preinit_array"), used))
static void (*const at_start[])(int, char **, char **) = {occupy_standard_files, place_heap};

#endif
