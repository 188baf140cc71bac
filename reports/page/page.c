#include "page.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "html.h"
#include "model/family.h"
#include "publish.h"
#include "read/case_metrics.h"
#include "read/group.h"

static const char page_css[] = {
#include "page_css.inc"
};
static const char page_js[] = {
#include "page_js.inc"
};

static void add_fact(fm_text *page, const char *name, const char *value)
{
    if (value[0] == '\0')
        return;
    text_add(page, "<dt>");
    html_add(page, name);
    text_add(page, "</dt><dd>");
    html_add(page, value);
    text_add(page, "</dd>\n");
}

static size_t count_outcome(const fm_result_files *results, fm_case_status outcome)
{
    size_t count = 0;
    for (size_t i = 0; i < results->count; i++)
        count += results->cases[i].outcome == outcome;
    return count;
}

static bool is_single_launch(const fm_case_row *result)
{
    return result->is_measured && result->metric[FM_METRIC_LAUNCHES] < 2;
}

/* How far the times are to be trusted, before any of them is read. */
static void add_trust(fm_text *page, const fm_result_files *results, bool is_untimed)
{
    const char *first = NULL;
    size_t noisy = 0, timed = 0, single = 0;
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *result = &results->cases[i];
        if (!result->is_measured || result->is_simulated)
            continue;
        timed++;
        single += is_single_launch(result);
        noisy += result->noisy[0] != '\0';
        if (first == NULL && result->noisy[0] != '\0')
            first = result->noisy;
    }
    if (noisy > 0) {
        text_add(page,
                 "<p class=note>The machine was busy, or launches disagree: %zu of %zu timed "
                 "cases are noisy, the first because ",
                 noisy, timed);
        html_add(page, first);
        text_add(page, ". Their times cannot be relied on: measure again on a quiet machine. More "
                       "launches help only where launches differ.</p>\n");
    }
    if (single > 0 && !is_untimed)
        text_add(page,
                 "<p class=note>%zu of %zu timed cases had one launch: their times have no "
                 "interval, and decide no claim.</p>\n",
                 single, timed);
}

void page_open(fm_text *page, const char *title, size_t missing_count)
{
    text_add(
        page,
        "<!doctype html>\n<html lang=en><head><meta charset=utf-8>\n"
        "<meta name=viewport content=\"width=device-width, initial-scale=1\">\n" FM_PUBLISH_MARK
        "%zu>\n"
        "<title>%s</title>\n<style>\n%s</style></head><body>\n",
        missing_count, title, page_css);
}

void page_begin(fm_text *page, const fm_result_files *results, bool is_untimed)
{
    const fm_provenance *manifest = results->manifest;
    const size_t ok = count_outcome(results, FM_CASE_OK);
    const size_t not_supported = count_outcome(results, FM_CASE_NOT_SUPPORTED);
    const size_t wrong_image = count_outcome(results, FM_CASE_WRONG_IMAGE);
    page_open(page, "fragmark report", results->missing.count);
    text_add(page,
             "<h1>fragmark report</h1>\n<p class=faint>%zu cases: %zu ok, %zu not supported, "
             "%zu with a wrong image, %zu that failed or were skipped.</p>\n",
             results->count, ok, not_supported, wrong_image,
             results->count - ok - not_supported - wrong_image);
    for (size_t i = 0; i < results->missing.count; i++) {
        text_add(page, "<p class=note>");
        html_add(page, results->missing.items[i]);
        text_add(page, ".</p>\n");
    }
    add_trust(page, results, is_untimed);
    text_add(page, "<dl>\n");
    add_fact(page, "what", provenance_fact(manifest, "command"));
    for (size_t i = 0; i < manifest->device_count; i++) {
        char where[256];
        snprintf(where, sizeof where, "%.60s: %.180s", manifest->devices[i].selector,
                 manifest->devices[i].name);
        add_fact(page, "where", where);
    }
    add_fact(page, "when", provenance_fact(manifest, "started"));
    add_fact(page, "commit", provenance_fact(manifest, "git_commit"));
    text_add(page, "</dl>\n");
}

