/* A libGL.so.1 that records: put before the real one on LD_LIBRARY_PATH of glretrace, it turns each
 * draw call into triangles by OpenGL's feedback mode, and each swap into a frame of a stream.
 *
 * Its own entry points are below; all others come from libOpenGL and libGLX, which it needs. What
 * it draws it does not draw for real: nothing of a replay depends on pixels. In the environment:
 *   FRAGMARK_RECORD_STREAM  the stream's path; it is there when the recording is complete
 *   FRAGMARK_RECORD_FIRST   frames to leave out before the first recorded one; default 0
 *   FRAGMARK_RECORD_FRAMES  frames to record; default 60
 * Beside the stream STREAM.txt tells, in a line, what was and what could not be recorded.
 *
 * State is one static struct: the interface is OpenGL's, which has no place for a context of ours.
 * Calls come from one thread, glretrace's. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "draw_state.h"
#include "own_calls.h"
#include "scene/frame_stream.h"

#define RECORDED __attribute__((visibility("default")))
enum { FIRST_FLOATS = 1 << 22, MAX_FLOATS = 1 << 27, DEFAULT_FRAMES = 60 };

typedef struct recorder {
    bool is_open, has_failed, is_finished;
    draw_state state;
    fm_stream_writer stream;
    fm_frame_builder frame;
    polygon_totals polygons;
    uint64_t offscreen, unheard, unseen; /* draw calls into framebuffer objects; without feedback;
                                            of kinds that are not recorded */
    float *values;                       /* of feedback */
    size_t room;
    uint32_t first, wanted, swaps;
    uint32_t width_px, height_px;
    bool in_list, in_begin;
    uint32_t immediate_vertices;
} recorder;

static recorder the_recorder;

/* ---- opening, closing ---- */

static uint32_t number_from(const char *variable, uint32_t otherwise)
{
    const char *text = getenv(variable);
    return text != NULL && *text != '\0' ? (uint32_t)strtoul(text, NULL, 10) : otherwise;
}

static recorder *opened(void)
{
    recorder *r = &the_recorder;
    if (r->is_open)
        return r;
    r->is_open = true;
    r->first = number_from("FRAGMARK_RECORD_FIRST", 0);
    r->wanted = number_from("FRAGMARK_RECORD_FRAMES", DEFAULT_FRAMES);
    r->room = FIRST_FLOATS;
    r->values = malloc(r->room * sizeof *r->values);
    /* Without its entry points no call can be passed on. */
    if (!gl_calls_open(&r->state.gl))
        abort();
    r->has_failed = r->values == NULL || getenv("FRAGMARK_RECORD_STREAM") == NULL;
    frame_builder_clear(&r->frame);
    return r;
}

static void write_totals(const recorder *r, const char *stream)
{
    char *path = NULL;
    FILE *file = asprintf(&path, "%s.txt", stream) < 0 ? NULL : fopen(path, "w");
    if (file != NULL) {
        fprintf(file,
                "%u frames of %u x %u px, %llu triangles; left out: %llu points, lines and "
                "rectangles, %llu draw calls into framebuffer objects, %llu without feedback, "
                "%llu of kinds that are not recorded (instances, indirect, pixels)\n",
                r->stream.head.frame_count, r->width_px, r->height_px,
                (unsigned long long)r->polygons.triangles, (unsigned long long)r->polygons.dropped,
                (unsigned long long)r->offscreen, (unsigned long long)r->unheard,
                (unsigned long long)r->unseen);
        fclose(file);
    }
    free(path);
}

static void finish(recorder *r)
{
    if (r->is_finished || r->stream.file == NULL)
        return;
    r->is_finished = true;
    write_totals(r, r->stream.path);
    stream_writer_close(&r->stream, NULL);
}

/* A trace may end before all wanted frames were there. */
__attribute__((destructor)) static void close_recorder(void)
{
    finish(&the_recorder);
    frame_builder_free(&the_recorder.frame);
    free(the_recorder.values);
}

/* ---- frames ---- */

static bool is_heard(const recorder *r)
{
    return !r->has_failed && !r->is_finished && r->swaps >= r->first;
}

static void find_size(recorder *r)
{
    unsigned width = 0, height = 0;
    Display *display = glXGetCurrentDisplay();
    const GLXDrawable drawable = r->state.gl.glXGetCurrentDrawable();
    if (r->height_px != 0 || display == NULL || drawable == None)
        return;
    r->state.gl.glXQueryDrawable(display, drawable, GLX_WIDTH, &width);
    r->state.gl.glXQueryDrawable(display, drawable, GLX_HEIGHT, &height);
    r->width_px = width;
    r->height_px = height;
}

