#include "devices.h"

#include "device/dummy/dummy.h"
#include "device/osmesa/osmesa.h"
#include "device/vulkan/vulkan.h"
#include "simulator/sequence_device.h"

static const fm_device_ops *const built[] = {
    &vulkan_device,
#ifdef FM_HAS_OSMESA
    &osmesa_device,
#endif
    &tbr_sequence_device,
    &dummy_device,
};

const fm_device_list program_devices = { .devices = built,
                                         .count = sizeof built / sizeof built[0] };
