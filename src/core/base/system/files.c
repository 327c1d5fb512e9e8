/* What files need of POSIX that Fortran cannot call: functions with optional arguments, structures, clocks. For Windows see
   windows_files.c and windows_locks.c. */
#ifndef _WIN32
#define _GNU_SOURCE
#include "standard.h"
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Make a folder, remove an empty one, give a file another name in place of a file that has it, remove a file; 1: done */
int dondolo_make_folder(const char *path)
{
   return mkdir(path, 0777) == 0;
}

int dondolo_remove_folder(const char *path)
{
   return rmdir(path) == 0;
}

int dondolo_rename(const char *from, const char *to)
{
   return rename(from, to) == 0;
}

int dondolo_remove_file(const char *path)
{
   return unlink(path) == 0;
}

/* 1: a file may be replaced, whoever has it open */
int dondolo_is_free(const char *path)
{
   (void)path;
   return 1;
}

/* 1: two paths are one file that exists */
int dondolo_same_file(const char *first, const char *second)
{
   char *real_first = realpath(first, NULL), *real_second = realpath(second, NULL);
   int is_same = real_first != NULL && real_second != NULL && strcmp(real_first, real_second) == 0;

   free(real_first);
   free(real_second);
   return is_same;
}

/* Where the folders of a path end: number of bytes with the last separator */
size_t dondolo_last_separator(const char *path)
{
   const char *last = strrchr(path, '/');

   return last == NULL ? 0 : (size_t)(last - path) + 1;
}

/* 1: a path does not depend on the current folder */
int dondolo_is_absolute(const char *path)
{
   return path[0] == '/';
}

/* Make a file that is not there yet, and open it to write; NULL if that fails. No link is followed. */
FILE *dondolo_create(const char *path)
{
   int descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);

   return descriptor < 0 ? NULL : fdopen(descriptor, "w");
}

/* What is at a path: 0 nothing, 1 a regular file, 2 a symbolic link, 3 a folder, 4 a pipe, 5 a socket, 6 a device. A link is
   what it leads to where links are followed. */
int dondolo_thing(const char *path, int follows)
{
   struct stat found;

   if ((follows ? stat(path, &found) : lstat(path, &found)) != 0)
      return 0;
   switch (found.st_mode & S_IFMT) {
   case S_IFREG: return 1;
   case S_IFLNK: return 2;
   case S_IFDIR: return 3;
   case S_IFIFO: return 4;
   case S_IFSOCK: return 5;
   default: return 6;
   }
}

/* Read the first and the last bytes of a regular file, `room` of each or all that there are; what is left of the texts stays
   as it is. No link is followed, and nothing is waited for. */
void dondolo_read_ends(const char *path, char *first, char *last, size_t room)
{
   struct stat found;
   int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);

   if (descriptor < 0)
      return;
   if (fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && pread(descriptor, first, room, 0) > 0) {
      off_t at = found.st_size > (off_t)room ? found.st_size - (off_t)room : 0;

      if (pread(descriptor, last, room, at) < 0)
         last[0] = ' ';
   }
   close(descriptor);
}

/* Open a regular file to read it, links followed; its descriptor, negative if that fails */
int dondolo_open_to_read(const char *path)
{
   struct stat found;
   int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);

   if (descriptor >= 0 && !(fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode))) {
      close(descriptor);
      descriptor = -1;
   }
   return descriptor;
}

/* Bytes in an open file, and in what is at a path, links followed; negative if that is not known or nothing is there */
int64_t dondolo_size_of(int descriptor)
{
   struct stat found;

   return fstat(descriptor, &found) == 0 ? (int64_t)found.st_size : -1;
}

int64_t dondolo_size(const char *path)
{
   struct stat found;

   return stat(path, &found) == 0 ? (int64_t)found.st_size : -1;
}

/* Read bytes at a place of an open file; 1: all of them are there */
int dondolo_read(int descriptor, int64_t at, char *bytes, size_t count)
{
   while (count > 0) {
      ssize_t length = pread(descriptor, bytes, count, (off_t)at);

      if (length <= 0)
         return 0;
      bytes += length;
      at += length;
      count -= (size_t)length;
   }
   return 1;
}

void dondolo_close_reader(int descriptor)
{
   close(descriptor);
}

/* The names in a folder that begin with a text, each with a line feed at its end; those without room are left out, and so are
   names with a line feed */
void dondolo_list(const char *folder, const char *begin, char *names, size_t room)
{
   DIR *list = opendir(folder);
   struct dirent *entry;
   size_t used = 0;

   while (list != NULL && (entry = readdir(list)) != NULL) {
      size_t length = strlen(entry->d_name);

      if (strncmp(entry->d_name, begin, strlen(begin)) != 0 || strchr(entry->d_name, '\n') != NULL || used + length + 2 > room)
         continue;
      memcpy(names + used, entry->d_name, length);
      names[used + length] = '\n';
      used += length + 1;
   }
   names[used] = '\0';
   if (list != NULL)
      closedir(list);
}

