/* Who is beaten in time and error, and who cannot be told apart.
 *
 * The room reports/tradeoff weighs speed against error: which cases of a group stand on the
 * frontier (standing), which is the cheapest for an error that one can bear (cheapest), how methods
 * fare over several scenes (overall), and all of it as a table (tradeoff_csv). It draws nothing. */
#ifndef FM_STANDING_H
#define FM_STANDING_H

#include "error_kind.h"
#include "read/group.h"

/* One is clearly faster than another if its whole interval lies below the other's. A time without
 * interval (one launch) is clearly faster, or slower, than none. */
typedef enum fm_standing {
    FM_STANDING_NONE,      /* does not compete: a control, no time or error, not ok, simulated */
    FM_STANDING_DOMINATED, /* another one has no more error and is clearly faster */
    FM_STANDING_TIED,      /* neither: times overlap with another's of no more error */
    FM_STANDING_FRONTIER   /* clearly faster than all that have no more error */
} fm_standing;

typedef struct fm_place {
    fm_standing standing;
    size_t beaten_by; /* index of another, where dominated: the one whose time ends first */
} fm_place;

/* "frontier", "tied", "dominated", "". */
const char *standing_name(fm_standing standing);

/* A case's time with its interval; without one it is from 0 to INFINITY. */
typedef struct fm_span {
    double value, low, high;
} fm_span;
/* What is compared: any errors from 0, any times or ratios of such, of one amount of work. */
typedef struct fm_contender {
    double work; /* those of other values are no rivals */
    double error;
    fm_span time;
    size_t index; /* of its place */
} fm_contender;
/* Sets the place of each contender; sorts them. In n log n. */
void contenders_place(fm_place *places, fm_contender *contenders, size_t count);

/* places: [group->count], in the order of its cases; cases of another n (layers made of r and k)
 * are no rivals. false: no memory. */
bool standings_make(fm_place *places, const fm_group *group, const fm_error_kind *kind);

/* Whether a case has a time and an error that can be drawn; wrong images and controls, too. */
bool standing_has_point(const fm_case_row *result, const fm_error_kind *kind);

fm_span standing_time(const fm_case_row *result);
/* The ratio of two times: its interval holds the true ratio if theirs hold the true times. */
fm_span span_ratio(const fm_span *a, const fm_span *b);

#endif
