/* The first byte says the format, the rest is the file: read, cut, and made a mesh. */
#include "base/text.h"
#include "fuzz.h"
#include "mesh/mesh_build.h"
#include "mesh/readers.h"

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t count)
{
    static fm_status (*const readers[])(fm_polygons * polygons, const fm_file_bytes *file,
                                        fm_error *err) = { obj_read, ply_read, off_read, stl_read };
    fm_polygons polygons = { 0 };
    fm_mesh mesh = { 0 };
    fm_error err = { 0 };
    if (count == 0)
        return 0;
    fm_text text = { 0 }; /* ends with a NUL, as files that are read do */
    text_add_raw(&text, (const char *)bytes + 1, count - 1);
    const fm_file_bytes file = { .bytes = text.bytes, .count = text.length, .path = "fuzz" };
    fm_status status = readers[bytes[0] % 4](&polygons, &file, &err);
    if (status == FM_OK)
        status = mesh_build(&mesh, &polygons, "fuzz", &err);
    fuzz_expect_reason(status, &err);
    mesh_free(&mesh);
    polygons_free(&polygons);
    text_free(&text);
    return 0;
}
