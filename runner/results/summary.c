/* What stands in each column of summary.csv (model/columns.h) for one case. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/stats.h"
#include "decide/precision.h"
#include "model/columns.h"
#include "noise.h"
#include "summary_internal.h"

static const double clock_slack = 1.4; /* a canary above this many of the fastest is off clock */

static const char *method_version(const row_state *row)
{
    const bool is_open = row->plugin != NULL && row->plugin->plugin != NULL;
    const char *version = is_open ? row->plugin->plugin->method->version : NULL;
    return version != NULL ? version : "";
}

/* Parts stand one after the other. */
static void add_part(fm_text *message, const char *part)
{
    if (part[0] != '\0')
        text_add(message, "%s%s", message->length > 0 ? "; " : "", part);
}

/* "precision 2%: reached, 1.4% after 10 launches" */
static void write_precision(char *text, size_t room, const row_state *row)
{
    char wanted[FM_PATH_MAX_BYTES];
    const fm_interval frame_ms = summary_frames(row, FM_METRIC_FRAME_MS);
    const double half = 100.0 * precision_half_width(&frame_ms);
    const bool is_reached = half <= row->measured->settings.precision_percent;
    settings_text(wanted, &row->measured->settings, key_find("precision"));
    if (isnan(half))
        snprintf(text, room, "precision %.16s: no interval of frame_ms", wanted);
    else
        snprintf(text, room, "precision %.16s: %s, %.3g%% after %u launches", wanted,
                 is_reached ? "reached" : "not reached", half, row->result->done);
}

static void write_message(fm_text *text, const row_state *row)
{
    char part[96];
    fm_text message = { 0 };
    const uint32_t done = row->result->done, wanted = row->result->wanted;
    if (row->excluded > 0 && row->samples < FM_SAMPLES_WANTED) {
        snprintf(part, sizeof part, "unclear: only %zu samples at full clock", row->samples);
        add_part(&message, part);
    }
    if (done > 0 && done < wanted && !row->result->is_enough &&
        case_status_continues(row->result->status)) {
        snprintf(part, sizeof part, "%u of %u launches so far: the run is not finished", done,
                 wanted);
        add_part(&message, part);
    } else if (row->measured->settings.precision_percent > 0.0 && done > 0 &&
               case_status_continues(row->result->status)) {
        write_precision(part, sizeof part, row);
        add_part(&message, part);
    }
    add_part(&message, row->result->message);
    csv_add(text, message.bytes != NULL ? message.bytes : "");
    text_free(&message);
}

/* A key's value; empty where the method or the generator does not use it. */
static void write_key(fm_text *text, const row_state *row, const char *name)
{
    char value[FM_PATH_MAX_BYTES];
    const fm_key *key = key_find(name);
    const fm_settings *settings = &row->measured->settings;
    if (key == NULL || !key_is_read(key, settings->generator))
        return;
    settings_text(value, settings, key);
    if (strcmp(value, "none") != 0)
        csv_add(text, value);
}

/* n before truth was there is what the recipe says. */
static void write_case_metric(fm_text *text, const row_state *row, fm_metric metric)
{
    const json_t *value = summary_metric(row, metric);
    if (json_is_integer(value))
        text_add(text, "%lld", (long long)json_integer_value(value));
    else if (json_is_real(value))
        csv_add_real(text, json_real_value(value));
    else if (json_is_string(value))
        csv_add(text, json_string_value(value));
    else if (metric == FM_METRIC_N)
        write_key(text, row, fm_metrics[metric].name);
}

/* Layers tell their recipe; others, whose scene's name says it, only what an axis changed. */
static bool is_told(const fm_case *measured, size_t index, const fm_settings *defaults,
                    char value[FM_PATH_MAX_BYTES])
{
    char usual[FM_PATH_MAX_BYTES];
    const fm_key *key = &fm_keys[index];
    const fm_generator generator = measured->settings.generator;
    const bool is_scenes = key->scope == FM_SCOPE_SCENE && key_is_read(key, generator);
    const bool is_changed =
        is_scenes && generator != FM_GENERATOR_LAYERS && case_is_given(measured, key);
    const bool is_recipe = is_scenes && generator == FM_GENERATOR_LAYERS;
    if ((key->scope != FM_SCOPE_CASE && !is_recipe && !is_changed) ||
        summary_has_column(key->name) || strcmp(key->name, "generator") == 0)
        return false;
    settings_text(value, &measured->settings, key);
    settings_text(usual, defaults, key);
    return is_changed || strcmp(value, usual) != 0;
}

