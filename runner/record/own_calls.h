/* The entry points of recorder.c by name, for programs that look them up. */
#ifndef FM_RECORD_OWN_CALLS_H
#define FM_RECORD_OWN_CALLS_H

#include "gl_calls.h"

/* NULL: not one of ours. */
__GLXextFuncPtr own_call(const char *name);

#endif
