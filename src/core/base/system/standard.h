/* What the C files of each system use of standard.c */
#ifndef DONDOLO_STANDARD_H
#define DONDOLO_STANDARD_H

int dondolo_is_part(const char *name, const char *file);
char *dondolo_modules_elsewhere(char divider);

#endif
