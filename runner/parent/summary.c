/* The columns of summary.csv, in their order: one line a column. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/stats.h"
#include "results.h"

enum { SAMPLES_WANTED = 5 };           /* fewer at full clock: no statement */
static const double clock_slack = 1.4; /* a canary above this many of the fastest is off clock */

/* What the columns of one row read. */
typedef struct row_state {
    const fm_results *results;
    const fm_case *measured;
    const fm_case_result *result;
    const fm_plugin_entry *plugin; /* may be NULL */
    fm_interval frame_ms;
    size_t samples, excluded; /* frames used and left out */
    const bool *is_off_clock; /* [launch * frames + frame] */
    double *values;           /* room for all samples */
    uint32_t *groups;
} row_state;

typedef struct summary_column {
    const char *name;
    void (*write)(fm_text *text, const row_state *row, const struct summary_column *column);
    int argument;
} summary_column;

static bool is_used(const row_state *row, const fm_kept_sample *sample)
{
    const uint32_t frames = row->results->plan->frames;
    return sample->frame >= frames ||
           !row->is_off_clock[(size_t)sample->launch * frames + sample->frame];
}

/* Gathers one metric's used samples of one launch, or of all with launch = UINT32_MAX. */
static size_t gather(const row_state *row, fm_sample_metric metric, uint32_t launch)
{
    size_t count = 0;
    for (size_t i = 0; i < row->result->sample_count; i++) {
        const fm_kept_sample *sample = &row->result->samples[i];
        if (sample->metric != metric || (launch != UINT32_MAX && sample->launch != launch) ||
            !is_used(row, sample))
            continue;
        row->values[count] = sample->value;
        row->groups[count++] = sample->launch;
    }
    return count;
}

static double median_of(const row_state *row, fm_sample_metric metric, uint32_t launch)
{
    return stats_median(row->values, gather(row, metric, launch));
}

static void write_schema(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)row, (void)column;
    text_add(text, "1");
}

static void write_text(fm_text *text, const row_state *row, const summary_column *column)
{
    const char *const texts[] = {
        row->measured->id,
        case_status_name(row->result->status),
        row->measured->method,
        row->plugin != NULL && row->plugin->plugin != NULL ? row->plugin->plugin->method->version
                                                           : "",
        row->measured->device,
        row->result->device_name,
        row->measured->feed,
        row->measured->scene,
    };
    csv_add(text, texts[column->argument] != NULL ? texts[column->argument] : "");
}

static void write_message(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)column;
    fm_text message = { 0 };
    if (row->excluded > 0 && row->samples < SAMPLES_WANTED)
        text_add(&message, "unclear: only %zu samples at full clock%s", row->samples,
                 row->result->message[0] != '\0' ? "; " : "");
    text_add(&message, "%s", row->result->message);
    csv_add(text, message.bytes != NULL ? message.bytes : "");
    text_free(&message);
}

/* A key's value; empty where the method or the generator does not use it. */
static void write_key(fm_text *text, const row_state *row, const summary_column *column)
{
    char value[FM_PATH_MAX_BYTES];
    const fm_key *key = key_find(column->name);
    const fm_settings *settings = &row->measured->settings;
    if (key == NULL || !key_is_read(key, settings->generator))
        return;
    settings_text(value, settings, key);
    if (strcmp(value, "none") != 0)
        csv_add(text, value);
}

static void write_metric(fm_text *text, const row_state *row, const summary_column *column)
{
    const json_t *value = json_object_get(row->result->metrics, column->name);
    if (json_is_integer(value))
        text_add(text, "%lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        csv_add_real(text, json_real_value(value));
    else if (json_is_string(value))
        csv_add(text, json_string_value(value));
}

/* As the truth counted, else as the recipe says. */
static void write_n(fm_text *text, const row_state *row, const summary_column *column)
{
    if (json_object_get(row->result->metrics, column->name) != NULL)
        write_metric(text, row, column);
    else
        write_key(text, row, column);
}

/* Layers tell their recipe; frames, whose scene's name says it, only what an axis changed. */
static bool is_told(const fm_case *measured, size_t index, const fm_settings *defaults,
                    char value[FM_PATH_MAX_BYTES])
{
    char usual[FM_PATH_MAX_BYTES];
    const fm_key *key = &fm_keys[index];
    const fm_generator generator = measured->settings.generator;
    const bool is_scenes = key->scope == FM_SCOPE_SCENE && key_is_read(key, generator);
    const bool is_changed =
        is_scenes && generator_makes_frames(generator) && measured->is_given[index];
    const bool is_recipe = is_scenes && generator == FM_GENERATOR_LAYERS;
    if ((key->scope != FM_SCOPE_CASE && !is_recipe && !is_changed) ||
        summary_has_column(key->name) || strcmp(key->name, "generator") == 0)
        return false;
    settings_text(value, &measured->settings, key);
    settings_text(usual, defaults, key);
    return is_changed || strcmp(value, usual) != 0;
}

/* The method's own options, then whatever else is not as usual and has no column. */
static void write_options(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)column;
    char value[FM_PATH_MAX_BYTES];
    fm_settings defaults;
    fm_text all = { 0 };
    settings_default(&defaults);
    for (size_t i = 0; i < row->measured->choice_count; i++)
        text_add(&all, "%s%s=%s", all.length > 0 ? " " : "", row->measured->choices[i].name,
                 row->measured->choices[i].value);
    for (size_t i = 0; i < fm_key_count; i++)
        if (is_told(row->measured, i, &defaults, value))
            text_add(&all, "%s%s=%s", all.length > 0 ? " " : "", fm_keys[i].name, value);
    csv_add(text, all.bytes != NULL ? all.bytes : "");
    text->failed = text->failed || all.failed;
    text_free(&all);
}