/* Open a regular file to write behind what is there, no link followed; it is made if it is not there. NULL if that fails. */
FILE *dondolo_append(const char *path)
{
   struct stat found;
   int descriptor = open(path, O_WRONLY | O_APPEND | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0666);

   if (descriptor < 0)
      return NULL;
   if (fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode))
      return fdopen(descriptor, "a");
   close(descriptor);
   return NULL;
}

/* Cut a regular file to a length, no link followed; 1: it has this length now */
int dondolo_cut(const char *path, int64_t bytes)
{
   struct stat found;
   int descriptor = open(path, O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), done;

   if (descriptor < 0)
      return 0;
   done = fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && ftruncate(descriptor, (off_t)bytes) == 0;
   close(descriptor);
   return done;
}

/* Open a file, which is made with the sticky bit if it is not there. `is_made`: it is known to have been made here. */
static int open_marked(const char *path, int access, int *is_made)
{
   const int how = access | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC;

   *is_made = 0;
#ifdef __APPLE__
   /* There the bit is lost when a file is made. */
   struct stat made;
   int descriptor = open(path, how | O_EXCL, 0666);

   if (descriptor >= 0 || errno != EEXIST) {
      *is_made = descriptor >= 0;
      if (*is_made && fstat(descriptor, &made) == 0)
         fchmod(descriptor, (made.st_mode & 07777) | S_ISVTX);
      return descriptor;
   }
#endif
   return open(path, how, 0666 | S_ISVTX);
}

/* What keeps a path from being that of a file, but for what is on the disk: -1: the name of a device of Windows; its number of
   letters if they are too many for Windows; 0: nothing, as of any path of POSIX */
int dondolo_path_problem(const char *path)
{
   (void)path;
   return 0;
}

/* Make an empty file and remove it; 1: that can be done. It has the sticky bit of dondolo_take_lock: so one that a killed
   trial has left is removed too, and a file of somebody else's is not. */
int dondolo_try_file(const char *path)
{
   struct stat found;
   int is_made, descriptor = open_marked(path, O_WRONLY, &is_made);

   if (descriptor < 0)
      return 0;
   if (fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) && found.st_size == 0 &&
       (is_made || (found.st_mode & S_ISVTX) != 0))
      unlink(path);
   close(descriptor);
   return 1;
}

/* 1: all that was written to a file, or to the list of files of a folder, is on the disk */
static int synchronize(int descriptor)
{
#ifdef F_FULLFSYNC
   /* fsync of macOS leaves it in the memory of the disk. */
   if (fcntl(descriptor, F_FULLFSYNC) == 0)
      return 1;
#endif
   /* Some file systems have nothing to synchronize, and say so. */
   return fsync(descriptor) == 0 || errno == EINVAL || errno == ENOTSUP;
}

int dondolo_synchronize(FILE *file)
{
   return fflush(file) == 0 && synchronize(fileno(file));
}

int dondolo_synchronize_folder(const char *path)
{
   int descriptor = open(path, O_RDONLY | O_DIRECTORY | O_CLOEXEC);
   int done = descriptor < 0 || synchronize(descriptor);

   if (descriptor >= 0)
      close(descriptor);
   return done;
}

static void pause_briefly(void)
{
   const struct timespec pause = {0, 20000000L};

   nanosleep(&pause, NULL);
}

static void read_text(int descriptor, char *text, size_t room)
{
   ssize_t length = pread(descriptor, text, room - 1, 0);

   text[length > 0 ? length : 0] = '\0';
}

/* Take the lock file of a path, and read what stands in it. 0: taken; 1: another process has it; 2: it cannot be written;
   3: an empty file of somebody else. The kernel gives the lock back when the last process that has it ends, however that
   ends. A lock file is made with the sticky bit, which no other program gives a file: so one that is still empty, since
   its run was killed at once, is told from an empty file of the user's. */
