/* The shared libraries that a program needs, as the loader of this machine finds them. */
#ifndef FM_BUNDLE_LIBRARIES_H
#define FM_BUNDLE_LIBRARIES_H

#include "base/text.h"

/* Adds the paths of all libraries that these programs and plugins need, directly or not, but
 * glibc's own: those must fit the machine's loader and kernel. Asks ldd, whose answer is kept in
 * the file log. FM_UNSUPPORTED: no ldd; FM_IO: a library is not found, with its name. */
fm_status libraries_find(fm_text_list *paths, const fm_text_list *programs, const char *log,
                         fm_error *err);

#endif
