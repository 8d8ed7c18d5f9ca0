/* What there is to say when the program cannot go on from where it is, as in the middle of a library that
   asked for memory in vain: from anywhere, with no memory, it says so in words, removes what it holds
   on the disk, and ends. What is to be said and removed then cannot be an argument of anything, so it
   is kept here. app/failing_calls.c calls this; programs that only use the library never get here. */
#define _GNU_SOURCE
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/syscall.h>
#include <ucontext.h>
#endif

enum { most_names = 64, exit_deck = 2, exit_memory = 6, exit_internal = 70 };

/* What the program is doing */
static char stage[128];
/* The file that a library reads at the moment, which trusts what it finds there; empty if none does */
static char foreign[PATH_MAX];
/* Locks that this process holds or asks for, each NAME.lock or a file that becomes one; the lines of a lock that tell
   whose it is; the end of the names of this process's temporary files */
static char locks[most_names][PATH_MAX];
static char own_host[300], own_process[32], own_ending[320];
/* Whether a failure of this thread's requests for memory is told to who asked */
static _Thread_local int may_fail = 0;
/* Whether the last words are being said */
static int ending = 0;

void axijoint_note_stage(const char *text)
{
   snprintf(stage, sizeof stage, "%s", text);
}

void axijoint_note_reading(const char *path)
{
   snprintf(foreign, sizeof foreign, "%s", path);
}

/* From here to the same with -1, requests of this thread for memory may fail: who asks looks at what comes
   back, and knows something better than to end */
void axijoint_let_fail(int change) { may_fail += change; }

int axijoint_may_fail(void) { return may_fail > 0; }

/* A lock is going to be asked for by this process; its temporary files have names NAME.(...).HOST.PROCESS.tmp in the
   same folder */
void axijoint_note_lock(const char *path, const char *host, int process)
{
   snprintf(own_host, sizeof own_host, "\nhost %.256s\n", host);
   snprintf(own_process, sizeof own_process, "\nprocess %d\n", process);
   snprintf(own_ending, sizeof own_ending, ".%.256s.%d.tmp", host, process);
   for (int k = 0; k < most_names; k++)
      if (!locks[k][0] && strlen(path) < PATH_MAX) {
         strcpy(locks[k], path);
         return;
      }
}

void axijoint_forget_lock(const char *path)
{
   for (int k = 0; k < most_names; k++)
      if (strcmp(locks[k], path) == 0) locks[k][0] = '\0';
}

/* All bytes to the standard error output; nothing can be done if they do not get there */
static void say(const char *text)
{
   size_t left = strlen(text);
   while (left > 0) {
      ssize_t n = write(2, text, left);
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) return;
      text += n;
      left -= (size_t)n;
   }
}

#ifdef __linux__
/* A size in /proc/self/status [MiB]; -1 if it is not told */
static long status_mebibytes(const char *label)
{
   char text[4096];
   int file = open("/proc/self/status", O_RDONLY | O_CLOEXEC);
   ssize_t n = file < 0 ? 0 : read(file, text, sizeof text - 1);
   if (file >= 0) close(file);
   text[n > 0 ? n : 0] = '\0';
   const char *found = strstr(text, label);
   return found ? atol(found + strlen(label)) / 1024 : -1;
}

/* Remove from the folder of a lock the files of this process that are not complete. Opening a folder by
   the library asks for memory, so the system is asked. */
static void remove_files(const char *lock, size_t length)
{
   struct entry {
      uint64_t number;
      int64_t offset;
      unsigned short size;
      unsigned char type;
      char name[];
   };
   static char folder[PATH_MAX], path[2 * PATH_MAX];
   static _Alignas(struct entry) char entries[32768];
   const char *slash = strrchr(lock, '/');
   const char *name = slash ? slash + 1 : lock;
   const size_t ahead = length - (size_t)(name - lock), behind = strlen(own_ending);
   snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash + 1 - lock) : 2, slash ? lock : "./");
   int file = open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
   if (file < 0) return;
   for (long n; (n = syscall(SYS_getdents64, file, entries, sizeof entries)) > 0;)
      for (long at = 0; at < n;) {
         const struct entry *entry = (const struct entry *)(entries + at);
         const size_t all = strlen(entry->name);
         at += entry->size;
         if (all < ahead + 1 + behind || strncmp(entry->name, name, ahead) != 0 ||
             entry->name[ahead] != '.' || strcmp(entry->name + all - behind, own_ending) != 0)
            continue;
         if ((size_t)snprintf(path, sizeof path, "%s%s", folder, entry->name) < sizeof path) unlink(path);
      }
   close(file);
}
#endif

/* Whether a lock is there and of this process */
static int is_own(const char *path)
{
   static char text[4096];
   int file = open(path, O_RDONLY | O_CLOEXEC);
   if (file < 0) return 0;
   ssize_t n = read(file, text, sizeof text - 1);
   close(file);
   text[n > 0 ? n : 0] = '\0';
   return strstr(text, own_host) && strstr(text, own_process);
}

/* Remove locks and files that are not complete. Where files were about to get their names, all stays
   for the next run, which brings that to its end: their journal is there. */
