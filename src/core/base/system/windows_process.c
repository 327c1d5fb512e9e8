/* What process.c and interrupt.c do on POSIX, for Windows; see there what each function promises. */
#ifdef _WIN32
#include "interrupt.h"
#include "windows_files.h"
#include <conio.h>
#include <io.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* No shell of Windows replaces * and ? by the names of files: the C library's start of the program does, if this says so. */
int _dowildcard = -1;

void dondolo_own_path(char *path, size_t room)
{
   enum { longest = 32768 };
   wchar_t *wide = malloc(longest * sizeof *wide);
   DWORD length = wide == NULL ? 0 : GetModuleFileNameW(NULL, wide, longest);

   path[0] = '\0';
   if (length > 0 && length < longest)
      dondolo_narrow(wide, path, room);
   free(wide);
   for (; *path != '\0'; path++)
      if (*path == '\\')
         *path = '/';
}

static UINT code_page_before;

static void restore_code_page(void)
{
   SetConsoleOutputCP(code_page_before);
}

/* The console shows texts in UTF-8, and in the code page from before when the program has ended; it knows escape sequences. */
void dondolo_set_up_process(void)
{
   HANDLE console = GetStdHandle(STD_ERROR_HANDLE);
   DWORD mode;

   if (GetConsoleMode(console, &mode))
      SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
   code_page_before = GetConsoleOutputCP();
   if (code_page_before != 0 && code_page_before != CP_UTF8 && SetConsoleOutputCP(CP_UTF8))
      atexit(restore_code_page);
}

int dondolo_is_terminal(int descriptor)
{
   DWORD mode;

   return GetConsoleMode((HANDLE)_get_osfhandle(descriptor), &mode) != 0;
}

/* 1: no other program is in the console, which was opened for this one and closes with it, as after a double click. A task of the
   system (in session 0) has such a console too, but nobody sees it. */
static int has_own_console(void)
{
   DWORD processes[2], session = 0;

   return dondolo_is_terminal(0) && dondolo_is_terminal(1) && GetConsoleProcessList(processes, 2) == 1 &&
      ProcessIdToSessionId(GetCurrentProcessId(), &session) && session != 0;
}

/* Show a text in a console that closes with the program, and wait for a key. */
void dondolo_hold_console(const char *text)
{
   if (has_own_console()) {
      fputs(text, stdout);
      fflush(stdout);
      _getch();
   }
}

static void wait_for_key(void)
{
   fputs("\nPress any key to close this window.\n", stdout);
   fflush(stdout);
   _getch();
}

/* A file was dropped on the program: its whole path is the only word, and the console closes with the program. Work in the folder of
   the file, and wait for a key at the end. */
void dondolo_receive_file(const char *path)
{
   size_t length = dondolo_last_separator(path);
   wchar_t *folder = NULL;
   char *plain = malloc(length + 1);

   if (plain != NULL && length > 0 && dondolo_is_absolute(path) && has_own_console()) {
      memcpy(plain, path, length);
      plain[length] = '\0';
      folder = dondolo_wide(plain);
      if (folder != NULL && SetCurrentDirectoryW(folder))
         atexit(wait_for_key);
   }
   free(plain);
   free(folder);
}

/* Put a word behind others as the start of the other program takes it apart, and return its end */
static wchar_t *quote(wchar_t *to, const wchar_t *word)
{
   size_t backslashes = 0;

   *to++ = L'"';
   for (;; word++) {
      if (*word == L'\\') {
         backslashes++;
      } else {
         /* Those before a quotation mark are doubled, and it has one more. */
         if (*word == L'"' || *word == L'\0')
            for (size_t i = 0; i < backslashes + (*word == L'"'); i++)
               *to++ = L'\\';
         backslashes = 0;
      }
      if (*word == L'\0')
         break;
      *to++ = *word;
   }
   *to++ = L'"';
   *to++ = L' ';
   *to = L'\0';
   return to;
}

/* The program of a name: with a folder, in it or one folder up, or else in one of PATH, never in the current folder; 1: found.
   pip puts programs into the folder Scripts of a Python, whose python.exe is in that of a virtual environment or one folder up. */
