#include "flip_kit.h"

#include <unistd.h>

#include "base/csv.h"
#include "cli/cli.h"
#include "model/columns.h"

/* What the program prints for this spec. */
static json_t *plan_of(const char *program, const char *spec)
{
    char command[1200];
    json_error_t error;
    snprintf(command, sizeof command, "'%s' plan -q --json '%s' 2>/dev/null", program, spec);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    json_t *plan = json_loadf(pipe, 0, &error);
    pclose(pipe);
    if (plan == NULL)
        fail_msg("%s: %s", command, error.text);
    return plan;
}

/* Equal cases of several blocks are one. */
static void add_cases(json_t *all, json_t *plan)
{
    json_t *one, *old;
    size_t i, j;
    json_array_foreach(json_object_get(plan, "cases"), i, one)
    {
        bool is_new = true;
        json_array_foreach(all, j, old) is_new &=
            !json_equal(json_object_get(old, "case_id"), json_object_get(one, "case_id"));
        if (is_new)
            json_array_append(all, one);
    }
}

static void plan_figure(flip_cases *made, const char *path, const char *program)
{
    fm_figure figure = { .id = "" };
    fm_text_list specs = { 0 };
    snprintf(figure.id, sizeof figure.id, "%s", made->figure->id);
    snprintf(figure.path, sizeof figure.path, "%s", path);
    if (made->figure->file.run != NULL)
        assert_int_equal(
            figure_write_specs(&specs, made->directory, &figure, FM_FIGURE_LARGE, NULL), FM_OK);
    for (size_t i = 0; i < specs.count; i++) {
        json_t *plan = plan_of(program, specs.items[i]);
        add_cases(made->cases, plan);
        json_decref(plan);
        unlink(specs.items[i]);
    }
    text_list_free(&specs);
}

bool flip_open(flip_cases *made, const char *path, const char *program)
{
    fm_error err = { 0 };
    *made = (flip_cases){ .directory = "/tmp/fragmark-flip-XXXXXX" };
    if (paper_figure_read(&made->figure, path, &err) != FM_OK)
        fail_msg("%s", err.message);
    if (made->figure->claim_count == 0) {
        paper_figure_close(made->figure);
        return false;
    }
    char images[96];
    made->cases = json_array();
    assert_non_null(mkdtemp(made->directory));
    snprintf(images, sizeof images, "%s/images", made->directory);
    assert_int_equal(mkdir(images, 0777), 0);
    plan_figure(made, path, program);
    return true;
}

void flip_close(flip_cases *made)
{
    kit_remove_directory(made->directory);
    json_decref(made->cases);
    paper_figure_close(made->figure);
}

void flip_numbers_open(flip_numbers *made, size_t row_count)
{
    *made = (flip_numbers){ .row_count = row_count };
}

void flip_numbers_close(flip_numbers *made)
{
    text_list_free(&made->metrics);
    free(made->values);
}

double *flip_number(flip_numbers *numbers, const char *metric, size_t row)
{
    const size_t room = numbers->row_count + 1;
    size_t index = 0;
    while (index < numbers->metrics.count && strcmp(numbers->metrics.items[index], metric) != 0)
        index++;
    if (index == numbers->metrics.count) {
        assert_true(text_list_add(&numbers->metrics, metric));
        numbers->values = reallocarray(numbers->values, (index + 1) * room, sizeof(double));
        assert_non_null(numbers->values);
        for (size_t i = 0; i < room; i++)
            numbers->values[index * room + i] = NAN;
    }
    return &numbers->values[index * room + row];
}

static double number_at(const flip_numbers *numbers, const char *metric, size_t row)
{
    for (size_t i = 0; i < numbers->metrics.count; i++)
        if (strcmp(numbers->metrics.items[i], metric) == 0)
            return numbers->values[i * (numbers->row_count + 1) + row];
    return NAN;
}

static const char *text_of(const json_t *one, const char *key)
{
    const char *text = json_string_value(json_object_get(one, key));
    return text != NULL ? text : "";
}

static bool has_column(const char *name)
{
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++)
        if (fm_columns[i].kind <= FM_COLUMN_METRIC &&
            strcmp(column_name(&fm_columns[i]), name) == 0)
            return true;
    return false;
}

/* Keys of a case that are as usual are not told; how it is run neither. */
static bool is_told(const char *name, const char *value)
{
    static const char *const not [] = { "generator", "frames", "warmup", "launches", "precision" };
    const fm_key *key = key_find(name);
    for (size_t i = 0; i < sizeof not / sizeof not [0]; i++)
        if (strcmp(name, not [i]) == 0)
            return false;
    return !has_column(name) && value[0] != '\0' && strchr(value, ' ') == NULL && key != NULL &&
           (key->scope != FM_SCOPE_CASE || strcmp(key->fallback, value) != 0);
}

