/* What the standard C library says through macros and structures, which a
   Fortran interface cannot name portably. Every function returns 0 or the
   value of errno, unless its comment says otherwise. */
#define _GNU_SOURCE /* for sync_file_range */
#include <errno.h>
#include <fcntl.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

/* A kind of file: 1 regular file, 2 directory, 3 symbolic link, 4 anything else. */
static int kind_of(mode_t mode)
{
   if (S_ISREG(mode)) return 1;
   if (S_ISDIR(mode)) return 2;
   if (S_ISLNK(mode)) return 3;
   return 4;
}

/* What a path is, links not followed: 0 nothing, else its kind; -errno if that
   cannot be told. */
int axijoint_path_kind(const char *path)
{
   struct stat status;
   if (lstat(path, &status) != 0) return errno == ENOENT ? 0 : -errno;
   return kind_of(status.st_mode);
}

/* The same, links followed: a link that leads nowhere is nothing. */
int axijoint_target_kind(const char *path)
{
   struct stat status;
   if (stat(path, &status) != 0) return errno == ENOENT ? 0 : -errno;
   return kind_of(status.st_mode);
}

/* Whether two paths, links followed, lead to one file: 1 or 0. */
int axijoint_same_file(const char *first, const char *second)
{
   struct stat one, other;
   if (stat(first, &one) != 0 || stat(second, &other) != 0) return 0;
   return one.st_dev == other.st_dev && one.st_ino == other.st_ino ? 1 : 0;
}

/* Bring what was written to a file, or a directory's entries, to the disk.
   A file system that cannot do this for directories is no error. */
int axijoint_sync_path(const char *path)
{
   int cause = 0;
   int descriptor = open(path, O_RDONLY | O_CLOEXEC);
   if (descriptor < 0) return errno;
   if (fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP) cause = errno;
   if (close(descriptor) != 0 && cause == 0) cause = errno;
   return cause;
}

/* Let bytes go to the disk without waiting for them: who waits later waits less. A system that
   cannot, or does not like to, is no error. */
static void start_sync(int descriptor)
{
#ifdef SYNC_FILE_RANGE_WRITE
   (void)!sync_file_range(descriptor, 0, 0, SYNC_FILE_RANGE_WRITE);
#else
   (void)descriptor;
#endif
}

/* The same by name; a file that cannot be opened will be missed later. */
void axijoint_start_sync(const char *path)
{
   int descriptor = open(path, O_RDONLY | O_CLOEXEC);
   if (descriptor < 0) return;
   start_sync(descriptor);
   close(descriptor);
}

/* Hand the buffer of a stream to the system, and let it go to the disk. */
int axijoint_flush_stream(FILE *stream)
{
   if (fflush(stream) != 0) return errno;
   start_sync(fileno(stream));
   return 0;
}

/* Largest resident memory of this process so far in kilobytes; -1 unknown. Linux
   says it in /proc; what getrusage says there is at least the memory of the
   process that started this one. */
long axijoint_peak_memory(void)
{
   struct rusage usage;
   char line[128];
   long peak = -1;
   FILE *status = fopen("/proc/self/status", "r");
   if (status) {
      while (peak < 0 && fgets(line, sizeof line, status))
         if (sscanf(line, "VmHWM: %ld", &peak) != 1) peak = -1;
      fclose(status);
      if (peak >= 0) return peak;
   }
   if (getrusage(RUSAGE_SELF, &usage) != 0) return -1;
#ifdef __APPLE__
   return usage.ru_maxrss / 1024;
#else
   return usage.ru_maxrss;
#endif
}

/* Let that memory be counted anew from what the process has now, where the system can. */
void axijoint_forget_peak_memory(void)
{
   FILE *marks = fopen("/proc/self/clear_refs", "w");
   if (!marks) return;
   fputs("5", marks);
   fclose(marks);
}

/* A write beyond the limit on file sizes shall fail with EFBIG and be
   reported, instead of ending the process by a signal. */
void axijoint_ignore_file_size_signal(void)
{
   signal(SIGXFSZ, SIG_IGN);
}

