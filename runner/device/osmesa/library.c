#include "library.h"

#include <dlfcn.h>
#include <stddef.h>
#include <string.h>

#include "base/data.h"

static const struct {
    const char *name;
    size_t offset;
} functions[] = {
    { "OSMesaCreateContextAttribs", offsetof(osmesa_library, create_context) },
    { "OSMesaDestroyContext", offsetof(osmesa_library, destroy_context) },
    { "OSMesaGetCurrentContext", offsetof(osmesa_library, current_context) },
    { "OSMesaGetProcAddress", offsetof(osmesa_library, function) },
    { "OSMesaMakeCurrent", offsetof(osmesa_library, make_current) },
};

fm_status osmesa_library_open(osmesa_library *library, fm_error *err)
{
    *library = (osmesa_library){ 0 };
    void *handle = dlopen("libOSMesa.so.8", RTLD_NOW | RTLD_LOCAL | RTLD_NODELETE);
    if (handle == NULL)
        return fm_fail(err, FM_IO, "osmesa: %s%s", dlerror(),
                       data_is_bundle() ? " (a bundle has none of its own)" : "");
    for (size_t i = 0; i < sizeof functions / sizeof functions[0]; i++) {
        void *function = dlsym(handle, functions[i].name);
        if (function == NULL) {
            dlclose(handle);
            return fm_fail(err, FM_IO, "osmesa: this libOSMesa has no %s", functions[i].name);
        }
        memcpy((char *)library + functions[i].offset, &function, sizeof function);
    }
    library->handle = handle;
    return FM_OK;
}
