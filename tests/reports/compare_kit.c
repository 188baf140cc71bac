#include "compare_kit.h"

#include "base/text.h"
#include "model/columns.h"

/* Cells of a row that says nothing of them. */
static const char usual[] =
    "schema=1;status=ok;method=a;method_version=1;device=vulkan;device_name=llvmpipe;feed=raster;"
    "scene=layers;width_px=64;height_px=32;n=16;pixel_density=0.25;fragment_probability=1;"
    "tessellation=1;order=random;seed=1;launches=5;samples=5;frame_ms=10;frame_ms_low=9.9;"
    "frame_ms_high=10.1;bytes_allocated=4096;missing=0;extra=0;rmse=0;total_rmse=0;"
    "distinct_images=1;code_program=p;code_driver=d;code_plugin=l;code_shaders=s";
static const char usual_machine[] =
    "\"cpu\": \"EPYC\", \"cores\": 2, \"memory_bytes\": 1000000, \"kernel\": \"6.1\"";
static const char usual_devices[] =
    "{\"selector\": \"vulkan\", \"name\": \"llvmpipe\", \"driver\": \"Mesa\"}";

/* The value of a cell in "name=value;name=value", with its length; NULL: not there. */
static const char *find_cell(size_t *length, const char *cells, const char *name)
{
    const size_t name_length = strlen(name);
    for (const char *at = cells; *at != '\0';) {
        const size_t cell = strcspn(at, ";");
        if (strncmp(at, name, name_length) == 0 && at[name_length] == '=') {
            *length = cell - name_length - 1;
            return at + name_length + 1;
        }
        at += cell + (at[cell] == ';');
    }
    return NULL;
}

static void add_row(fm_text *csv, const char *cells, size_t index)
{
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++) {
        const char *name = column_name(&fm_columns[i]);
        size_t length = 0;
        const char *value = find_cell(&length, cells, name);
        if (value == NULL)
            value = find_cell(&length, usual, name);
        if (value == NULL && strcmp(name, "case_id") == 0)
            text_add(csv, "c%zu", index);
        text_add(csv, "%.*s%s", (int)length, value != NULL ? value : "",
                 i + 1 < FM_COLUMN_COUNT ? "," : "\n");
    }
}

static void add_samples(fm_text *csv, const char *samples)
{
    char id[64], metric[64], value[64];
    unsigned launch;
    text_add(csv, "schema,run_id,case_id,launch,frame,metric,value,unit\n");
    for (const char *at = samples; at != NULL && *at != '\0'; at = strchr(at, '\n') + 1) {
        char line[256]; /* sscanf measures all that follows */
        snprintf(line, sizeof line, "%.*s", (int)strcspn(at, "\n"), at);
        assert_int_equal(sscanf(line, "%63s %u %63s %63s", id, &launch, metric, value), 4);
        text_add(csv, "1,r,%s,%u,0,%s,%s,ms\n", id, launch, metric, value);
    }
}

static void write_file(const char *directory, const char *name, fm_text *text)
{
    char path[128];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_false(text->failed);
    assert_int_equal(text_write_file(path, text->bytes, text->length, NULL), FM_OK);
    text_free(text);
}

void kit_open(kit_run *run, const kit_run_desc *desc)
{
    fm_text summary = { 0 }, samples = { 0 }, manifest = { 0 };
    fm_error err = { 0 };
    snprintf(run->directory, sizeof run->directory, "/tmp/fragmark-compare-XXXXXX");
    assert_non_null(mkdtemp(run->directory));
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++)
        text_add(&summary, "%s%s", column_name(&fm_columns[i]),
                 i + 1 < FM_COLUMN_COUNT ? "," : "\n");
    for (size_t i = 0; i < desc->row_count; i++)
        add_row(&summary, desc->rows[i], i);
    add_samples(&samples, desc->samples);
    text_add(&manifest,
             "{\"schema\": 1, \"run_id\": \"%s\", \"started\": \"%s\", \"machine\": {%s}, "
             "\"methods\": {\"a\": {\"defaults\": \"x=1 y=2 node=auto node=split "
             "node=whole layout=auto layout=tile layout=image\"}, "
             "\"racy\": {\"traits\": [\"racy\"]}}, \"devices\": [%s]}",
             desc->run_id != NULL ? desc->run_id : "",
             desc->started != NULL ? desc->started : "2026-01-02T03:04:05Z",
             desc->machine != NULL ? desc->machine : usual_machine,
             desc->devices != NULL ? desc->devices : usual_devices);
    write_file(run->directory, "summary.csv", &summary);
    write_file(run->directory, "samples.csv", &samples);
    write_file(run->directory, "manifest.json", &manifest);
    if (desc->journal != NULL) {
        fm_text journal = { 0 };
        text_add(&journal, "{\"event\":\"plan\"}\n%s", desc->journal);
        write_file(run->directory, "journal.jsonl", &journal);
    }
    if (result_files_read(&run->results, run->directory, &err) != FM_OK)
        fail_msg("%s", err.message);
}

void kit_close(kit_run *run)
{
    char command[128];
    result_files_close(run->results);
    snprintf(command, sizeof command, "rm -r '%s'", run->directory);
    assert_int_equal(system(command), 0);
}

void kit_compare(kit_comparison *kit, const kit_run_desc *base, const kit_run_desc *now,
                 const fm_quantity_desc *quantity)
{
    *kit = (kit_comparison){ .status = FM_OK };
    kit_open(&kit->base, base);
    kit_open(&kit->now, now);
    fm_comparison_desc desc = { .base = kit->base.results, .now = kit->now.results, .band = 0.02 };
    if (quantity != NULL)
        desc.quantity = *quantity;
    kit->status = comparison_make(&kit->made, &desc, &kit->err);
}

void kit_end(kit_comparison *kit)
{
    comparison_free(&kit->made);
    kit_close(&kit->base);
    kit_close(&kit->now);
}

const fm_compared *kit_case(const kit_comparison *kit, const char *id)
{
    for (size_t i = 0; i < kit->made.count; i++)
        if (strcmp(kit->made.cases[i].pair.base->id, id) == 0)
            return &kit->made.cases[i];
    fail_msg("no case %s", id);
    return NULL;
}
