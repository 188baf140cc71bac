#include "claims_kit.h"

#include "base/csv.h"

static const char header[] =
    "schema,case_id,status,message,method,method_version,device,device_name,feed,scene,width_px,"
    "height_px,n,k,r,pixel_density,fragment_probability,tessellation,order,seed,options,launches,"
    "samples,frame_ms,frame_ms_low,frame_ms_high,clear_ms,count_ms,reference_ms,store_ms,"
    "resolve_ms,times_floor,bytes_allocated,bytes_predicted,bytes_used,fragments_generated,"
    "fragments_stored,fragments_lost,missing,extra,misordered,depth_ulp_max,rmse,psnr_db,max_abs,"
    "ssim,flip,truncation_rmse,distinct_images,frame_wall_ms,fragments_per_s\n";
static const char manifest[] =
    "{\"methods\": {\"a\": {\"title\": \"A\"}, \"b\": {\"title\": \"B\"}},"
    " \"devices\": [{\"selector\": \"soft\", \"name\": \"llvmpipe\", \"is_software\": true},"
    " {\"selector\": \"hard\", \"name\": \"H100\", \"is_software\": false}]}";

static const char *given(const char *text, const char *usual)
{
    return text != NULL ? text : usual;
}

/* A cell, empty for 0. */
static void add_given(fm_text *csv, double number)
{
    if (number > 0.0)
        text_add(csv, "%g", number);
    text_add(csv, ",");
}

/* The time of each launch; returns how many there are. */
static int add_times(double times[16], const fake *row)
{
    const int launches = row->launches == 0 ? 6 : row->launches;
    const double noise = row->noise > 0.0 ? row->noise : 0.01;
    for (int i = 0; i < launches; i++) {
        const double off = launches == 1 ? 0.0 : noise * (2.0 * i / (launches - 1) - 1.0);
        times[i] = row->frame_ms * (1.0 + off);
    }
    return launches;
}

static void add_summary(fm_text *csv, const fake *row, int index)
{
    const char *device = given(row->device, "soft"), *status = given(row->status, "ok");
    const bool is_ok = strcmp(status, "ok") == 0;
    double times[16];
    const int launches = add_times(times, row);
    fm_interval frame = stats_interval(times, (size_t)launches);
    if (launches == 1) /* as older programs wrote them: of the frames */
        frame = (fm_interval){ row->frame_ms, 0.99 * row->frame_ms, 1.01 * row->frame_ms };
    text_add(csv, "1,c%d,%s,,%s,1,%s,%s,%s,%s,64,32,%g,", index, status, row->method, device,
             strcmp(device, "soft") == 0 ? "llvmpipe" : "H100", given(row->feed, "raster"),
             given(row->scene, "layers"), row->n > 0.0 ? row->n : 16.0);
    add_given(csv, row->k);
    add_given(csv, row->r);
    text_add(csv, "%g,1,1,random,%u,%s,%d,", row->pixel_density, row->seed > 0 ? row->seed : 1,
             given(row->options, ""), launches);
    if (!is_ok) {
        text_add(csv, "0,,,,,,,,,,,,,,,,,,,,,,,,,,,,\n");
        return;
    }
    text_add(csv, "%d,%g,", launches, row->frame_ms);
    csv_add_real(csv, frame.low);
    text_add(csv, ",");
    csv_add_real(csv, frame.high);
    text_add(csv, ",0.1,,,%g,%g,2,%g,4096,1,%g,1,0,%g,0,0,0,0,inf,0,1,,,1,1,1\n",
             row->frame_ms - row->resolve_ms, row->resolve_ms, row->bytes,
             1000.0 * row->pixel_density, row->missing);
}

static void add_samples(fm_text *csv, const fake *row, int index)
{
    double times[16];
    const int launches = add_times(times, row);
    for (int i = 0; i < launches && row->status == NULL; i++) {
        text_add(csv, "1,r,c%d,%d,0,frame_ms,%.9g,ms\n", index, i, times[i]);
        text_add(csv, "1,r,c%d,%d,0,resolve_ms,%.9g,ms\n", index, i, row->resolve_ms);
    }
}

void kit_write_file(const char *directory, const char *name, const char *text)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_int_equal(text_write_file(path, text, strlen(text), NULL), FM_OK);
}

