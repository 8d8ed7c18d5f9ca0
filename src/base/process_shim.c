/* Who a process is, and whether it still runs: for locks, which name their owner. */
#include <errno.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/types.h>
#include <time.h>
#include <unistd.h>

/* The first line of a file without its end, empty if there is none. */
static void first_line(const char *path, char *text, size_t size)
{
   text[0] = '\0';
   FILE *file = fopen(path, "r");
   if (!file) return;
   if (!fgets(text, (int)size, file)) text[0] = '\0';
   text[strcspn(text, "\n")] = '\0';
   fclose(file);
}

/* Names of this machine, each ended by a zero and empty if the system has none: 0 the name of the
   host, 1 its installation, 2 the time that it has been up (a name of the boot), 3 the space that
   process numbers are of, which containers have of their own. */
void axijoint_machine_name(int which, char *text, size_t size)
{
   ssize_t length = 0;
   text[0] = '\0';
   switch (which) {
   case 0:
      if (gethostname(text, size - 1) != 0) text[0] = '\0';
      text[size - 1] = '\0';
      break;
   case 1: first_line("/etc/machine-id", text, size); break;
   case 2: first_line("/proc/sys/kernel/random/boot_id", text, size); break;
   default:
      length = readlink("/proc/self/ns/pid", text, size - 1);
      text[length > 0 ? length : 0] = '\0';
   }
}

/* When a process of this machine began, in the ticks of its clock; 0 if it runs but that cannot be
   told, -1 if it does not run. One that has ended and was not yet waited for does not run. */
int64_t axijoint_process_start(int process)
{
   char path[64], line[1024], state = 0;
   long long start = 0;
   snprintf(path, sizeof path, "/proc/%d/stat", process);
   FILE *file = fopen(path, "r");
   if (file) {
      const char *rest = fgets(line, sizeof line, file) ? strrchr(line, ')') : NULL;
      if (rest && sscanf(rest + 1, " %c %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s %*s"
                         " %*s %*s %*s %*s %lld", &state, &start) != 2) start = 0;
      fclose(file);
      return state == 'Z' || state == 'X' ? -1 : start;
   }
   return kill(process, 0) == 0 || errno == EPERM ? 0 : -1;
}

/* Do nothing for some milliseconds. */
void axijoint_pause(int milliseconds)
{
   struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
   nanosleep(&time, NULL);
}
