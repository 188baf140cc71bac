/* Capturing truth: two passes over the fragments (count, store), in bands of pixels; on the device
 * by raster passes of the runner's own, on the host for the feed `triangles`. */
#include "truth_capture.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "instance/instance.h"
#include "scene/layers.h"
#include "truth/kept_file.h"
#include "truth/truth_triangles.h"

/* Records of one band: 128 MiB, what the smallest device binds in one buffer. */
enum { BAND_RECORDS = 8 << 20 };

static const fm_method_desc count_method = {
    .id = "truth",
    .resources = { { .name = "counts", .extent = { .per_pixel = 1 } } },
    .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "counts" } },
                { .name = "count", .shader = "common/truth_count.glsl", .writes = { "counts" } } },
};

static const fm_method_desc store_method = {
    .id = "truth",
    .resources = { { .name = "cursors", .extent = { .per_pixel = 1 } },
                   { .name = "records",
                     .element = FM_ELEMENT_UVEC4,
                     .extent = { .constant = BAND_RECORDS } } },
    .passes = { { .name = "store",
                  .shader = "common/truth_store.glsl",
                  .writes = { "cursors", "records" } } },
};

typedef struct truth_run {
    fm_device *device;
    const fm_scene *scene;
    fm_stage *stage;
    fm_shader_folders folders;
    uint64_t pixels;
    uint32_t *counts;
    uint64_t *offsets; /* [pixels + 1] */
    uint32_t *cursors;
    truth_record *records; /* of a band */
    fm_fragment *sorted;   /* of a band */
    uint32_t *arrival;     /* of a band */
    bool keeps_arrival;
    bool is_known; /* in closed form, and that has not been wrong */
    bool by_host;  /* no stage, no instances */
    uint32_t n;
    fm_error *err;
} truth_run;

static fm_status create_instance(fm_instance **instance, truth_run *capture,
                                 const fm_method_desc *method)
{
    const fm_instance_desc desc = { .stage = capture->stage,
                                    .method = method,
                                    .folders = capture->folders,
                                    .settings = &capture->scene->settings,
                                    .wants_primitive = method == &store_method };
    return instance_create(instance, &desc, capture->err);
}

static fm_status count_on_device(truth_run *capture)
{
    fm_instance *instance;
    fm_frame_result result;
    fm_status status = create_instance(&instance, capture, &count_method);
    if (status == FM_OK)
        status = instance_frame(&result, instance, NULL, capture->err);
    if (status == FM_OK)
        status = capture->device->ops->buffer_read(
            capture->device, instance_slot(instance, "counts")->buffer, 0, capture->counts,
            capture->pixels * sizeof capture->counts[0], capture->err);
    instance_destroy(instance);
    return status;
}

static fm_status count_fragments(truth_run *capture)
{
    fm_status status = FM_OK;
    if (capture->by_host)
        truth_count_triangles(capture->counts, capture->scene);
    else
        status = count_on_device(capture);
    for (uint64_t i = 0; i < capture->pixels && status == FM_OK; i++) {
        capture->offsets[i + 1] = capture->offsets[i] + capture->counts[i];
        capture->n = capture->counts[i] > capture->n ? capture->counts[i] : capture->n;
    }
    return status;
}

static int by_primitive(const void *a, const void *b)
{
    const truth_record *left = a, *right = b;
    return (left->primitive > right->primitive) - (left->primitive < right->primitive);
}

static int by_depth(const void *a, const void *b)
{
    const truth_record *left = a, *right = b;
    if (left->depth_bits != right->depth_bits)
        return left->depth_bits > right->depth_bits ? 1 : -1;
    return by_primitive(a, b);
}

/* `unused` carries the rank of arrival through the second sort. */
static void sort_pixel(const truth_run *capture, truth_record *records, uint32_t count, uint64_t at)
{
    if (capture->keeps_arrival) {
        qsort(records, count, sizeof *records, by_primitive);
        for (uint32_t i = 0; i < count; i++)
            records[i].unused = i;
    }
    qsort(records, count, sizeof *records, by_depth);
    for (uint32_t i = 0; i < count; i++) {
        memcpy(&capture->sorted[at + i].depth, &records[i].depth_bits, sizeof(float));
        capture->sorted[at + i].colour = records[i].colour;
        if (capture->keeps_arrival)
            capture->arrival[at + records[i].unused] = i;
    }
}