static void end_frame(recorder *r)
{
    const bool has_more = is_heard(r);
    r->swaps++;
    if (has_more && r->stream.file == NULL)
        r->has_failed = stream_writer_open(&r->stream, getenv("FRAGMARK_RECORD_STREAM"),
                                           r->width_px, r->height_px, NULL) != FM_OK;
    if (has_more && !r->has_failed)
        r->has_failed =
            r->frame.failed || stream_writer_add(&r->stream, &r->frame.frame, NULL) != FM_OK;
    frame_builder_clear(&r->frame);
    if (has_more && !r->has_failed && r->stream.head.frame_count == r->wanted)
        finish(r);
}

/* ---- draw calls ---- */

typedef enum verdict { PASS_ON, RECORD } verdict;

static verdict judge(recorder *r)
{
    GLint framebuffer = 0;
    if (r->in_list || r->in_begin || r->has_failed || r->is_finished)
        return PASS_ON;
    r->state.gl.glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &framebuffer);
    if (framebuffer != 0) {
        draw_state_rendered(&r->state);
        r->offscreen += is_heard(r);
        return PASS_ON;
    }
    find_size(r);
    return is_heard(r) ? RECORD : PASS_ON;
}

static void begin_feedback(recorder *r)
{
    while (r->state.gl.glGetError() != GL_NO_ERROR)
        continue;
    r->state.gl.glFeedbackBuffer((GLsizei)r->room, GL_3D_COLOR_TEXTURE, r->values);
    r->state.gl.glRenderMode(GL_FEEDBACK);
}

/* What was drawn since begin_feedback is a draw call; false: the buffer was too small, and is now
 * larger. */
static bool end_feedback(recorder *r, uint32_t vertices)
{
    const GLint count = r->state.gl.glRenderMode(GL_RENDER);
    if (r->state.gl.glGetError() != GL_NO_ERROR) { /* a core profile has no feedback */
        r->unheard++;
        return true;
    }
    if (count < 0 && r->room < MAX_FLOATS) {
        float *grown = realloc(r->values, 2 * r->room * sizeof *grown);
        r->values = grown != NULL ? grown : r->values;
        r->room = grown != NULL ? 2 * r->room : r->room;
        return grown == NULL;
    }
    r->unheard += count < 0;
    if (count <= 0)
        return true;
    const fm_draw_call draw = draw_state_read(&r->state, vertices);
    const polygon_view view = draw_state_view(&r->state, r->height_px);
    frame_builder_draw(&r->frame, &draw);
    const polygon_alpha alpha =
        polygons_add(&r->frame, &r->polygons, r->values, (size_t)count, &view);
    if (!r->frame.failed)
        draw_state_alpha(&r->frame.frame.draws[r->frame.frame.draw_count - 1], &r->state, alpha);
    return true;
}

/* Draws by CALL, as feedback where it is recorded; again while the buffer is too small. */
#define RECORD_DRAW(vertices, call)                                                                \
    recorder *r = opened();                                                                        \
    if (judge(r) == PASS_ON) {                                                                     \
        r->state.gl.call;                                                                          \
        return;                                                                                    \
    }                                                                                              \
    do {                                                                                           \
        begin_feedback(r);                                                                         \
        r->state.gl.call;                                                                          \
    } while (!end_feedback(r, (vertices)))

RECORDED void glDrawArrays(GLenum mode, GLint first, GLsizei count)
{
    RECORD_DRAW((uint32_t)count, glDrawArrays(mode, first, count));
}

/* Shared vertices are shaded once, if the cache holds: a mesh has about half as many as triangles.
 */
static uint32_t indexed_vertices(GLsizei count)
{
    return (uint32_t)count / 6 + 3;
}

RECORDED void glDrawElements(GLenum mode, GLsizei count, GLenum type, const void *indices)
{
    RECORD_DRAW(indexed_vertices(count), glDrawElements(mode, count, type, indices));
}

RECORDED void glDrawRangeElements(GLenum mode, GLuint start, GLuint end, GLsizei count, GLenum type,
                                  const void *indices)
{
    RECORD_DRAW(end - start + 1, glDrawRangeElements(mode, start, end, count, type, indices));
}

RECORDED void glDrawElementsBaseVertex(GLenum mode, GLsizei count, GLenum type, const void *indices,
                                       GLint base)
{
    RECORD_DRAW(indexed_vertices(count),
                glDrawElementsBaseVertex(mode, count, type, indices, base));
}

