/* A wish that the program ends before its time: a signal, or a file. What a signal changes cannot be an
   argument of anything, so it is kept here. */
#include <fcntl.h>
#include <signal.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

static volatile sig_atomic_t wish = 0;
static char file[4096];
static volatile time_t looked = 0;

/* The first time, remember it; interrupted once more, end as if nothing had been set up. */
static void note_signal(int number)
{
   if (number == SIGINT && wish == SIGINT) {
      signal(SIGINT, SIG_DFL);
      raise(SIGINT);
   }
   wish = number;
}

/* From now on take note of signals, but of none that this process was told to ignore. That nobody
   reads what is printed any more is no reason to end. */
void axijoint_heed_signals(void)
{
   signal(SIGPIPE, SIG_IGN);
   const int numbers[] = {SIGTERM, SIGINT, SIGUSR1};
   for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
      struct sigaction action, before;
      if (sigaction(numbers[k], NULL, &before) == 0 && before.sa_handler == SIG_IGN) continue;
      memset(&action, 0, sizeof action);
      action.sa_handler = note_signal;
      action.sa_flags = SA_RESTART;
      sigemptyset(&action.sa_mask);
      sigaction(numbers[k], &action, NULL);
   }
}

/* From now on take note of a file that somebody makes; of none if the path is empty. */
void axijoint_heed_file(const char *path)
{
   strncpy(file, path, sizeof file - 1);
   looked = 0;
}

/* The wish: 0 none, else the number of the signal, -1 for the file. The file is looked for once a
   second. */
int axijoint_stop_wish(void)
{
   if (wish == 0 && file[0] != '\0') {
      const time_t now = time(NULL);
      if (now != looked) {
         looked = now;
         if (access(file, F_OK) == 0) wish = -1;
      }
   }
   return wish;
}

/* What the signals are called here, as their numbers are not the same everywhere: 1 SIGTERM, 2 SIGINT,
   3 SIGUSR1, 0 another. */
int axijoint_signal_name(int number)
{
   return number == SIGTERM ? 1 : number == SIGINT ? 2 : number == SIGUSR1 ? 3 : 0;
}
