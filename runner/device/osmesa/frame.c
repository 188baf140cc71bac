#include <assert.h>

#include "base/clock.h"
#include "context.h"

fm_status osmesa_frame_begin(fm_device *device, fm_error *err)
{
    osmesa *self = osmesa_current(device);
    const GLenum code = self->gl.GetError();
    if (code != GL_NO_ERROR) /* not the frame's: blaming a pass for it would mislead */
        return fm_fail(err, FM_DEVICE_LOST, "osmesa: before the frame: %s", gl_error_name(code));
    self->times = (fm_frame_times){ .wall_ns = 0 };
    self->queries_used = 0;
    self->frame_start_ns = clock_ns();
    return FM_OK;
}

static uint64_t read_query(const fm_gl *gl, GLuint query)
{
    GLuint64 value = 0;
    gl->GetQueryObjectui64v(query, GL_QUERY_RESULT, &value); /* waits */
    return value;
}

void osmesa_query_collect(osmesa *self, uint32_t slot)
{
    if ((self->queries_used >> slot & 1u) != 0)
        self->times.query[slot] += read_query(&self->gl, self->queries[slot]);
    self->queries_used &= ~(1u << slot);
}

fm_status osmesa_frame_end(fm_device *device, fm_frame_times *times, fm_error *err)
{
    osmesa *self = osmesa_current(device);
    self->gl.MemoryBarrier(GL_ALL_BARRIER_BITS);
    self->gl.Finish();
    for (uint32_t slot = 0; slot < FM_MAX_QUERIES; slot++)
        osmesa_query_collect(self, slot);
    self->times.wall_ns = clock_ns() - self->frame_start_ns;
    *times = self->times;
    const GLenum code = self->gl.GetError();
    if (code != GL_NO_ERROR)
        return fm_fail(err, FM_DEVICE_LOST, "osmesa: in the frame: %s", gl_error_name(code));
    return FM_OK;
}

/* llvmpipe works when it is flushed: a plain timestamp lands before work that was issued earlier.
 * Finishing on both sides pins it down. The value can be read at once, so that a timer may be used
 * again without a second query object. */
static void take_timestamp(const fm_gl *gl, GLuint query)
{
    gl->Finish();
    gl->QueryCounter(query, GL_TIMESTAMP);
    gl->Finish();
}

void osmesa_timer_begin(fm_device *device, uint32_t timer)
{
    osmesa *self = osmesa_current(device);
    assert(timer < FM_MAX_TIMERS);
    (void)timer;
    if (!self->no_timers)
        take_timestamp(&self->gl, self->timestamps[0]);
}

void osmesa_timer_end(fm_device *device, uint32_t timer)
{
    osmesa *self = osmesa_current(device);
    assert(timer < FM_MAX_TIMERS);
    if (self->no_timers)
        return;
    take_timestamp(&self->gl, self->timestamps[1]);
    self->times.timer_ns[timer] +=
        read_query(&self->gl, self->timestamps[1]) - read_query(&self->gl, self->timestamps[0]);
}
