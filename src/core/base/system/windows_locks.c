/* Locks, parts of files and names of runs on Windows; see files.c for what each function promises. */
#ifdef _WIN32
#define _CRT_RAND_S
#include "windows_files.h"
#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

static void read_text(HANDLE file, char *text, size_t room)
{
   text[dondolo_read_at(file, 0, text, room - 1)] = '\0';
}

/* One byte far behind the text is locked: others read what stands there. */
static int lock(HANDLE file, DWORD flags)
{
   OVERLAPPED behind = {.OffsetHigh = 0x40000000};

   return LockFileEx(file, flags, 0, 1, 0, &behind);
}

int dondolo_take_lock(const char *path, int *descriptor, char *text, size_t room)
{
   BY_HANDLE_FILE_INFORMATION ours, there;

   for (int tries = 0; tries < 5; tries++) {
      HANDLE file = dondolo_open(path, GENERIC_READ | GENERIC_WRITE | DELETE, OPEN_ALWAYS, mark_of_ours);
      int is_made = GetLastError() != ERROR_ALREADY_EXISTS;

      if (file == INVALID_HANDLE_VALUE) {
         /* A file that was removed has its name until it is closed. */
         if (GetLastError() != ERROR_ACCESS_DENIED || tries == 4)
            return 2;
         Sleep(20);
         continue;
      }
      if (!lock(file, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY)) {
         read_text(file, text, room);
         CloseHandle(file);
         Sleep(20);
         continue;
      }
      if (GetFileInformationByHandle(file, &ours) && dondolo_identify(path, &there) && dondolo_is_same(&ours, &there)) {
         read_text(file, text, room);
         if (text[0] != '\0' || is_made || dondolo_is_marked(file, &ours)) {
            *descriptor = _open_osfhandle((intptr_t)file, _O_RDWR | _O_BINARY | _O_NOINHERIT);
            return 0;
         }
         CloseHandle(file);
         return 3;
      }
      CloseHandle(file);
   }
   return 1;
}

int dondolo_mark_lock(int descriptor, const char *text)
{
   HANDLE file = (HANDLE)_get_osfhandle(descriptor);
   OVERLAPPED start = {0};
   DWORD length = (DWORD)strlen(text), written = 0;

   return WriteFile(file, text, length, &written, &start) && written == length && _chsize_s(descriptor, length) == 0;
}

void dondolo_give_back_lock(int descriptor)
{
   _close(descriptor);
}

int dondolo_look_at_lock(const char *path, char *text, size_t room)
{
   HANDLE file = dondolo_open(path, GENERIC_READ, OPEN_EXISTING, 0);
   int is_held;

   if (file == INVALID_HANDLE_VALUE)
      return 2;
   read_text(file, text, room);
   is_held = !lock(file, LOCKFILE_FAIL_IMMEDIATELY);
   CloseHandle(file);
   return is_held;
}

int dondolo_make_part(const char *path, int *descriptor)
{
   BY_HANDLE_FILE_INFORMATION ours, there;
   /* Without DELETE, or other programs, Python among them, could not open it */
   HANDLE file = dondolo_open(path, GENERIC_READ | GENERIC_WRITE, CREATE_NEW, 0);

   *descriptor = -1;
   if (file == INVALID_HANDLE_VALUE)
      return (int)GetLastError();
   lock(file, LOCKFILE_EXCLUSIVE_LOCK);
   if (!GetFileInformationByHandle(file, &ours) || !dondolo_identify(path, &there) || !dondolo_is_same(&ours, &there)) {
      CloseHandle(file);
      return ERROR_BUSY;
   }
   *descriptor = _open_osfhandle((intptr_t)file, _O_RDWR | _O_BINARY | _O_NOINHERIT);
   return 0;
}

int dondolo_publish_part(const char *part, const char *path)
{
   HANDLE file = dondolo_open(part, GENERIC_WRITE, OPEN_EXISTING, 0);
   int is_written;
   DWORD error;

   if (file == INVALID_HANDLE_VALUE)
      return (int)GetLastError();
   is_written = FlushFileBuffers(file);
   error = GetLastError();
   CloseHandle(file);
   if (!is_written)
      return (int)error;
   return dondolo_rename(part, path) ? 0 : (int)GetLastError();
}

struct parts {
   const char *folder, *file;
};

static void remove_dead(void *data, const char *name)
{
   struct parts *parts = data;
   size_t length = strlen(parts->folder) + strlen(name) + 2;
   char *path = dondolo_is_part(name, parts->file) ? malloc(length) : NULL;
   HANDLE file;

   if (path == NULL)
      return;
   snprintf(path, length, "%s/%s", parts->folder, name);
   file = dondolo_open(path, GENERIC_READ, OPEN_EXISTING, 0);
   if (file != INVALID_HANDLE_VALUE) {
      if (lock(file, LOCKFILE_EXCLUSIVE_LOCK | LOCKFILE_FAIL_IMMEDIATELY))
         dondolo_remove_file(path);
      CloseHandle(file);
   }
   free(path);
}

void dondolo_remove_dead_parts(const char *folder, const char *file)
{
   struct parts parts = {folder, file};

   dondolo_for_each(folder, file, remove_dead, &parts);
}

void dondolo_describe_error(int number, char *text, size_t room)
{
   wchar_t *said = NULL;

   snprintf(text, room, "error %d of Windows", number);
   if (number == ERROR_SHARING_VIOLATION || number == ERROR_ACCESS_DENIED) {
      snprintf(text, room, "access denied: is it open in another program?");
   } else if (FormatMessageW(FORMAT_MESSAGE_ALLOCATE_BUFFER | FORMAT_MESSAGE_FROM_SYSTEM | FORMAT_MESSAGE_IGNORE_INSERTS |
                                FORMAT_MESSAGE_MAX_WIDTH_MASK, NULL, (DWORD)number, 0, (LPWSTR)&said, 0, NULL) > 0) {
      dondolo_narrow(said, text, room);
      LocalFree(said);
   }
}

void dondolo_introduce(int *pid, char *host, size_t host_room, char *since, size_t since_room, char *run, size_t run_room)
{
   wchar_t name[256];
   DWORD length = sizeof name / sizeof *name;
   time_t now = time(NULL);
   struct tm parts;
   unsigned low = 0, high = 0;
   char stamp[32];

   *pid = (int)GetCurrentProcessId();
   host[0] = '\0';
   if (GetComputerNameExW(ComputerNameDnsHostname, name, &length))
      dondolo_narrow(name, host, host_room);
   gmtime_s(&parts, &now);
   strftime(since, since_room, "%Y-%m-%dT%H:%M:%SZ", &parts);
   strftime(stamp, sizeof stamp, "%Y%m%dT%H%M%SZ", &parts);
   rand_s(&low);
   rand_s(&high);
   snprintf(run, run_room, "%s-%08x%08x", stamp, high, low);
}

double dondolo_seconds_since(const char *since)
{
   struct tm parts;

   memset(&parts, 0, sizeof parts);
   if (sscanf(since, "%d-%d-%dT%d:%d:%dZ", &parts.tm_year, &parts.tm_mon, &parts.tm_mday, &parts.tm_hour, &parts.tm_min,
              &parts.tm_sec) != 6)
      return -1.0;
   parts.tm_year -= 1900;
   parts.tm_mon -= 1;
   return difftime(time(NULL), _mkgmtime(&parts));
}
#endif
