#include "registry.h"

#include <string.h>

#include "base/text.h"
#include "selector.h"

enum { ENTRIES_MAX = 32 }; /* devices of one driver that are looked at */

const fm_device_ops *device_find(const fm_device_list *list, const char *name)
{
    const size_t length = strcspn(name, ":");
    for (size_t i = 0; i < list->count; i++) {
        const fm_device_ops *ops = list->devices[i];
        if (strlen(ops->name) == length && strncmp(ops->name, name, length) == 0)
            return ops;
    }
    return NULL;
}

/* The nearest so far against the next one, so that no number of devices is too many. */
const char *device_nearest(const fm_device_list *list, const char *name)
{
    const char *nearest = NULL;
    for (size_t i = 0; i < list->count; i++) {
        const char *next = list->devices[i]->name;
        const char *const pair[] = { nearest != NULL ? nearest : next, next };
        nearest = text_nearest(name, pair, 2);
    }
    return nearest;
}

uint32_t device_feeds(const fm_device_ops *ops)
{
    return ops->feeds != 0 ? ops->feeds : FM_FEEDS_FRAGMENTS | FM_FEED_TRIANGLES;
}

fm_status device_expect(const fm_device_list *list, const char *name, fm_error *err)
{
    const fm_device_ops *ops = device_find(list, name);
    const char *colon = strchr(name, ':');
    fm_device_entry entries[ENTRIES_MAX];
    size_t count = ENTRIES_MAX;
    fm_text there = { 0 };
    if (ops == NULL || colon == NULL || ops->list(entries, &count, NULL) != FM_OK || count == 0)
        return FM_OK;
    for (size_t i = 0; i < count; i++) {
        if (selector_matches(colon + 1, i, entries[i].name)) {
            text_free(&there);
            return FM_OK;
        }
        text_add(&there, "%s%s '%s'", i > 0 ? ", " : "", entries[i].selector, entries[i].name);
    }
    const fm_status status = fm_fail(err, FM_INVALID, "--device %s: no such device; there is %s",
                                     name, there.failed ? "another" : there.bytes);
    text_free(&there);
    return status;
}

static fm_status fail_name(const fm_device_list *list, const char *name, fm_error *err)
{
    const char *nearest = device_nearest(list, name);
    if (list->count == 0)
        return fm_fail(err, FM_INVALID, "no device '%s'; this program has none", name);
    return fm_fail(err, FM_INVALID, "no device '%s'; the nearest is '%s'", name,
                   nearest != NULL ? nearest : list->devices[0]->name);
}

fm_status device_open(fm_device **device, const fm_device_list *list, const char *name,
                      const fm_device_desc *desc, fm_error *err)
{
    const fm_device_ops *ops = device_find(list, name);
    const char *colon = strchr(name, ':');
    fm_device_desc chosen = *desc;
    *device = NULL;
    if (ops == NULL)
        return fail_name(list, name, err);
    chosen.selector = colon != NULL ? colon + 1 : NULL;
    return ops->open(device, &chosen, err);
}

void device_close(fm_device *device)
{
    if (device != NULL)
        device->ops->close(device);
}
