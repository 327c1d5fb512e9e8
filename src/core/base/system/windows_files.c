/* What files.c does on POSIX, for Windows; see there what each function promises. Names of files are UTF-8. */
#ifdef _WIN32
#include "windows_files.h"
#include <fcntl.h>
#include <io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Files of dondolo are opened so that others may read, replace and remove them meanwhile, as on POSIX. */
static const DWORD shared = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;

/* Virus scanners and indexers have a new file for a moment. */
enum { tries_for_others = 25, pause_for_others = 40 };

wchar_t *dondolo_wide(const char *text)
{
   int count = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text, -1, NULL, 0);
   wchar_t *wide = count > 0 ? malloc((size_t)count * sizeof *wide) : NULL;

   if (wide != NULL)
      MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, text, -1, wide, count);
   else
      SetLastError(ERROR_INVALID_NAME);
   return wide;
}

void dondolo_narrow(const wchar_t *wide, char *text, size_t room)
{
   if (WideCharToMultiByte(CP_UTF8, 0, wide, -1, text, (int)room, NULL, NULL) == 0)
      text[0] = '\0';
}

/* Open a file, keeping the number of the error. A colon but that of a drive would name a hidden stream of a file, and Fortran's
   library does not open paths longer than MAX_PATH: both are refused. */
static HANDLE open_file(const char *path, DWORD access, DWORD how, DWORD flags)
{
   const char *colon = strchr(path, ':');
   wchar_t *name = colon != NULL && (colon != path + 1 || strchr(colon + 1, ':') != NULL) ? NULL : dondolo_wide(path);
   HANDLE file = INVALID_HANDLE_VALUE;
   DWORD error = ERROR_INVALID_NAME;

   if (name != NULL && GetFullPathNameW(name, 0, NULL, NULL) > MAX_PATH) {
      error = ERROR_FILENAME_EXCED_RANGE;
   } else if (name != NULL) {
      file = CreateFileW(name, access, shared, NULL, how, flags, NULL);
      error = GetLastError();
   }
   free(name);
   SetLastError(error);
   return file;
}

/* A link leads elsewhere; other reparse points, of clouds and of compressed files, are the files themselves. */
static int is_link(HANDLE file)
{
   FILE_ATTRIBUTE_TAG_INFO found;

   return GetFileInformationByHandleEx(file, FileAttributeTagInfo, &found, sizeof found) &&
          (found.FileAttributes & FILE_ATTRIBUTE_REPARSE_POINT) != 0 && IsReparseTagNameSurrogate(found.ReparseTag);
}

HANDLE dondolo_open(const char *path, DWORD access, DWORD how, DWORD flags)
{
   int thing = how == CREATE_NEW ? 0 : dondolo_thing(path, 0);

   if (thing > 1) {
      SetLastError(ERROR_CANT_ACCESS_FILE);
      return INVALID_HANDLE_VALUE;
   }
   return open_file(path, access, how, flags);
}

/* Do something with the names of one or two files; 1: done */
static int with_names(BOOL (*action)(const wchar_t *, const wchar_t *), const char *first, const char *second)
{
   wchar_t *one = dondolo_wide(first), *other = second == NULL ? NULL : dondolo_wide(second);
   int done = one != NULL && (second == NULL || other != NULL) && action(one, other);
   DWORD error = GetLastError();

   free(one);
   free(other);
   SetLastError(error);
   return done;
}

static BOOL make_folder(const wchar_t *path, const wchar_t *none)
{
   (void)none;
   return CreateDirectoryW(path, NULL);
}

static BOOL remove_folder(const wchar_t *path, const wchar_t *none)
{
   (void)none;
   return RemoveDirectoryW(path);
}

static BOOL remove_file(const wchar_t *path, const wchar_t *none)
{
   (void)none;
   return DeleteFileW(path);
}

