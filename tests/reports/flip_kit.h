/* Fabricated results of a figure's own cases, as `fragmark plan` lists them: what a claim is judged
 * by is set until its verdict flips. */
#ifndef FM_FLIP_KIT_H
#define FM_FLIP_KIT_H

#include <jansson.h>

#include "claims_kit.h"

/* A figure's cases, and a folder for results that are made of them. */
typedef struct flip_cases {
    fm_paper_figure *figure;
    json_t *cases; /* as `fragmark plan --json` has them, of `run` and `large` */
    char directory[64];
} flip_cases;

/* Numbers of all cases, by metric: a row of `value` for each name. */
typedef struct flip_numbers {
    fm_text_list metrics;
    double *values; /* [metrics.count][row_count]; NAN: none */
    size_t row_count;
    bool is_software;
} flip_numbers;

/* program: fragmark, which plans. false: the figure has no claims. */
bool flip_open(flip_cases *made, const char *path, const char *program);
void flip_close(flip_cases *made);
/* All NAN. The caller closes them. */
void flip_numbers_open(flip_numbers *made, size_t row_count);
void flip_numbers_close(flip_numbers *made);
/* Where the number of that metric and row stands. */
double *flip_number(flip_numbers *numbers, const char *metric, size_t row);
/* Writes the folder, and memory.csv with its `memory`, an owned text, if that is not NULL. */
void flip_write(const flip_cases *of, const flip_numbers *numbers, const char *memory);

#endif
