#include "kernels.h"

#include "stage/shader.h"
#include "stage/stage.h"

enum {
    COPY_PASSES = 4,
    EMPTY_PASSES = 64,
    TURNS = 16,                    /* atomics of an invocation */
    SMALLEST_INVOCATIONS = 1 << 14 /* of kernel_atomics */
};
#define COPY_BYTES_GPU      (256ull << 20) /* several times what a GPU's caches hold */
#define COPY_BYTES_SOFTWARE (64ull << 20)

static const char invocation[] =
    "uint invocation()\n{\n"
    "    return gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x)\n"
    "        + gl_GlobalInvocationID.x;\n}\n";

static fm_status create_buffer(fm_buffer **buffer, fm_device *device, const char *name,
                               uint64_t bytes, fm_error *err)
{
    const fm_buffer_desc desc = { .name = name, .bytes = bytes, .owner = FM_OWNER_RUNNER };
    return device->ops->buffer_create(buffer, device, &desc, err);
}

/* main and declarations stand behind what all shaders begin with. */
static fm_status create_pipeline(kernel *made, const char *name, uint32_t features,
                                 const char *rest, fm_error *err)
{
    fm_text text = { 0 };
    fm_pipeline_desc desc = { .name = name };
    shader_begin(&text, &made->device->caps, features);
    text_add(&text, "layout(local_size_x = %d) in;\n%s%s", STAGE_GROUP_SIZE, invocation, rest);
    for (uint32_t i = 0; i < 2; i++)
        if (made->buffers[i] != NULL)
            desc.bindings[desc.binding_count++] = (fm_pipeline_binding){ i, FM_BINDING_STORAGE };
    desc.compute = text.bytes;
    const fm_status status =
        text.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", name)
                    : made->device->ops->pipeline_create(&made->pipeline, made->device, &desc, err);
    text_free(&text);
    return status;
}

fm_status kernel_copy(kernel *made, fm_device *device, fm_error *err)
{
    static const char shader[] = "layout(std430, binding = 0) readonly buffer from_block { uvec4 "
                                 "from[]; };\n"
                                 "layout(std430, binding = 1) writeonly buffer to_block { uvec4 "
                                 "to[]; };\n"
                                 "void main()\n{\n    to[invocation()] = from[invocation()];\n}\n";
    const fm_device_caps *caps = &device->caps;
    uint64_t bytes = caps->is_software ? COPY_BYTES_SOFTWARE : COPY_BYTES_GPU;
    while (bytes > caps->storage_range_bytes ||
           (caps->memory_bytes > 0 && bytes > caps->memory_bytes / 8))
        bytes /= 2;
    const uint64_t invocations = bytes / 16 / STAGE_GROUP_SIZE * STAGE_GROUP_SIZE;
    *made = (kernel){ .device = device, .passes = COPY_PASSES };
    made->units = (double)invocations * 16 * 2 * COPY_PASSES;
    fm_status status = stage_groups(made->groups, caps, invocations, err);
    for (int i = 0; i < 2 && status == FM_OK; i++)
        status = create_buffer(&made->buffers[i], device, "copied", bytes, err);
    return status == FM_OK ? create_pipeline(made, "copying", 0, shader, err) : status;
}

fm_status kernel_atomics(kernel *made, fm_device *device, uint32_t word_bytes, uint32_t lanes,
                         uint32_t scale, fm_error *err)
{
    const bool is_wide = word_bytes == 8;
    const uint64_t invocations = (uint64_t)SMALLEST_INVOCATIONS << 2 * scale;
    char shader[512];
    *made = (kernel){ .device = device, .passes = 1 };
    if (is_wide && (device->caps.features & FM_FEATURE_INT64_ATOMICS) == 0)
        return fm_refuse(err, FM_REASON_FEATURE, "no 64-bit atomics");
    made->units = (double)invocations * TURNS;
    /* Nothing reads the sums: any order will do. */
    snprintf(shader, sizeof shader,
             "layout(std430, binding = 0) buffer word_block { %s words[]; };\n"
             "void main()\n{\n    uint i = %s;\n"
             "    FM_LOOP for (uint turn = 0u; turn < %uu; ++turn)\n"
             "        atomicAdd(words[i], %s);\n}\n",
             is_wide ? "uint64_t" : "uint",
             lanes == 0   ? "0u"
             : lanes == 1 ? "invocation()"
                          : "invocation() / 32u",
             (unsigned)TURNS, is_wide ? "1ul" : "1u");
    fm_status status = stage_groups(made->groups, &device->caps, invocations, err);
    if (status == FM_OK)
        status = create_buffer(&made->buffers[0], device, "words", invocations * word_bytes, err);
    return status == FM_OK ? create_pipeline(made, "atomics",
                                             is_wide ? FM_FEATURE_INT64_ATOMICS : 0, shader, err)
                           : status;
}

fm_status kernel_dispatch(kernel *made, fm_device *device, fm_error *err)
{
    static const char shader[] = "layout(std430, binding = 0) buffer word_block { uint words[]; "
                                 "};\nvoid main()\n{\n}\n";
    *made = (kernel){
        .device = device, .passes = EMPTY_PASSES, .groups = { 1, 1, 1 }, .units = EMPTY_PASSES
    };
    const fm_status status = create_buffer(&made->buffers[0], device, "words", 64, err);
    return status == FM_OK ? create_pipeline(made, "a pass of nothing", 0, shader, err) : status;
}

void kernel_timer(kernel *made, fm_device *device)
{
    *made = (kernel){ .device = device, .units = 1 };
}

void kernel_free(kernel *made)
{
    if (made->device == NULL)
        return;
    made->device->ops->pipeline_destroy(made->device, made->pipeline);
    for (int i = 0; i < 2; i++)
        made->device->ops->buffer_destroy(made->device, made->buffers[i]);
    *made = (kernel){ 0 };
}

static fm_status dispatch(const kernel *of, uint32_t pass, fm_error *err)
{
    fm_bind binds[2];
    fm_dispatch dispatch = { .pipeline = of->pipeline, .binds = binds };
    for (uint32_t i = 0; i < 2; i++) {
        fm_buffer *buffer = of->buffers[of->buffers[1] != NULL ? (i + pass) % 2 : i];
        if (buffer != NULL)
            binds[dispatch.bind_count++] = (fm_bind){ .binding = i,
                                                      .kind = FM_BINDING_STORAGE,
                                                      .buffer = buffer,
                                                      .access = FM_ACCESS_READ | FM_ACCESS_WRITE };
    }
    for (int i = 0; i < 3; i++)
        dispatch.groups[i] = of->groups[i];
    return of->device->ops->dispatch(of->device, &dispatch, err);
}

fm_status kernel_run(uint64_t *ns, const kernel *of, fm_error *err)
{
    const fm_device_ops *ops = of->device->ops;
    fm_frame_times times;
    fm_error ignored;
    fm_status status = ops->frame_begin(of->device, err);
    if (status != FM_OK)
        return status;
    ops->timer_begin(of->device, 0);
    for (uint32_t i = 0; i < of->passes && status == FM_OK; i++)
        status = dispatch(of, i, err);
    ops->timer_end(of->device, 0);
    /* After an error the frame that is open must still be ended, and the first error stays. */
    const fm_status ended = ops->frame_end(of->device, &times, status == FM_OK ? err : &ignored);
    if (status == FM_OK)
        status = ended;
    *ns = times.timer_ns[0];
    return status;
}
