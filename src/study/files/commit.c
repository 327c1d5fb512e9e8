/* The commit that was built. meson puts it in the place of the word below at every build (src/meson.build); the word stays in
   builds outside a repository and in those of fpm, which compiles this file as it is. */
#include <stddef.h>

static const char commit[] = "unknown";

/* Write the commit into a text of `room` characters, filled up with blanks */
void dondolo_write_commit(char *text, size_t room)
{
   size_t i;

   for (i = 0; i < room; i++)
      text[i] = i < sizeof commit - 1 ? commit[i] : ' ';
}
