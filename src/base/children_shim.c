/* Processes that this one starts: the same program again, with other words. */
#define _GNU_SOURCE
#include <errno.h>
#include <limits.h>
#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

extern char **environ;

/* stop_shim.c */
void axijoint_stop_signals(sigset_t *set);

/* Whether a variable of the environment is one of this process alone: to what processor its threads are bound */
static int is_own(const char *variable)
{
   static const char *const own[] = {"AXIJOINT_PROGRESS=", "OMP_PROC_BIND=", "OMP_PLACES=", "GOMP_CPU_AFFINITY="};
   for (size_t k = 0; k < sizeof own / sizeof own[0]; k++)
      if (strncmp(variable, own[k], strlen(own[k])) == 0) return 1;
   return 0;
}

/* Start this program again with n words, each ended by a zero. What is started ends when this process ends, by the
   signal that asks it to, and shows no progress, which would be written over what others show. Signals that come before
   it takes note of them wait. It is this program even if another stands under its name by now. The number of the
   process, or -errno. */
int axijoint_start_child(const char *words, int n)
{
   static char path[PATH_MAX];
   char *arguments[n + 2];
   size_t n_variables = 0, n_kept = 0;
   while (environ[n_variables]) n_variables++;
   char *variables[n_variables + 2];
   for (size_t k = 0; k < n_variables; k++)
      if (!is_own(environ[k])) variables[n_kept++] = environ[k];
   variables[n_kept++] = (char *)"AXIJOINT_PROGRESS=none";
   variables[n_kept] = NULL;
   const pid_t parent = getpid();
   const ssize_t length = readlink("/proc/self/exe", path, sizeof path - 1);
   if (length <= 0) return -(length < 0 ? errno : ENOENT);
   path[length] = '\0';
   arguments[0] = path;
   for (int k = 1; k <= n; k++) {
      arguments[k] = (char *)words;
      while (*words++) {}
   }
   arguments[n + 1] = NULL;
   sigset_t held, before;
   axijoint_stop_signals(&held);
   sigprocmask(SIG_BLOCK, &held, &before);
   const pid_t child = fork();
   const int failure = errno;
   if (child != 0) sigprocmask(SIG_SETMASK, &before, NULL);
   if (child < 0) return -failure;
   if (child == 0) {
#ifdef __linux__
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) _exit(0);
#endif
      execve("/proc/self/exe", arguments, variables);
      _exit(127);
   }
   return (int)child;
}

/* How a child ended: its exit code, 128 and the number of the signal that ended it, or -1 while it runs. */
int axijoint_child_ended(int child)
{
   int status;
   const pid_t found = waitpid((pid_t)child, &status, WNOHANG);
   if (found == 0 || (found < 0 && errno == EINTR)) return -1;
   if (found < 0) return 127;
   return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/* Ask a child to end. */
void axijoint_end_child(int child) { kill((pid_t)child, SIGTERM); }
