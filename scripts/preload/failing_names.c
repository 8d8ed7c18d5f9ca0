/* Loaded before other libraries, lets the n-th call that gives a name to a file fail, or ends the process
   there: NAMES_FAIL=N, NAMES_FAIL_FROM=N for that and all that follow, NAMES_KILL=N, where calls that take
   a name away count, too. Only names that begin with NAMES_IN are looked at. NAMES_LOG=FILE notes there, in
   order, what is waited for to be on the disk and which names are given. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static long given = 0, changed = 0;

static long number(const char *name)
{
   const char *text = getenv(name);
   return text ? atol(text) : -1;
}

/* Whether a call shall fail; it may be the last thing that the process does. */
static int faulty(const char *path, int gives)
{
   const char *folder = getenv("NAMES_IN");
   if (!folder || strncmp(path, folder, strlen(folder)) != 0) return 0;
   if (++changed == number("NAMES_KILL")) kill(getpid(), SIGKILL);
   if (!gives) return 0;
   given++;
   return given == number("NAMES_FAIL") ||
          (number("NAMES_FAIL_FROM") > 0 && given >= number("NAMES_FAIL_FROM"));
}

static void note(const char *what, const char *path)
{
   const char *folder = getenv("NAMES_IN"), *name = getenv("NAMES_LOG");
   FILE *log = name && folder && strncmp(path, folder, strlen(folder)) == 0 ? fopen(name, "a") : NULL;
   if (!log) return;
   fprintf(log, "%s %s\n", what, path);
   fclose(log);
}

int fsync(int file)
{
   int (*next)(int) = dlsym(RTLD_NEXT, "fsync");
   char link[64], path[PATH_MAX];
   snprintf(link, sizeof link, "/proc/self/fd/%d", file);
   const ssize_t length = readlink(link, path, sizeof path - 1);
   if (length > 0) {
      path[length] = 0;
      note("sync", path);
   }
   return next(file);
}

int rename(const char *from, const char *to)
{
   int (*next)(const char *, const char *) = dlsym(RTLD_NEXT, "rename");
   note("name", to);
   if (faulty(to, 1)) return errno = EIO, -1;
   return next(from, to);
}

int link(const char *from, const char *to)
{
   int (*next)(const char *, const char *) = dlsym(RTLD_NEXT, "link");
   if (faulty(to, 1)) return errno = EIO, -1;
   if (getenv("NAMES_NO_LINKS")) return errno = EPERM, -1;
   return next(from, to);
}

int unlink(const char *path)
{
   int (*next)(const char *) = dlsym(RTLD_NEXT, "unlink");
   faulty(path, 0);
   return next(path);
}
