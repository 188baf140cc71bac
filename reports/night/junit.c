#include <math.h>

#include "compare/comparison.h"
#include "night.h"

/* XML 1.0 has no other control characters, and takes UTF-8 alone. */
static void add_escaped(fm_text *xml, const char *raw)
{
    fm_text text = { 0 };
    text_add(&text, "%s", raw);
    if (text.bytes != NULL)
        text_make_utf8(text.bytes);
    for (const char *at = text.bytes; at != NULL && *at != '\0'; at++)
        if (*at == '<' || *at == '>' || *at == '&' || *at == '"')
            text_add(xml, "&#%d;", *at);
        else
            text_add_raw(xml, (unsigned char)*at < ' ' || *at == 0x7f ? " " : at, 1);
    xml->failed |= text.failed;
    text_free(&text);
}

static void add_element(fm_text *xml, const char *element, const char *type, const char *message)
{
    text_add(xml, "    <%s type=\"%s\" message=\"", element, type);
    add_escaped(xml, message);
    text_add(xml, "\"/>\n");
}

/* Without findings: a failure is an error if it is new, and else stands aside. */
static void add_status(fm_text *xml, const fm_night_result *night, size_t index)
{
    const fm_case_row *row = &night->desc->now->cases[index];
    if (row->outcome == FM_CASE_OK)
        return;
    const bool has_past = night->cases[index].previous != NULL || night->desc->baseline != NULL;
    const bool is_failure = row->outcome > FM_CASE_NOT_SUPPORTED;
    add_element(xml, is_failure && !has_past ? "error" : "skipped", row->status, row->message);
}

static void add_case(fm_text *xml, const fm_night_result *night, size_t index)
{
    char name[FM_COMPARED_NAME_BYTES];
    const fm_case_row *row = &night->desc->now->cases[index];
    const double seconds = row->metric[FM_METRIC_FRAME_MS] / 1000.0;
    size_t failures = 0;
    compared_name(name, row);
    text_add(xml, "  <testcase classname=\"fragmark.");
    add_escaped(xml, row->method);
    text_add(xml, "\" name=\"");
    add_escaped(xml, name);
    text_add(xml, " (%s)\" time=\"%.6f\">\n", row->id, isfinite(seconds) ? seconds : 0.0);
    for (size_t i = 0; i < night->count; i++) {
        const fm_finding *finding = &night->findings[i];
        if (finding->case_index != index || finding->is_dismissed)
            continue;
        add_element(xml, "failure", finding_kind_name(finding->kind), finding->text);
        failures++;
    }
    if (failures == 0)
        add_status(xml, night, index);
    text_add(xml, "  </testcase>\n");
}

static size_t count_failing(const fm_night_result *night)
{
    size_t failing = 0;
    for (size_t i = 0; i < night->desc->now->count; i++) {
        bool fails = false;
        for (size_t j = 0; j < night->count; j++)
            fails |= night->findings[j].case_index == i && !night->findings[j].is_dismissed;
        failing += fails;
    }
    return failing;
}

void night_add_junit(fm_text *xml, const fm_night_result *night)
{
    const fm_result_files *now = night->desc->now;
    text_add(xml,
             "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuite name=\"fragmark nightly\" "
             "tests=\"%zu\" failures=\"%zu\" errors=\"%zu\" timestamp=\"",
             now->count, count_failing(night), night->new_failures);
    add_escaped(xml, provenance_fact(now->manifest, "started"));
    text_add(xml, "\">\n");
    for (size_t i = 0; i < now->count; i++)
        add_case(xml, night, i);
    text_add(xml, "</testsuite>\n");
}