void kit_make_results(char directory[64], const fakes *all)
{
    fm_text summary = { 0 }, samples = { 0 };
    snprintf(directory, 64, "/tmp/fragmark-claims-XXXXXX");
    assert_non_null(mkdtemp(directory));
    text_add(&summary, "%s", header);
    text_add(&samples, "schema,run_id,case_id,launch,frame,metric,value,unit\n");
    for (int i = 0; i < 12 && all->rows[i].method != NULL; i++) {
        add_summary(&summary, &all->rows[i], i);
        add_samples(&samples, &all->rows[i], i);
    }
    kit_write_file(directory, "summary.csv", summary.bytes);
    kit_write_file(directory, "samples.csv", samples.bytes);
    kit_write_file(directory, "manifest.json", manifest);
    text_free(&summary);
    text_free(&samples);
}

void kit_remove_directory(const char *directory)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", directory);
    assert_int_equal(system(command), 0);
}

/* Writes a figure with the claim whose keys are given, one a line. */
fm_status kit_read_figure(fm_paper_figure **figure, const char *directory, const char *claim,
                          fm_error *err)
{
    char path[1024];
    fm_text text = { 0 };
    text_add(&text, "id: f-1\npaper: f\ntitle: t\ncharts:\n"
                    "  - { id: c, title: c, x: k, y: frame_ms }\nclaims:\n  - id: F-1\n"
                    "    text: so it is\n");
    while (*claim != '\0') {
        const size_t length = strcspn(claim, "\n");
        text_add(&text, "    %.*s\n", (int)length, claim);
        claim += length + (claim[length] == '\n');
    }
    kit_write_file(directory, "f-1.yml", text.bytes);
    snprintf(path, sizeof path, "%s/f-1.yml", directory);
    text_free(&text);
    return paper_figure_read(figure, path, err);
}

judged judge_beside(const char *claim, const fakes *rows, const fakes *reference)
{
    char directory[64], other[64] = "";
    fm_error err = { 0 };
    fm_result_files *results = NULL, *reference_results = NULL;
    fm_paper_figure *figure = NULL;
    fm_claim_results verdicts;
    kit_make_results(directory, rows);
    if (kit_read_figure(&figure, directory, claim, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_int_equal(result_files_read(&results, directory, &err), FM_OK);
    if (reference != NULL) {
        kit_make_results(other, reference);
        assert_int_equal(result_files_read(&reference_results, other, &err), FM_OK);
    }
    const fm_paper_figure *const figures[] = { figure };
    const fm_verdicts_desc desc = { results, reference_results, figures, 1 };
    if (verdicts_make(&verdicts, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_true(verdicts.count > 0);
    judged made = { .verdict = verdicts.items[0].verdict,
                    .count = verdicts.count,
                    .required_failed = verdicts_required_failed(&verdicts) };
    snprintf(made.device, sizeof made.device, "%s", verdicts.items[0].device);
    verdicts_free(&verdicts);
    paper_figure_close(figure);
    result_files_close(results);
    result_files_close(reference_results);
    kit_remove_directory(directory);
    if (reference != NULL)
        kit_remove_directory(other);
    return made;
}

fm_verdict_kind kit_judge_memory(const char *memory_rows, const char *claim)
{
    char directory[64], csv[512];
    fm_error err = { 0 };
    fm_result_files *results = NULL;
    fm_paper_figure *figure = NULL;
    fm_claim_results verdicts;
    const fakes rows = { { { ROW("a", 4, 1, 10) } } };
    kit_make_results(directory, &rows);
    snprintf(csv, sizeof csv,
             "figure,workload,method,title,bytes,mib,printed,difference_mib,verdict,why\n%s",
             memory_rows);
    kit_write_file(directory, "memory.csv", csv);
    assert_int_equal(kit_read_figure(&figure, directory, claim, &err), FM_OK);
    assert_int_equal(result_files_read(&results, directory, &err), FM_OK);
    const fm_paper_figure *const figures[] = { figure };
    const fm_verdicts_desc desc = { results, NULL, figures, 1 };
    assert_int_equal(verdicts_make(&verdicts, &desc, &err), FM_OK);
    const fm_verdict_kind kind = verdicts.items[0].verdict.kind;
    verdicts_free(&verdicts);
    paper_figure_close(figure);
    result_files_close(results);
    kit_remove_directory(directory);
    return kind;
}
