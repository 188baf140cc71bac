/* fragmark-report on fabricated results. */
#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/table.h"
#include "base/text.h"
#include "draw/axis.h"
#include "draw/chart.h"
#include "draw/figure_charts.h"
#include "image/image.h"
#include "page/report.h"
#include "read/case_metrics.h"
#include "read/group.h"
#include "read/paper_figure.h"
#include "read/result_files.h"

static const char header[] =
    "schema,case_id,status,message,method,method_version,device,device_name,feed,scene,width_px,"
    "height_px,n,k,r,pixel_density,fragment_probability,tessellation,order,seed,options,launches,"
    "samples,frame_ms,frame_ms_low,frame_ms_high,clear_ms,count_ms,reference_ms,store_ms,"
    "resolve_ms,times_floor,bytes_allocated,bytes_predicted,bytes_used,fragments_generated,"
    "fragments_stored,fragments_lost,missing,extra,misordered,depth_ulp_max,rmse,psnr_db,max_abs,"
    "ssim,flip,truncation_rmse,distinct_images,frame_wall_ms,fragments_per_s\n";
static const char sample_header[] = "schema,run_id,case_id,launch,frame,metric,value,unit\n";
static const char manifest[] =
    "{\"methods\": {\"kplus-array\": {\"title\": \"K+B-Array\", \"family\": \"k-plus-buffer\"},"
    " \"kb\": {\"title\": \"KB\", \"traits\": [\"racy\"]},"
    " \"exact\": {\"traits\": [\"control\"]}},"
    " \"devices\": [{\"selector\": \"vulkan\", \"name\": \"llvmpipe\", \"is_software\": true}]}";

/* What differs between fabricated cases; all else is the same. */
typedef struct fake_case {
    const char *id, *method, *k, *status;
    double frame_ms, rmse;
    const char *options;
} fake_case;

static void add_case(fm_text *csv, const fake_case *fake)
{
    bool is_measured = strcmp(fake->status, "ok") == 0 || strcmp(fake->status, "wrong_image") == 0;
    text_add(csv, "1,%s,%s,\"why, \"\"so\"\"\",%s,1,vulkan,llvmpipe,raster,layers,64,32,16,%s,,",
             fake->id, fake->status, fake->method, fake->k);
    text_add(csv, "0.25,1,1,random,1,%s,", fake->options == NULL ? "" : fake->options);
    if (is_measured)
        text_add(csv, "3,30,%g,%g,%g,0.1,,,%g,1,2,4096,4096,1,1,1,0,0,0,0,0,%g,inf,0,1,,,1,1,1\n",
                 fake->frame_ms, fake->frame_ms * 0.9, fake->frame_ms * 1.1, fake->frame_ms - 1.1,
                 fake->rmse);
    else
        text_add(csv, "0,0,,,,,,,,,,,,,,,,,,,,,,,,,,,,\n");
}

static void write_file(const char *directory, const char *name, const char *text)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s", directory, name);
    assert_int_equal(text_write_file(path, text, strlen(text), NULL), FM_OK);
}

static void make_directory(char directory[64])
{
    snprintf(directory, 64, "/tmp/fragmark-report-XXXXXX");
    assert_non_null(mkdtemp(directory));
}

static void remove_directory(const char *directory)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", directory);
    assert_int_equal(system(command), 0);
}

static void make_results(char directory[64], const fake_case *fakes, size_t count)
{
    fm_text csv = { 0 }, samples = { 0 };
    make_directory(directory);
    text_add(&csv, "%s", header);
    text_add(&samples, "%s", sample_header);
    for (size_t i = 0; i < count; i++) {
        add_case(&csv, &fakes[i]);
        text_add(&samples, "1,r,%s,0,0,store_ms,1,ms\n", fakes[i].id);
    }
    write_file(directory, "summary.csv", csv.bytes);
    write_file(directory, "samples.csv", samples.bytes);
    write_file(directory, "manifest.json", manifest);
    text_free(&csv);
    text_free(&samples);
}

