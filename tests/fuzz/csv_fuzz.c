/* summary.csv and samples.csv: the table, and what its rows mean. */
#include <stdlib.h>

#include "fuzz.h"
#include "read/cases.h"
#include "read/samples.h"

static void read_rows(const fm_table *table)
{
    static const uint8_t empty[] = "{}";
    fuzz_file file;
    fm_error err = { 0 };
    fm_provenance *manifest = NULL;
    fm_case_row *cases = NULL;
    fm_text_index ids = { 0 }, none = { 0 };
    fm_sample_rows samples = { 0 };
    fuzz_file_open(&file, empty, sizeof empty - 1);
    fuzz_expect_reason(provenance_read(&manifest, file.path, &err), &err);
    const fm_status status = cases_read(&cases, &ids, table, manifest, &err);
    fuzz_expect_reason(status, &err);
    const bool is_summary = status == FM_OK; /* what is refused as one may be samples of no case */
    const fm_case_list of = { .cases = cases,
                              .count = is_summary ? table->row_count : 0,
                              .ids = is_summary ? &ids : &none };
    fuzz_expect_reason(sample_rows_read(&samples, is_summary ? NULL : table, &of, &err), &err);
    sample_rows_free(&samples);
    free(cases);
    text_index_free(&ids);
    provenance_close(manifest);
    fuzz_file_close(&file);
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_table *table = NULL;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    const fm_status status = table_read(&table, file.path, &err);
    fuzz_expect_reason(status, &err);
    if (status == FM_OK)
        read_rows(table);
    table_close(table);
    fuzz_file_close(&file);
    return 0;
}
