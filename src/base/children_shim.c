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

/* Start this program again with n words, each ended by a zero. What is started ends when this process ends, by the
   signal that asks it to, and shows no progress, which would be written over what others show. The number of the
   process, or -errno. */
int axijoint_start_child(const char *words, int n)
{
   static char path[PATH_MAX];
   char *arguments[n + 2];
   size_t n_variables = 0;
   while (environ[n_variables]) n_variables++;
   char *variables[n_variables + 2];
   memcpy(variables, environ, n_variables * sizeof *variables);
   variables[n_variables] = (char *)"AXIJOINT_PROGRESS=none";
   variables[n_variables + 1] = NULL;
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
   const pid_t child = fork();
   if (child < 0) return -errno;
   if (child == 0) {
#ifdef __linux__
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) _exit(0);
#endif
      execve(path, arguments, variables);
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