static const fake_case usual[] = {
    { "a4", "kplus-array", "4", "ok", 10, 0.2, "" },
    { "a8", "kplus-array", "8", "ok", 20, 0.1, "" },
    { "b4", "kb", "4", "ok", 15, 0.3, "" },
    { "e", "exact", "", "ok", 40, 0, "" },
    { "c", "ab-array", "", "crash", 0, 0, "" },
};
enum { USUAL = sizeof usual / sizeof usual[0] };

/* Reads a CSV given as text; the error's message goes to *err. */
static fm_status read_text_table(fm_table **table, const char *text, fm_error *err)
{
    char directory[64], path[1024];
    make_directory(directory);
    write_file(directory, "t.csv", text);
    snprintf(path, sizeof path, "%s/t.csv", directory);
    fm_status status = table_read(table, path, err);
    remove_directory(directory);
    return status;
}

static void table_reads_quotes_commas_and_line_ends(void **state)
{
    (void)state;
    fm_table *table;
    fm_error err;
    assert_int_equal(read_text_table(&table, "a,b\r\n\"x,\"\"y\"\"\n\",2\n,", &err), FM_OK);
    assert_int_equal(table->row_count, 2);
    assert_string_equal(table_cell(table, 0, 0), "x,\"y\"\n");
    assert_string_equal(table_cell(table, 0, table_column(table, "b")), "2");
    assert_string_equal(table_cell(table, 1, 1), "");
    assert_int_equal(table->lines[1], 4);
    table_close(table);
}

static void table_names_the_line_of_damage(void **state)
{
    (void)state;
    static const struct {
        const char *text, *says;
    } damaged[] = {
        { "a,b\n1,2\n3\n", "t.csv:3: 1 cells where the header has 2" },
        { "a,b\n1,\"2\n", "t.csv:2: a quote is opened" },
        { "a,b\n1,2\"\n", "t.csv:2: a quote inside" },
        { "a,b\n1,\"2\"x\n", "t.csv:2: text after a closing quote" },
        { "a,a\n", "t.csv:1: column \"a\" appears twice" },
        { "a,\n", "t.csv:1: column 2 has no name" },
        { "", "t.csv:1: the file is empty" },
    };
    for (size_t i = 0; i < sizeof damaged / sizeof damaged[0]; i++) {
        fm_table *table;
        fm_error err;
        assert_int_equal(read_text_table(&table, damaged[i].text, &err), FM_INVALID);
        assert_null(table);
        assert_non_null(strstr(err.message, damaged[i].says));
    }
}

static void axis_puts_exact_values_into_a_bin_of_their_own(void **state)
{
    (void)state;
    const double values[] = { 0, 0.001, 1 };
    fm_axis axis = { .scale = FM_SCALE_LOG, .zero_below = 1e-6, .length_px = 500 };
    axis_fit(&axis, values, 3);
    assert_string_equal(axis.ticks[0].label, "exact");
    assert_true(axis_position(&axis, 0) < FM_AXIS_BIN_PX);
    assert_true(axis_position(&axis, 0.001) > FM_AXIS_BIN_PX);
    assert_true(axis_position(&axis, 1) < 500);
}

static void axis_has_few_readable_ticks_over_many_decades(void **state)
{
    (void)state;
    char label[24];
    const double values[] = { 1e-9, 1e9 };
    fm_axis axis = { .scale = FM_SCALE_LOG, .length_px = 500 };
    axis_fit(&axis, values, 2);
    assert_in_range(axis.tick_count, 3, 10);
    axis_label(label, 1e-4);
    assert_string_equal(label, "1e-4");
    axis_label(label, 0.02);
    assert_string_equal(label, "0.02");
}

static void results_name_what_is_damaged(void **state)
{
    (void)state;
    char directory[64];
    fm_result_files *results;
    fm_error err;
    make_results(directory, usual, USUAL);
    write_file(directory, "summary.csv", "schema,case_id\n");
    assert_int_equal(result_files_read(&results, directory, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "summary.csv:1: no column \"status\""));
    fm_text csv = { 0 };
    text_add(&csv, "%s", header);
    add_case(&csv, &(fake_case){ "x", "kb", "four", "ok", 1, 0, "" });
    write_file(directory, "summary.csv", csv.bytes);
    assert_int_equal(result_files_read(&results, directory, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "summary.csv:2: k: \"four\" is not a number"));
    text_free(&csv);
    write_file(directory, "manifest.json", "[1]");
    assert_int_equal(result_files_read(&results, directory, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "manifest.json:1: not a JSON object"));
    remove_directory(directory);
}

