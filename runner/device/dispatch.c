#include "dispatch.h"

fm_status dispatch_check_groups(const fm_device *device, const fm_dispatch *dispatch, fm_error *err)
{
    const uint32_t *most = device->caps.max_groups;
    for (int axis = 0; axis < 3 && dispatch->indirect == NULL; axis++)
        if (dispatch->groups[axis] > most[axis])
            return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                             "dispatch: %u groups, this device's most are %u",
                             dispatch->groups[axis], most[axis]);
    return FM_OK;
}
