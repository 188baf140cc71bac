/* The one hook of a method: what it is shown, and whether what it answers can be done. */
#include <inttypes.h>
#include <string.h>

#include "frame_internal.h"

/* What a hook is shown. It is code of somebody else: nothing of it goes back. */
typedef struct hook_view {
    fm_workload workload;
    uint64_t totals[FM_MAX_TOTALS];
    const fm_method_desc *method;
    const fm_choice *choices;
    size_t choice_count;
} hook_view;

static const char *view_option(const fm_workload *workload, const char *name)
{
    const hook_view *view = workload->runner;
    return option_chosen(view->method, name, view->choices, view->choice_count);
}

static void fill_view(hook_view *view, const fm_instance *instance)
{
    memset(view, 0, sizeof *view);
    memcpy(&view->workload, &instance->workload, sizeof view->workload);
    memcpy(view->totals, instance->totals, sizeof view->totals);
    view->method = instance->method;
    view->choices = instance->choices;
    view->choice_count = instance->choice_count;
    view->workload.totals = view->totals;
    view->workload.option = view_option;
    view->workload.runner = view;
}

static bool is_in_loop(const fm_instance *instance, size_t index)
{
    const fm_loop *loops = instance->method->loops;
    for (int i = 0; i < FM_MAX_LOOPS && loops[i].first != NULL; i++)
        if (pass_index(instance->method, loops[i].first) <= (int)index &&
            (int)index <= pass_index(instance->method, loops[i].last))
            return true;
    return false;
}

fm_status frame_hook(fm_next *next, const frame_run *frame, size_t index)
{
    const fm_instance *instance = frame->instance;
    const char *id = instance->method->id, *pass = instance->method->passes[index].name;
    hook_view shown, before;
    fill_view(&shown, instance);
    memcpy(&before, &shown, sizeof before);
    hook_mark_pass(instance->desc.mark, pass);
    hook_enter(instance->desc.mark, FM_HOOK_AFTER);
    *next = instance->method->after(&shown.workload, pass);
    hook_leave(instance->desc.mark, FM_HOOK_AFTER);
    if (memcmp(&before, &shown, sizeof before) != 0)
        return fm_fail(frame->err, FM_INVALID,
                       "%s: pass '%s': after: wrote to the workload, which is constant", id, pass);
    if (*next != FM_NEXT && *next != FM_REPEAT && *next != FM_REDO)
        return fm_fail(frame->err, FM_INVALID, "%s: pass '%s': after: answered %u, no fm_next", id,
                       pass, (unsigned)*next);
    if (*next == FM_REPEAT && !is_in_loop(instance, index))
        return fm_fail(frame->err, FM_INVALID,
                       "%s: pass '%s': after: answered FM_REPEAT (%u), and no loop holds the pass",
                       id, pass, (unsigned)*next);
    return FM_OK;
}
