/* What became of each fragment of one pixel: the counts of check.h, fragment by fragment. */
#ifndef FM_STATES_H
#define FM_STATES_H

#include "base/error.h"
#include "scene/scene.h"

typedef enum fragment_state {
    STATE_OK,      /* handed over, and wanted */
    STATE_MISSING, /* wanted, and not handed over */
    STATE_EXTRA, /* handed over, and not the pixel's; or the pixel's, but beyond the wanted count */
    STATE_BEHIND, /* handed over and the pixel's, but behind the wanted ones: within the count, in
                     the place of one that is missing */
    STATE_COUNT
} fragment_state;
/* "ok", "missing", "extra", "behind". */
extern const char *const state_names[STATE_COUNT];

#define STATES_NO_RANK UINT32_MAX
typedef struct fragment_line {
    fm_fragment fragment;
    uint32_t rank;      /* its place among those handed over, from 0; STATES_NO_RANK: none */
    uint32_t true_rank; /* its place among the pixel's, from 0; the same */
    fragment_state state;
    bool is_misordered; /* nearer than the one that was handed over before it */
} fragment_line;

/* One pixel; all borrowed. */
typedef struct states_pixel {
    const fm_fragment *captured; /* in the order of ranks */
    uint32_t captured_count;
    const fm_fragment *truth; /* all of the pixel's, nearest first */
    uint32_t truth_count;
    uint32_t wanted; /* of these, from the front; UINT32_MAX: all */
} states_pixel;

/* What was handed over, in its order, and the missing ones before the first that is farther.
 * lines: room for captured_count + truth_count; *count: how many they are.
 * missing, extra and misordered ones are as many as check_pixel counts. FM_NO_MEMORY. */
fm_status states_of_pixel(fragment_line *lines, uint32_t *count, const states_pixel *pixel,
                          fm_error *err);

#endif
