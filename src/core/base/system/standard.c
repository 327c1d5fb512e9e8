/* What every C library does alike: buffered files, and names. */
#include "standard.h"
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/* Write bytes, give them to the system, close a file; 1: done */
int dondolo_write(const char *bytes, size_t count, FILE *file)
{
   return fwrite(bytes, 1, count, file) == count;
}

int dondolo_flush(FILE *file)
{
   return fflush(file) == 0;
}

int dondolo_close(FILE *file)
{
   return fclose(file) == 0;
}

/* Number of the last error of the C library, and to forget it */
int dondolo_errno(void)
{
   return errno;
}

void dondolo_forget_error(void)
{
   errno = 0;
}

/* 1: a name is that of a part FILE.RUN.new of a file */
int dondolo_is_part(const char *name, const char *file)
{
   const char *form = ".00000000T000000Z-xxxxxxxxxxxxxxxx.new";
   size_t begin = strlen(file);

   if (strncmp(name, file, begin) != 0 || strlen(name + begin) != strlen(form))
      return 0;
   for (name += begin; *form != '\0'; form++, name++)
      if (*form == '0'   ? strchr("0123456789", *name) == NULL
          : *form == 'x' ? strchr("0123456789abcdef", *name) == NULL
                         : *name != *form)
         return 0;
   return 1;
}

/* PYTHONPATH without the current folder, which an empty entry means too, as in the common PYTHONPATH=$PYTHONPATH:more. To be freed;
   NULL: there is none. */
char *dondolo_modules_elsewhere(char divider)
{
   const char *given = getenv("PYTHONPATH");
   char *kept, *end;

   if (given == NULL || (kept = malloc(strlen(given) + 1)) == NULL)
      return NULL;
   end = kept;
   for (const char *entry = given; entry != NULL;) {
      const char *next = strchr(entry, divider);
      size_t length = next == NULL ? strlen(entry) : (size_t)(next - entry);

      if (strspn(entry, "./\\") < length || entry[0] == '/' || entry[0] == '\\' || strncmp(entry, "..", 2) == 0) {
         if (end > kept)
            *end++ = divider;
         memcpy(end, entry, length);
         end += length;
      }
      entry = next == NULL ? NULL : next + 1;
   }
   *end = '\0';
   return kept;
}

/* Let the process keep some memory that it gives back, for what is made again and again: to get it anew from the system, page by
   page, takes longer than to fill it. GNU's library comes to these numbers by itself once it has freed a block of 32 MB. */
void dondolo_keep_freed(void)
{
#ifdef __GLIBC__
   static volatile int is_done;

   if (is_done)
      return;
   is_done = 1;
   mallopt(M_MMAP_THRESHOLD, 32 << 20);
   mallopt(M_TRIM_THRESHOLD, 64 << 20);
#endif
}
