#include "gl_calls.h"

#include <dlfcn.h>
#include <stddef.h>
#include <string.h>

static const struct {
    const char *name;
    size_t offset;
} entries[] = {
#define RECORD_ENTRY(name)                               { #name, offsetof(gl_calls, name) },
#define RECORD_UNSEEN_ENTRY(name, parameters, arguments) RECORD_ENTRY(name)
    RECORD_UNSEEN_CALLS(RECORD_UNSEEN_ENTRY) RECORD_GL_CALLS(RECORD_ENTRY)
#undef RECORD_UNSEEN_ENTRY
#undef RECORD_ENTRY
};

/* Both are needed by this library, so that they are loaded already. */
bool gl_calls_open(gl_calls *gl)
{
    void *opengl = dlopen("libOpenGL.so.0", RTLD_LAZY), *glx = dlopen("libGLX.so.0", RTLD_LAZY);
    for (size_t i = 0; i < sizeof entries / sizeof entries[0]; i++) {
        void *found = opengl != NULL ? dlsym(opengl, entries[i].name) : NULL;
        if (found == NULL && glx != NULL)
            found = dlsym(glx, entries[i].name);
        if (found == NULL)
            return false;
        memcpy((char *)gl + entries[i].offset, &found, sizeof found);
    }
    return true;
}
