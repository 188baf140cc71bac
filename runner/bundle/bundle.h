/* A bundle: one folder with the program, methods, GLSL, scenes, figures, references and the shared
 * libraries that it needs. It runs on a machine without root and without packages, whose glibc is
 * at least as new. It measures; reports are drawn where fragmark-report is. Drivers are the
 * machine's.
 *
 *   bin/fragmark                      as it is, byte for byte
 *   lib/fragmark/lib/                 libraries but glibc's; the program looks there first
 *   lib/fragmark/methods/             plugins and GLSL
 *   share/fragmark/{scenes,figures,reference}/
 *   bundle.json  README               what it holds, with hashes; how it is used
 *
 * The room bundle holds this alone. */
#ifndef FM_BUNDLE_H
#define FM_BUNDLE_H

#include <stdint.h>

#include "base/error.h"
#include "base/text.h"

typedef struct fm_bundle_desc {
    const char *directory;              /* is made; an empty folder may be there */
    const fm_text_list *plugin_folders; /* searched first; NULL: none */
    const fm_text_list *methods;        /* NULL or empty: all. Floors of feeds come in any case */
} fm_bundle_desc;

typedef struct fm_bundle_result {
    uint32_t methods, scenes, figures, references, libraries;
    uint64_t bytes;
} fm_bundle_result;

/* Makes it beside the directory, tries it, and renames it: there is a whole bundle or none.
 * FM_INVALID: the directory is not empty, no such method, with the nearest, or a scene's mesh lies
 * outside its folder. FM_IO: what could
 * not be read or written, too little room, or the bundle does not start. FM_UNSUPPORTED: no ldd. */
fm_status bundle_make(fm_bundle_result *result, const fm_bundle_desc *desc, fm_error *err);

#endif