static int find_program(const char *name, wchar_t *path, DWORD room)
{
   size_t length = strlen(name), size = length + sizeof "../.exe";
   const char *slash = strrchr(name, '/'), *base = slash == NULL ? name : slash + 1;
   char *plain = malloc(size);
   const wchar_t *folders = _wgetenv(L"PATH");
   DWORD found = 0;

   /* It has no number there. */
   if (length >= 7 && strcmp(name + length - 7, "python3") == 0)
      length--;
   for (int up = 0; plain != NULL && found == 0 && up <= (slash != NULL); up++) {
      wchar_t *wide;

      snprintf(plain, size, "%.*s%s%.*s.exe", (int)(base - name), name, up ? "../" : "", (int)(length - (size_t)(base - name)), base);
      wide = dondolo_wide(plain);
      if (wide != NULL && slash != NULL)
         found = GetFileAttributesW(wide) != INVALID_FILE_ATTRIBUTES ? GetFullPathNameW(wide, room, path, NULL) : 0;
      else if (wide != NULL && folders != NULL)
         found = SearchPathW(folders, wide, NULL, room, path, NULL);
      free(wide);
   }
   free(plain);
   return found > 0 && found < room;
}

/* Ctrl-C is the other program's; this one waits for it. */
static BOOL WINAPI leave_to_other(DWORD event)
{
   return event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT;
}

/* Windows cannot become another program, and the shell would not wait for it: this one waits, and ends as it does. */
void dondolo_become(char *words, int count)
{
   enum { longest = 32768 };
   wchar_t *path = malloc(longest * sizeof *path), *line = NULL, *end;
   char *modules = dondolo_modules_elsewhere(';');
   STARTUPINFOW start = {.cb = sizeof start};
   PROCESS_INFORMATION other;
   const char *word = words;
   size_t room = 1;
   DWORD stat = 1;
   int is_found = path != NULL && find_program(words, path, longest);

   for (int i = 0; i < count; i++) {
      room += 2 * strlen(word) + 3;
      word += strlen(word) + 1;
   }
   if (is_found)
      line = malloc(room * sizeof *line);
   if (line != NULL) {
      end = line;
      for (int i = 0; i < count; i++) {
         wchar_t *wide = dondolo_wide(words);

         if (wide != NULL)
            end = quote(end, wide);
         free(wide);
         words += strlen(words) + 1;
      }
      if (modules != NULL)
         _putenv_s("PYTHONPATH", modules);
      SetConsoleCtrlHandler(leave_to_other, TRUE);
      if (CreateProcessW(path, line, NULL, NULL, TRUE, 0, NULL, NULL, &start, &other)) {
         WaitForSingleObject(other.hProcess, INFINITE);
         GetExitCodeProcess(other.hProcess, &stat);
         exit((int)stat);
      }
      SetConsoleCtrlHandler(leave_to_other, FALSE);
   }
   free(path);
   free(line);
   free(modules);
}

/* A program of Windows cannot begin again in its place. */
void dondolo_sleep_while_waiting(char *words, int count)
{
   (void)words;
   (void)count;
}

/* Windows promises no more memory than it has. */
int dondolo_is_limited(void)
{
   return 1;
}

static volatile LONG come, is_ending;

/* Runs in a thread of its own. What it does not take (FALSE) goes to the handlers from before, Python's among them. */
static BOOL WINAPI note(DWORD event)
{
   LONG count = InterlockedIncrement(&come);

   if (!is_ending || count > 1)
      return FALSE;
   /* A console that is closed ends the program when this returns. */
   if (event != CTRL_C_EVENT && event != CTRL_BREAK_EVENT)
      Sleep(INFINITE);
   return TRUE;
}

void dondolo_listen(void)
{
   static int is_listening;

   dondolo_watch_signals(come);
   if (!is_listening)
      is_listening = SetConsoleCtrlHandler(note, TRUE);
}

void dondolo_end_listening(void)
{
   dondolo_watch_signals(-1);
}

void dondolo_end_in_order(void)
{
   dondolo_watch_signals(come);
   is_ending = 1;
   SetConsoleCtrlHandler(note, TRUE);
}

/* With the status of a program that Ctrl-C has ended */
void dondolo_die_of_signal(void)
{
   if (is_ending && come != 0) {
      restore_code_page();
      ExitProcess((UINT)STATUS_CONTROL_C_EXIT);
   }
}

int dondolo_signals_come(void)
{
   return come;
}
#endif
