/* Targets of fuzzing: one file a reader, each with libFuzzer's function. Built by clang in preset
 * `fuzz`, a target links libFuzzer, which is led by coverage; built otherwise, driver.c, which is
 * not. A target must hold whatever it is given: no crash, no report of a sanitizer, no leak, no
 * time beyond seconds, and an error that names what is wrong. */
#ifndef FM_FUZZ_H
#define FM_FUZZ_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count);

/* A file that holds the bytes, for readers that take a path. No other is open meanwhile. */
typedef struct fuzz_file {
    int fd;
    char path[64];
} fuzz_file;
void fuzz_file_open(fuzz_file *file, const uint8_t *bytes, size_t count);
void fuzz_file_close(const fuzz_file *file);

/* Stops the program unless a refusal says why, and nothing else does. */
void fuzz_expect_reason(fm_status status, const fm_error *err);

#endif
