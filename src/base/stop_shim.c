/* A wish that the program ends before its time: a signal, or a file. What a signal changes cannot be an
   argument of anything, so it is kept here. */
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

/* What schedulers, terminals and limits of processor time send */
static const int signals[] = {SIGTERM, SIGINT, SIGUSR1, SIGUSR2, SIGHUP, SIGXCPU};
enum { n_signals = sizeof signals / sizeof signals[0], by_file = -1 };

static volatile sig_atomic_t wish = 0;
static char file[4096];
static volatile time_t looked = 0;
static int together = 0, agreed = 0;

void axijoint_stop_signals(sigset_t *set);

/* The first time, remember it; interrupted once more, end as if nothing had been set up. */
static void note_signal(int number)
{
   if (number == SIGINT && wish == SIGINT) {
      signal(SIGINT, SIG_DFL);
      raise(SIGINT);
   }
   wish = number;
}

/* From now on take note of signals, but of none that this process was told to ignore. Where several
   processes work together, what counts is the wish that they have agreed on. */
void axijoint_heed_signals(int with_others)
{
   together = with_others;
   for (int k = 0; k < n_signals; k++) {
      struct sigaction action, before;
      if (sigaction(signals[k], NULL, &before) == 0 && before.sa_handler == SIG_IGN) continue;
      memset(&action, 0, sizeof action);
      action.sa_handler = note_signal;
      action.sa_flags = SA_RESTART;
      sigemptyset(&action.sa_mask);
      sigaction(signals[k], &action, NULL);
   }
   sigset_t mine;
   axijoint_stop_signals(&mine);
   sigprocmask(SIG_UNBLOCK, &mine, NULL); /* who started this process held them back until now */
}

/* The signals that are taken note of */
void axijoint_stop_signals(sigset_t *set)
{
   sigemptyset(set);
   for (int k = 0; k < n_signals; k++) sigaddset(set, signals[k]);
}

/* From now on take note of a file that somebody makes; of none if the path is empty. */
void axijoint_heed_file(const char *path)
{
   strncpy(file, path, sizeof file - 1);
   looked = 0;
}

/* The wish that this process knows of: 0 none, the place of the signal from 1, then the file, for the
   numbers of signals are not the same everywhere. The file is looked for once a second. */
int axijoint_own_wish(void)
{
   if (wish == 0 && file[0] != '\0') {
      const time_t now = time(NULL);
      if (now != looked) {
         looked = now;
         if (access(file, F_OK) == 0) wish = by_file;
      }
   }
   for (int k = 0; k < n_signals; k++)
      if (wish == signals[k]) return k + 1;
   return wish == by_file ? n_signals + 1 : 0;
}

/* The wish that counts */
int axijoint_stop_wish(void)
{
   return together ? agreed : axijoint_own_wish();
}

/* What the processes agree on, the same for all at the same place of their way */
void axijoint_agree_wish(int number)
{
   agreed = number;
}