static void results_take_total_rmse_from_samples(void **state)
{
    (void)state;
    char directory[64];
    fm_result_files *results;
    make_results(directory, usual, USUAL);
    write_file(directory, "samples.csv",
               "schema,run_id,case_id,launch,frame,metric,value,unit\n1,r,a8,,,total_rmse,0.5,\n"
               "1,r,a8,0,0,pass.peel_ms,3,ms\n1,r,a8,0,1,pass.peel_ms,5,ms\n1,r,zz,0,0,x,1,\n");
    assert_int_equal(result_files_read(&results, directory, NULL), FM_OK);
    assert_true(results->cases[1].metric[FM_METRIC_TOTAL_RMSE] == 0.5);
    assert_true(results->cases[0].metric[FM_METRIC_TOTAL_RMSE] == 0.2);
    assert_true(case_metric(results, &results->cases[1], "pass.peel_ms") == 4.0);
    assert_true(isnan(case_metric(results, &results->cases[0], "pass.peel_ms")));
    result_files_close(results);
    remove_directory(directory);
}

static void results_leave_out_frames_that_are_off_clock(void **state)
{
    (void)state;
    char directory[64];
    fm_result_files *results;
    make_results(directory, usual, USUAL);
    write_file(directory, "samples.csv",
               "schema,run_id,case_id,launch,frame,metric,value,unit\n"
               "1,r,a8,0,0,pass.peel_ms,3,ms\n1,r,a8,0,1,pass.peel_ms,99,ms\n"
               "1,r,a8,1,1,pass.peel_ms,3,ms\n1,r,a8,0,1,off_clock,1,\n");
    assert_int_equal(result_files_read(&results, directory, NULL), FM_OK);
    assert_true(case_metric(results, &results->cases[1], "pass.peel_ms") == 3.0);
    assert_true(isnan(case_metric(results, &results->cases[1], "off_clock")));
    result_files_close(results);
    remove_directory(directory);
}

static void groups_keep_different_scene_options_apart(void **state)
{
    (void)state;
    static const fake_case fakes[] = {
        { "1", "kb", "4", "ok", 10, 0, "lock=spin depths=sloped" },
        { "2", "kb", "4", "ok", 10, 0, "lock=interlock depths=sloped" },
        { "3", "kb", "4", "ok", 10, 0, "lock=spin" },
    };
    char directory[64], title[96];
    fm_result_files *results;
    fm_groups groups;
    make_results(directory, fakes, 3);
    assert_int_equal(result_files_read(&results, directory, NULL), FM_OK);
    assert_int_equal(groups_make(&groups, results, &(fm_groups_desc){ 0 }, NULL), FM_OK);
    assert_int_equal(groups.count, 2);
    assert_int_equal(groups.groups[0].count, 2);
    group_series_title(title, groups.groups[0].cases[1], NULL);
    assert_string_equal(title, "KB (lock=spin)");
    assert_string_not_equal(groups.groups[0].name, groups.groups[1].name);
    groups_free(&groups);
    result_files_close(results);
    remove_directory(directory);
}

static void figure_files_of_the_project_are_read(void **state)
{
    (void)state;
    size_t count = 0;
    DIR *folder = opendir(FM_FIGURES_SOURCE_DIR);
    const struct dirent *file;
    assert_non_null(folder);
    while ((file = readdir(folder)) != NULL) {
        char path[1024], id[300];
        fm_paper_figure *figure;
        fm_error err = { 0 };
        if (file->d_name[0] == '.')
            continue;
        snprintf(path, sizeof path, "%s/%s", FM_FIGURES_SOURCE_DIR, file->d_name);
        if (paper_figure_read(&figure, path, &err) != FM_OK)
            fail_msg("%s", err.message);
        snprintf(id, sizeof id, "%s.yml", figure->id);
        assert_string_equal(id, file->d_name);
        paper_figure_close(figure);
        count++;
    }
    closedir(folder);
    assert_true(count >= 12);
}

