#include "memory_rows.h"

#include <string.h>

#include "html.h"

/* Columns of memory.csv as people read them. */
static const struct {
    const char *name, *title;
    bool is_number;
} columns[] = {
    { "workload", "workload", false },
    { "title", "method", false },
    { "bytes", "bytes", true },
    { "mib", "MiB", true },
    { "printed", "printed, MiB", true },
    { "difference_mib", "difference, MiB", true },
    { "verdict", "the printed is", false },
    { "why", "added or taken off", false },
};
enum { COLUMN_COUNT = sizeof columns / sizeof columns[0] };

static bool is_of(const fm_table *memory, size_t row, const char *figure)
{
    return strcmp(table_cell(memory, row, table_column(memory, "figure")), figure) == 0;
}

static bool has_rows(const fm_table *memory, const char *figure)
{
    for (size_t row = 0; memory != NULL && row < memory->row_count; row++)
        if (is_of(memory, row, figure))
            return true;
    return false;
}

void memory_rows_add(fm_text *page, const fm_table *memory, const char *figure)
{
    if (!has_rows(memory, figure))
        return;
    text_add(page, "<p>Memory by the methods' own formulas, and as printed:</p>\n"
                   "<div class=table><table><thead><tr>");
    for (size_t i = 0; i < COLUMN_COUNT; i++)
        text_add(page, "<th>%s</th>", columns[i].title);
    text_add(page, "</tr></thead><tbody>\n");
    for (size_t row = 0; row < memory->row_count; row++) {
        if (!is_of(memory, row, figure))
            continue;
        text_add(page, "<tr>");
        for (size_t i = 0; i < COLUMN_COUNT; i++) {
            text_add(page, columns[i].is_number ? "<td class=n>" : "<td>");
            html_add(page, table_cell(memory, row, table_column(memory, columns[i].name)));
            text_add(page, "</td>");
        }
        text_add(page, "</tr>\n");
    }
    text_add(page, "</tbody></table></div>\n");
}
