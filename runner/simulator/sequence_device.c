#include "sequence_device.h"

#include <stdio.h>
#include <stdlib.h>

static const char title[] = "simulated tile-based GPU, as an ARM Mali-450";

static fm_status list_devices(fm_device_entry *entries, size_t *count, fm_error *err)
{
    (void)err;
    if (*count > 0) {
        snprintf(entries[0].selector, sizeof entries[0].selector, "tbr");
        snprintf(entries[0].name, sizeof entries[0].name, "%s", title);
        *count = 1;
    }
    return FM_OK;
}

static fm_status open_device(fm_device **device, const fm_device_desc *desc, fm_error *err)
{
    *device = NULL;
    if (desc->selector != NULL)
        return fm_fail(err, FM_INVALID, "tbr:%s: there is one such device, 'tbr'", desc->selector);
    fm_device *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "tbr: %zu bytes", sizeof *made);
    made->ops = &tbr_sequence_device;
    snprintf(made->caps.name, sizeof made->caps.name, "%s", title);
    snprintf(made->caps.driver, sizeof made->caps.driver, "fragmark");
    snprintf(made->caps.api, sizeof made->caps.api, "frames");
    made->caps.is_software = true;
    *device = made;
    return FM_OK;
}

static void close_device(fm_device *device)
{
    free(device);
}

static uint32_t validation_errors(const fm_device *device, const char **first)
{
    (void)device;
    *first = "";
    return 0;
}

const fm_device_ops tbr_sequence_device = {
    .name = "tbr",
    .feeds = FM_FEED_FRAMES,
    .list = list_devices,
    .open = open_device,
    .close = close_device,
    .validation_errors = validation_errors,
};
