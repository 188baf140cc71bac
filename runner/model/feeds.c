#include "feeds.h"

#include <string.h>

const fm_feed_info fm_feeds[FM_FEED_COUNT] = {
    { FM_FEED_RASTER, "raster", true, true, "null" },
    { FM_FEED_COMPUTE_LAYER, "compute-layer", true, true, "null" },
    { FM_FEED_COMPUTE_PIXEL, "compute-pixel", true, true, "null" },
    { FM_FEED_COMPUTE_ADJACENT, "compute-adjacent", true, true, "null" },
    { FM_FEED_TRIANGLES, "triangles", false, true, "null-triangles" },
    { FM_FEED_FRAMES, "frames", false, false, "" },
};
_Static_assert(FM_FEEDS_ALL == (1u << FM_FEED_COUNT) - 1, "one row a feed");

uint32_t feed_from_name(const char *name)
{
    for (size_t i = 0; i < FM_FEED_COUNT; i++)
        if (strcmp(fm_feeds[i].name, name) == 0)
            return fm_feeds[i].feed;
    return 0;
}

const fm_feed_info *feed_info(uint32_t feed)
{
    for (size_t i = 0; i < FM_FEED_COUNT; i++)
        if (fm_feeds[i].feed == feed)
            return &fm_feeds[i];
    return NULL;
}

const char *feed_name(uint32_t feed)
{
    const fm_feed_info *info = feed_info(feed);
    return info != NULL ? info->name : "none";
}

size_t feed_names(const char *names[FM_FEED_COUNT + 1], uint32_t mask)
{
    size_t count = 0;
    for (size_t i = 0; i < FM_FEED_COUNT; i++)
        if ((mask & fm_feeds[i].feed) != 0)
            names[count++] = fm_feeds[i].name;
    names[count] = NULL;
    return count;
}

uint32_t method_feeds(const fm_method_desc *method)
{
    return method->feeds != 0 ? method->feeds : FM_FEEDS_FRAGMENTS;
}