int dondolo_take_lock(const char *path, int *descriptor, char *text, size_t room)
{
   struct stat ours, there;
   int tries = 0, is_made;

   while (tries < 5) {
      *descriptor = open_marked(path, O_RDWR, &is_made);
      if (*descriptor < 0)
         return 2;
      if (flock(*descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
         /* Who only looks has it for a moment. */
         read_text(*descriptor, text, room);
         close(*descriptor);
         pause_briefly();
         tries++;
         continue;
      }
      /* Who had it before has removed the file, unless it is still the one of this name. */
      if (fstat(*descriptor, &ours) == 0 && S_ISREG(ours.st_mode) && lstat(path, &there) == 0 &&
          ours.st_ino == there.st_ino && ours.st_dev == there.st_dev) {
         read_text(*descriptor, text, room);
         if (text[0] != '\0' || is_made || (ours.st_mode & S_ISVTX) != 0)
            return 0;
         close(*descriptor);
         return 3;
      }
      close(*descriptor);
      if (!S_ISREG(ours.st_mode))
         return 2;
   }
   return 1;
}

/* Say in the lock file who has it; 1: it is there whole */
int dondolo_mark_lock(int descriptor, const char *text)
{
   size_t length = strlen(text);

   return pwrite(descriptor, text, length, 0) == (ssize_t)length && ftruncate(descriptor, (off_t)length) == 0;
}

/* Give the lock back; a process that was forked meanwhile does not keep it. */
void dondolo_give_back_lock(int descriptor)
{
   flock(descriptor, LOCK_UN);
   close(descriptor);
}

/* Make a part of a file, which is locked while it is written; number of the error, 0: it is there. Who has found it before it
   was locked has removed it: it is made under another name then (EBUSY). */
int dondolo_make_part(const char *path, int *descriptor)
{
   struct stat there;

   *descriptor = open(path, O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
   if (*descriptor < 0)
      return errno;
   /* A file system without locks refuses none. */
   flock(*descriptor, LOCK_EX);
   if (lstat(path, &there) == 0)
      return 0;
   close(*descriptor);
   return EBUSY;
}

/* Bring a part to the disk and let it take the place of its file; number of the error, 0: done */
int dondolo_publish_part(const char *part, const char *path)
{
   int descriptor = open(part, O_RDONLY | O_NOFOLLOW | O_CLOEXEC), error = 0;

   if (descriptor < 0)
      return errno;
   if (!synchronize(descriptor) || rename(part, path) != 0)
      error = errno;
   close(descriptor);
   return error;
}

/* Remove the parts FILE.RUN.new of a file that nobody writes any more */
void dondolo_remove_dead_parts(const char *folder, const char *file)
{
   DIR *list = opendir(folder);
   struct dirent *entry;

   while (list != NULL && (entry = readdir(list)) != NULL) {
      const char *name = entry->d_name;

      if (dondolo_is_part(name, file)) {
         int descriptor = openat(dirfd(list), name, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);

         if (descriptor < 0)
            continue;
         if (flock(descriptor, LOCK_EX | LOCK_NB) == 0)
            unlinkat(dirfd(list), name, 0);
         close(descriptor);
      }
   }
   if (list != NULL)
      closedir(list);
}

/* What the system says of an error */
void dondolo_describe_error(int number, char *text, size_t room)
{
   snprintf(text, room, "%s", strerror(number));
}

/* Look at a lock file. 0: nobody has the lock; 1: a process has it; 2: there is no such file. */
int dondolo_look_at_lock(const char *path, char *text, size_t room)
{
   int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC), is_held;

   if (descriptor < 0)
      return 2;
   read_text(descriptor, text, room);
   is_held = flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
   close(descriptor);
   return is_held;
}

/* Who this process is: its number, its machine, the time (UTC), and a name for the run that no other has */
void dondolo_introduce(int *pid, char *host, size_t host_room, char *since, size_t since_room, char *run, size_t run_room)
{
   struct timespec now;
   struct tm parts;
   uint64_t random = 0;
   FILE *source = fopen("/dev/urandom", "r");
   char stamp[32];

   *pid = (int)getpid();
   if (gethostname(host, host_room) != 0)
      host[0] = '\0';
   host[host_room - 1] = '\0';
   clock_gettime(CLOCK_REALTIME, &now);
   gmtime_r(&now.tv_sec, &parts);
   strftime(since, since_room, "%Y-%m-%dT%H:%M:%SZ", &parts);
   strftime(stamp, sizeof stamp, "%Y%m%dT%H%M%SZ", &parts);
   if (source == NULL || fread(&random, sizeof random, 1, source) != 1) {
      /* FNV-1a of machine, process and nanoseconds */
      random = 14695981039346656037u ^ (uint64_t)*pid ^ ((uint64_t)now.tv_nsec << 32);
      for (const char *letter = host; *letter != '\0'; letter++)
         random = (random ^ (unsigned char)*letter) * 1099511628211u;
   }
   if (source != NULL)
      fclose(source);
   snprintf(run, run_room, "%s-%016llx", stamp, (unsigned long long)random);
}

/* Seconds since a time as dondolo_introduce gives it; negative if it is none */
double dondolo_seconds_since(const char *since)
{
   struct tm parts;

   memset(&parts, 0, sizeof parts);
   if (strptime(since, "%Y-%m-%dT%H:%M:%SZ", &parts) == NULL)
      return -1.0;
   return difftime(time(NULL), timegm(&parts));
}
#endif
