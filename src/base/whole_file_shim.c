/* Files that are read and written whole, and the names in a folder. Every function returns 0 or the
   value of errno, unless its comment says otherwise. */
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Make a file that is not there, of some bytes, and bring it to the disk if that is asked for;
   nothing stays of one that could not be written. */
int axijoint_write_new(const char *path, const char *bytes, int64_t count, int lasting)
{
   int cause = 0, descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
   if (descriptor < 0) return errno;
   while (count > 0 && cause == 0) {
      ssize_t n = write(descriptor, bytes, (size_t)count);
      if (n < 0 && errno != EINTR) cause = errno;
      if (n > 0) {
         bytes += n;
         count -= n;
      }
   }
   if (lasting && cause == 0 && fsync(descriptor) != 0 && errno != EINVAL && errno != ENOTSUP)
      cause = errno;
   if (close(descriptor) != 0 && cause == 0) cause = errno;
   if (cause != 0) unlink(path);
   return cause;
}

/* Bytes of a regular file; -errno if that cannot be told. */
int64_t axijoint_file_size(const char *path)
{
   struct stat status;
   if (stat(path, &status) != 0) return -errno;
   return S_ISREG(status.st_mode) ? (int64_t)status.st_size : -EINVAL;
}

/* Read the first bytes of a file: how many there were, or -errno. */
int64_t axijoint_read_file(const char *path, char *bytes, int64_t most)
{
   int64_t used = 0;
   int descriptor = open(path, O_RDONLY | O_CLOEXEC);
   if (descriptor < 0) return -errno;
   while (used < most) {
      ssize_t n = read(descriptor, bytes + used, (size_t)(most - used));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) used = -errno;
      if (n <= 0) break;
      used += n;
   }
   close(descriptor);
   return used;
}

/* Give a file a second name that must be free. Over a network the answer may be lost though it was
   done: then the file has two names. */
int axijoint_link(const char *from, const char *to)
{
   struct stat one, other;
   if (link(from, to) == 0) return 0;
   int cause = errno;
   if (cause != EEXIST || stat(from, &one) != 0 || stat(to, &other) != 0) return cause;
   return one.st_dev == other.st_dev && one.st_ino == other.st_ino ? 0 : cause;
}

/* Whether a cause of the last function says that the file system knows no second names. */
int axijoint_knows_no_links(int cause)
{
   return cause == EPERM || cause == ENOTSUP || cause == EOPNOTSUPP || cause == ENOSYS ||
          cause == EMLINK;
}

/* Whether a cause says that there is such a name, or none, already; or that it is too long. */
int axijoint_is_there(int cause) { return cause == EEXIST; }
int axijoint_is_not_there(int cause) { return cause == ENOENT; }
int axijoint_is_too_long(int cause) { return cause == ENAMETOOLONG; }

/* Names in a folder that begin and end with some letters, each followed by a line feed: the number
   of bytes, of which no more are given than there is room for; -errno if it cannot be read. */
int64_t axijoint_names_in(const char *folder, const char *first, const char *last, char *names,
                          int64_t room)
{
   const size_t ahead = strlen(first), behind = strlen(last);
   int64_t used = 0;
   DIR *stream = opendir(folder);
   if (!stream) return -errno;
   for (struct dirent *entry; (entry = readdir(stream));) {
      const size_t length = strlen(entry->d_name);
      if (length < ahead + behind || strncmp(entry->d_name, first, ahead) != 0 ||
          strcmp(entry->d_name + length - behind, last) != 0 || strchr(entry->d_name, '\n'))
         continue;
      if (used + (int64_t)length + 1 <= room) {
         memcpy(names + used, entry->d_name, length);
         names[used + (int64_t)length] = '\n';
      }
      used += (int64_t)length + 1;
   }
   closedir(stream);
   return used;
}
