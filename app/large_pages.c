/* Large pages for large arrays and for the heap. A page is cleared when it is first touched; there are 512 times fewer
   large ones, and each costs a tenth of what it stands for. Systems that give them to who asks alone ("madvise") are
   asked here for whatever the program and its libraries take, without a word in the places that allocate. Only a hint;
   nothing depends on it. This file is a part of programs only, never of the library. */
#define _GNU_SOURCE
#include <errno.h>
#include <stddef.h>
#include <stdint.h>
#include <sys/mman.h>
#include <unistd.h>

#if defined(__linux__) && defined(MADV_HUGEPAGE)

/* Least block that is worth the call: that of two large pages, as one of them lies in it whole */
#define WORTH_ASKING ((size_t)4 << 20)
#define PAGE ((uintptr_t)4096)

static void ask(uintptr_t from, uintptr_t to)
{
   from = (from + PAGE - 1) / PAGE * PAGE;
   to = to / PAGE * PAGE;
   const int cause = errno;
   if (to > from) madvise((void *)from, to - from, MADV_HUGEPAGE);
   errno = cause;
}

/* A block has been allocated: ask for it if it is large, and for what the heap has grown by, which small blocks
   share. Who asks twice at once does no harm. */
void axijoint_ask_large_pages(const void *block, size_t bytes)
{
   static uintptr_t told;
   const uintptr_t end = (uintptr_t)sbrk(0), before = __atomic_load_n(&told, __ATOMIC_RELAXED);

   if (bytes >= WORTH_ASKING && block) ask((uintptr_t)block, (uintptr_t)block + bytes);
   if (end == before) return;
   if (before && end > before) ask(before, end);
   __atomic_store_n(&told, end, __ATOMIC_RELAXED);
}

#else

void axijoint_ask_large_pages(const void *block, size_t bytes)
{
   (void)block;
   (void)bytes;
}

#endif
