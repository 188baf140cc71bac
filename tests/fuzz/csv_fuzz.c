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
    fm_sample_rows samples = { 0 };
    fuzz_file_open(&file, empty, sizeof empty - 1);
    fuzz_expect_reason(provenance_read(&manifest, file.path, &err), &err);
    const fm_status status = cases_read(&cases, table, manifest, &err);
    fuzz_expect_reason(status, &err);
    const size_t count = status == FM_OK ? table->row_count : 0;
    fuzz_expect_reason(sample_rows_read(&samples, table, cases, count, &err), &err);
    sample_rows_free(&samples);
    free(cases);
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
