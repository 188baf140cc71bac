/* What the kits of all devices share: the screen, its triangles, a frame's begin and end. */
#ifndef FM_TESTS_SCREEN_KIT_H
#define FM_TESTS_SCREEN_KIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "device/device.h"

enum { SIDE_PX = 16, PIXELS = SIDE_PX * SIDE_PX };

/* A triangle over the whole screen for each instance, the later the nearer: 0.75, 0.5, ... */
static const char stacked_vertex[] __attribute__((unused)) =
    "#version 450\n"
    "layout(location = 0) flat out int instance;\n"
    "void main() {\n"
    "  vec2 corner = vec2(gl_VertexIndex & 1, gl_VertexIndex >> 1);\n"
    "  instance = gl_InstanceIndex;\n"
    "  gl_Position = vec4(corner * 4.0 - 1.0, 0.75 - 0.25 * float(instance), 1.0);\n"
    "}\n";

static inline void begin(fm_device *device)
{
    fm_error err = { .message = "" };
    if (device->ops->frame_begin(device, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static inline fm_frame_times end(fm_device *device)
{
    fm_frame_times times = { .wall_ns = 0 };
    fm_error err = { .message = "" };
    if (device->ops->frame_end(device, &times, &err) != FM_OK)
        fail_msg("%s", err.message);
    return times;
}

#endif