RECORDED void glDrawRangeElementsBaseVertex(GLenum mode, GLuint start, GLuint end, GLsizei count,
                                            GLenum type, const void *indices, GLint base)
{
    RECORD_DRAW(end - start + 1,
                glDrawRangeElementsBaseVertex(mode, start, end, count, type, indices, base));
}

RECORDED void glMultiDrawArrays(GLenum mode, const GLint *first, const GLsizei *count,
                                GLsizei draws)
{
    for (GLsizei i = 0; i < draws; i++)
        glDrawArrays(mode, first[i], count[i]);
}

RECORDED void glMultiDrawElements(GLenum mode, const GLsizei *count, GLenum type,
                                  const void *const *indices, GLsizei draws)
{
    for (GLsizei i = 0; i < draws; i++)
        glDrawElements(mode, count[i], type, indices[i]);
}

RECORDED void glMultiDrawElementsBaseVertex(GLenum mode, const GLsizei *count, GLenum type,
                                            const void *const *indices, GLsizei draws,
                                            const GLint *base)
{
    for (GLsizei i = 0; i < draws; i++)
        glDrawElementsBaseVertex(mode, count[i], type, indices[i], base[i]);
}

#define RECORD_UNSEEN(name, parameters, arguments)                                                 \
    RECORDED void name parameters                                                                  \
    {                                                                                              \
        recorder *r = opened();                                                                    \
        r->unseen += judge(r) == RECORD;                                                           \
        r->state.gl.name arguments;                                                                \
    }
RECORD_UNSEEN_CALLS(RECORD_UNSEEN)
#undef RECORD_UNSEEN

/* A list draws with the state that it sets on the way; it is recorded with that before it. */
RECORDED void glCallList(GLuint list)
{
    RECORD_DRAW(0, glCallList(list));
}

RECORDED void glCallLists(GLsizei count, GLenum type, const void *lists)
{
    RECORD_DRAW(0, glCallLists(count, type, lists));
}

RECORDED void glNewList(GLuint list, GLenum mode)
{
    recorder *r = opened();
    r->in_list = mode == GL_COMPILE;
    r->state.gl.glNewList(list, mode);
}

RECORDED void glEndList(void)
{
    recorder *r = opened();
    r->in_list = false;
    r->state.gl.glEndList();
}

/* Immediate mode cannot be drawn again: what does not fit the buffer is lost, and counted. */
RECORDED void glBegin(GLenum mode)
{
    recorder *r = opened();
    if (judge(r) == RECORD) {
        begin_feedback(r);
        r->in_begin = true;
    }
    r->state.gl.glBegin(mode);
}

RECORDED void glEnd(void)
{
    recorder *r = opened();
    r->state.gl.glEnd();
    if (!r->in_begin)
        return;
    r->in_begin = false;
    r->unheard += !end_feedback(r, 0);
}

/* ---- clears ---- */

static uint8_t byte_from(float value)
{
    return (uint8_t)(value <= 0 ? 0 : value >= 1 ? 255 : value * 255 + 0.5f);
}

/* Before anything was drawn a clear is the frame's own. */
static void clear_start(recorder *r, GLbitfield mask)
{
    float colour[4] = { 0 }, depth = 1;
    r->state.gl.glGetFloatv(GL_COLOR_CLEAR_VALUE, colour);
    r->state.gl.glGetFloatv(GL_DEPTH_CLEAR_VALUE, &depth);
    if ((mask & GL_COLOR_BUFFER_BIT) != 0)
        r->frame.frame.clear_colour = byte_from(colour[0]) | (uint32_t)byte_from(colour[1]) << 8 |
                                      (uint32_t)byte_from(colour[2]) << 16 | 0xFF000000u;
    if ((mask & GL_DEPTH_BUFFER_BIT) != 0)
        r->frame.frame.clear_depth = (uint32_t)((double)depth * FRAMES_DEPTH_MAX + 0.5);
}