void page_add_links(fm_text *page, const fm_text_list *papers)
{
    text_add(page, "<nav>");
    for (size_t i = 0; i < papers->count; i++)
        text_add(page, "<a href=\"#paper-%s\">%s</a>", papers->items[i],
                 strcmp(papers->items[i], "none") == 0 ? "figures" : papers->items[i]);
    text_add(page, "<a href=\"#pictures\">Pictures</a><a href=\"#speed\">Speed against error</a>"
                   "<a href=\"#hardware\">What the device allows</a>"
                   "<a href=\"#stability\">Stability</a>"
                   "<a href=\"#notes\">Notes</a><a href=\"#guide\">How to read</a><a "
                   "href=\"#machine\">Machine and methods</a></nav>\n");
}

void page_add_guide(fm_text *page)
{
    static const char *const sentences[] = {
        "<b>frame_ms</b> is the sum of a method's GPU passes (with timers=frame: one time for all, "
        "and none of each), the median of the launches' medians. A launch is a process of "
        "its own; launches of all methods take turns, so that a "
        "drift of the machine meets all alike.",
        "<b>Intervals</b> hold the median with 95 % confidence. They are made of launches, each of "
        "which counts as one number, the median of its frames. One launch has no interval, however "
        "many frames it has, and decides no claim on a time; of two launches it is very wide. "
        "Two methods whose intervals overlap are not told apart by this run.",
        "<b>The floor</b> is a method that consumes every fragment and stores none. <b>&times; "
        "floor</b> is a method's store time over the floor's (with timers=frame: frame time over "
        "frame time), measured in the same process: 1 is "
        "as cheap as taking every fragment can be, and only who need not look at every fragment "
        "(Z-buffer, culling, tile-k) comes below. Each feed has its floor. It compares between "
        "machines where milliseconds "
        "cannot.",
        "<b>The bound</b> is the least time for a case on its device: that of the floor, or what "
        "copying the fragments, those that are kept and the picture takes if that is longer. "
        "<b>&times; bound</b> is frame_ms over it: how much better a method could ever be. It "
        "needs a calibration of the device (<code>fragmark calibrate device</code>). "
        "<b>limited_by</b> says what takes the device longest of a case: delivering its "
        "fragments (feed), the bytes that its shaders move, or its atomics, each at the rate that "
        "was calibrated.",
        "<b>total_rmse</b> is the error of the picture against all fragments, sorted and "
        "composited "
        "in double precision; up to 1e-6 it is rounding, and called exact. It has two parts: "
        "<b>truncation_rmse</b>, the cost of keeping only k fragments, which no method with that "
        "k avoids, and <b>rmse</b>, what the method itself loses: where depths tie, its distance "
        "to the nearest picture that any order of the tied fragments makes.",
        "<b>missing, extra, misordered</b> count fragments, not pixels. A method that claims to be "
        "exact and is not has the status wrong_image, but losses that it declares are excused; for "
        "methods published as approximate or racy a wrong picture is a result.",
        "<b>Stability</b> is what each method did on each scene: right, off by rounding, wrong, or "
        "not supported. Traits are what a method declares of itself: that it loses ties, that "
        "fragments race. An error is explained if a trait allows it, there and in that size; "
        "losses of ties and at depth 1 are counted one by one. What no trait explains is a fault. "
        "<a href=\"stability.csv\">stability.csv</a> has the numbers.",
        "<b>The frontier</b> (&#9679; in tables) are the cases that are clearly faster than all "
        "with no more error: their intervals lie apart. Where these overlap, cases are tied "
        "(&#9675;); a case is dominated, and grey in charts, if another with no more error is "
        "clearly faster. Times of one launch have no interval, and all are tied. Controls do not "
        "compete. <a href=\"tradeoff.csv\">tradeoff.csv</a> has the numbers.",
    };
    text_add(page, "<h2 id=guide>How to read this</h2>\n<ul>\n");
    for (size_t i = 0; i < sizeof sentences / sizeof sentences[0]; i++)
        text_add(page, "<li>%s</li>\n", sentences[i]);
    text_add(page, "</ul>\n");
}

