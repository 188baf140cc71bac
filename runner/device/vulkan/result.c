#include <stdarg.h>
#include <stdio.h>

#include "context.h"

typedef struct result_traits {
    VkResult result;
    fm_status status;
    fm_reason reason; /* of FM_UNSUPPORTED */
    const char *name;
} result_traits;

static const result_traits known_results[] = {
    { VK_ERROR_OUT_OF_HOST_MEMORY, FM_NO_MEMORY, FM_REASON_NONE, "out of host memory" },
    { VK_ERROR_OUT_OF_DEVICE_MEMORY, FM_NO_MEMORY, FM_REASON_NONE, "out of device memory" },
    { VK_ERROR_TOO_MANY_OBJECTS, FM_NO_MEMORY, FM_REASON_NONE, "too many objects" },
    { VK_ERROR_DEVICE_LOST, FM_DEVICE_LOST, FM_REASON_NONE, "device lost" },
    { VK_ERROR_LAYER_NOT_PRESENT, FM_UNSUPPORTED, FM_REASON_DRIVER, "layer not present" },
    { VK_ERROR_EXTENSION_NOT_PRESENT, FM_UNSUPPORTED, FM_REASON_FEATURE, "extension not present" },
    { VK_ERROR_FEATURE_NOT_PRESENT, FM_UNSUPPORTED, FM_REASON_FEATURE, "feature not present" },
    { VK_ERROR_INCOMPATIBLE_DRIVER, FM_UNSUPPORTED, FM_REASON_DRIVER, "incompatible driver" },
    { VK_ERROR_INITIALIZATION_FAILED, FM_UNSUPPORTED, FM_REASON_DRIVER, "initialization failed" },
    { VK_ERROR_FORMAT_NOT_SUPPORTED, FM_UNSUPPORTED, FM_REASON_FEATURE, "format not supported" },
    { VK_ERROR_INVALID_SHADER_NV, FM_SHADER, FM_REASON_NONE,
      "the driver's compiler refused the shader" },
};

fm_status vulkan_fail(fm_error *err, VkResult result, const char *format, ...)
{
    result_traits traits = { result, FM_DEVICE_LOST, FM_REASON_NONE, "the driver failed" };
    char what[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(what, sizeof what, format, arguments);
    va_end(arguments);
    for (size_t i = 0; i < sizeof known_results / sizeof known_results[0]; i++) {
        if (known_results[i].result == result)
            traits = known_results[i];
    }
    if (traits.status == FM_UNSUPPORTED)
        return fm_refuse(err, traits.reason, "%s: %s (VkResult %d)", what, traits.name,
                         (int)result);
    return fm_fail(err, traits.status, "%s: %s (VkResult %d)", what, traits.name, (int)result);
}
