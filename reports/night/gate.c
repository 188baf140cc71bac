#include "gate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

fm_status gate_answers_open(fm_gate_answers *answers, const char *path, fm_error *err)
{
    *answers = (fm_gate_answers){ .table = NULL };
    fm_status status = table_read(&answers->table, path, err);
    const struct {
        size_t *column;
        const char *name;
    } wanted[] = {
        { &answers->case_id, "case_id_new" },
        { &answers->verdict, "verdict" },
        { &answers->why, "why" },
        { &answers->time, "time_shift" },
        { &answers->cpu, "cpu_shift" },
    };
    if (status == FM_OK)
        status = table_check_schema(answers->table, "1", err);
    for (size_t i = 0; i < sizeof wanted / sizeof wanted[0] && status == FM_OK; i++)
        status = table_need_column(wanted[i].column, answers->table, wanted[i].name, err);
    return status;
}

void gate_answers_close(fm_gate_answers *answers)
{
    table_close(answers->table);
    answers->table = NULL;
}

/* The row of a case; row_count: there is none. */
static size_t find_row(const fm_gate_answers *answers, const char *case_id)
{
    size_t row = 0;
    while (row < answers->table->row_count &&
           strcmp(table_cell(answers->table, row, answers->case_id), case_id) != 0)
        row++;
    return row;
}

/* ", time +1.3 %"; nothing where the gate has no number. */
static void add_change(fm_text *text, const fm_gate_answers *answers, size_t row, size_t column,
                       const char *name)
{
    double ratio;
    if (table_number(&ratio, answers->table, row, column, NULL) == FM_OK && isfinite(ratio))
        text_add(text, ", %s %+.1f %%", name, 100.0 * (ratio - 1.0));
}

static void add_answer(fm_text *text, const fm_gate_answers *answers, size_t row)
{
    const char *why = table_cell(answers->table, row, answers->why);
    text_add(text, "; a gate says %s", table_cell(answers->table, row, answers->verdict));
    add_change(text, answers, row, answers->time, "time");
    add_change(text, answers, row, answers->cpu, "cpu");
    if (why[0] != '\0')
        text_add(text, ": %s", why);
}

bool gate_confirm(fm_finding *finding, const fm_result_files *now, void *context)
{
    const fm_gate_answers *answers = context;
    const size_t row = find_row(answers, now->cases[finding->case_index].id);
    const char *verdict = row < answers->table->row_count
                              ? table_cell(answers->table, row, answers->verdict)
                              : "unmeasured";
    const bool is_measured = strcmp(verdict, "unmeasured") != 0;
    fm_text text = { 0 };
    text_add(&text, "%s", finding->text);
    if (is_measured)
        add_answer(&text, answers, row);
    else
        text_add(&text, "; a gate could not measure it");
    if (text.bytes != NULL)
        snprintf(finding->text, sizeof finding->text, "%s", text.bytes);
    text_free(&text);
    finding->is_confirmed = strcmp(verdict, "worse") == 0;
    return finding->is_confirmed || !is_measured;
}