static BOOL replace(const wchar_t *from, const wchar_t *to)
{
   for (int tries = 1;; tries++) {
      DWORD error;

      if (MoveFileExW(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
         return TRUE;
      error = GetLastError();
      if ((error != ERROR_ACCESS_DENIED && error != ERROR_SHARING_VIOLATION) || tries == tries_for_others)
         return FALSE;
      Sleep(pause_for_others);
   }
}

int dondolo_make_folder(const char *path)
{
   return with_names(make_folder, path, NULL);
}

int dondolo_remove_folder(const char *path)
{
   return with_names(remove_folder, path, NULL);
}

int dondolo_rename(const char *from, const char *to)
{
   return with_names(replace, from, to);
}

int dondolo_remove_file(const char *path)
{
   return with_names(remove_file, path, NULL);
}

int dondolo_is_free(const char *path)
{
   for (int tries = 1;; tries++) {
      HANDLE file = open_file(path, DELETE, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS | FILE_FLAG_OPEN_REPARSE_POINT);

      if (file != INVALID_HANDLE_VALUE) {
         CloseHandle(file);
         return 1;
      }
      if (GetLastError() != ERROR_SHARING_VIOLATION)
         return 1;
      if (tries == tries_for_others)
         return 0;
      Sleep(pause_for_others);
   }
}

int dondolo_identify(const char *path, BY_HANDLE_FILE_INFORMATION *found)
{
   HANDLE file = open_file(path, 0, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS);
   int done = file != INVALID_HANDLE_VALUE && GetFileInformationByHandle(file, found);

   if (file != INVALID_HANDLE_VALUE)
      CloseHandle(file);
   return done;
}

int dondolo_is_same(const BY_HANDLE_FILE_INFORMATION *one, const BY_HANDLE_FILE_INFORMATION *other)
{
   return one->nFileIndexHigh == other->nFileIndexHigh && one->nFileIndexLow == other->nFileIndexLow &&
          one->dwVolumeSerialNumber == other->dwVolumeSerialNumber;
}

int dondolo_same_file(const char *first, const char *second)
{
   BY_HANDLE_FILE_INFORMATION one, other;

   return dondolo_identify(first, &one) && dondolo_identify(second, &other) && dondolo_is_same(&one, &other);
}

static int is_separator(char letter)
{
   return letter == '/' || letter == '\\';
}

size_t dondolo_last_separator(const char *path)
{
   size_t length = strlen(path);

   while (length > 0 && !is_separator(path[length - 1]))
      length--;
   return length;
}

int dondolo_is_absolute(const char *path)
{
   return is_separator(path[0]) || (path[0] != '\0' && path[1] == ':' && is_separator(path[2]));
}

int dondolo_thing(const char *path, int follows)
{
   HANDLE file = open_file(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING,
                           FILE_FLAG_BACKUP_SEMANTICS | (follows ? 0 : FILE_FLAG_OPEN_REPARSE_POINT));
   FILE_ATTRIBUTE_TAG_INFO found = {0};
   int thing;

   if (file == INVALID_HANDLE_VALUE)
      return 0;
   switch (GetFileType(file)) {
   case FILE_TYPE_DISK:
      GetFileInformationByHandleEx(file, FileAttributeTagInfo, &found, sizeof found);
      thing = is_link(file) ? 2 : (found.FileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0 ? 3 : 1;
      break;
   case FILE_TYPE_PIPE: thing = 4; break;
   default: thing = 6;
   }
   CloseHandle(file);
   return thing;
}

size_t dondolo_read_at(HANDLE file, uint64_t at, char *text, size_t room)
{
   OVERLAPPED place = {.Offset = (DWORD)at, .OffsetHigh = (DWORD)(at >> 32)};
   DWORD length = 0;

   return ReadFile(file, text, (DWORD)room, &length, &place) ? length : 0;
}

void dondolo_read_ends(const char *path, char *first, char *last, size_t room)
{
   HANDLE file = dondolo_open(path, GENERIC_READ, OPEN_EXISTING, 0);
   LARGE_INTEGER size;

   if (file == INVALID_HANDLE_VALUE)
      return;
   if (GetFileSizeEx(file, &size) && dondolo_read_at(file, 0, first, room) > 0)
      dondolo_read_at(file, size.QuadPart > (LONGLONG)room ? (uint64_t)size.QuadPart - room : 0, last, room);
   CloseHandle(file);
}

int dondolo_open_to_read(const char *path)
{
   HANDLE file = dondolo_thing(path, 1) == 1 ? open_file(path, GENERIC_READ, OPEN_EXISTING, 0) : INVALID_HANDLE_VALUE;

   return file == INVALID_HANDLE_VALUE ? -1 : _open_osfhandle((intptr_t)file, _O_RDONLY | _O_BINARY | _O_NOINHERIT);
}

int64_t dondolo_size_of(int descriptor)
{
   LARGE_INTEGER size;

   return GetFileSizeEx((HANDLE)_get_osfhandle(descriptor), &size) ? size.QuadPart : -1;
}

int64_t dondolo_size(const char *path)
{
   BY_HANDLE_FILE_INFORMATION found;

   return dondolo_identify(path, &found) ? (int64_t)(((uint64_t)found.nFileSizeHigh << 32) | found.nFileSizeLow) : -1;
}

int dondolo_read(int descriptor, int64_t at, char *bytes, size_t count)
{
   /* ReadFile takes 32 bits. */
   const size_t most = (size_t)1 << 30;

   while (count > 0) {
      size_t length = dondolo_read_at((HANDLE)_get_osfhandle(descriptor), (uint64_t)at, bytes, count < most ? count : most);

      if (length == 0)
         return 0;
      bytes += length;
      at += (int64_t)length;
      count -= length;
   }
   return 1;
}

void dondolo_close_reader(int descriptor)
{
   _close(descriptor);
}

void dondolo_for_each(const char *folder, const char *begin, void (*action)(void *, const char *), void *data)
{
   size_t length = strlen(folder) + strlen(begin) + 4, room = 4 * MAX_PATH;
   char *pattern = malloc(length), *name = malloc(room);
   wchar_t *wide = NULL;
   WIN32_FIND_DATAW entry;
   HANDLE list = INVALID_HANDLE_VALUE;

   if (pattern != NULL && name != NULL) {
      snprintf(pattern, length, "%s/%s*", folder, begin);
      wide = dondolo_wide(pattern);
   }
   if (wide != NULL)
      list = FindFirstFileW(wide, &entry);
   if (list != INVALID_HANDLE_VALUE) {
      do {
         dondolo_narrow(entry.cFileName, name, room);
         action(data, name);
      } while (FindNextFileW(list, &entry));
      FindClose(list);
   }
   free(pattern);
   free(name);
   free(wide);
}

struct names {
   const char *begin;
   char *text;
   size_t used, room;
};

static void add_name(void *data, const char *name)
{
   struct names *names = data;
   size_t length = strlen(name);

   if (strncmp(name, names->begin, strlen(names->begin)) != 0 || names->used + length + 2 > names->room)
      return;
   memcpy(names->text + names->used, name, length);
   names->text[names->used + length] = '\n';
   names->used += length + 1;
}

void dondolo_list(const char *folder, const char *begin, char *names, size_t room)
{
   struct names found = {begin, names, 0, room};

   dondolo_for_each(folder, begin, add_name, &found);
   names[found.used] = '\0';
}

/* A file of the C library for a handle, which writes lines as they are */
static FILE *buffered(HANDLE file, int how, const char *mode)
{
   int descriptor = file == INVALID_HANDLE_VALUE ? -1 : _open_osfhandle((intptr_t)file, how | _O_BINARY | _O_NOINHERIT);

   return descriptor < 0 ? NULL : _fdopen(descriptor, mode);
}

FILE *dondolo_create(const char *path)
{
   return buffered(dondolo_open(path, GENERIC_WRITE, CREATE_NEW, 0), 0, "wb");
}

FILE *dondolo_append(const char *path)
{
   return buffered(dondolo_open(path, GENERIC_WRITE, OPEN_ALWAYS, 0), _O_APPEND, "ab");
}

int dondolo_cut(const char *path, int64_t bytes)
{
   HANDLE file = dondolo_open(path, GENERIC_WRITE, OPEN_EXISTING, 0);
   LARGE_INTEGER length = {.QuadPart = bytes};
   int done;

   if (file == INVALID_HANDLE_VALUE)
      return 0;
   done = SetFilePointerEx(file, length, NULL, FILE_BEGIN) && SetEndOfFile(file);
   CloseHandle(file);
   return done;
}

int dondolo_is_marked(HANDLE file, BY_HANDLE_FILE_INFORMATION *found)
{
   return GetFileInformationByHandle(file, found) && (found->dwFileAttributes & mark_of_ours) != 0;
}

/* 1: a folder or the file of a path has the name of a device, whatever follows a point */
static int names_device(const char *path)
{
   static const char *const devices[] = {"CON", "PRN", "AUX", "NUL"};

   while (*path != '\0') {
      size_t length = strcspn(path, "/\\"), stem = strcspn(path, "/\\. :");

      for (size_t i = 0; stem == 3 && i < sizeof devices / sizeof *devices; i++)
         if (_strnicmp(path, devices[i], 3) == 0)
            return 1;
      if (stem == 4 && (_strnicmp(path, "COM", 3) == 0 || _strnicmp(path, "LPT", 3) == 0) && path[3] >= '1' && path[3] <= '9')
         return 1;
      path += length + (path[length] != '\0');
   }
   return 0;
}

int dondolo_path_problem(const char *path)
{
   wchar_t *wide = dondolo_wide(path);
   DWORD length = wide == NULL ? 0 : GetFullPathNameW(wide, 0, NULL, NULL);

   free(wide);
   if (names_device(path))
      return -1;
   /* With the NUL at its end */
   return length > MAX_PATH ? (int)length - 1 : 0;
}

int dondolo_try_file(const char *path)
{
   BY_HANDLE_FILE_INFORMATION found;
   HANDLE file = dondolo_open(path, GENERIC_WRITE, OPEN_ALWAYS, mark_of_ours);
   int is_made = file != INVALID_HANDLE_VALUE && GetLastError() != ERROR_ALREADY_EXISTS;

   if (file == INVALID_HANDLE_VALUE)
      return 0;
   if (is_made || (dondolo_is_marked(file, &found) && found.nFileSizeHigh == 0 && found.nFileSizeLow == 0))
      dondolo_remove_file(path);
   CloseHandle(file);
   return 1;
}

int dondolo_synchronize(FILE *file)
{
   return fflush(file) == 0 && _commit(_fileno(file)) == 0;
}

/* dondolo_rename writes through. */
int dondolo_synchronize_folder(const char *path)
{
   (void)path;
   return 1;
}
#endif
