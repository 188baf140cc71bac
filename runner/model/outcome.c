#include "outcome.h"

#include <string.h>

#include "base/text.h"

static const char *const status_name[] = {
    [FM_CASE_SKIPPED] = "skipped",
    [FM_CASE_OK] = "ok",
    [FM_CASE_NOT_SUPPORTED] = "not_supported",
    [FM_CASE_WRONG_IMAGE] = "wrong_image",
    [FM_CASE_PLUGIN_ERROR] = "plugin_error",
    [FM_CASE_DEVICE_LOST] = "device_lost",
    [FM_CASE_OUT_OF_MEMORY] = "out_of_memory",
    [FM_CASE_TIMEOUT] = "timeout",
    [FM_CASE_CRASH] = "crash",
};
_Static_assert(sizeof status_name / sizeof status_name[0] == FM_CASE_STATUS_COUNT,
               "one name a status");

const char *case_status_name(fm_case_status status)
{
    return status_name[status];
}

bool case_status_parse(fm_case_status *status, const char *name)
{
    for (int i = 0; name != NULL && i < FM_CASE_STATUS_COUNT; i++) {
        if (strcmp(name, status_name[i]) == 0) {
            *status = (fm_case_status)i;
            return true;
        }
    }
    return false;
}

bool case_status_continues(fm_case_status status)
{
    return status == FM_CASE_SKIPPED || status == FM_CASE_OK || status == FM_CASE_WRONG_IMAGE;
}

static const char *const reason_name[] = {
    [FM_REASON_NONE] = "",           [FM_REASON_FEED] = "feed",
    [FM_REASON_SETTING] = "setting", [FM_REASON_DEPTH_TEST] = "depth-test",
    [FM_REASON_FEATURE] = "feature", [FM_REASON_DEVICE_LIMIT] = "device-limit",
    [FM_REASON_LOOPS] = "loops",     [FM_REASON_SUITE_LIMIT] = "suite-limit",
    [FM_REASON_SCENE] = "scene",     [FM_REASON_DRIVER] = "driver",
};
_Static_assert(sizeof reason_name / sizeof reason_name[0] == FM_REASON_COUNT, "one name a reason");

const char *case_reason_name(fm_reason reason)
{
    return reason_name[reason];
}

bool case_reason_parse(fm_reason *reason, const char *name, const char **nearest)
{
    for (int i = 0; name != NULL && i < FM_REASON_COUNT; i++) {
        if (strcmp(name, reason_name[i]) == 0) {
            *reason = (fm_reason)i;
            return true;
        }
    }
    if (nearest != NULL)
        *nearest = name != NULL ? text_nearest(name, reason_name + 1, FM_REASON_COUNT - 1) : NULL;
    return false;
}