/* The method's own options, then whatever else is not as usual and has no column. */
static void write_options(fm_text *text, const row_state *row)
{
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

static void add_noise(fm_text *text, const row_state *row)
{
    const uint32_t launches = row->results->plan->launches;
    for (uint32_t i = 0; i < launches; i++)
        row->by_launch[i] = summary_median(row, FM_METRIC_FRAME_MS, i);
    noise_reasons(text, row->result, launches, row->by_launch);
}

static void write_noisy(fm_text *text, const row_state *row)
{
    fm_text reasons = { 0 };
    add_noise(&reasons, row);
    csv_add(text, reasons.bytes != NULL ? reasons.bytes : "");
    text->failed = text->failed || reasons.failed;
    text_free(&reasons);
}

static void write_code(fm_text *text, const row_state *row, fm_code_part part)
{
    char digits[17] = "";
    const size_t index = (size_t)(row->result - row->results->cases);
    const fm_code *code = codes_of(&row->results->codes, index);
    if (code != NULL)
        code_digits(digits, code_part(code, part));
    text_add(text, "%s", digits);
}

static void write_fact(fm_text *text, const row_state *row, fm_fact fact)
{
    switch (fact) {
    case FM_FACT_SCHEMA:
        csv_add(text, FM_SUMMARY_SCHEMA);
        break;
    case FM_FACT_CASE_ID:
        csv_add(text, row->measured->id);
        break;
    case FM_FACT_STATUS:
        csv_add(text, case_status_name(row->result->status));
        break;
    case FM_FACT_MESSAGE:
        write_message(text, row);
        break;
    case FM_FACT_METHOD:
        csv_add(text, row->measured->method);
        break;
    case FM_FACT_METHOD_VERSION:
        csv_add(text, method_version(row));
        break;
    case FM_FACT_DEVICE:
        csv_add(text, row->measured->device);
        break;
    case FM_FACT_DEVICE_NAME:
        csv_add(text, row->result->device_name);
        break;
    case FM_FACT_FEED:
        csv_add(text, row->measured->feed);
        break;
    case FM_FACT_SCENE:
        csv_add(text, row->measured->scene);
        break;
    case FM_FACT_OPTIONS:
        write_options(text, row);
        break;
    case FM_FACT_NOISY:
        write_noisy(text, row);
        break;
    case FM_FACT_CODE_PROGRAM:
        write_code(text, row, FM_CODE_PROGRAM);
        break;
    case FM_FACT_CODE_DRIVER:
        write_code(text, row, FM_CODE_DRIVER);
        break;
    case FM_FACT_CODE_PLUGIN:
        write_code(text, row, FM_CODE_PLUGIN);
        break;
    case FM_FACT_CODE_SHADERS:
        write_code(text, row, FM_CODE_SHADERS);
        break;
    case FM_FACT_REASON:
        csv_add(text, case_reason_name(row->result->reason));
        break;
    case FM_FACT_LIMITED_BY:
        csv_add(text, summary_limited_by(row));
        break;
    case FM_FACT_COUNT:
        break;
    }
}

/* The slowest frame has the lowest rate. */
static fm_interval fragments_per_s(const row_state *row)
{
    const json_t *fragments = summary_metric(row, FM_METRIC_FRAGMENTS_GENERATED);
    const fm_interval ms = summary_frames(row, FM_METRIC_FRAME_MS);
    if (!json_is_number(fragments) || !(ms.median > 0.0))
        return (fm_interval){ NAN, NAN, NAN };
    const double per_ms = json_number_value(fragments) * 1e3;
    return (fm_interval){ per_ms / ms.median, per_ms / ms.high, per_ms / ms.low };
}

/* A metric that has an interval, in the columns beside it. */
static fm_interval interval_of(const row_state *row, fm_metric metric)
{
    if (metric == FM_METRIC_TIMES_FLOOR)
        return summary_times_floor(row);
    if (metric == FM_METRIC_BOUND_MS)
        return summary_bound_ms(row);
    if (metric == FM_METRIC_TIMES_BOUND)
        return summary_times_bound(row);
    if (metric == FM_METRIC_DEVICE_BYTES_PER_S)
        return summary_limit(row, FM_LIMIT_COPY);
    if (metric == FM_METRIC_DEVICE_ATOMICS_PER_S)
        return summary_limit(row, FM_LIMIT_ATOMICS_OWN);
    if (metric == FM_METRIC_DEVICE_FRAGMENTS_PER_S)
        return summary_limit(row, FM_LIMIT_RASTER);
    if (metric == FM_METRIC_FRAGMENTS_PER_S)
        return fragments_per_s(row);
    return summary_frames(row, metric);
}

static void write_distinct_images(fm_text *text, const row_state *row)
{
    if (row->result->image_count > 0)
        text_add(text, "%zu", row->result->image_count);
}

static void write_frames_drawn(fm_text *text, const row_state *row)
{
    if (row->samples + row->excluded > 0)
        text_add(text, "%zu", row->samples + row->excluded);
}

/* A metric of launches: the largest. */
static double largest_of(const row_state *row, fm_metric metric)
{
    const size_t count = summary_gather(row, metric, UINT32_MAX);
    double largest = NAN;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, row->values[i]);
    return largest;
}

/* What follows from all launches of a case. */
static void write_summary_metric(fm_text *text, const row_state *row, fm_metric metric)
{
    if (metric == FM_METRIC_LAUNCHES)
        text_add(text, "%u", row->result->done);
    else if (metric == FM_METRIC_SAMPLES)
        text_add(text, "%zu", row->samples);
    else if (metric == FM_METRIC_DISTINCT_IMAGES)
        write_distinct_images(text, row);
    else if (metric == FM_METRIC_FRAMES_DRAWN)
        write_frames_drawn(text, row);
    else
        csv_add_real(text, interval_of(row, metric).median);
}

