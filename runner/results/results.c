#include "results.h"
#include "answer_check.h"
#include "base/clock.h"
#include "base/csv.h"
#include "base/file.h"
#include "base/text_index.h"
#include "simulator/counters.h"
#include "worker/protocol.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* results_write_summary_if_due says what they are for. */
enum { SUMMARY_PARTS = 64 };
static const double summary_pause_s = 2.0, summary_pause_times = 20.0;

static const char samples_header[] = "schema,run_id,case_id,launch,frame,metric,value,unit\n";

static fm_status append(const fm_results *results, const fm_text *text, fm_error *err)
{
    if (text->failed)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for its rows", results->samples_path);
    for (size_t done = 0; done < text->length;) {
        const ssize_t count = write(results->samples_fd, text->bytes + done, text->length - done);
        if (count < 0 && errno != EINTR)
            return fm_fail(err, FM_IO, "%s: %s", results->samples_path, strerror(errno));
        done += count > 0 ? (size_t)count : 0;
    }
    return FM_OK;
}

static fm_status create_cases(fm_results *results, fm_error *err)
{
    const fm_plan *plan = results->plan;
    results->cases = calloc(plan->count > 0 ? plan->count : 1, sizeof *results->cases);
    if (results->cases == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    for (size_t i = 0; i < plan->count; i++) {
        results->cases[i].launches = calloc(plan->launches, sizeof(fm_launch_state));
        if (results->cases[i].launches == NULL)
            return fm_fail(err, FM_NO_MEMORY, "no memory for %u launches", plan->launches);
        results->cases[i].wanted = plan_case_launches(plan, i);
        const fm_case *planned = &plan->cases[i];
        if (planned->skip != NULL) {
            results->cases[i].status = planned->skip_status;
            results->cases[i].reason = planned->skip_reason;
        }
        snprintf(results->cases[i].message, sizeof results->cases[i].message, "%s",
                 planned->skip != NULL ? planned->skip : "the run was stopped before its turn");
    }
    return FM_OK;
}

/* Cases of one device follow one another, or take turns with few others. */
static fm_status number_devices(fm_results *results, fm_error *err)
{
    const fm_plan *plan = results->plan;
    fm_text_index devices = { 0 };
    size_t count = 0;
    bool is_done = true;
    for (size_t i = 0; i < plan->count && is_done; i++) {
        results->cases[i].device = text_index_add(&devices, plan->cases[i].device, count);
        is_done = results->cases[i].device != FM_TEXT_INDEX_NONE;
        count += results->cases[i].device == count;
    }
    text_index_free(&devices);
    results->fastest_canary_ns = calloc(count + 1, sizeof *results->fastest_canary_ns);
    if (!is_done || results->fastest_canary_ns == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu devices", count);
    for (size_t i = 0; i < count; i++)
        results->fastest_canary_ns[i] = INFINITY;
    return FM_OK;
}

static fm_status begin_samples(fm_results *results, fm_error *err)
{
    fm_text header = { 0 };
    fm_status status = file_check_replaceable(results->samples_path, err);
    if (status == FM_OK)
        status = file_create(&results->samples_fd, results->new_path, err);
    if (status != FM_OK)
        return status;
    text_add(&header, "%s", samples_header);
    status = append(results, &header, err);
    text_free(&header);
    return status;
}

fm_status results_keep_replayed(fm_results *results, fm_error *err)
{
    if (rename(results->new_path, results->samples_path) != 0)
        return fm_fail(err, FM_IO, "%s: %s", results->samples_path, strerror(errno));
    results->new_path[0] = '\0';
    return FM_OK;
}

fm_status results_create(fm_results **results, const fm_plan *plan, const fm_plugin_list *plugins,
                         const char *directory, const char *run_id, fm_error *err)
{
    fm_status status;
    fm_results *created = calloc(1, sizeof *created);
    *results = NULL;
    if (created == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for results");
    created->plan = plan;
    created->plugins = plugins;
    created->samples_fd = -1;
    created->meshes = json_object();
    snprintf(created->run_id, sizeof created->run_id, "%s", run_id);
    status = path_join(created->summary_path, directory, "summary.csv", err);
    if (status == FM_OK)
        status = path_join(created->samples_path, directory, "samples.csv", err);
    if (status == FM_OK)
        status = path_join(created->new_path, directory, "samples.csv.partial", err);
    if (status == FM_OK)
        status = create_cases(created, err);
    if (status == FM_OK)
        status = codes_create(&created->codes, plan->count, err);
    if (status == FM_OK)
        status = number_devices(created, err);
    if (status == FM_OK)
        status = begin_samples(created, err);
    if (status == FM_OK)
        *results = created;
    else
        results_destroy(created);
    return status;
}

void results_destroy(fm_results *results)
{
    if (results == NULL)
        return;
    for (size_t i = 0; results->cases != NULL && i < results->plan->count; i++) {
        fm_case_result *result = &results->cases[i];
        json_decref(result->metrics);
        json_decref(result->modelled);
        for (uint32_t j = 0; result->launches != NULL && j < results->plan->launches; j++)
            free(result->launches[j].death);
        free(result->launches);
        free(result->samples);
        free(result->row);
        free(result->images);
    }
    free(results->cases);
    codes_free(&results->codes);
    free(results->fastest_canary_ns);
    json_decref(results->meshes);
    if (results->samples_fd >= 0) {
        close(results->samples_fd);
        if (results->new_path[0] != '\0')
            unlink(results->new_path);
    }
    free(results);
}

bool results_take_mesh(fm_results *results, const json_t *answer)
{
    json_t *mesh = answer_mesh(answer);
    const char *file = answer_mesh_file(mesh);
    if (file[0] == '\0' || json_object_get(results->meshes, file) != NULL)
        return false;
    return json_object_set(results->meshes, file, mesh) == 0;
}

static void add_sample_row(fm_text *rows, const fm_results *results, const char *case_id,
                           uint32_t launch, const fm_answer_sample *sample)
{
    text_add(rows, "1,%s,%s,%u,", results->run_id, case_id, launch);
    if (sample->frame != FM_FRAME_NONE)
        text_add(rows, "%u", sample->frame);
    text_add(rows, ",");
    csv_add(rows, sample->metric);
    text_add(rows, ",");
    csv_add_real(rows, sample->value);
    text_add(rows, ",");
    csv_add(rows, sample->unit);
    text_add(rows, "\n");
}

/* Metrics and their families have a unit; so have the simulated GPU's counters. */
static const char *unit_of(const char *name)
{
    const fm_metric_info *info = metric_describe(name);
    const tbr_counter_info *counter = counter_find(name);
    return info != NULL ? info->unit : counter != NULL ? counter->unit : "";
}

/* Metrics of the case that summary.csv has no column for: rows without launch and frame. */
static void add_metric_rows(fm_text *rows, const fm_results *results, const char *case_id,
                            json_t *metrics)
{
    const char *name;
    json_t *value;
    json_object_foreach(metrics, name, value)
    {
        if (summary_has_column(name) || !(json_is_number(value) || json_is_string(value)))
            continue;
        text_add(rows, "1,%s,%s,,,", results->run_id, case_id);
        csv_add(rows, name);
        text_add(rows, ",");
        if (json_is_integer(value))
            text_add(rows, "%lld", (long long)json_integer_value(value));
        else if (json_is_real(value))
            csv_add_real(rows, json_real_value(value));
        else
            csv_add(rows, json_string_value(value));
        text_add(rows, ",%s\n", unit_of(name));
    }
}

static fm_status keep_sample(fm_results *results, size_t case_index, uint32_t launch,
                             const fm_answer_sample *sample, fm_error *err)
{
    fm_metric metric;
    fm_case_result *result = &results->cases[case_index];
    double *fastest = &results->fastest_canary_ns[result->device];
    if (!metric_find(&metric, sample->metric))
        return FM_OK;
    if (metric == FM_METRIC_CANARY_NS && sample->value > 0.0)
        *fastest = fmin(*fastest, sample->value);
    if (result->sample_count == result->sample_room) {
        const size_t room = result->sample_room > 0 ? 2 * result->sample_room : 64;
        fm_kept_sample *grown = reallocarray(result->samples, room, sizeof *grown);
        if (grown == NULL)
            return fm_fail(err, FM_NO_MEMORY, "no memory for %zu samples", room);
        result->samples = grown;
        result->sample_room = room;
    }
    result->samples[result->sample_count++] = (fm_kept_sample){
        .value = sample->value,
        .launch = launch,
        .frame = sample->frame,
        .metric = metric,
    };
    return FM_OK;
}

/* What stands in the journal of an older run has none. */
static fm_status keep_launch(fm_text *rows, fm_results *results, size_t case_index, uint32_t launch,
                             const json_t *answer, fm_error *err)
{
    const char *name;
    json_t *value;
    fm_status status = FM_OK;
    json_object_foreach(answer_launch(answer), name, value)
    {
        fm_answer_sample sample = { .frame = FM_FRAME_NONE, .metric = name, .unit = unit_of(name) };
        answer_value(&sample.value, value);
        add_sample_row(rows, results, results->plan->cases[case_index].id, launch, &sample);
        if (status == FM_OK)
            status = keep_sample(results, case_index, launch, &sample, err);
    }
    return status;
}

static void keep_device(fm_case_result *kept, const json_t *answer)
{
    fm_answer_device device;
    if (!answer_device(&device, answer))
        return;
    snprintf(kept->device_name, sizeof kept->device_name, "%s", device.name);
    snprintf(kept->device_driver, sizeof kept->device_driver, "%s", device.driver);
    snprintf(kept->device_api, sizeof kept->device_api, "%s", device.api);
    kept->has_gpu_clock = device.has_gpu_clock;
    kept->is_software = device.is_software;
}

static void worsen(fm_case_result *kept, uint32_t launch, fm_case_status status, fm_reason reason,
                   const char *message)
{
    if (status < kept->status || (status == kept->status && kept->message[0] != '\0'))
        return;
    kept->status = status;
    kept->reason = reason;
    if (launch == 0 || message[0] == '\0')
        snprintf(kept->message, sizeof kept->message, "%s", message);
    else
        snprintf(kept->message, sizeof kept->message, "launch %u: %s", launch, message);
    /* Compilers' logs end with empty lines. */
    for (size_t length = strlen(kept->message); length > 0 && kept->message[length - 1] == '\n';)
        kept->message[--length] = '\0';
}

static fm_status keep_image(fm_case_result *kept, const char *digits, fm_error *err)
{
    const uint64_t hash = strtoull(digits != NULL ? digits : "", NULL, 16);
    for (size_t i = 0; i < kept->image_count; i++)
        if (kept->images[i] == hash)
            return FM_OK;
    uint64_t *grown = reallocarray(kept->images, kept->image_count + 1, sizeof *grown);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu images", kept->image_count + 1);
    kept->images = grown;
    kept->images[kept->image_count++] = hash;
    return FM_OK;
}

static fm_status keep_images(fm_case_result *kept, const json_t *answer, fm_error *err)
{
    size_t index;
    const json_t *hash;
    fm_status status = FM_OK;
    json_array_foreach(answer_image_hashes(answer), index, hash)
    {
        if (status == FM_OK)
            status = keep_image(kept, json_string_value(hash), err);
    }
    return status;
}

/* Only launch 0 is checked against truth. Where no depths tie, all images of an exact method are
 * that one; where some do, each launch compares its own with truth. */
static void compare_images(fm_results *results, size_t case_index, uint32_t launch)
{
    const fm_case *measured = &results->plan->cases[case_index];
    fm_case_result *kept = &results->cases[case_index];
    const fm_plugin_entry *entry = plugin_list_find(results->plugins, measured->method);
    const json_t *tied = json_object_get(kept->metrics, fm_metrics[FM_METRIC_TIED_PIXELS].name);
    if (launch == 0 || entry == NULL || entry->plugin == NULL || !json_is_integer(tied) ||
        json_integer_value(tied) > 0)
        return;
    const uint32_t traits = entry->plugin->method->traits;
    if ((traits & FM_TRAIT_EXACT) == 0 || (traits & FM_TRAIT_RACY) != 0)
        return;
    if (kept->image_count > 1)
        worsen(kept, launch, FM_CASE_WRONG_IMAGE, FM_REASON_NONE,
               "drew another image than the checked launch 0");
}

static fm_status keep(fm_results *results, size_t case_index, uint32_t launch, const json_t *answer,
                      fm_error *err)
{
    fm_case_result *kept = &results->cases[case_index];
    const fm_case_status status = answer_status(answer);
    size_t index;
    const json_t *sample;
    worsen(kept, launch, status, answer_reason(answer), answer_message(answer));
    keep_device(kept, answer);
    kept->launches[launch].is_done = true;
    kept->done++;
    const fm_status images = keep_images(kept, answer, err);
    if (images != FM_OK)
        return images;
    compare_images(results, case_index, launch);
    if (launch == 0) {
        kept->metrics = json_incref(answer_metrics(answer));
        kept->modelled = json_incref(answer_modelled(answer));
    }
    /* Times of a launch that went wrong stand for nothing. */
    if (!case_status_continues(status))
        return FM_OK;
    json_array_foreach(answer_samples(answer), index, sample)
    {
        const fm_answer_sample read = answer_sample(sample);
        const fm_status kept_status = keep_sample(results, case_index, launch, &read, err);
        if (kept_status != FM_OK)
            return kept_status;
    }
    return FM_OK;
}

static fm_status keep_code(fm_results *results, size_t case_index, const json_t *answer,
                           fm_error *err)
{
    fm_code code;
    const bool has_code = answer_code(&code, answer);
    const fm_status status = codes_add(&results->codes, case_index, has_code ? &code : NULL, err);
    code_free(&code);
    return status;
}

fm_status results_add(fm_results *results, size_t case_index, uint32_t launch, const json_t *answer,
                      fm_error *err)
{
    const char *case_id = results->plan->cases[case_index].id;
    fm_case_result *kept = &results->cases[case_index];
    fm_text rows = { 0 };
    size_t index;
    const json_t *sample;
    fm_status status = keep(results, case_index, launch, answer, err);
    if (status == FM_OK)
        status = keep_code(results, case_index, answer, err);
    if (status != FM_OK)
        return status;
    free(kept->row);
    kept->row = NULL;
    json_array_foreach(answer_samples(answer), index, sample)
    {
        const fm_answer_sample read = answer_sample(sample);
        add_sample_row(&rows, results, case_id, launch, &read);
    }
    status = keep_launch(&rows, results, case_index, launch, answer, err);
    if (launch == 0)
        add_metric_rows(&rows, results, case_id, kept->metrics);
    if (status == FM_OK)
        status = append(results, &rows, err);
    text_free(&rows);
    return status;
}

void results_want(fm_results *results, size_t case_index, uint32_t launches)
{
    fm_case_result *kept = &results->cases[case_index];
    kept->wanted = launches;
    free(kept->row); /* which says whether the case is finished */
    kept->row = NULL;
}

bool results_is_finished(const fm_results *results, size_t case_index)
{
    const fm_case_result *kept = &results->cases[case_index];
    return kept->is_enough || kept->done >= kept->wanted || !case_status_continues(kept->status);
}

static fm_status write_summary(fm_results *results, bool is_end, fm_error *err)
{
    fm_text all = { 0 };
    fm_status status = FM_OK;
    summary_header(&all);
    for (size_t i = 0; i < results->plan->count && status == FM_OK; i++) {
        fm_case_result *kept = &results->cases[i];
        if (kept->status == FM_CASE_SKIPPED && !is_end)
            continue;
        if (is_end || kept->row == NULL) {
            fm_text row = { 0 };
            summary_row(&row, results, i);
            if (row.failed)
                status = fm_fail(err, FM_NO_MEMORY, "no memory for a row of the summary");
            free(kept->row);
            kept->row = row.bytes;
        }
        if (status == FM_OK)
            text_add_raw(&all, kept->row, strlen(kept->row));
    }
    if (status == FM_OK && all.failed)
        status = fm_fail(err, FM_NO_MEMORY, "no memory for the summary");
    if (status == FM_OK)
        status = text_write_file(results->summary_path, all.bytes, all.length, err);
    text_free(&all);
    return status;
}

fm_status results_write_summary(fm_results *results, fm_error *err)
{
    results->unwritten = 0;
    return write_summary(results, false, err);
}

fm_status results_write_summary_if_due(fm_results *results, double now_s, fm_error *err)
{
    const double pause_s = fmax(summary_pause_s, summary_pause_times * results->took_s);
    results->unwritten++;
    if (results->unwritten * SUMMARY_PARTS < results->plan->count &&
        now_s - results->written_at_s < pause_s)
        return FM_OK;
    const double began_s = clock_s();
    const fm_status status = results_write_summary(results, err);
    results->took_s = clock_s() - began_s;
    results->written_at_s = now_s;
    return status;
}

static void add_off_clock_rows(fm_text *rows, bool *is_off_clock, const fm_results *results,
                               size_t case_index)
{
    const uint32_t frames = results->plan->frames;
    const size_t count = (size_t)results->plan->launches * frames;
    memset(is_off_clock, 0, count * sizeof *is_off_clock);
    summary_off_clock(is_off_clock, results, case_index);
    for (size_t i = 0; i < count; i++)
        if (is_off_clock[i])
            text_add(rows, "1,%s,%s,%zu,%zu,%s,1,\n", results->run_id,
                     results->plan->cases[case_index].id, i / frames, i % frames,
                     fm_metrics[FM_METRIC_OFF_CLOCK].name);
}

fm_status results_end(fm_results *results, fm_error *err)
{
    fm_text rows = { 0 };
    bool *is_off_clock =
        calloc((size_t)results->plan->launches * results->plan->frames + 1, sizeof *is_off_clock);
    if (is_off_clock == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %u launches", results->plan->launches);
    for (size_t i = 0; i < results->plan->count; i++)
        add_off_clock_rows(&rows, is_off_clock, results, i);
    fm_status status = append(results, &rows, err);
    if (status == FM_OK)
        status = write_summary(results, true, err);
    text_free(&rows);
    free(is_off_clock);
    return status;
}
