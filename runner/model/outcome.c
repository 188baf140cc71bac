#include "outcome.h"

#include <string.h>

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