static void write_launches(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)column;
    text_add(text, "%u", row->result->done);
}

static void write_samples(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)column;
    text_add(text, "%zu", row->samples);
}

static void write_frame_ms(fm_text *text, const row_state *row, const summary_column *column)
{
    const double values[] = { row->frame_ms.median, row->frame_ms.low, row->frame_ms.high };
    csv_add_real(text, values[column->argument]);
}

static void write_median(fm_text *text, const row_state *row, const summary_column *column)
{
    csv_add_real(text, median_of(row, (fm_sample_metric)column->argument, UINT32_MAX));
}

/* Store time, or the frame's where that is all that is timed, over the floor's, launch by launch:
 * both ran in one process, moments apart. */
static void write_times_floor(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)column;
    const bool is_span = row->measured->settings.timers == FM_TIMERS_FRAME;
    size_t count = 0;
    double *ratios = calloc(row->results->plan->launches, sizeof *ratios);
    for (uint32_t i = 0; ratios != NULL && i < row->results->plan->launches; i++) {
        const double ms = median_of(row, is_span ? FM_SAMPLE_FRAME_MS : FM_SAMPLE_STORE_MS, i);
        const double floor_ms =
            median_of(row, is_span ? FM_SAMPLE_FLOOR_FRAME_MS : FM_SAMPLE_FLOOR_STORE_MS, i);
        if (!isnan(ms) && floor_ms > 0.0)
            ratios[count++] = ms / floor_ms;
    }
    if (ratios == NULL)
        text->failed = true;
    else
        csv_add_real(text, stats_median(ratios, count));
    free(ratios);
}

static void write_distinct_images(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)column;
    const fm_launch_state *launches = row->result->launches;
    unsigned distinct = 0;
    for (uint32_t i = 0; i < row->results->plan->launches; i++) {
        bool is_new = launches[i].image_hash[0] != '\0';
        for (uint32_t j = 0; j < i && is_new; j++)
            is_new = strcmp(launches[i].image_hash, launches[j].image_hash) != 0;
        distinct += is_new;
    }
    if (distinct > 0)
        text_add(text, "%u", distinct);
}

static void write_rate(fm_text *text, const row_state *row, const summary_column *column)
{
    (void)column;
    const json_t *fragments = json_object_get(row->result->metrics, "fragments_generated");
    if (json_is_number(fragments) && row->frame_ms.median > 0.0)
        csv_add_real(text, json_number_value(fragments) / (row->frame_ms.median / 1e3));
}

