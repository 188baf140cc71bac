#include "verdicts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/csv.h"
#include "base/text.h"
#include "memory_points.h"
#include "read/figure_cases.h"
#include "seeds.h"
#include "summary_points.h"

/* What the functions below share. */
typedef struct verdicts_job {
    fm_claim_results *to;
    const fm_result_files *results; /* those that are being judged */
    const fm_paper_figure *figure;
    const fm_table *memory;
    bool is_reference;
    bool *takes;          /* [results->count] */
    const char **devices; /* names of the results' devices; "" of none known */
    size_t device_count;
    fm_error *err;
} verdicts_job;

static void find_devices(verdicts_job *job)
{
    job->device_count = 0;
    for (size_t i = 0; i < job->results->count; i++) {
        const char *name = job->results->cases[i].device_name;
        bool is_known = name[0] == '\0';
        for (size_t j = 0; j < job->device_count && !is_known; j++)
            is_known = strcmp(job->devices[j], name) == 0;
        if (!is_known)
            job->devices[job->device_count++] = name;
    }
    if (job->device_count == 0)
        job->devices[job->device_count++] = "";
}

/* The figure's own cases on this device. */
static void choose_cases(const verdicts_job *job, const char *device)
{
    const fm_figure_cases cases = figure_cases(job->results, job->figure);
    for (size_t i = 0; i < job->results->count; i++) {
        const fm_case_row *result = &job->results->cases[i];
        const bool is_here =
            strcmp(result->device_name, device) == 0 || result->device_name[0] == '\0';
        job->takes[i] = is_here && figure_takes_case(result, &cases);
    }
}

static bool is_software(const verdicts_job *job, const char *device)
{
    for (size_t i = 0; i < job->results->count; i++)
        if (strcmp(job->results->cases[i].device_name, device) == 0)
            return job->results->cases[i].is_software;
    return false;
}

/* No row of the claim's selection gave a point: why. */
static void explain(fm_verdict *verdict, const verdicts_job *job, const fm_claim *claim,
                    const char *device, const fm_claim_points *points)
{
    static const char *const needs[] = { [FM_CLAIM_ANY_DEVICE] = "",
                                         [FM_CLAIM_GPU] = "needs a GPU",
                                         [FM_CLAIM_HAZARDS] =
                                             "needs a GPU, or feed compute-adjacent",
                                         [FM_CLAIM_SOFTWARE] = "needs a software rasteriser" };
    const size_t cases = points->lost_count > 0 ? points->lost_count : points->missing_count;
    *verdict = (fm_verdict){ .kind = FM_VERDICT_NOT_TESTABLE, .measured = { NAN, NAN, NAN } };
    if (claim->where != FM_CLAIM_ANY_DEVICE &&
        is_software(job, device) == (claim->where != FM_CLAIM_SOFTWARE))
        snprintf(verdict->reason, sizeof verdict->reason, "%s%s%s", needs[claim->where],
                 claim->why[0] != '\0' ? ": " : "", claim->why);
    else if (cases > 0)
        snprintf(verdict->reason, sizeof verdict->reason, "%zu case%s without a result (%s)", cases,
                 cases == 1 ? "" : "s", points->missing);
    else
        snprintf(verdict->reason, sizeof verdict->reason,
                 "no case of this run is what the claim is about");
}

/* All points of the claim, series by series, x rising. FM_OK also without any. */
static fm_status make_points(fm_claim_points *points, const fm_claim *claim,
                             const fm_claim_rows *rows, fm_error *err)
{
    *points = (fm_claim_points){ 0 };
    for (size_t i = 0; i < claim->of_count; i++)
        if (claim->of[i].table == FM_SELECT_MEMORY)
            memory_points_add(points, claim, rows, i);
        else
            summary_points_add(points, claim, rows, i);
    if (points->failed)
        return fm_fail(err, FM_NO_MEMORY, "claim %s: %zu points", claim->id, points->count);
    seeds_join(points, claim);
    if (points->failed)
        return fm_fail(err, FM_NO_MEMORY, "claim %s: seeds", claim->id);
    claim_points_sort(points, claim);
    return FM_OK;
}

