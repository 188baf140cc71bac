#include "text_index.h"

#include <search.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* What the tree holds; the text lies behind it. */
typedef struct numbered {
    const char *text;
    size_t number;
} numbered;

static int compare(const void *a, const void *b)
{
    const numbered *left = a, *right = b;
    return strcmp(left->text, right->text);
}

static numbered *make_entry(const char *text, size_t number)
{
    const size_t length = strlen(text) + 1;
    numbered *made = malloc(sizeof *made + length);
    if (made == NULL)
        return NULL;
    memcpy(made + 1, text, length);
    *made = (numbered){ (const char *)(made + 1), number };
    return made;
}

size_t text_index_add(fm_text_index *index, const char *text, size_t number)
{
    const size_t known = text_index_find(index, text);
    if (known != FM_TEXT_INDEX_NONE)
        return known;
    numbered *made = make_entry(text, number);
    if (made == NULL || tsearch(made, &index->texts, compare) == NULL) {
        free(made);
        return FM_TEXT_INDEX_NONE;
    }
    return number;
}

size_t text_index_find(const fm_text_index *index, const char *text)
{
    const numbered wanted = { .text = text };
    numbered *const *found = tfind(&wanted, &index->texts, compare);
    return found != NULL ? (*found)->number : FM_TEXT_INDEX_NONE;
}

void text_index_free(fm_text_index *index)
{
    tdestroy(index->texts, free);
    *index = (fm_text_index){ 0 };
}
