/* The feeds: how fragments reach a method. One table of what is known of each. */
#ifndef FM_FEEDS_H
#define FM_FEEDS_H

#include <stdbool.h>

#include "fragmark/method.h"

enum { FM_FEED_COUNT = 6 };

typedef struct fm_feed_info {
    uint32_t feed;         /* one FM_FEED_* bit */
    const char *name;      /* as --feed and the column `feed` spell it */
    bool is_of_rasteriser; /* its fragments are those of the device's rasteriser: such feeds share
                              one truth, and the floor `null` */
    bool has_floor;        /* its times are compared with a floor; false: it has no times */
    const char *floor;     /* the method that is its floor, for messages; "" without one */
} fm_feed_info;

/* In the order of their bits. */
extern const fm_feed_info fm_feeds[FM_FEED_COUNT];

/* One FM_FEED_* bit; 0: no feed has this name. */
uint32_t feed_from_name(const char *name);
/* The row of one FM_FEED_* bit; NULL: it is none. */
const fm_feed_info *feed_info(uint32_t feed);
/* The name of one FM_FEED_* bit; "none" for anything else. */
const char *feed_name(uint32_t feed);
/* The names of all feeds in a mask, in the order of the table, ending with NULL. Returns how many.
 */
size_t feed_names(const char *names[FM_FEED_COUNT + 1], uint32_t mask);
/* The feeds that a method takes: FM_FEEDS_FRAGMENTS where its descriptor says 0. */
uint32_t method_feeds(const fm_method_desc *method);

#endif
