/* Calls that fail: to be preloaded. FAULT names a kind of call: memory, map, open, write, short, sync, close, rename or
   unlink. Of that kind the call FAULT_AT fails, and with FAULT_ON=1 all that follow, with errno FAULT_ERRNO; a short
   write writes half of its bytes. Counted is what is called after main begins; of files, those in the folder FAULT_IN
   and, if FAULT_SCREEN=1, the standard outputs. How many calls there were is appended to the file FAULT_COUNT.

   FAULT_SWEEP=FIRST:LAST:STEP, for memory, tries all of them in one run instead: at each the process forks, the
   request fails in the child, and the parent, once the child has ended, goes on as if nothing had been, with the files in the
   folder put back. FAULT_COUNT takes a line for each child that did not end in order - exit code 6, one message in two or three
   lines, no file of its own left - and in the end how many were tried. */
#define _GNU_SOURCE
#include <dirent.h>
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

enum { most_files = 64, seconds_to_hang = 20 };

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t), *__libc_realloc(void *, size_t);
extern void *__libc_memalign(size_t, size_t);

static long calls = 0, tried = 0, odd = 0;
static int counting = 0, failing = 0, busy = 0;

#define NEXT(name) ((__typeof__(&name))dlsym(RTLD_NEXT, #name))

static const char *setting(const char *name)
{
   const char *value = getenv(name);
   return value ? value : "";
}

static void report(const char *format, ...)
{
   va_list values;
   FILE *file = fopen(setting("FAULT_COUNT"), "a");
   if (!file) return;
   va_start(values, format);
   vfprintf(file, format, values);
   va_end(values);
   fclose(file);
}

/* The folder's files, kept by a second name in a folder beside it */
static char kept[most_files][NAME_MAX + 1];
static int n_kept;

static void each_file(const char *folder, void (*act)(const char *folder, const char *name))
{
   DIR *stream = opendir(folder);
   if (!stream) return;
   for (struct dirent *entry; (entry = readdir(stream));)
      if (entry->d_name[0] != '.') act(folder, entry->d_name);
   closedir(stream);
}

static char aside[PATH_MAX];

static void keep(const char *folder, const char *name)
{
   char from[PATH_MAX], to[2 * PATH_MAX];
   if (n_kept == most_files) return;
   strcpy(kept[n_kept++], name);
   snprintf(from, sizeof from, "%s/%s", folder, name);
   snprintf(to, sizeof to, "%s/%s", aside, name);
   if (link(from, to) != 0) report("cannot keep %s\n", name);
}

static void drop(const char *folder, const char *name)
{
   char path[PATH_MAX];
   snprintf(path, sizeof path, "%s/%s", folder, name);
   unlink(path);
}

static long left = 0;
static void count_left(const char *folder, const char *name)
{
   const size_t n = strlen(name);
   (void)folder;
   if ((n > 4 && strcmp(name + n - 4, ".tmp") == 0) || (n > 5 && strcmp(name + n - 5, ".lock") == 0)) left++;
   if (n > 7 && strcmp(name + n - 7, ".commit") == 0) left = LONG_MIN / 2;
}

static void put_back(const char *folder)
{
   char from[2 * PATH_MAX], to[PATH_MAX];
   each_file(folder, drop);
   for (int k = 0; k < n_kept; k++) {
      snprintf(from, sizeof from, "%s/%s", aside, kept[k]);
      snprintf(to, sizeof to, "%s/%s", folder, kept[k]);
      rename(from, to);
   }
   n_kept = 0;
}

/* What a child said and how it ended */
static void judge(int status, int file)
{
   static char text[2048];
   const char *folder = setting("FAULT_IN");
   ssize_t n = pread(file, text, sizeof text - 1, 0);
   int lines = 0;
   text[n > 0 ? n : 0] = '\0';
   for (const char *c = text; *c; c++) lines += *c == '\n';
   left = 0;
   each_file(folder, count_left);
   if (WIFEXITED(status) && WEXITSTATUS(status) == 6 && left <= 0 && lines <= 3 && strstr(text, "out of memory: ") &&
       strstr(text, "\nmend: ") && !strstr(strstr(text, "\nmend: ") + 7, "mend: "))
      return;
   odd++;
   report("call %ld: %s %d, %ld files left: %s\n", calls, WIFSIGNALED(status) ? "signal" : "exit code",
          WIFSIGNALED(status) ? WTERMSIG(status) : WEXITSTATUS(status), left > 0 ? left : 0, text);
}