static void points_of_the_paper_are_sums_of_parts(void **state)
{
    (void)state;
    fm_paper_figure *figure;
    fm_error err;
    assert_int_equal(paper_figure_read(&figure, FM_FIGURES_SOURCE_DIR "/kplus-05.yml", &err),
                     FM_OK);
    assert_string_equal(figure->id, "kplus-05");
    assert_int_equal(figure->point_count, 40);
    assert_true(fabs(figure->points[0].value - 4.9) < 1e-9);
    assert_true(text_list_has(&figure->methods, "kplus-array"));
    paper_figure_close(figure);
}

static void figure_with_an_unknown_key_names_the_nearest(void **state)
{
    (void)state;
    char directory[64], path[1024];
    fm_paper_figure *figure;
    fm_error err;
    make_directory(directory);
    write_file(directory, "f.yml", "id: f\npaper: p\ntitel: x\n");
    snprintf(path, sizeof path, "%s/f.yml", directory);
    assert_int_equal(paper_figure_read(&figure, path, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "f.yml:3: unknown key \"titel\""));
    assert_non_null(strstr(err.message, "\"title\""));
    remove_directory(directory);
}

static void chart_is_svg_without_ids_that_could_clash(void **state)
{
    (void)state;
    const double values[] = { 1, 10 };
    fm_chart chart = { .title = "a < b & c", .x.length_px = 200, .y.length_px = 100 };
    char *svg;
    axis_fit(&chart.x, values, 2);
    axis_fit(&chart.y, values, 2);
    fm_series *series = chart_add_series(&chart);
    chart_add_point(&chart, series, &(fm_point){ 5, 5, 4, 6, 0 });
    series->has_marker = true;
    assert_int_equal(chart_svg(&svg, &chart, NULL), FM_OK);
    assert_non_null(strstr(svg, "<svg"));
    assert_non_null(strstr(svg, "a &lt; b &amp; c"));
    assert_null(strstr(svg, " id=\""));
    assert_null(strstr(svg, "clip-path"));
    free(svg);
    chart_free(&chart);
}

/* report.html of fabricated results, for the caller to free. */
static char *report_of(const char *directory, const char *figure_path)
{
    char path[1024], *html;
    size_t count;
    fm_error err = { 0 };
    fm_result_files *results;
    fm_paper_figure *figure = NULL;
    fm_report_outcome outcome;
    assert_int_equal(result_files_read(&results, directory, &err), FM_OK);
    if (figure_path != NULL)
        assert_int_equal(paper_figure_read(&figure, figure_path, &err), FM_OK);
    const fm_paper_figure *figures[] = { figure };
    const fm_report_desc desc = { .results = results,
                                  .figures = figures,
                                  .figure_count = figure != NULL,
                                  .error = error_kind_find(NULL, NULL) };
    assert_int_equal(report_write(&outcome, &desc, &err), FM_OK);
    snprintf(path, sizeof path, "%s/report.html", directory);
    assert_int_equal(text_read_file(&html, &count, path, 64 << 20, &err), FM_OK);
    paper_figure_close(figure);
    result_files_close(results);
    return html;
}

static void report_shows_failed_cases_and_warns_of_hidden_races(void **state)
{
    (void)state;
    char directory[64], path[1024];
    make_results(directory, usual, USUAL);
    char *html = report_of(directory, FM_FIGURES_SOURCE_DIR "/kplus-05.yml");
    assert_non_null(strstr(html, "why, &#34;so&#34;"));
    assert_non_null(strstr(html, "<td>crash</td>"));
    assert_non_null(strstr(html, "races cannot show here"));
    assert_non_null(strstr(html, "k+-buffer, Fig. 5"));
    assert_null(strstr(html, "http-equiv"));
    assert_null(strstr(html, "src=\"http"));
    snprintf(path, sizeof path, "%s/charts/kplus-05-ratio-layers-vulkan-raster.png", directory);
    assert_int_equal(access(path, R_OK), 0);
    free(html);
    remove_directory(directory);
}

