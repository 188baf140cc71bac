/* Numbers found by text: which case an id is of, which row a name. */
#ifndef FM_TEXT_INDEX_H
#define FM_TEXT_INDEX_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define FM_TEXT_INDEX_NONE SIZE_MAX

/* Starts as {0}. A look-up among n texts takes about log2(n) comparisons. */
typedef struct fm_text_index {
    void *texts; /* of tsearch(3); owned, with a copy of each text */
} fm_text_index;

/* The number of the text, which becomes `number` if the text is new: what is returned is then
 * `number` itself. FM_TEXT_INDEX_NONE: no memory; the index stays. */
size_t text_index_add(fm_text_index *index, const char *text, size_t number);
/* FM_TEXT_INDEX_NONE: it is not there. */
size_t text_index_find(const fm_text_index *index, const char *text);
void text_index_free(fm_text_index *index);

#endif