static void write_metric(fm_text *text, const row_state *row, fm_metric metric)
{
    switch (fm_metrics[metric].of) {
    case FM_OF_FRAME:
        csv_add_real(text, interval_of(row, metric).median);
        break;
    case FM_OF_CASE:
        write_case_metric(text, row, metric);
        break;
    case FM_OF_SUMMARY:
        write_summary_metric(text, row, metric);
        break;
    case FM_OF_LAUNCH:
        csv_add_real(text, largest_of(row, metric));
        break;
    case FM_OF_REPORT:
        break;
    }
}

static void write_column(fm_text *text, const row_state *row, const fm_column *column)
{
    switch (column->kind) {
    case FM_COLUMN_FACT:
        write_fact(text, row, column->fact);
        break;
    case FM_COLUMN_KEY:
        write_key(text, row, column->name);
        break;
    case FM_COLUMN_METRIC:
        write_metric(text, row, column->metric);
        break;
    case FM_COLUMN_LOW:
        csv_add_real(text, interval_of(row, column->metric).low);
        break;
    case FM_COLUMN_HIGH:
        csv_add_real(text, interval_of(row, column->metric).high);
        break;
    }
}

void summary_header(fm_text *text)
{
    for (int i = 0; i < FM_COLUMN_COUNT; i++)
        text_add(text, "%s%s", column_name(&fm_columns[i]), i + 1 < FM_COLUMN_COUNT ? "," : "\n");
}

void summary_off_clock(bool *is_off_clock, const fm_results *results, size_t case_index)
{
    const uint32_t frames = results->plan->frames;
    const fm_case_result *result = &results->cases[case_index];
    if (!result->has_gpu_clock)
        return;
    const double limit = clock_slack * results->fastest_canary_ns[result->device];
    for (size_t i = 0; i < result->sample_count; i++) {
        const fm_kept_sample *sample = &result->samples[i];
        if (sample->metric == FM_METRIC_CANARY_NS && sample->value > limit &&
            sample->frame < frames)
            is_off_clock[(size_t)sample->launch * frames + sample->frame] = true;
    }
}

static void count_frames(row_state *row)
{
    size_t all = 0;
    for (size_t i = 0; i < row->result->sample_count; i++)
        all += row->result->samples[i].metric == FM_METRIC_FRAME_MS;
    row->samples = summary_gather(row, FM_METRIC_FRAME_MS, UINT32_MAX);
    row->excluded = all - row->samples;
}

/* false: no memory. close_row also then. */
static bool open_row(row_state *row, const fm_results *results, size_t case_index)
{
    const fm_plan *plan = results->plan;
    const fm_case_result *result = &results->cases[case_index];
    const size_t room = result->sample_count + 1;
    *row = (row_state){
        .results = results,
        .measured = &plan->cases[case_index],
        .result = result,
        .plugin = plugin_list_find(results->plugins, plan->cases[case_index].method),
        .is_off_clock = calloc((size_t)plan->launches * plan->frames + 1, sizeof(bool)),
        .values = calloc(room, sizeof(double)),
        .groups = calloc(room, sizeof(uint32_t)),
        .by_launch = calloc((size_t)plan->launches + 1, sizeof(double)),
    };
    if (row->is_off_clock == NULL || row->values == NULL || row->groups == NULL ||
        row->by_launch == NULL)
        return false;
    summary_off_clock(row->is_off_clock, results, case_index);
    count_frames(row);
    return true;
}

static void close_row(row_state *row)
{
    free(row->is_off_clock);
    free(row->values);
    free(row->groups);
    free(row->by_launch);
}

void summary_row(fm_text *text, const fm_results *results, size_t case_index)
{
    row_state row = { 0 };
    if (!open_row(&row, results, case_index))
        text->failed = true;
    for (int i = 0; i < FM_COLUMN_COUNT && !text->failed; i++) {
        write_column(text, &row, &fm_columns[i]);
        text_add(text, i + 1 < FM_COLUMN_COUNT ? "," : "\n");
    }
    close_row(&row);
}

void summary_noise(fm_text *text, const fm_results *results, size_t case_index)
{
    row_state row = { 0 };
    if (open_row(&row, results, case_index))
        add_noise(text, &row);
    else
        text->failed = true;
    close_row(&row);
}

fm_status summary_half_width(double *half_width, bool *has_times, const fm_results *results,
                             size_t case_index, fm_error *err)
{
    row_state row = { 0 };
    fm_status status = FM_OK;
    *half_width = NAN;
    *has_times = false;
    if (open_row(&row, results, case_index)) {
        const fm_interval frame_ms = summary_frames(&row, FM_METRIC_FRAME_MS);
        *half_width = precision_half_width(&frame_ms);
        *has_times = !isnan(frame_ms.median);
    } else
        status = fm_fail(err, FM_NO_MEMORY, "no memory for the times of a case");
    close_row(&row);
    return status;
}