/* A block of the figure has the point's scene, or it is by formula. */
static bool is_at_home(const fm_paper_figure *figure, const fm_claim_point *point)
{
    return point->result == NULL || figure->own_scenes.count == 0 ||
           text_list_has(&figure->own_scenes, point->result->scene);
}

/* A row of a scene that no block of the figure has; NULL: there is none. */
static const char *other_scene(const fm_paper_figure *figure, const fm_claim_points *points)
{
    for (size_t i = 0; i < points->count; i++)
        if (!is_at_home(figure, &points->points[i]))
            return points->points[i].result->scene;
    return NULL;
}

static void say_where(fm_verdict *verdict, const char *before, const char *scene, const char *after)
{
    const size_t used = strlen(verdict->reason);
    snprintf(verdict->reason + used, sizeof verdict->reason - used,
             "; %s%.60s, which is no scene of this figure%s", before, scene, after);
}

/* What fails on another scene says nothing of the claim: the points of the figure's own scenes
 * decide, if there are any. */
static fm_status judge_at_home(fm_verdict *verdict, const verdicts_job *job, const fm_claim *claim,
                               const fm_claim_rows *rows, const fm_claim_points *points)
{
    const char *scene = other_scene(job->figure, points);
    fm_status status = FM_OK;
    fm_claim_points own = *points; /* all but its points are borrowed */
    own.count = 0;
    own.points = calloc(points->count, sizeof *own.points);
    if (own.points == NULL)
        return fm_fail(job->err, FM_NO_MEMORY, "claim %s: %zu points", claim->id, points->count);
    for (size_t i = 0; i < points->count; i++)
        if (is_at_home(job->figure, &points->points[i]))
            own.points[own.count++] = points->points[i];
    if (own.count > 0)
        status = claim_judge(verdict, claim, rows, &own, job->err);
    if (status == FM_OK && own.count > 0) {
        verdict->total += points->count - own.count;
        say_where(verdict, "left out: points on ", scene, "");
        if (verdict->kind == FM_VERDICT_HOLDS && claim->form != FM_CLAIM_ANY)
            verdict->kind = FM_VERDICT_IN_PART;
    } else if (status == FM_OK) {
        verdict->is_elsewhere = true;
        verdict->kind = FM_VERDICT_NOT_TESTABLE;
        say_where(verdict, "on ", scene, ": it fails there");
    }
    free(own.points);
    return status;
}

/* What holds on another scene than the paper's, or ours for it, is no plain "holds"; what fails
 * must fail on the figure's own, unless it must hold everywhere. */
static fm_status place_verdict(fm_verdict *verdict, const verdicts_job *job, const fm_claim *claim,
                               const fm_claim_rows *rows, const fm_claim_points *points)
{
    const char *scene = other_scene(job->figure, points);
    if (scene == NULL)
        return FM_OK;
    if (verdict->kind == FM_VERDICT_FAILS && !claim->is_required)
        return judge_at_home(verdict, job, claim, rows, points);
    verdict->is_elsewhere = true;
    say_where(verdict, "on ", scene, "");
    if (verdict->kind == FM_VERDICT_HOLDS)
        verdict->kind = FM_VERDICT_IN_PART;
    return FM_OK;
}

static fm_status judge_on(fm_verdict *verdict, const verdicts_job *job, const fm_claim *claim,
                          const char *device)
{
    fm_claim_points points;
    const fm_claim_rows rows = { .results = job->results,
                                 .takes = job->takes,
                                 .memory = job->memory,
                                 .figure = job->figure->id };
    choose_cases(job, device);
    fm_status status = make_points(&points, claim, &rows, job->err);
    if (status == FM_OK && points.count == 0)
        explain(verdict, job, claim, device, &points);
    else if (status == FM_OK)
        status = claim_judge(verdict, claim, &rows, &points, job->err);
    if (status == FM_OK && points.count > 0)
        status = place_verdict(verdict, job, claim, &rows, &points);
    claim_points_free(&points);
    return status;
}

