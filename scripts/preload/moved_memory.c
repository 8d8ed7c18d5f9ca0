/* Memory at other places: to be preloaded. Every block that the program asks for lies 0, 16, 32 or
   48 bytes beyond a multiple of 64, by chance of the number SHUFFLE, so that what depends on where
   arrays lie shows in a few runs. Blocks asked for at a multiple of their own lie there. */
#include <errno.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

extern void *__libc_malloc(size_t);
extern void __libc_free(void *);

/* What stands before a block */
struct head {
   size_t size;
   void *base;
};

/* A number from 0 to 3: the high bits of a linear congruential sequence */
static size_t chance(void)
{
   static uint64_t state;
   const char *seed = getenv("SHUFFLE");
   uint64_t step = 2 * (seed ? strtoull(seed, NULL, 10) : 0) + 0x9E3779B97F4A7C15u;
   uint64_t x = __atomic_add_fetch(&state, step, __ATOMIC_RELAXED);
   return (size_t)(x * 0xD1342543DE82EF95u >> 62);
}

static void *place(size_t size, size_t boundary, size_t beyond)
{
   char *base = size < SIZE_MAX / 2 ? __libc_malloc(size + boundary + 128) : NULL;
   if (!base) {
      errno = ENOMEM;
      return NULL;
   }
   uintptr_t block = ((uintptr_t)base + sizeof(struct head) + boundary - 1) / boundary * boundary + beyond;
   ((struct head *)block)[-1] = (struct head){size, base};
   return (void *)block;
}

void *malloc(size_t size) { return place(size, 64, 16 * chance()); }

void free(void *block)
{
   if (block) __libc_free(((struct head *)block)[-1].base);
}

void *calloc(size_t count, size_t size)
{
   void *block = size && count > SIZE_MAX / size ? NULL : malloc(count * size);
   if (!block) errno = ENOMEM;
   return block ? memset(block, 0, count * size) : NULL;
}

void *realloc(void *old, size_t size)
{
   void *block = malloc(size);
   if (!old || !block) return block;
   size_t kept = ((struct head *)old)[-1].size;
   memcpy(block, old, kept < size ? kept : size);
   free(old);
   return block;
}

void *memalign(size_t boundary, size_t size) { return place(size, boundary < 64 ? 64 : boundary, 0); }

void *aligned_alloc(size_t boundary, size_t size) { return memalign(boundary, size); }

int posix_memalign(void **block, size_t boundary, size_t size)
{
   *block = memalign(boundary, size);
   return *block ? 0 : ENOMEM;
}

size_t malloc_usable_size(void *block) { return block ? ((struct head *)block)[-1].size : 0; }
