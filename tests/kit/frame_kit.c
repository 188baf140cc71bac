#include "frame_kit.h"

#include <stdio.h>
#include <unistd.h>

#include "model/descriptor.h"

static void write_files(char folder[32], const kit_frames *frames)
{
    char path[64];
    assert_non_null(mkdtemp(folder));
    for (size_t i = 0; i < frames->file_count; i++) {
        const kit_file *file = &frames->files[i];
        snprintf(path, sizeof path, "%s/%s", folder, file->name);
        assert_int_equal(text_write_file(path, file->text, strlen(file->text), NULL), FM_OK);
    }
}

static void remove_files(const char *folder, const kit_frames *frames)
{
    char path[64];
    for (size_t i = 0; i < frames->file_count; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, frames->files[i].name);
        unlink(path);
    }
    rmdir(folder);
}

static fm_status look(frames_seen *seen, fm_device *device, fm_instance *instance,
                      const fm_method_desc *method, fm_error *err)
{
    const char *last = method->resources[resource_count(method) - 1].name;
    const fm_slot *slot = instance_slot(instance, last);
    seen->length = slot->length;
    fm_status status = device->ops->buffer_read(device, instance_slot(instance, "result")->buffer,
                                                0, &seen->result, sizeof seen->result, err);
    if (status == FM_OK)
        status = device->ops->buffer_read(device, slot->buffer, (slot->length - 1) * 4, &seen->last,
                                          sizeof seen->last, err);
    return status;
}

/* Memory of a new buffer holds anything, what an earlier one left there as well. */
static fm_status start_at_zero(fm_device *device, fm_instance *instance, fm_error *err)
{
    const uint32_t zero = 0;
    return device->ops->buffer_write(device, instance_slot(instance, "result")->buffer, 0, &zero,
                                     sizeof zero, err);
}

static void look_at_counts(frames_seen *seen, const fm_instance *instance,
                           const fm_method_desc *method)
{
    const char *name;
    assert_string_equal(instance_uncounted(instance), "");
    for (size_t i = 0; i < resource_count(method); i++)
        seen->has_counts = instance_accesses(&seen->accesses[i], &name, instance, i);
}

static fm_status run(frames_seen *seen, const kit_scene *scene, const kit_frames *frames,
                     const fm_shader_folders *folders, fm_error *err)
{
    fm_device *device = scene->kit->device;
    fm_settings settings = scene->scene->settings;
    fm_instance_desc desc = { .method = frames->method, .folders = *folders };
    fm_instance *instance = NULL;
    fm_frame_result result = { 0 };
    settings.buffers = frames->buffers;
    desc.counts_accesses = frames->counts;
    desc.settings = &settings;
    fm_status status =
        stage_create(&desc.stage, device, scene->scene, scene->truth, FM_FEED_RASTER, err);
    if (status == FM_OK)
        status = instance_create(&instance, &desc, err);
    if (status == FM_OK)
        status = start_at_zero(device, instance, err);
    for (int i = 0; i < (frames->frames > 0 ? frames->frames : 1) && status == FM_OK; i++)
        status = instance_frame(&result, instance, NULL, err);
    seen->redos = result.redos;
    if (status == FM_OK)
        look_at_counts(seen, instance, frames->method);
    if (status == FM_OK)
        status = look(seen, device, instance, frames->method, err);
    instance_destroy(instance);
    stage_destroy(desc.stage);
    return status;
}

fm_status frames_try(frames_seen *seen, fm_device *device, const kit_frames *frames, fm_error *err)
{
    char folder[32] = "/tmp/fm-instance-XXXXXX";
    scene_kit kit;
    kit_scene scene;
    *seen = (frames_seen){ 0 };
    write_files(folder, frames);
    kit_open(&kit, device);
    kit_scene_open(&scene, &kit,
                   frames->scene != NULL ? frames->scene : "width_px=3 height_px=2 n=0");
    const fm_shader_folders folders = { .method = folder, .common = kit.plugins.common_folder };
    const fm_status status = run(seen, &scene, frames, &folders, err);
    kit_scene_close(&scene);
    kit_close(&kit);
    remove_files(folder, frames);
    return status;
}

uint32_t frames_run(fm_device *device, const kit_frames *frames)
{
    frames_seen seen;
    fm_error err = { .message = "" };
    if (frames_try(&seen, device, frames, &err) != FM_OK)
        fail_msg("%s", err.message);
    return seen.result;
}
