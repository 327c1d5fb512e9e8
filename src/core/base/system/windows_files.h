/* What the C files of Windows share (windows_files.c) */
#ifndef DONDOLO_WINDOWS_FILES_H
#define DONDOLO_WINDOWS_FILES_H
#define WIN32_LEAN_AND_MEAN
#define _WIN32_WINNT 0x0A00
#include "standard.h"
#include <windows.h>
#include <stdint.h>

/* What files of no length are made with, in the place of the sticky bit */
enum { mark_of_ours = FILE_ATTRIBUTE_HIDDEN };

/* From UTF-8 and back. What dondolo_wide gives is to be freed; NULL: it is no UTF-8. */
wchar_t *dondolo_wide(const char *text);
void dondolo_narrow(const wchar_t *wide, char *text, size_t room);

/* Open a regular file, or make it, no link followed; GetLastError() is that of CreateFileW */
HANDLE dondolo_open(const char *path, DWORD access, DWORD how, DWORD flags);

/* Volume and number of a file that exists, by its path or opened, which names do not tell: they differ in upper and lower case,
   drives and links. 1: found */
int dondolo_identify(const char *path, BY_HANDLE_FILE_INFORMATION *found);
int dondolo_is_same(const BY_HANDLE_FILE_INFORMATION *one, const BY_HANDLE_FILE_INFORMATION *other);

/* 1: a file has mark_of_ours */
int dondolo_is_marked(HANDLE file, BY_HANDLE_FILE_INFORMATION *found);

/* Read from a place in a file; number of bytes */
size_t dondolo_read_at(HANDLE file, uint64_t at, char *text, size_t room);

/* Call an action with each name in a folder that begins with a text */
void dondolo_for_each(const char *folder, const char *begin, void (*action)(void *, const char *), void *data);

/* As the functions of these names in files.c */
size_t dondolo_last_separator(const char *path);
int dondolo_is_absolute(const char *path);
int dondolo_thing(const char *path, int follows);
int dondolo_rename(const char *from, const char *to);
int dondolo_remove_file(const char *path);

#endif