static void report_of_a_single_failed_case_says_so(void **state)
{
    (void)state;
    char directory[64];
    make_results(directory, &usual[4], 1);
    char *html = report_of(directory, FM_FIGURES_SOURCE_DIR "/kplus-05.yml");
    assert_non_null(strstr(html, "No chart: "));
    assert_non_null(strstr(html, "<td>crash</td>"));
    free(html);
    remove_directory(directory);
}

static void report_of_no_case_at_all_is_a_report(void **state)
{
    (void)state;
    char directory[64];
    make_results(directory, usual, 0);
    char *html = report_of(directory, NULL);
    assert_non_null(strstr(html, "no case yet"));
    free(html);
    remove_directory(directory);
}

static void report_embeds_result_truth_and_heat_map(void **state)
{
    (void)state;
    char directory[64], path[1024];
    fm_image *image;
    make_results(directory, usual, 1);
    snprintf(path, sizeof path, "%s/images", directory);
    assert_int_equal(mkdir(path, 0777), 0);
    assert_int_equal(image_create(&image, 4, 2, NULL), FM_OK);
    snprintf(path, sizeof path, "%s/images/a4.truth.rgba32f", directory);
    assert_int_equal(image_write(path, image, NULL), FM_OK);
    image->rgba[0] = 0.5F;
    snprintf(path, sizeof path, "%s/images/a4.rgba32f", directory);
    assert_int_equal(image_write(path, image, NULL), FM_OK);
    char *html = report_of(directory, NULL);
    assert_non_null(strstr(html, "at most 0.5; 12.5 % of pixels above 1e-4"));
    assert_non_null(strstr(html, "data:image/png;base64,"));
    snprintf(path, sizeof path, "%s/images/a4.difference.exr", directory);
    assert_int_equal(access(path, R_OK), 0);
    free(html);
    image_destroy(image);
    remove_directory(directory);
}

static int run_program(const char *arguments)
{
    char command[512];
    snprintf(command, sizeof command, "%s %s >/dev/null 2>&1", FM_REPORT_PROGRAM, arguments);
    int status = system(command);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

static void program_answers_with_documented_exit_codes(void **state)
{
    (void)state;
    char directory[64];
    make_results(directory, usual, USUAL);
    assert_int_equal(run_program("--help"), 0);
    assert_int_equal(run_program(""), 2);
    assert_int_equal(run_program("--no-such-option x"), 2);
    assert_int_equal(run_program("/nonexistent"), 2);
    assert_int_equal(run_program(directory), 0);
    char arguments[128];
    snprintf(arguments, sizeof arguments, "%s --figure no-such-figure", directory);
    assert_int_equal(run_program(arguments), 2);
    write_file(directory, "samples.csv", "case_id\n1,2\n");
    assert_int_equal(run_program(directory), 8);
    remove_directory(directory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(table_reads_quotes_commas_and_line_ends),
        cmocka_unit_test(table_names_the_line_of_damage),
        cmocka_unit_test(axis_puts_exact_values_into_a_bin_of_their_own),
        cmocka_unit_test(axis_has_few_readable_ticks_over_many_decades),
        cmocka_unit_test(results_name_what_is_damaged),
        cmocka_unit_test(results_take_total_rmse_from_samples),
        cmocka_unit_test(results_leave_out_frames_that_are_off_clock),
        cmocka_unit_test(groups_keep_different_scene_options_apart),
        cmocka_unit_test(figure_files_of_the_project_are_read),
        cmocka_unit_test(points_of_the_paper_are_sums_of_parts),
        cmocka_unit_test(figure_with_an_unknown_key_names_the_nearest),
        cmocka_unit_test(chart_is_svg_without_ids_that_could_clash),
        cmocka_unit_test(report_shows_failed_cases_and_warns_of_hidden_races),
        cmocka_unit_test(report_of_a_single_failed_case_says_so),
        cmocka_unit_test(report_of_no_case_at_all_is_a_report),
        cmocka_unit_test(report_embeds_result_truth_and_heat_map),
        cmocka_unit_test(program_answers_with_documented_exit_codes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
