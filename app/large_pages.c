/* Large pages for large arrays and for the heap. A page is cleared when it is first touched; there are 512 times fewer
   large ones, and each costs a tenth of what it stands for. Systems that give them to who asks alone ("madvise") are
   asked here for whatever the program and its libraries take, without a word in the places that allocate. Only a hint;
   nothing depends on it. This file is a part of programs only, never of the library. */
#define _GNU_SOURCE
#include <errno.h>
#include <pthread.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/mman.h>
#include <unistd.h>

#if defined(__linux__) && defined(MADV_HUGEPAGE)

/* Least block that is worth the call, and the least that is worth a look at the heap: smaller ones are many, and what
   they made it grow by is seen with the next */
#define WORTH_ASKING ((size_t)1 << 20)
#define WORTH_A_LOOK ((size_t)1 << 10)
#define PAGE ((uintptr_t)4096)
/* Where heaps of other threads than the first lie: each has so many bytes of addresses, from a multiple of them on (glibc) */
#define THREAD_HEAP ((uintptr_t)64 << 20)

static void ask(uintptr_t from, uintptr_t to)
{
   from = (from + PAGE - 1) / PAGE * PAGE;
   to = to / PAGE * PAGE;
   const int cause = errno;
   if (to > from) madvise((void *)from, to - from, MADV_HUGEPAGE);
   errno = cause;
}

/* A block has been allocated: ask for it if it is large. Where it lies in the heap, or that has grown, ask for all of
   the heap, which small blocks share: the part that it was given back by and has grown by again has forgotten. A thread
   that has come to another heap of its own asks for all of that; the first one has none but the heap. */
void axijoint_ask_large_pages(const void *block, size_t bytes)
{
   static uintptr_t heap, seen;
   static pthread_t first;
   if (bytes < WORTH_A_LOOK) return;
   const uintptr_t from = (uintptr_t)block, end = (uintptr_t)sbrk(0);
   uintptr_t begin = __atomic_load_n(&heap, __ATOMIC_RELAXED);
   const int grown = __atomic_exchange_n(&seen, end, __ATOMIC_RELAXED) != end;

   if (!begin) {
      first = pthread_self();
      begin = from && from < end ? from : end;
      __atomic_store_n(&heap, begin, __ATOMIC_RELAXED);
   }
   if (grown || (bytes >= WORTH_ASKING && from >= begin && from < end)) ask(begin, end);
   if (from <= end) return;
   if (bytes >= WORTH_ASKING) {
      ask(from, from + bytes);
      return;
   }
   if (pthread_equal(pthread_self(), first)) return;
   static _Thread_local uintptr_t own;
   const uintptr_t base = from / THREAD_HEAP * THREAD_HEAP;
   if (base != own) ask(base, base + THREAD_HEAP);
   own = base;
}

#else

void axijoint_ask_large_pages(const void *block, size_t bytes)
{
   (void)block;
   (void)bytes;
}

#endif
