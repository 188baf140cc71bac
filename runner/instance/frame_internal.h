/* What the files that run a frame share; nobody else includes it. From below:
 *   frame_record.c    a recording: opened, timed, submitted; one pass in it
 *   frame_hook.c      the method's hook
 *   frame_totals.c    totals read back, and what follows from them
 *   frame_loops.c     passes in order, loops within loops
 *   instance_frame.c  a whole frame, and again if something had to grow */
#ifndef FM_FRAME_INTERNAL_H
#define FM_FRAME_INTERNAL_H

#include "instance_internal.h"

enum {
    CANARY_TIMER = FM_MAX_TIMERS - 1,  /* of nothing: tells the clock */
    COMBINE_TIMER = FM_MAX_TIMERS - 2, /* of the pass that joins both ends */
    SPAN_TIMER = FM_MAX_TIMERS - 3     /* of a whole frame: timers=frame */
};
_Static_assert((int)SPAN_TIMER >= (int)FM_MAX_PASSES, "a timer for each pass");

/* A frame on its way. */
typedef struct frame_run {
    fm_instance *instance;
    fm_frame_result *result;
    fm_band band;
    fm_params params;
    bool params_are_set;
    bool is_recording;
    bool is_in_span;
    bool redo;
    bool hook_redoes; /* because the hook said so */
    uint32_t gone_on; /* what STAGE_COUNTER_GO_ON was when it was read */
    uint64_t query[FM_MAX_QUERIES];
    fm_error *err;
} frame_run;

/* frame_record.c */
/* Opens a recording, unless one is open. */
fm_status frame_record(frame_run *frame);
/* Submits the recording and takes its times; nothing, if none is open. */
fm_status frame_flush(frame_run *frame);
/* Around what is timed as `timer`; with timers=frame one timer runs from the first of them on. */
void frame_timer_begin(frame_run *frame, uint32_t timer);
void frame_timer_end(frame_run *frame, uint32_t timer);
/* Records one pass. */
fm_status frame_pass(frame_run *frame, size_t index, uint32_t iteration);

/* frame_hook.c */
/* Asks the `after` hook, which is there. FM_INVALID: it answers what cannot be done, or writes to
 * what it is shown. */
fm_status frame_hook(fm_next *next, const frame_run *frame, size_t index);

/* frame_totals.c */
/* Totals that this pass completes; the hook, if it is a host pass. */
fm_status frame_after_pass(frame_run *frame, size_t index, fm_next *next);
/* Totals that frames did not wait for. */
fm_status frame_late_totals(frame_run *frame);

/* frame_loops.c: passes first to last, with the loops among them; inside: the loop around them. */
fm_status frame_range(frame_run *frame, size_t first, size_t last, uint32_t iteration,
                      const fm_loop *inside, fm_next *next);

#endif