/* Titles of the methods for which `wanted` holds, each once; 0 when there is none. */
static size_t add_titles(fm_text *page, const fm_result_files *results,
                         bool (*wanted)(const fm_case_row *result))
{
    size_t count = 0;
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *result = &results->cases[i];
        bool is_new = wanted(result);
        for (size_t j = 0; j < i && is_new; j++)
            is_new = !wanted(&results->cases[j]) ||
                     strcmp(results->cases[j].method, result->method) != 0;
        if (!is_new)
            continue;
        text_add(page, count > 0 ? ", " : "");
        html_add(page, result->look.title);
        count++;
    }
    return count;
}

static bool hides_races(const fm_case_row *result)
{
    return (result->look.traits & FM_TRAIT_RACY) != 0 && result->is_measured &&
           result->is_software && strcmp(result->feed, "raster") == 0;
}

static bool has_few_launches(const fm_case_row *result)
{
    const double launches = result->metric[FM_METRIC_LAUNCHES];
    return result->is_measured && !result->is_simulated && launches >= 2 &&
           launches < FM_LAUNCHES_WANTED;
}

static bool is_timed_once(const fm_case_row *result)
{
    return is_single_launch(result) && !result->is_simulated;
}

static bool is_noisy(const fm_case_row *result)
{
    return result->is_measured && result->noisy[0] != '\0';
}

static bool is_unstable(const fm_case_row *result)
{
    return result->is_measured && result->metric[FM_METRIC_DISTINCT_IMAGES] > 1;
}

static bool is_empty(const fm_case_row *result)
{
    return result->is_ok && strstr(result->message, FM_NOTHING_DRAWN) != NULL;
}

static void add_note(fm_text *page, const fm_result_files *results,
                     bool (*wanted)(const fm_case_row *result), const char *sentence)
{
    fm_text titles = { 0 };
    if (add_titles(&titles, results, wanted) > 0)
        text_add(page, "<p class=note>%s (%s)</p>\n", sentence, titles.bytes);
    page->failed |= titles.failed;
    text_free(&titles);
}

/* Of a method's cases with different pictures the one whose worst frame is the worst; NULL: none.
 */
static const fm_case_row *most_unstable(const fm_result_files *results, const char *method)
{
    const fm_case_row *worst = NULL;
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *result = &results->cases[i];
        if (!is_unstable(result) || strcmp(result->method, method) != 0)
            continue;
        if (worst == NULL ||
            result->metric[FM_METRIC_FRAMES_RMSE_MAX] > worst->metric[FM_METRIC_FRAMES_RMSE_MAX])
            worst = result;
    }
    return worst;
}

/* Results of older runs have the number of pictures alone. */
static void add_instability(fm_text *page, const fm_case_row *result)
{
    const double frames = result->metric[FM_METRIC_FRAMES_DRAWN];
    const double rmse = result->metric[FM_METRIC_FRAMES_RMSE_MAX];
    const double kinds = result->metric[FM_METRIC_DISTINCT_FRAGMENTS];
    html_add(page, result->look.title);
    text_add(page, ": %.0f pictures", result->metric[FM_METRIC_DISTINCT_IMAGES]);
    if (!isnan(frames))
        text_add(page, " in %.0f frames", frames);
    if (!isnan(rmse))
        text_add(page, ", rmse up to %.3g", rmse);
    if (!isnan(kinds))
        text_add(page, ", %.0f sets of fragments in %.0f captured frames", kinds,
                 result->metric[FM_METRIC_CAPTURED_FRAMES]);
}

static void add_unstable(fm_text *page, const fm_result_files *results)
{
    size_t count = 0;
    for (size_t i = 0; i < results->count; i++) {
        const fm_case_row *result = &results->cases[i];
        if (!is_unstable(result) || most_unstable(results, result->method) != result)
            continue;
        text_add(page, count++ == 0 ? "<p class=note>Timed frames drew different pictures of the "
                                      "same case; of each method the case with the worst frame: "
                                    : "; ");
        add_instability(page, result);
    }
    if (count > 0)
        text_add(page,
                 ". The ranges among the <a href=\"#pictures\">pictures</a> show where.</p>\n");
}

static bool any_stand_in(const fm_result_files *results)
{
    for (size_t i = 0; i < results->count; i++)
        if (group_is_stand_in(results->cases[i].scene))
            return true;
    return false;
}

