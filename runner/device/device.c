#include "device.h"

#include <string.h>

#include "base/text.h"
#include "device/dummy/dummy.h"
#include "device/osmesa/osmesa.h"
#include "device/selector.h"
#include "device/vulkan/vulkan.h"
#include "simulator/device.h"

enum { DEVICE_ENTRIES_MAX = 32 };

const fm_device_ops *const fm_device_table[] = {
    &vulkan_device,
#ifdef FM_HAS_OSMESA
    &osmesa_device,
#endif
    &tbr_device,    &dummy_device, NULL,
};

const fm_device_ops *device_find(const char *name)
{
    const size_t length = strcspn(name, ":");
    for (const fm_device_ops *const *ops = fm_device_table; *ops != NULL; ops++)
        if (strlen((*ops)->name) == length && strncmp((*ops)->name, name, length) == 0)
            return *ops;
    return NULL;
}

uint32_t device_feeds(const fm_device_ops *ops)
{
    return ops->feeds != 0 ? ops->feeds : FM_FEEDS_FRAGMENTS | FM_FEED_TRIANGLES;
}

fm_status device_expect(const char *name, fm_error *err)
{
    const fm_device_ops *ops = device_find(name);
    const char *colon = strchr(name, ':');
    fm_device_entry entries[DEVICE_ENTRIES_MAX];
    size_t count = DEVICE_ENTRIES_MAX;
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

fm_status device_open(fm_device **device, const char *name, const fm_device_desc *desc,
                      fm_error *err)
{
    const fm_device_ops *ops = device_find(name);
    const char *colon = strchr(name, ':');
    const char *known[8];
    size_t count = 0;
    *device = NULL;
    if (ops != NULL) {
        fm_device_desc chosen = *desc;
        chosen.selector = colon != NULL ? colon + 1 : NULL;
        return ops->open(device, &chosen, err);
    }
    for (; fm_device_table[count] != NULL; count++)
        known[count] = fm_device_table[count]->name;
    const char *nearest = text_nearest(name, known, count);
    return fm_fail(err, FM_INVALID, "no device '%s'; the nearest is '%s'", name,
                   nearest != NULL ? nearest : known[0]);
}

void device_close(fm_device *device)
{
    if (device != NULL)
        device->ops->close(device);
}