/* Later, depth is cleared by a draw call of its own, colour by a quad. */
static void clear_within(recorder *r, GLbitfield mask)
{
    float colour[4] = { 0 }, depth = 1;
    r->state.gl.glGetFloatv(GL_COLOR_CLEAR_VALUE, colour);
    r->state.gl.glGetFloatv(GL_DEPTH_CLEAR_VALUE, &depth);
    if ((mask & GL_DEPTH_BUFFER_BIT) != 0)
        frame_builder_draw(
            &r->frame,
            &(fm_draw_call){ .flags = FM_DRAW_DEPTH_CLEAR,
                             .mask = 15,
                             .clear_depth = (uint32_t)((double)depth * FRAMES_DEPTH_MAX + 0.5) });
    if ((mask & GL_COLOR_BUFFER_BIT) == 0)
        return;
    const int32_t right = (int32_t)r->width_px * FRAMES_SUBPIXELS;
    const int32_t bottom = (int32_t)r->height_px * FRAMES_SUBPIXELS;
    const fm_corner a = { 0, 0, 0, 0, 0 }, b = { right, 0, 0, 0, 0 };
    const fm_corner c = { right, bottom, 0, 0, 0 }, d = { 0, bottom, 0, 0, 0 };
    uint32_t word = 0;
    memcpy(&word, colour, sizeof word);
    frame_builder_draw(&r->frame, &(fm_draw_call){ .mask = 15,
                                                   .alpha = 255,
                                                   .uniforms = word,
                                                   .vertices = 4,
                                                   .attribute_bytes = 144,
                                                   .scalars = 4,
                                                   .vertex_bytes = 16 });
    frame_builder_triangle(&r->frame, &(fm_triangle){ { a, b, c } });
    frame_builder_triangle(&r->frame, &(fm_triangle){ { a, c, d } });
}

RECORDED void glClear(GLbitfield mask)
{
    recorder *r = opened();
    if (judge(r) == RECORD) {
        if (r->frame.frame.draw_count == 0)
            clear_start(r, mask);
        else
            clear_within(r, mask);
    }
    r->state.gl.glClear(mask);
}

/* ---- uploads ---- */

RECORDED void glTexImage2D(GLenum target, GLint level, GLint internal, GLsizei width,
                           GLsizei height, GLint border, GLenum format, GLenum type,
                           const void *texels)
{
    recorder *r = opened();
    draw_state_uploaded(&r->state, target);
    r->state.gl.glTexImage2D(target, level, internal, width, height, border, format, type, texels);
}

RECORDED void glTexSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei width,
                              GLsizei height, GLenum format, GLenum type, const void *texels)
{
    recorder *r = opened();
    draw_state_uploaded(&r->state, target);
    r->state.gl.glTexSubImage2D(target, level, x, y, width, height, format, type, texels);
}

RECORDED void glCompressedTexImage2D(GLenum target, GLint level, GLenum internal, GLsizei width,
                                     GLsizei height, GLint border, GLsizei bytes,
                                     const void *texels)
{
    recorder *r = opened();
    draw_state_uploaded(&r->state, target);
    r->state.gl.glCompressedTexImage2D(target, level, internal, width, height, border, bytes,
                                       texels);
}

RECORDED void glCompressedTexSubImage2D(GLenum target, GLint level, GLint x, GLint y, GLsizei width,
                                        GLsizei height, GLenum format, GLsizei bytes,
                                        const void *texels)
{
    recorder *r = opened();
    draw_state_uploaded(&r->state, target);
    r->state.gl.glCompressedTexSubImage2D(target, level, x, y, width, height, format, bytes,
                                          texels);
}

RECORDED void glCopyTexImage2D(GLenum target, GLint level, GLenum internal, GLint x, GLint y,
                               GLsizei width, GLsizei height, GLint border)
{
    recorder *r = opened();
    draw_state_uploaded(&r->state, target);
    r->state.gl.glCopyTexImage2D(target, level, internal, x, y, width, height, border);
}

RECORDED void glCopyTexSubImage2D(GLenum target, GLint level, GLint to_x, GLint to_y, GLint x,
                                  GLint y, GLsizei width, GLsizei height)
{
    recorder *r = opened();
    draw_state_uploaded(&r->state, target);
    r->state.gl.glCopyTexSubImage2D(target, level, to_x, to_y, x, y, width, height);
}

/* ---- GLX ---- */

RECORDED void glXSwapBuffers(Display *display, GLXDrawable drawable)
{
    recorder *r = opened();
    end_frame(r);
    r->state.gl.glXSwapBuffers(display, drawable);
}

RECORDED __GLXextFuncPtr glXGetProcAddress(const GLubyte *name)
{
    const __GLXextFuncPtr own = own_call((const char *)name);
    if (own != NULL)
        return own;
    return opened()->state.gl.glXGetProcAddress(name);
}

RECORDED __GLXextFuncPtr glXGetProcAddressARB(const GLubyte *name)
{
    return glXGetProcAddress(name);
}