static fm_status add_result(verdicts_job *job, const fm_claim *claim, const char *device,
                            const fm_verdict *verdict)
{
    fm_claim_results *to = job->to;
    fm_claim_result *grown = reallocarray(to->items, to->count + 1, sizeof *grown);
    if (grown == NULL)
        return fm_fail(job->err, FM_NO_MEMORY, "%zu verdicts", to->count + 1);
    to->items = grown;
    fm_claim_result *added = &grown[to->count++];
    *added = (fm_claim_result){ .figure = job->figure,
                                .claim = claim,
                                .verdict = *verdict,
                                .is_reference = job->is_reference };
    snprintf(added->device, sizeof added->device, "%.120s%s", device,
             job->is_reference ? " (reference)" : "");
    return FM_OK;
}

static fm_status judge_claim(verdicts_job *job, const fm_claim *claim)
{
    const bool is_by_formula = claim->of[0].table == FM_SELECT_MEMORY;
    fm_status status = FM_OK;
    if (is_by_formula && job->is_reference)
        return FM_OK; /* the same on all machines */
    for (size_t i = 0; i < (is_by_formula ? 1 : job->device_count) && status == FM_OK; i++) {
        fm_verdict verdict;
        status = judge_on(&verdict, job, claim, job->devices[i]);
        if (status == FM_OK && !(job->is_reference && verdict.kind == FM_VERDICT_NOT_TESTABLE))
            status =
                add_result(job, claim, is_by_formula ? "by formula" : job->devices[i], &verdict);
    }
    return status;
}

/* Rows [first, ...) are one claim's. Where the reference can say something, "not testable here" of
 * the own devices becomes a part of its reason. */
static void let_reference_speak(fm_claim_results *to, size_t first)
{
    const char *why = NULL;
    size_t kept = first, spoken = SIZE_MAX;
    for (size_t i = first; i < to->count && spoken == SIZE_MAX; i++)
        if (to->items[i].is_reference)
            spoken = i;
    if (spoken == SIZE_MAX)
        return;
    fm_verdict *verdict = &to->items[spoken].verdict;
    for (size_t i = first; i < to->count; i++) {
        fm_claim_result *item = &to->items[i];
        if (item->is_reference || item->verdict.kind != FM_VERDICT_NOT_TESTABLE)
            continue;
        const size_t used = strlen(verdict->reason);
        if (why == NULL)
            snprintf(verdict->reason + used, sizeof verdict->reason - used,
                     "; not testable on %.60s: %.160s", item->device, item->verdict.reason);
        why = item->verdict.reason;
    }
    for (size_t i = first; i < to->count; i++)
        if (to->items[i].is_reference || to->items[i].verdict.kind != FM_VERDICT_NOT_TESTABLE)
            to->items[kept++] = to->items[i];
    to->count = kept;
}

static fm_status judge_figure(verdicts_job *own, verdicts_job *reference,
                              const fm_paper_figure *figure)
{
    fm_status status = FM_OK;
    own->figure = reference->figure = figure;
    for (size_t i = 0; i < figure->claim_count && status == FM_OK; i++) {
        const size_t first = own->to->count;
        status = judge_claim(own, &figure->claims[i]);
        if (status == FM_OK && reference->results != NULL)
            status = judge_claim(reference, &figure->claims[i]);
        let_reference_speak(own->to, first);
    }
    return status;
}

