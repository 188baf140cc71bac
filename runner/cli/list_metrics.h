/* `list metrics`: the table of model/metrics.h in words, as JSON, or as Markdown. */
#ifndef FM_CLI_LIST_METRICS_H
#define FM_CLI_LIST_METRICS_H

#include <jansson.h>
#include <stdio.h>

/* Aligned lines: name, unit, meaning. */
void list_metrics_text(FILE *out);
/* The table of reports/README.md. */
void list_metrics_markdown(FILE *out);
/* A list of objects: name, title, unit, of, better, is_measured, column, definition. */
json_t *list_metrics_json(void);

#endif