static void add_options(fm_text *csv, json_t *one)
{
    const char *name;
    json_t *value;
    fm_text all = { 0 };
    json_object_foreach(json_object_get(one, "options"), name, value)
        text_add(&all, "%s%s=%s", all.length > 0 ? " " : "", name, json_string_value(value));
    json_object_foreach(json_object_get(one, "settings"), name,
                        value) if (is_told(name, json_string_value(value)))
        text_add(&all, "%s%s=%s", all.length > 0 ? " " : "", name, json_string_value(value));
    csv_add(csv, all.bytes != NULL ? all.bytes : "");
    text_free(&all);
}

static void add_fact(fm_text *csv, json_t *one, fm_fact fact)
{
    const bool is_skipped = text_of(one, "skip")[0] != '\0';
    if (fact == FM_FACT_SCHEMA)
        text_add(csv, "1");
    else if (fact == FM_FACT_STATUS)
        text_add(csv, is_skipped ? "not_supported" : "ok");
    else if (fact == FM_FACT_DEVICE_NAME)
        text_add(csv, "D");
    else if (fact == FM_FACT_OPTIONS)
        add_options(csv, one);
    else if (fact == FM_FACT_CASE_ID || fact == FM_FACT_METHOD || fact == FM_FACT_DEVICE ||
             fact == FM_FACT_FEED || fact == FM_FACT_SCENE)
        text_add(csv, "%s",
                 text_of(one, fact == FM_FACT_CASE_ID  ? "case_id"
                              : fact == FM_FACT_METHOD ? "method"
                              : fact == FM_FACT_DEVICE ? "device"
                              : fact == FM_FACT_FEED   ? "feed"
                                                       : "scene"));
}

/* A key's value where it is one that such a column may hold. */
static void add_setting(fm_text *csv, json_t *one, const char *name)
{
    double number;
    const char *value = text_of(json_object_get(one, "settings"), name);
    const bool is_text = strcmp(name, "order") == 0;
    if (is_text || (text_to_double(&number, value) && number > 0.0))
        text_add(csv, "%s", value);
}

static void add_cell(fm_text *csv, json_t *one, const fm_column *column,
                     const flip_numbers *numbers, size_t row)
{
    if (column->kind == FM_COLUMN_FACT)
        add_fact(csv, one, column->fact);
    else if (column->kind == FM_COLUMN_KEY)
        add_setting(csv, one, column->name);
    else if (column->kind == FM_COLUMN_METRIC && column->metric == FM_METRIC_N)
        add_setting(csv, one, "n");
    else if (column->kind == FM_COLUMN_METRIC && column->metric == FM_METRIC_LAUNCHES)
        text_add(csv, "3");
    else if (column->kind == FM_COLUMN_METRIC && !metric_is_time(column_name(column)))
        csv_add_real(csv, number_at(numbers, column_name(column), row));
}

static void add_samples(fm_text *csv, const char *id, const char *metric, double value)
{
    if (metric_is_time(metric))
        for (int launch = 0; launch < 3; launch++)
            text_add(csv, "1,r,%s,%d,0,%s,%.17g,ms\n", id, launch, metric, value);
    else if (!has_column(metric))
        text_add(csv, "1,r,%s,,,%s,%.17g,\n", id, metric, value);
}

/* Keys that are metrics too, such as cull_words, which a row tells when it has its default. */
static void add_keys(fm_text *csv, json_t *one)
{
    const char *name;
    json_t *value;
    fm_metric metric;
    json_object_foreach(json_object_get(one, "settings"), name,
                        value) if (metric_find(&metric, name) && !has_column(name))
        add_samples(csv, text_of(one, "case_id"), name, atof(json_string_value(value)));
}

void flip_write(const flip_cases *of, const flip_numbers *numbers, const char *memory)
{
    fm_text summary = { 0 }, samples = { 0 };
    json_t *one;
    size_t row;
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++)
        text_add(&summary, "%s%s", i > 0 ? "," : "", column_name(&fm_columns[i]));
    text_add(&summary, "\n");
    text_add(&samples, "schema,run_id,case_id,launch,frame,metric,value,unit\n");
    json_array_foreach(of->cases, row, one)
    {
        for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
            text_add(&summary, i > 0 ? "," : "");
            add_cell(&summary, one, &fm_columns[i], numbers, row);
        }
        text_add(&summary, "\n");
        if (text_of(one, "skip")[0] == '\0')
            add_keys(&samples, one);
        for (size_t m = 0; m < numbers->metrics.count; m++) {
            const double value = number_at(numbers, numbers->metrics.items[m], row);
            if (isfinite(value) && text_of(one, "skip")[0] == '\0')
                add_samples(&samples, text_of(one, "case_id"), numbers->metrics.items[m], value);
        }
    }
    kit_write_file(of->directory, "summary.csv", summary.bytes);
    kit_write_file(of->directory, "samples.csv", samples.bytes);
    kit_write_file(of->directory, "manifest.json",
                   numbers->is_software
                       ? "{\"devices\": [{\"name\": \"D\", \"is_software\": true}]}"
                       : "{\"devices\": [{\"name\": \"D\", \"is_software\": false}]}");
    if (memory != NULL)
        kit_write_file(of->directory, "memory.csv", memory);
    text_free(&summary);
    text_free(&samples);
}
