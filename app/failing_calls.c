/* Calls that nobody looks after. Temporary arrays of the compiler and arrays inside libraries are taken from
   malloc all over the program; some who ask look at what they get, some print a message of their own, some
   crash, OpenBLAS tries again for ever. What stands in the program itself goes before the same names in the
   system's library, for all libraries that are loaded: so a request that fails ends in words, unless the thread has
   said that it may fail (src/base/last_words_shim.c). Bytes for the screen that are lost are noted in the same way: the
   run-time library does not tell. This file is a part of programs only, never of the library. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <signal.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

/* Elsewhere, and where sanitizers stand there already, nothing is put before the system's names */
#if defined(__linux__) && defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__)

void axijoint_out_of_memory(size_t bytes, const char *what);
int axijoint_may_fail(void);
int axijoint_is_ending(void);
void axijoint_signal_stack(void);
void axijoint_note_lost(int cause);
void axijoint_ask_large_pages(const void *block, size_t bytes); /* large_pages.c */

extern void *__libc_malloc(size_t), *__libc_calloc(size_t, size_t);
extern void *__libc_realloc(void *, size_t), *__libc_memalign(size_t, size_t);

/* The function of a name that would be called without this file; that may be of a library that was loaded before
   the others. While it is looked for, the system's own are used. */
#define NEXT(name, alone)                                                       \
   static __typeof__(&name) next;                                               \
   static _Thread_local int looking;                                            \
   __typeof__(&name) call = __atomic_load_n(&next, __ATOMIC_RELAXED);           \
   if (!call && looking) call = alone;                                          \
   if (!call) {                                                                 \
      looking = 1;                                                              \
      call = (__typeof__(&name))dlsym(RTLD_NEXT, #name);                        \
      looking = 0;                                                              \
      if (!call) call = alone;                                                  \
      __atomic_store_n(&next, call, __ATOMIC_RELAXED);                          \
   }

/* The end, unless a failure is looked after or somebody is ending already */
static void fail(size_t bytes)
{
   const int cause = errno;
   if (!axijoint_may_fail() && !axijoint_is_ending()) axijoint_out_of_memory(bytes, "");
   errno = cause;
}

static int aligned(void **block, size_t boundary, size_t bytes)
{
   *block = __libc_memalign(boundary, bytes);
   return *block ? 0 : ENOMEM;
}

void *malloc(size_t bytes)
{
   NEXT(malloc, __libc_malloc)
   void *block = call(bytes);
   if (!block) fail(bytes);
   axijoint_ask_large_pages(block, bytes);
   return block;
}

void *calloc(size_t count, size_t bytes)
{
   NEXT(calloc, __libc_calloc)
   void *block = call(count, bytes);
   if (!block && count > 0 && bytes > 0) fail(count > SIZE_MAX / bytes ? SIZE_MAX : count * bytes);
   axijoint_ask_large_pages(block, count * bytes);
   return block;
}

void *realloc(void *old, size_t bytes)
{
   NEXT(realloc, __libc_realloc)
   void *block = call(old, bytes);
   if (!block && (bytes > 0 || !old)) fail(bytes);
   axijoint_ask_large_pages(block, bytes);
   return block;
}

int posix_memalign(void **block, size_t boundary, size_t bytes)
{
   NEXT(posix_memalign, aligned)
   const int cause = call(block, boundary, bytes);
   if (cause == ENOMEM) fail(bytes);
   if (cause == 0) axijoint_ask_large_pages(*block, bytes);
   return cause;
}

void *aligned_alloc(size_t boundary, size_t bytes)
{
   NEXT(aligned_alloc, __libc_memalign)
   void *block = call(boundary, bytes);
   if (!block) fail(bytes);
   axijoint_ask_large_pages(block, bytes);
   return block;
}

/* OpenBLAS takes its buffers so */
void *mmap(void *place, size_t bytes, int protection, int flags, int file, off_t offset)
{
   NEXT(mmap, NULL)
   void *block = call(place, bytes, protection, flags, file, offset);
   if (block == MAP_FAILED && errno == ENOMEM) fail(bytes);
   return block;
}

/* What a thread begins with */
struct beginning {
   void *(*work)(void *);
   void *argument;
};

static void *begin_thread(void *given)
{
   const struct beginning beginning = *(struct beginning *)given;
   sigset_t wishes;
   sigemptyset(&wishes);
   sigaddset(&wishes, SIGTERM); /* the main thread takes it, when METIS lets it */
   pthread_sigmask(SIG_BLOCK, &wishes, NULL);
   free(given);
   axijoint_signal_stack();
   return beginning.work(beginning.argument);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*work)(void *), void *argument)
{
   NEXT(pthread_create, NULL)
   struct beginning *beginning = malloc(sizeof *beginning);
   if (!beginning) return EAGAIN;
   *beginning = (struct beginning){work, argument};
   const int cause = call(thread, attributes, begin_thread, beginning);
   if (cause == 0) return 0;
   free(beginning);
   if (cause == EAGAIN && !axijoint_is_ending()) axijoint_out_of_memory(0, "a thread cannot be started");
   return cause;
}

ssize_t write(int file, const void *bytes, size_t count)
{
   NEXT(write, NULL)
   const ssize_t written = call(file, bytes, count);
   if (written < 0 && (file == 1 || file == 2) && errno != EINTR && errno != EAGAIN) {
      const int cause = errno;
      axijoint_note_lost(cause);
      errno = cause;
   }
   return written;
}

#endif
