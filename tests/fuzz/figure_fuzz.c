#include "fuzz.h"
#include "model/figure_file.h"
#include "read/paper_figure.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_figure_file head;
    fm_paper_figure *figure = NULL;
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    fuzz_expect_reason(figure_file_read(&head, file.path, &err), &err);
    figure_file_close(&head);
    fuzz_expect_reason(paper_figure_read(&figure, file.path, &err), &err);
    paper_figure_close(figure);
    fuzz_file_close(&file);
    return 0;
}