static void remove_what_is_held(void)
{
   static char journal[PATH_MAX + 16];
   for (int k = 0; k < most_names; k++) {
      if (!locks[k][0]) continue;
      size_t length = strlen(locks[k]) - strlen(".lock");
      snprintf(journal, sizeof journal, "%.*s.commit", (int)length, locks[k]);
      if (access(journal, F_OK) == 0) continue;
#ifdef __linux__
      remove_files(locks[k], length);
#endif
      if (is_own(locks[k])) unlink(locks[k]);
   }
}

/* The first thread that gets here ends the program, and others wait for that; a fault on the way ends it, too */
static void begin_to_end(void)
{
   static _Thread_local int begun = 0;
   if (begun++) _exit(exit_internal);
   if (__atomic_exchange_n(&ending, 1, __ATOMIC_SEQ_CST))
      for (;;) pause();
}

static void end(const char *text, int code)
{
   if (isatty(2)) say("\r");
   say(text);
   remove_what_is_held();
   _exit(code);
}

/* Whether the last words are being said, as of a thread that asks for memory */
int axijoint_is_ending(void) { return __atomic_load_n(&ending, __ATOMIC_SEQ_CST); }

/* The end for want of memory: of some bytes, or if that is 0 of what a text says */
void axijoint_out_of_memory(size_t bytes, const char *what)
{
   static char asked[128], limit[128], held[256], text[1024];
   begin_to_end();
   if (bytes > 0) snprintf(asked, sizeof asked, "%zu bytes asked for", bytes);
   else snprintf(asked, sizeof asked, "%s", what);
   struct rlimit space;
   if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY)
      snprintf(limit, sizeof limit, " of the %llu MiB that its limit (ulimit -v) allows",
               (unsigned long long)space.rlim_cur / 1048576);
#ifdef __linux__
   const long mebibytes = status_mebibytes(limit[0] ? "VmSize:" : "VmRSS:");
   if (mebibytes >= 0) snprintf(held, sizeof held, "; the program holds %ld MiB%s", mebibytes, limit);
#endif
   snprintf(text, sizeof text,
            "axijoint: out of memory: %s%s%s%s\n"
            "mend: more memory or a larger limit; fewer threads (--threads), another solver (axijoint estimate "
            "--solver NAME), fewer harmonics or a coarser mesh\n",
            asked, stage[0] ? " while " : "", stage, held);
   end(text, exit_memory);
}

#if defined(__linux__) && (defined(__x86_64__) || defined(__aarch64__))
/* Whether an address lies near the end of the stack as it stood when a signal came */
static int near_stack(const void *address, const void *context)
{
   const ucontext_t *at = context;
#ifdef __x86_64__
   const uintptr_t top = (uintptr_t)at->uc_mcontext.gregs[REG_RSP];
#else
   const uintptr_t top = (uintptr_t)at->uc_mcontext.sp;
#endif
   const uintptr_t place = (uintptr_t)address, reach = (uintptr_t)1 << 20;
   return place + reach > top && place < top + reach;
}
#else
static int near_stack(const void *address, const void *context) { return (void)address, (void)context, 0; }
#endif

/* A signal that only a fault of the program raises, or a stack that cannot grow */
static void fault(int number, siginfo_t *about, void *context)
{
   static char text[PATH_MAX + 512];
   if (number == SIGSEGV && near_stack(about->si_addr, context))
      axijoint_out_of_memory(0, "the stack (ulimit -s, OMP_STACKSIZE) cannot grow");
   begin_to_end();
   if (foreign[0]) {
      snprintf(text, sizeof text,
               "%s: error: the file is damaged: the library that reads it was led beyond its memory (signal %d)\n"
               "mend: write the file again\n", foreign, number);
      end(text, exit_deck);
   }
   snprintf(text, sizeof text,
            "axijoint: internal error: signal %d%s%s\nmend: this is a fault of the program, please report it with "
            "the deck and the command line\n", number, stage[0] ? " while " : "", stage);
   end(text, exit_internal);
}

/* A stack of its own for the signals of this thread; without it an end of the stack is a signal */
void axijoint_signal_stack(void)
{
   stack_t own = {.ss_size = 65536};
   axijoint_let_fail(1);
   own.ss_sp = mmap(NULL, own.ss_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
   axijoint_let_fail(-1);
   if (own.ss_sp != MAP_FAILED) sigaltstack(&own, NULL);
}

/* From now on such signals end in words, too; not where somebody else heeds them, as the run-time library does in
   a build for debugging. That nobody reads what is printed any more is no reason to end: exit codes mean something. */
void axijoint_heed_faults(void)
{
   signal(SIGPIPE, SIG_IGN);
   const int numbers[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT};
   axijoint_signal_stack();
   for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++) {
      struct sigaction action, before;
      if (sigaction(numbers[k], NULL, &before) != 0 || before.sa_handler != SIG_DFL) continue;
      memset(&action, 0, sizeof action);
      action.sa_sigaction = fault;
      action.sa_flags = SA_SIGINFO | SA_ONSTACK;
      sigemptyset(&action.sa_mask);
      sigaction(numbers[k], &action, NULL);
   }
}

/* Errors of the screen output */
static int lost = 0;

/* What was written to the standard outputs did not get there, for a cause that errno says. That nobody reads it
   any more is no fault. */
void axijoint_note_lost(int cause)
{
   if (lost == 0 && cause != EPIPE) lost = cause;
}

int axijoint_lost_output(void) { return lost; }