/* Fork; in the child the request is to fail */
static int try_in_child(void)
{
   char path[] = "/tmp/failing-XXXXXX";
   const char *folder = setting("FAULT_IN");
   int status = 0, file = mkstemp(path);
   unlink(path);
   snprintf(aside, sizeof aside, "%s.aside", folder);
   mkdir(aside, 0777);
   each_file(folder, keep);
   pid_t child = fork();
   if (child == 0) {
      signal(SIGALRM, SIG_DFL);
      alarm(seconds_to_hang);
      int nowhere = open("/dev/null", O_WRONLY);
      dup2(nowhere, 1);
      dup2(file, 2);
      return 1;
   }
   if (child < 0) report("cannot fork\n");
   else waitpid(child, &status, 0);
   judge(status, file);
   close(file);
   put_back(folder);
   tried++;
   return 0;
}

/* Whether a call of some kind is to fail */
static int fails(const char *kind)
{
   static int same = -1;
   static const char *last = NULL;
   static long at = -1, on, first = -1, end, step;
   if (!counting || busy) return 0;
   const int keep_errno = errno;
   busy = 1;
   if (at < 0) {
      at = atol(setting("FAULT_AT"));
      on = atol(setting("FAULT_ON"));
      if (sscanf(setting("FAULT_SWEEP"), "%ld:%ld:%ld", &first, &end, &step) != 3) first = -1;
   }
   if (kind != last) same = strcmp(setting("FAULT"), kind) == 0;
   last = kind;
   int result = 0;
   if (same) {
      calls++;
      if (failing) result = on != 0;
      else if (first >= 0 && calls >= first && calls <= end && (calls - first) % step == 0) result = try_in_child();
      else if (first < 0 && at > 0 && (calls == at || (on && calls > at))) result = 1;
      if (result) {
         failing = 1;
         first = -1;
      }
   }
   busy = 0;
   errno = result ? atoi(setting("FAULT_ERRNO")) : keep_errno;
   return result;
}

void *malloc(size_t bytes) { return fails("memory") ? NULL : __libc_malloc(bytes); }
void *calloc(size_t count, size_t bytes) { return fails("memory") ? NULL : __libc_calloc(count, bytes); }
void *realloc(void *old, size_t bytes) { return fails("memory") ? NULL : __libc_realloc(old, bytes); }
void *aligned_alloc(size_t boundary, size_t bytes) { return fails("memory") ? NULL : __libc_memalign(boundary, bytes); }
int posix_memalign(void **block, size_t boundary, size_t bytes)
{
   if (fails("memory")) return ENOMEM;
   *block = __libc_memalign(boundary, bytes);
   return *block ? 0 : ENOMEM;
}

void *mmap(void *place, size_t bytes, int protection, int flags, int file, off_t offset)
{
   return fails("map") ? MAP_FAILED : NEXT(mmap)(place, bytes, protection, flags, file, offset);
}

/* Whether a file is one of those that are counted */
static int inside(const char *path)
{
   const char *folder = setting("FAULT_IN");
   char whole[PATH_MAX];
   if (!counting || busy || !*folder) return 0;
   if (path[0] != '/' && getcwd(whole, sizeof whole - NAME_MAX)) {
      strncat(strcat(whole, "/"), path, NAME_MAX - 2);
      path = whole;
   }
   return strncmp(path, folder, strlen(folder)) == 0;
}

static int is_counted(int file)
{
   char link_name[64], path[PATH_MAX];
   if (!counting || busy) return 0;
   if (file == 1 || file == 2) return setting("FAULT_SCREEN")[0] == '1';
   snprintf(link_name, sizeof link_name, "/proc/self/fd/%d", file);
   ssize_t n = readlink(link_name, path, sizeof path - 1);
   path[n > 0 ? n : 0] = '\0';
   return n > 0 && inside(path);
}

