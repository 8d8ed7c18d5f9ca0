/* To be preloaded: SIGTERM comes as soon as METIS has taken it for an error of its own. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <signal.h>
#include <unistd.h>

typedef void (*handler_type)(int);

handler_type __sysv_signal(int number, handler_type handler)
{
   static int sent = 0;
   handler_type (*next)(int, handler_type) = (handler_type (*)(int, handler_type))dlsym(RTLD_NEXT, "__sysv_signal");
   handler_type before = next(number, handler);
   if (number == SIGTERM && handler != SIG_DFL && handler != SIG_IGN && !sent++) kill(getpid(), SIGTERM);
   return before;
}