static const summary_column columns[] = {
    { "schema", write_schema, 0 },
    { "case_id", write_text, 0 },
    { "status", write_text, 1 },
    { "message", write_message, 0 },
    { "method", write_text, 2 },
    { "method_version", write_text, 3 },
    { "device", write_text, 4 },
    { "device_name", write_text, 5 },
    { "feed", write_text, 6 },
    { "scene", write_text, 7 },
    { "width_px", write_key, 0 },
    { "height_px", write_key, 0 },
    { "n", write_n, 0 },
    { "k", write_key, 0 },
    { "r", write_key, 0 },
    { "pixel_density", write_key, 0 },
    { "fragment_probability", write_key, 0 },
    { "tessellation", write_key, 0 },
    { "order", write_key, 0 },
    { "seed", write_key, 0 },
    { "options", write_options, 0 },
    { "launches", write_launches, 0 },
    { "samples", write_samples, 0 },
    { "frame_ms", write_frame_ms, 0 },
    { "frame_ms_low", write_frame_ms, 1 },
    { "frame_ms_high", write_frame_ms, 2 },
    { "clear_ms", write_median, FM_SAMPLE_CLEAR_MS },
    { "count_ms", write_median, FM_SAMPLE_COUNT_MS },
    { "reference_ms", write_median, FM_SAMPLE_REFERENCE_MS },
    { "store_ms", write_median, FM_SAMPLE_STORE_MS },
    { "resolve_ms", write_median, FM_SAMPLE_RESOLVE_MS },
    { "times_floor", write_times_floor, 0 },
    { "bytes_allocated", write_metric, 0 },
    { "bytes_predicted", write_metric, 0 },
    { "bytes_used", write_metric, 0 },
    { "fragments_generated", write_metric, 0 },
    { "fragments_stored", write_metric, 0 },
    { "fragments_lost", write_metric, 0 },
    { "missing", write_metric, 0 },
    { "extra", write_metric, 0 },
    { "misordered", write_metric, 0 },
    { "depth_ulp_max", write_metric, 0 },
    { "rmse", write_metric, 0 },
    { "psnr_db", write_metric, 0 },
    { "max_abs", write_metric, 0 },
    { "ssim", write_metric, 0 },
    { "flip", write_metric, 0 },
    { "truncation_rmse", write_metric, 0 },
    { "distinct_images", write_distinct_images, 0 },
    { "frame_wall_ms", write_median, FM_SAMPLE_FRAME_WALL_MS },
    { "fragments_per_s", write_rate, 0 },
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

bool summary_has_column(const char *name)
{
    for (int i = 0; i < COLUMN_COUNT; i++)
        if (strcmp(columns[i].name, name) == 0)
            return true;
    return false;
}

void summary_header(fm_text *text)
{
    for (int i = 0; i < COLUMN_COUNT; i++)
        text_add(text, "%s%s", columns[i].name, i + 1 < COLUMN_COUNT ? "," : "\n");
}

/* The fastest canary of the run on this device; INFINITY when there is none. */
static double fastest_canary(const fm_results *results, const char *device)
{
    double fastest = INFINITY;
    for (size_t i = 0; i < results->plan->count; i++) {
        if (strcmp(results->plan->cases[i].device, device) != 0)
            continue;
        for (size_t j = 0; j < results->cases[i].sample_count; j++) {
            const fm_kept_sample *sample = &results->cases[i].samples[j];
            if (sample->metric == FM_SAMPLE_CANARY_NS && sample->value > 0.0)
                fastest = fmin(fastest, sample->value);
        }
    }
    return fastest;
}

void summary_off_clock(bool *is_off_clock, const fm_results *results, size_t case_index)
{
    const uint32_t frames = results->plan->frames;
    const fm_case_result *result = &results->cases[case_index];
    if (!result->has_gpu_clock)
        return;
    const double limit =
        clock_slack * fastest_canary(results, results->plan->cases[case_index].device);
    for (size_t i = 0; i < result->sample_count; i++) {
        const fm_kept_sample *sample = &result->samples[i];
        if (sample->metric == FM_SAMPLE_CANARY_NS && sample->value > limit &&
            sample->frame < frames)
            is_off_clock[(size_t)sample->launch * frames + sample->frame] = true;
    }
}

static void count_frames(row_state *row)
{
    size_t all = 0;
    for (size_t i = 0; i < row->result->sample_count; i++)
        all += row->result->samples[i].metric == FM_SAMPLE_FRAME_MS;
    row->samples = gather(row, FM_SAMPLE_FRAME_MS, UINT32_MAX);
    row->excluded = all - row->samples;
}

void summary_row(fm_text *text, const fm_results *results, size_t case_index)
{
    const fm_plan *plan = results->plan;
    const fm_case_result *result = &results->cases[case_index];
    const size_t room = result->sample_count + 1;
    bool *is_off_clock = calloc((size_t)plan->launches * plan->frames + 1, sizeof *is_off_clock);
    row_state row = {
        .results = results,
        .measured = &plan->cases[case_index],
        .result = result,
        .plugin = plugin_list_find(results->plugins, plan->cases[case_index].method),
        .is_off_clock = is_off_clock,
        .values = calloc(room, sizeof(double)),
        .groups = calloc(room, sizeof(uint32_t)),
    };
    if (is_off_clock == NULL || row.values == NULL || row.groups == NULL) {
        text->failed = true;
        goto out;
    }
    summary_off_clock(is_off_clock, results, case_index);
    count_frames(&row);
    const fm_samples samples = { row.values, row.groups, row.samples, plan->launches };
    row.frame_ms = stats_bootstrap(&samples, plan->seed);
    for (int i = 0; i < COLUMN_COUNT; i++) {
        columns[i].write(text, &row, &columns[i]);
        text_add(text, i + 1 < COLUMN_COUNT ? "," : "\n");
    }
out:
    free(is_off_clock);
    free(row.values);
    free(row.groups);
}