#define OPENS(name)                                                        \
   int name(const char *path, int flags, ...)                              \
   {                                                                       \
      va_list values;                                                      \
      va_start(values, flags);                                             \
      mode_t mode = flags & O_CREAT ? va_arg(values, mode_t) : 0;          \
      va_end(values);                                                      \
      if (inside(path) && fails("open")) return -1;                        \
      return NEXT(name)(path, flags, mode);                                \
   }
OPENS(open)
OPENS(open64)

FILE *fopen(const char *path, const char *mode)
{
   if (inside(path) && fails("open")) return NULL;
   return NEXT(fopen)(path, mode);
}

FILE *fopen64(const char *path, const char *mode)
{
   if (inside(path) && fails("open")) return NULL;
   return NEXT(fopen64)(path, mode);
}

ssize_t write(int file, const void *bytes, size_t count)
{
   if (is_counted(file)) {
      if (fails("write")) return -1;
      if (count > 1 && fails("short")) count /= 2;
   }
   return NEXT(write)(file, bytes, count);
}

ssize_t pwrite(int file, const void *bytes, size_t count, off_t offset)
{
   if (is_counted(file)) {
      if (fails("write")) return -1;
      if (count > 1 && fails("short")) count /= 2;
   }
   return NEXT(pwrite)(file, bytes, count, offset);
}

ssize_t pwrite64(int file, const void *bytes, size_t count, off64_t offset)
{
   if (is_counted(file)) {
      if (fails("write")) return -1;
      if (count > 1 && fails("short")) count /= 2;
   }
   return NEXT(pwrite64)(file, bytes, count, offset);
}

/* What the C library writes for its streams is called inside it, so the calls of the program are looked at */
size_t fwrite(const void *bytes, size_t size, size_t count, FILE *stream)
{
   if (is_counted(fileno(stream)) && fails("write")) return 0;
   return NEXT(fwrite)(bytes, size, count, stream);
}

int fflush(FILE *stream)
{
   if (stream && is_counted(fileno(stream)) && fails("write")) return EOF;
   return NEXT(fflush)(stream);
}

int fsync(int file) { return is_counted(file) && fails("sync") ? -1 : NEXT(fsync)(file); }
int fdatasync(int file) { return is_counted(file) && fails("sync") ? -1 : NEXT(fdatasync)(file); }

/* The system closes a file though it says that it failed */
int close(int file)
{
   const int fault = is_counted(file) && fails("close"), cause = errno, result = NEXT(close)(file);
   if (!fault) return result;
   return errno = cause, -1;
}

int fclose(FILE *stream)
{
   const int fault = is_counted(fileno(stream)) && fails("close"), cause = errno, result = NEXT(fclose)(stream);
   if (!fault) return result;
   return errno = cause, EOF;
}

int rename(const char *from, const char *to)
{
   return inside(to) && fails("rename") ? -1 : NEXT(rename)(from, to);
}

int link(const char *from, const char *to) { return inside(to) && fails("rename") ? -1 : NEXT(link)(from, to); }

int unlink(const char *path) { return inside(path) && fails("unlink") ? -1 : NEXT(unlink)(path); }

/* A child goes by the name of its parent */
pid_t getpid(void)
{
   static pid_t first = 0;
   if (!first) first = NEXT(getpid)();
   return first;
}

static int (*program)(int, char **, char **);

static int counted(int argc, char **argv, char **environment)
{
   getpid();
   counting = 1;
   return program(argc, argv, environment);
}

/* What begins main */
int __libc_start_main(int (*main)(int, char **, char **), int argc, char **argv, void (*init)(void),
                      void (*fini)(void), void (*rtld_fini)(void), void *stack_end)
{
   int (*next)(int (*)(int, char **, char **), int, char **, void (*)(void), void (*)(void), void (*)(void), void *) =
      (__typeof__(next))dlsym(RTLD_NEXT, "__libc_start_main");
   program = main;
   return next(counted, argc, argv, init, fini, rtld_fini, stack_end);
}

__attribute__((destructor)) static void say_how_many(void)
{
   if (!counting || failing) return;
   busy = 1;
   report("calls %ld, tried %ld, not in order %ld\n", calls, tried, odd);
}