static void add_launches(fm_text *page, const fm_result_files *results, bool is_untimed)
{
    if (is_untimed) {
        add_note(page, results, is_timed_once,
                 "One launch each, which is enough for figures without times. The times beside "
                 "them have no interval.");
        return;
    }
    add_note(page, results, has_few_launches, "Two launches only: the intervals are very wide.");
    add_note(page, results, is_timed_once,
             "One launch only: times have no interval, and claims on them stay unclear.");
}

void page_add_notes(fm_text *page, const fm_result_files *results, bool is_untimed)
{
    text_add(page, "<h2 id=notes>Notes on these results</h2>\n");
    const size_t empty = page->length;
    add_note(page, results, hides_races,
             "On Mesa's software rasterisers the fragments of one pixel never run at the same time "
             "on the raster feed, so that races cannot show here: use <code>--feed "
             "compute-adjacent</code> or a GPU.");
    add_launches(page, results, is_untimed);
    add_note(page, results, is_noisy,
             "The machine was busy, or launches disagree: the column noisy of summary.csv says of "
             "each row why its times cannot be relied on.");
    add_unstable(page, results);
    add_note(page, results, is_empty,
             "Cases in which nothing was drawn: no fragment lies in their pictures. They are ok, "
             "for an empty picture is right, but their times are those of empty frames.");
    if (any_stand_in(results))
        text_add(page, "<p>Scenes called a stand-in are generated with the properties that the "
                       "paper prints; they are not the paper's models.</p>\n");
    if (page->length == empty)
        text_add(page, "<p>Nothing to note.</p>\n");
}

static void add_row(fm_text *page, const char *const *cells, size_t count)
{
    text_add(page, "<tr>");
    for (size_t i = 0; i < count; i++) {
        text_add(page, "<td>");
        html_add(page, cells[i]);
        text_add(page, "</td>");
    }
    text_add(page, "</tr>\n");
}

static void add_devices(fm_text *page, const fm_provenance *manifest)
{
    if (manifest->device_count == 0)
        return;
    text_add(page, "<div class=table><table><thead><tr><th>device</th><th>name</th><th>driver</th>"
                   "<th>API</th><th>kind</th></tr></thead><tbody>\n");
    for (size_t i = 0; i < manifest->device_count; i++) {
        const fm_device_info *device = &manifest->devices[i];
        const char *const cells[] = { device->selector, device->name, device->driver, device->api,
                                      device->is_software ? "software" : "GPU" };
        add_row(page, cells, sizeof cells / sizeof cells[0]);
    }
    text_add(page, "</tbody></table></div>\n");
}

static void add_methods(fm_text *page, const fm_provenance *manifest)
{
    if (manifest->method_count == 0)
        return;
    text_add(page, "<div class=table><table><thead><tr><th>method</th><th>id</th><th>version</th>"
                   "<th>family</th><th>source</th></tr></thead><tbody>\n");
    for (size_t i = 0; i < manifest->method_count; i++) {
        const fm_method_info *method = &manifest->methods[i];
        const char *const cells[] = { method->title, method->id, method->version,
                                      family_name(method->family), method->citation };
        add_row(page, cells, sizeof cells / sizeof cells[0]);
    }
    text_add(page, "</tbody></table></div>\n");
}

void page_add_machine(fm_text *page, const fm_result_files *results)
{
    const fm_provenance *manifest = results->manifest;
    text_add(page, "<h2 id=machine>Machine and methods</h2>\n<dl>\n");
    for (size_t i = 0; i < manifest->machine_count; i++)
        add_fact(page, manifest->machine[i].name, manifest->machine[i].value);
    for (size_t i = 0; i < manifest->fact_count; i++)
        add_fact(page, manifest->facts[i].name, manifest->facts[i].value);
    text_add(page, "</dl>\n");
    add_devices(page, manifest);
    add_methods(page, manifest);
    text_add(page, "<p class=links>Data: <a href=\"summary.csv\">summary.csv</a>, "
                   "<a href=\"samples.csv\">samples.csv</a>, "
                   "<a href=\"manifest.json\">manifest.json</a></p>\n");
}

void page_end(fm_text *page)
{
    text_add(page, "<script>\n%s</script></body></html>\n", page_js);
}
