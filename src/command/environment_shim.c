/* The environment of the numerical libraries: threads that wait leave their processor to others,
   threads are for harmonics and not for the matrices inside one, and OpenBLAS 0.3.21 takes newer
   AMD processors for Haswell, whose kernels leave their AVX-512 units idle. The libraries read
   these variables when they are loaded, before any code of the program, but for what stands in
   .preinit_array: it runs before their constructors, and can do no more than start the program
   once more with a larger environment. What is set already stays, so that it starts once.
   scripts/environment sets the same for programs that are not this one. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <limits.h>
#include <string.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/syscall.h>
#endif

/* A reference to this function links this file. */
void axijoint_link_environment(void) {}

/* .preinit_array belongs to programs, not to shared libraries; musl has none, and checks of the
   compiler are not ready so early. */
#if defined(__linux__) && defined(__GLIBC__) && (defined(__PIE__) || !defined(__PIC__)) && \
   !defined(__SANITIZE_ADDRESS__)

/* Whether a variable has a value, be it empty. */
static int is_set(char **environment, const char *setting)
{
   size_t length = (size_t)(strchr(setting, '=') - setting) + 1;
   for (; *environment; ++environment)
      if (strncmp(*environment, setting, length) == 0) return 1;
   return 0;
}

static int has_avx512(void)
{
#ifdef __x86_64__
   __builtin_cpu_init();
   return __builtin_cpu_supports("avx512f");
#else
   return 0;
#endif
}

/* Whether a command computes, or has no address space to spare for threads of OpenBLAS that have nothing to do. */
static int needs_settings(const char *command)
{
   const char *const computing[] = {"run", "estimate", "study", "envelope"};
   struct rlimit space;
   for (size_t i = 0; i < sizeof computing / sizeof computing[0]; ++i)
      if (strcmp(command, computing[i]) == 0) return 1;
   return getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
}

/* A standard input or output that is closed is no number for the first file that is opened: the words for the screen
   would get into it. What is read from or written to this one is an error. */
static void occupy_standard_files(void)
{
   for (int file = 0; file <= 2; ++file)
      if (fcntl(file, F_GETFD) == -1) open("/dev/null", file == 0 ? O_WRONLY : O_RDONLY);
}

/* Commands that compute start again if a variable is not set. If that fails, nothing is lost but
   time. */
static void set_environment(int argc, char **argv, char **environment)
{
   occupy_standard_files();
   char *const settings[] = {"OMP_WAIT_POLICY=PASSIVE", "OPENBLAS_NUM_THREADS=1",
                             "OPENBLAS_CORETYPE=SKYLAKEX"};
   const size_t wanted = has_avx512() ? 3 : 2;
   size_t size = 0, all;
   char program[PATH_MAX];
   ssize_t length;

   if (argc < 2 || !needs_settings(argv[1])) return;
   while (environment[size]) ++size;
   char *larger[size + wanted + 1];
   memcpy(larger, environment, size * sizeof *larger);
   all = size;
   for (size_t i = 0; i < wanted; ++i)
      if (!is_set(environment, settings[i])) larger[all++] = settings[i];
   if (all == size) return;
   larger[all] = NULL;
   length = readlink("/proc/self/exe", program, sizeof program - 1);
   if (length <= 0) return;
   program[length] = '\0';
   if (strstr(program, "/ld-")) return; /* the loader was called with the program as its argument */
   /* not execve(), before which a build that counts coverage would write its files */
   syscall(SYS_execve, program, argv, larger);
}

__attribute__((section(".preinit_array"), used))
static void (*const at_start)(int, char **, char **) = set_environment;

#endif
