/* A hull of a mesh of four vertices. */
#include "fuzz.h"
#include "scene/solid.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    fuzz_file file;
    fm_solid solid;
    const fm_scene scene = { .vertex_count = 4 };
    fm_error err = { 0 };
    fuzz_file_open(&file, bytes, count);
    fuzz_expect_reason(solid_read(&solid, file.path, &scene, &err), &err);
    solid_free(&solid);
    fuzz_file_close(&file);
    return 0;
}