static void sort_band(const truth_run *capture, const fm_band *band)
{
    const uint64_t base = capture->offsets[band->first];
    for (uint64_t i = band->first; i < (uint64_t)band->first + band->pixels; i++)
        sort_pixel(capture, capture->records + (capture->offsets[i] - base), capture->counts[i],
                   capture->offsets[i] - base);
}

/* As many pixels from `first` on as fit into one band. */
static fm_status next_band(fm_band *band, const truth_run *capture, uint64_t first)
{
    uint64_t last = first;
    while (last < capture->pixels &&
           capture->offsets[last + 1] - capture->offsets[first] <= BAND_RECORDS)
        last++;
    if (last == first)
        return fm_refuse(capture->err, FM_REASON_SUITE_LIMIT,
                         "truth: a pixel has %u fragments, the most is %d", capture->counts[first],
                         BAND_RECORDS);
    *band = (fm_band){ .first = (uint32_t)first, .pixels = (uint32_t)(last - first) };
    return FM_OK;
}

static fm_status store_on_device(truth_run *capture, fm_instance *instance, const fm_band *band,
                                 uint64_t count)
{
    const fm_device_ops *ops = capture->device->ops;
    fm_frame_result result;
    fm_status status = ops->buffer_write(
        capture->device, instance_slot(instance, "cursors")->buffer, 0, capture->cursors,
        capture->pixels * sizeof capture->cursors[0], capture->err);
    if (status == FM_OK)
        status = instance_frame(&result, instance, band, capture->err);
    if (status == FM_OK && count > 0)
        status = ops->buffer_read(capture->device, instance_slot(instance, "records")->buffer, 0,
                                  capture->records, count * sizeof(truth_record), capture->err);
    return status;
}

static fm_status store_band(truth_run *capture, fm_instance *instance, const fm_band *band)
{
    const uint64_t base = capture->offsets[band->first];
    const truth_band wanted = { band->first, band->pixels, capture->records, capture->cursors };
    fm_status status = FM_OK;
    for (uint64_t i = 0; i < capture->pixels; i++)
        capture->cursors[i] = (uint32_t)(capture->offsets[i] - base);
    if (capture->by_host)
        truth_store_triangles(&wanted, capture->scene);
    else
        status = store_on_device(capture, instance, band,
                                 capture->offsets[band->first + band->pixels] - base);
    if (status == FM_OK)
        sort_band(capture, band);
    return status;
}

/* Fills `sorted` from the closed form; false if a pixel has not as many as the device counted. */
static bool recall_band(const truth_run *capture, fm_fragment *sorted, const fm_band *band)
{
    const uint64_t base = capture->offsets[band->first];
    for (uint64_t i = band->first; i < (uint64_t)band->first + band->pixels; i++)
        if (layers_sorted(sorted + (capture->offsets[i] - base), capture->scene,
                          (uint32_t)(i % capture->scene->width_px),
                          (uint32_t)(i / capture->scene->width_px)) != capture->counts[i])
            return false;
    return true;
}

/* The closed form against what is in `sorted`, bit by bit. The records are done with. */
static bool is_recalled(const truth_run *capture, const fm_band *band, size_t count)
{
    fm_fragment *recalled = (fm_fragment *)(void *)capture->records;
    return recall_band(capture, recalled, band) &&
           memcmp(recalled, capture->sorted, count * sizeof *recalled) == 0;
}

static fm_status fill_band(truth_run *capture, fm_instance *instance, const fm_band *band)
{
    const size_t count =
        (size_t)(capture->offsets[band->first + band->pixels] - capture->offsets[band->first]);
    if (capture->is_known && band->first > 0 && recall_band(capture, capture->sorted, band))
        return FM_OK;
    const fm_status status = store_band(capture, instance, band);
    if (status == FM_OK && capture->is_known)
        capture->is_known = is_recalled(capture, band, count);
    return status;
}