/* Large arrays go back to the system as soon as they are freed. By itself the
   library keeps ever larger ones for later, up to 32 MiB, and then less memory
   is free than the factors were planned for. Small ones stay: fetching their pages
   again and again is a tenth of the time of a small job. Where addresses are limited, threads
   have one heap: each heap of their own would reserve 64 MiB. */
void axijoint_return_freed_memory(void)
{
#ifdef M_MMAP_THRESHOLD
   struct rlimit space;
   if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY) mallopt(M_ARENA_MAX, 1);
   mallopt(M_MMAP_THRESHOLD, 4 << 20);
   mallopt(M_TRIM_THRESHOLD, 4 << 20);
#endif
}

/* What is freed stays, but for the largest arrays, as long as no more than so much of it lies at the end: the
   next harmonic, or the next row of a study, has the same arrays again, and fetching their pages is a tenth
   of the time of a run, and a quarter of that of a row. The heap grows by 64 MiB of addresses at once, so that the
   pages it is asked for can be large ones all over, unless addresses are limited: memory is taken by what is used alone. */
void axijoint_keep_freed_memory(int mebibytes)
{
#ifdef M_MMAP_THRESHOLD
   struct rlimit space;
   mallopt(M_MMAP_THRESHOLD, 32 << 20);
   mallopt(M_TRIM_THRESHOLD, mebibytes << 20);
   if (getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur == RLIM_INFINITY) mallopt(M_TOP_PAD, 64 << 20);
#else
   (void)mebibytes;
#endif
}

/* The last error of this thread, and setting it. */
int axijoint_get_errno(void) { return errno; }
void axijoint_set_errno(int value) { errno = value; }

/* The words for an errno value, ended by a zero, cut to the size given. */
void axijoint_error_text(int value, char *text, size_t size)
{
   if (size == 0) return;
   strncpy(text, strerror(value), size - 1);
   text[size - 1] = '\0';
}

/* Ask for large pages for an array that is going to be filled: a page is
   cleared when it is first touched, and there are 512 times fewer large ones.
   Only a hint; nothing depends on it. */
void axijoint_use_large_pages(double *array, int64_t count)
{
#ifdef MADV_HUGEPAGE
   const uintptr_t page = (uintptr_t)1 << 21;
   uintptr_t from = ((uintptr_t)array + page - 1) / page * page;
   uintptr_t to = ((uintptr_t)array + (uintptr_t)count * sizeof *array) / page * page;
   if (to > from) madvise((void *)from, to - from, MADV_HUGEPAGE);
#else
   (void)array;
   (void)count;
#endif
}

/* Zeros in an array that has just been allocated, in large pages. Pages that are given up are
   handed out again, cleared, when they are first touched: by the thread that needs them, and once,
   where filling the array would touch all of it before. */
void axijoint_zero_large_pages(double *array, int64_t count)
{
   char *from = (char *)array, *to = (char *)(array + count);
#ifdef __linux__
   const uintptr_t page = (uintptr_t)1 << 21;
   char *first = (char *)(((uintptr_t)from + page - 1) / page * page);
   char *last = (char *)((uintptr_t)to / page * page);
   if (last > first && madvise(first, (size_t)(last - first), MADV_DONTNEED) == 0) {
      axijoint_use_large_pages(array, count);
      memset(from, 0, (size_t)(first - from));
      from = last;
   }
#endif
   memset(from, 0, (size_t)(to - from));
}

/* Give memory that was freed back to the system, where the library keeps it */
void axijoint_give_back_memory(void)
{
#ifdef __GLIBC__
   malloc_trim(0);
#endif
}

/* Append bytes to a file, which is made if it is not there, and bring them to the disk if they
   are to be durable. */
int axijoint_append(const char *path, const char *bytes, size_t size, int durable)
{
   int cause = 0;
   int descriptor = open(path, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666);
   if (descriptor < 0) return errno;
   while (size > 0 && cause == 0) {
      ssize_t written = write(descriptor, bytes, size);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) cause = errno;
      if (written == 0) cause = ENOSPC;
      if (written > 0) {
         bytes += written;
         size -= (size_t)written;
      }
   }
   if (cause == 0 && durable && fdatasync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP) cause = errno;
   if (close(descriptor) != 0 && cause == 0) cause = errno;
   return cause;
}
