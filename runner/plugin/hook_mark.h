/* Which code of a plugin is running, written where it outlives the process: whoever finds a worker
 * dead, or has to end it, reads which hook it was in. A small file that is mapped into memory, so
 * that entering a hook costs a few nanoseconds, and no way to die leaves it unwritten. */
#ifndef FM_HOOK_MARK_H
#define FM_HOOK_MARK_H

#include <stdatomic.h>
#include <stdbool.h>
#include <stddef.h>

typedef enum fm_hook {
    FM_HOOK_LOAD,    /* no hook: the plugin is opened, and its constructors run */
    FM_HOOK_AFTER,   /* fragmark/method.h */
    FM_HOOK_PREDICT, /* fragmark/technique.h, as what follows */
    FM_HOOK_PLACE,
    FM_HOOK_SIGN,
    FM_HOOK_SKIP,
    FM_HOOK_TILE_END,
    FM_HOOK_COUNT
} fm_hook;

enum { HOOK_MARK_NAME_BYTES = 64, HOOK_MARK_TOLD_BYTES = 256 };

typedef struct fm_hook_mark {
    atomic_uint running[FM_HOOK_COUNT]; /* how many threads are in it */
    char plugin[HOOK_MARK_NAME_BYTES];  /* "kb.so" */
    char pass[HOOK_MARK_NAME_BYTES];    /* that FM_HOOK_AFTER was called for */
} fm_hook_mark;

/* Makes the file at path for a plugin. NULL: it cannot be had; all goes on without. */
fm_hook_mark *hook_mark_open(const char *path, const char *plugin);
/* Accepts NULL. The file stays. */
void hook_mark_close(fm_hook_mark *mark);

/* Around each call; mark may be NULL. */
static inline void hook_enter(fm_hook_mark *mark, fm_hook hook)
{
    if (mark != NULL)
        atomic_fetch_add_explicit(&mark->running[hook], 1, memory_order_relaxed);
}

static inline void hook_leave(fm_hook_mark *mark, fm_hook hook)
{
    if (mark != NULL)
        atomic_fetch_sub_explicit(&mark->running[hook], 1, memory_order_relaxed);
}

/* Of the pass that FM_HOOK_AFTER is about to be called for. */
void hook_mark_pass(fm_hook_mark *mark, const char *pass);

/* "in hook 'after' of kb.so, pass 'ask'"; false: there is no file, or no hook was running. What a
 * plugin may have scribbled there has no other effect than other words. */
bool hook_mark_read(char told[HOOK_MARK_TOLD_BYTES], const char *path);

#endif
