/* libOSMesa, opened when the device is: a program that links it does not start where it is missing,
 * and every start loads LLVM. */
#ifndef FM_OSMESA_LIBRARY_H
#define FM_OSMESA_LIBRARY_H

#include <GL/osmesa.h>

#include "base/error.h"

typedef struct osmesa_library {
    void *handle; /* NULL: not open */
    __typeof__(OSMesaCreateContextAttribs) *create_context;
    __typeof__(OSMesaDestroyContext) *destroy_context;
    __typeof__(OSMesaGetCurrentContext) *current_context;
    __typeof__(OSMesaGetProcAddress) *function;
    __typeof__(OSMesaMakeCurrent) *make_current;
} osmesa_library;

/* FM_IO: it is not on this machine, with the loader's reason. The library stays in the
 * process: LLVM cannot be unloaded. */
fm_status osmesa_library_open(osmesa_library *library, fm_error *err);

#endif
