#include "codes.h"

#include <stdlib.h>

fm_status codes_create(fm_codes *codes, size_t row_count, fm_error *err)
{
    *codes =
        (fm_codes){ .rows = calloc(row_count + 1, sizeof *codes->rows), .row_count = row_count };
    if (codes->rows == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the codes of %zu rows", row_count);
    return FM_OK;
}

void codes_free(fm_codes *codes)
{
    for (size_t i = 0; i < codes->count; i++)
        code_free(&codes->codes[i]);
    free(codes->codes);
    free(codes->rows);
    *codes = (fm_codes){ 0 };
}

static bool is_same(const fm_code *a, const fm_code *b)
{
    if (a->count != b->count || a->program != b->program || a->driver != b->driver)
        return false;
    for (size_t i = 0; i < a->count; i++) /* names are shared: equal ones have equal addresses */
        if (a->files[i].owner != b->files[i].owner || a->files[i].name != b->files[i].name ||
            a->files[i].hash != b->files[i].hash)
            return false;
    return true;
}

/* Takes *code, or frees it where there is such a one. */
static fm_status intern(fm_codes *codes, uint32_t *index, fm_code *code, fm_error *err)
{
    for (size_t i = codes->count; i-- > 0;) { /* the last ones are the likeliest */
        if (!is_same(&codes->codes[i], code))
            continue;
        code_free(code);
        *index = (uint32_t)i + 1;
        return FM_OK;
    }
    fm_code *grown = reallocarray(codes->codes, codes->count + 1, sizeof *grown);
    if (grown == NULL) {
        code_free(code);
        return fm_fail(err, FM_NO_MEMORY, "no memory for a row's code");
    }
    codes->codes = grown;
    grown[codes->count++] = *code;
    *index = (uint32_t)codes->count;
    return FM_OK;
}

fm_status codes_add(fm_codes *codes, size_t row, const fm_code *code, fm_error *err)
{
    fm_row_code *of = &codes->rows[row];
    fm_code joined = { 0 };
    of->launches++;
    if (code == NULL) {
        of->lacks_code = true;
        return FM_OK;
    }
    if (of->index != 0)
        code_join(&joined, &codes->codes[of->index - 1]);
    code_join(&joined, code);
    if (joined.failed) {
        code_free(&joined);
        return fm_fail(err, FM_NO_MEMORY, "no memory for a row's code");
    }
    return intern(codes, &of->index, &joined, err);
}

void codes_forget(fm_codes *codes, size_t row)
{
    fm_row_code *of = &codes->rows[row];
    *of = (fm_row_code){ .forgets = of->forgets + 1 };
}

const fm_code *codes_of(const fm_codes *codes, size_t row)
{
    const uint32_t index = codes->rows[row].index;
    return index != 0 ? &codes->codes[index - 1] : NULL;
}