static void write_band(kept_writer *file, const truth_run *capture, const fm_band *band)
{
    const uint64_t base = capture->offsets[band->first];
    const uint64_t end = (uint64_t)band->first + band->pixels;
    for (uint64_t i = band->first; i < end; i++)
        kept_add_list(file, capture->sorted + (capture->offsets[i] - base), capture->counts[i]);
    if (capture->keeps_arrival)
        kept_add_words(file, capture->arrival, (size_t)(capture->offsets[end] - base));
}

static fm_status store_fragments(truth_run *capture, kept_writer *file)
{
    fm_instance *instance = NULL;
    fm_band band = { 0 };
    fm_status status =
        capture->by_host ? FM_OK : create_instance(&instance, capture, &store_method);
    for (uint64_t first = 0; first < capture->pixels && status == FM_OK; first += band.pixels) {
        status = next_band(&band, capture, first);
        if (status == FM_OK)
            status = fill_band(capture, instance, &band);
        if (status == FM_OK)
            write_band(file, capture, &band);
    }
    instance_destroy(instance);
    return status;
}

static fm_status allocate(truth_run *capture)
{
    capture->counts = calloc(capture->pixels, sizeof capture->counts[0]);
    capture->offsets = calloc(capture->pixels + 1, sizeof capture->offsets[0]);
    capture->cursors = calloc(capture->pixels, sizeof capture->cursors[0]);
    /* The closed form may offer a pixel of n more than the device counted. */
    capture->records = calloc((size_t)BAND_RECORDS + capture->scene->n, sizeof capture->records[0]);
    capture->sorted = calloc((size_t)BAND_RECORDS + capture->scene->n, sizeof capture->sorted[0]);
    if (capture->keeps_arrival)
        capture->arrival = calloc(BAND_RECORDS, sizeof capture->arrival[0]);
    if (capture->counts == NULL || capture->offsets == NULL || capture->cursors == NULL ||
        capture->records == NULL || capture->sorted == NULL ||
        (capture->keeps_arrival && capture->arrival == NULL))
        return fm_fail(capture->err, FM_NO_MEMORY, "truth of %" PRIu64 " pixels", capture->pixels);
    return FM_OK;
}

static void release(truth_run *capture)
{
    stage_destroy(capture->stage);
    free(capture->counts);
    free(capture->offsets);
    free(capture->cursors);
    free(capture->records);
    free(capture->sorted);
    free(capture->arrival);
}

static fm_status write_file(truth_run *capture, const char *path)
{
    kept_writer file = { .out = NULL };
    const kept_header header = { .kind = KEPT_TRUTH,
                                 .width_px = capture->scene->width_px,
                                 .height_px = capture->scene->height_px,
                                 .list_count = capture->pixels };
    fm_status status = count_fragments(capture);
    if (status == FM_OK)
        status = kept_begin(&file, path, &header, capture->err);
    if (status == FM_OK)
        status = store_fragments(capture, &file);
    return kept_finish(&file, status, capture->err);
}

fm_status truth_capture(const char *path, fm_device *device, const fm_scene *scene, uint32_t feed,
                        const fm_shader_folders *folders, fm_error *err)
{
    const bool by_host = feed == FM_FEED_TRIANGLES;
    /* Flat layers replay from the recipe; only other scenes need the order of arrival. */
    const bool is_flat = layers_are_flat(&scene->settings);
    truth_run capture = { .device = device,
                          .scene = scene,
                          .folders = *folders,
                          .pixels = (uint64_t)scene->width_px * scene->height_px,
                          .keeps_arrival = !is_flat && !by_host,
                          .is_known = is_flat && !by_host && !layers_may_tie(&scene->settings),
                          .by_host = by_host,
                          .err = err };
    fm_status status = allocate(&capture);
    if (status == FM_OK && !by_host)
        status = stage_create(&capture.stage, device, scene, NULL, FM_FEED_RASTER, err);
    if (status == FM_OK)
        status = write_file(&capture, path);
    release(&capture);
    return status;
}
