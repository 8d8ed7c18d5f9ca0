/* METIS takes SIGTERM and SIGABRT for errors of its own while it works, and gives them back changed: a wish that the
   program ends would come back as an ordering that failed. Such a signal waits until METIS is done, and is then met by
   who met it before. */
#include <signal.h>
#include <stddef.h>

/* Before METIS works (1), and after (0) */
void axijoint_hold_termination(int hold)
{
   static _Thread_local sigset_t mask;
   static _Thread_local struct sigaction term, abort;
   sigset_t signals;
   sigemptyset(&signals);
   sigaddset(&signals, SIGTERM);
   if (hold) {
      pthread_sigmask(SIG_BLOCK, &signals, &mask);
      sigaction(SIGTERM, NULL, &term);
      sigaction(SIGABRT, NULL, &abort);
   } else {
      sigaction(SIGTERM, &term, NULL);
      sigaction(SIGABRT, &abort, NULL);
      pthread_sigmask(SIG_SETMASK, &mask, NULL);
   }
}