static fm_status open_job(verdicts_job *job, const fm_result_files *results, fm_error *err)
{
    job->results = results;
    job->err = err;
    if (results == NULL)
        return FM_OK;
    job->takes = calloc(results->count + 1, sizeof *job->takes);
    job->devices = calloc(results->count + 1, sizeof *job->devices);
    if (job->takes == NULL || job->devices == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%zu cases", results->count);
    find_devices(job);
    return FM_OK;
}

fm_status verdicts_make(fm_claim_results *verdicts, const fm_verdicts_desc *desc, fm_error *err)
{
    verdicts_job own = { .to = verdicts, .memory = desc->results->memory },
                 reference = { .to = verdicts, .is_reference = true };
    *verdicts = (fm_claim_results){ 0 };
    fm_status status = open_job(&own, desc->results, err);
    if (status == FM_OK)
        status = open_job(&reference, desc->reference, err);
    for (size_t i = 0; i < desc->figure_count && status == FM_OK; i++)
        status = judge_figure(&own, &reference, desc->figures[i]);
    free(own.takes);
    free(own.devices);
    free(reference.takes);
    free(reference.devices);
    if (status != FM_OK)
        verdicts_free(verdicts);
    return status;
}

void verdicts_free(fm_claim_results *verdicts)
{
    free(verdicts->items);
    *verdicts = (fm_claim_results){ 0 };
}

void claim_paper_value(char text[256], const fm_claim *claim)
{
    const bool has_both = claim->paper[0] != '\0' && claim->plot[0] != '\0';
    snprintf(text, 256, "%.120s%s%.100s", claim->paper,
             has_both                 ? "; its own plot: "
             : claim->plot[0] != '\0' ? "plot: "
                                      : "",
             claim->plot);
}

static void add_row(fm_text *csv, const fm_claim_result *item)
{
    char paper[256], words[FM_VERDICT_WORDS_BYTES];
    const fm_interval *measured = &item->verdict.measured;
    const double numbers[] = { measured->median, measured->low, measured->high };
    const char *const texts[] = { item->claim->id, item->figure->paper, item->figure->id,
                                  item->claim->text, item->device };
    claim_paper_value(paper, item->claim);
    for (size_t i = 0; i < sizeof texts / sizeof texts[0]; i++) {
        csv_add(csv, texts[i]);
        text_add(csv, ",");
    }
    for (size_t i = 0; i < sizeof numbers / sizeof numbers[0]; i++) {
        csv_add_real(csv, numbers[i]);
        text_add(csv, ",");
    }
    csv_add(csv, paper);
    verdict_words(words, &item->verdict);
    text_add(csv, ",%s,", words);
    csv_add(csv, item->verdict.reason);
    text_add(csv, ",%s\n", claim_basis_name(item->claim->basis));
}

fm_status verdicts_write(const fm_claim_results *verdicts, const char *path, fm_error *err)
{
    fm_text csv = { 0 };
    text_add(&csv, "claim,paper,figure,text,device,measured,low,high,paper_value,verdict,reason,"
                   "basis\n");
    for (size_t i = 0; i < verdicts->count; i++)
        add_row(&csv, &verdicts->items[i]);
    const fm_status status = csv.failed ? fm_fail(err, FM_NO_MEMORY, "%s", path)
                                        : text_write_file(path, csv.bytes, csv.length, err);
    text_free(&csv);
    return status;
}

size_t verdicts_required_failed(const fm_claim_results *verdicts)
{
    size_t failed = 0;
    for (size_t i = 0; i < verdicts->count; i++)
        failed += verdicts->items[i].claim->is_required && !verdicts->items[i].is_reference &&
                  verdicts->items[i].verdict.kind == FM_VERDICT_FAILS;
    return failed;
}

fm_verdict_counts verdicts_count(const fm_claim_results *verdicts, const char *paper)
{
    fm_verdict_counts counts = { 0 };
    for (size_t i = 0; i < verdicts->count; i++) {
        const fm_claim_result *item = &verdicts->items[i];
        if (paper == NULL || strcmp(item->figure->paper, paper) == 0)
            counts.counts[item->claim->basis][item->verdict.kind]++;
    }
    return counts;
}

bool verdict_counts_has(const fm_verdict_counts *counts, fm_claim_basis basis)
{
    for (int kind = 0; kind < FM_VERDICT_COUNT; kind++)
        if (counts->counts[basis][kind] > 0)
            return true;
    return false;
}
