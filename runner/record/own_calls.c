#include "own_calls.h"

#include <stddef.h>
#include <string.h>

static const struct {
    const char *name;
    __GLXextFuncPtr function;
} own_calls[] = {
#define RECORD_OWN(name)                                                                           \
    {                                                                                              \
#name, (__GLXextFuncPtr)name                                                               \
    }
    RECORD_OWN(glBegin),
    RECORD_OWN(glCallList),
    RECORD_OWN(glCallLists),
    RECORD_OWN(glClear),
    RECORD_OWN(glCompressedTexImage2D),
    RECORD_OWN(glCompressedTexSubImage2D),
    RECORD_OWN(glCopyTexImage2D),
    RECORD_OWN(glCopyTexSubImage2D),
    RECORD_OWN(glDrawArrays),
    RECORD_OWN(glDrawElements),
    RECORD_OWN(glDrawElementsBaseVertex),
    RECORD_OWN(glDrawRangeElements),
    RECORD_OWN(glDrawRangeElementsBaseVertex),
    RECORD_OWN(glEnd),
    RECORD_OWN(glEndList),
    RECORD_OWN(glMultiDrawArrays),
    RECORD_OWN(glMultiDrawElements),
    RECORD_OWN(glMultiDrawElementsBaseVertex),
    RECORD_OWN(glNewList),
    RECORD_OWN(glTexImage2D),
    RECORD_OWN(glTexSubImage2D),
    RECORD_OWN(glXSwapBuffers),
#define RECORD_OWN_UNSEEN(name, parameters, arguments) RECORD_OWN(name),
    RECORD_UNSEEN_CALLS(RECORD_OWN_UNSEEN)
#undef RECORD_OWN_UNSEEN
#undef RECORD_OWN
    /* Older names of the same functions. */
    { "glDrawArraysEXT", (__GLXextFuncPtr)glDrawArrays },
    { "glDrawArraysInstancedARB", (__GLXextFuncPtr)glDrawArraysInstanced },
    { "glDrawArraysInstancedEXT", (__GLXextFuncPtr)glDrawArraysInstanced },
    { "glDrawElementsInstancedARB", (__GLXextFuncPtr)glDrawElementsInstanced },
    { "glDrawElementsInstancedEXT", (__GLXextFuncPtr)glDrawElementsInstanced },
    { "glDrawRangeElementsEXT", (__GLXextFuncPtr)glDrawRangeElements },
    { "glMultiDrawArraysEXT", (__GLXextFuncPtr)glMultiDrawArrays },
    { "glMultiDrawElementsEXT", (__GLXextFuncPtr)glMultiDrawElements },
    { "glBlitFramebufferEXT", (__GLXextFuncPtr)glBlitFramebuffer },
};

__GLXextFuncPtr own_call(const char *name)
{
    for (size_t i = 0; i < sizeof own_calls / sizeof own_calls[0]; i++)
        if (strcmp(name, own_calls[i].name) == 0)
            return own_calls[i].function;
    return NULL;
}
