/* STL, as text and binary. Each facet is flat: its own normal follows from its corners, since those
 * in files are often wrong or zero. */
#include <inttypes.h>
#include <string.h>

#include "readers.h"

enum { STL_HEAD_BYTES = 84, STL_FACET_BYTES = 50, STL_ATTRIBUTE_AT = 48 };

static uint32_t word_at(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

static double float_at(const char *bytes)
{
    const uint32_t bits = word_at(bytes);
    float value;
    memcpy(&value, &bits, sizeof value);
    return (double)value;
}

static fm_status add_corner(fm_polygons *polygons, const double at[3], fm_error *err)
{
    const fm_status status = polygons_position(polygons, at, err);
    if (status != FM_OK)
        return status;
    return polygons_corner(polygons, (uint32_t)(polygons->position_count - 1), FM_NO_NORMAL, err);
}

static fm_status read_binary_facet(fm_polygons *polygons, const char *bytes, uint32_t number,
                                   fm_error *err)
{
    const char *facet = bytes + STL_HEAD_BYTES + (size_t)number * STL_FACET_BYTES;
    fm_status status = FM_OK;
    for (size_t corner = 0; corner < 3 && status == FM_OK; corner++) {
        double at[3];
        for (size_t axis = 0; axis < 3; axis++)
            at[axis] = float_at(facet + 12 + 12 * corner + 4 * axis);
        status = add_corner(polygons, at, err);
    }
    if (facet[STL_ATTRIBUTE_AT] != 0 || facet[STL_ATTRIBUTE_AT + 1] != 0)
        polygons_ignore(polygons, FM_MESH_FACE_COLOURS);
    return status == FM_OK ? polygons_end_face(polygons, number, err) : status;
}

static uint64_t binary_bytes(const fm_file_bytes *file)
{
    return STL_HEAD_BYTES + (uint64_t)STL_FACET_BYTES * word_at(file->bytes + 80);
}

static fm_status read_binary(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err)
{
    fm_status status = FM_OK;
    if (file->count < STL_HEAD_BYTES)
        return fm_fail(err, FM_INVALID, "%s: neither text nor a binary STL: %zu bytes", file->path,
                       file->count);
    const uint32_t facets = word_at(file->bytes + 80);
    if (file->count < binary_bytes(file))
        return fm_fail(err, FM_INVALID,
                       "%s: %" PRIu32 " triangles need %" PRIu64
                       " bytes, the file has %zu: is it cut off?",
                       file->path, facets, binary_bytes(file), file->count);
    polygons->element = "facet";
    for (uint32_t i = 0; i < facets && status == FM_OK; i++)
        status = read_binary_facet(polygons, file->bytes, i, err);
    if (file->count > binary_bytes(file))
        polygons_ignore(polygons, FM_MESH_TRAILING);
    polygons->facts.parts = 1;
    return status;
}

static fm_status expect(fm_scan *scan, const char *wanted, fm_error *err)
{
    fm_word word;
    if (!scan_word_on(&word, scan))
        return scan_fail(scan, err, "the file ends before '%s': is it cut off?", wanted);
    if (!word_is_any_case(word, wanted))
        return scan_fail(scan, err, "'%.*s', where '%s' is expected", WORD_TEXT(word), wanted);
    return FM_OK;
}

/* The normal, of three words or none, and `outer`. */
static fm_status skip_normal(fm_scan *scan, fm_error *err)
{
    enum { WORDS_MAX = 4 };
    fm_word word;
    for (int i = 0; i < WORDS_MAX; i++) {
        if (!scan_word_on(&word, scan))
            return scan_fail(scan, err, "the file ends before 'outer': is it cut off?");
        if (word_is_any_case(word, "outer"))
            return FM_OK;
    }
    return expect(scan, "outer", err);
}

/* A name goes to the end of its line, or to `facet normal`. */
static void skip_name(fm_scan *scan)
{
    fm_word word;
    const char *facet = NULL;
    while (scan_word(&word, scan)) {
        if (facet != NULL && word_is_any_case(word, "normal")) {
            scan->at = facet;
            return;
        }
        facet = word_is_any_case(word, "facet") ? word.bytes : NULL;
    }
}

/* Behind `facet`. A loop may have any number of corners. */
static fm_status read_facet(fm_polygons *polygons, fm_scan *scan, fm_error *err)
{
    fm_word word;
    double at[3];
    const uint64_t line = scan->line;
    fm_status status = skip_normal(scan, err);
    if (status == FM_OK)
        status = expect(scan, "loop", err);
    while (status == FM_OK && scan_word_on(&word, scan) && word_is_any_case(word, "vertex")) {
        status = scan_reals_on(at, 3, scan, "a vertex", err);
        if (status == FM_OK)
            status = add_corner(polygons, at, err);
    }
    if (status == FM_OK && !word_is_any_case(word, "endloop"))
        status = scan_fail(scan, err, "a facet has no 'endloop': is the file cut off?");
    if (status == FM_OK)
        status = expect(scan, "endfacet", err);
    return status == FM_OK ? polygons_end_face(polygons, line, err) : status;
}

/* Behind `solid`, to its `endsolid`. */
static fm_status read_solid(fm_polygons *polygons, fm_scan *scan, fm_error *err)
{
    fm_word word;
    const size_t faces = polygons->face_count;
    fm_status status = FM_OK;
    skip_name(scan);
    while (status == FM_OK && scan_word_on(&word, scan)) {
        if (word_is_any_case(word, "endsolid")) {
            skip_name(scan);
            polygons->facts.parts += polygons->face_count > faces;
            return FM_OK;
        }
        if (!word_is_any_case(word, "facet"))
            return scan_fail(scan, err, "'%.*s', where 'facet' or 'endsolid' is expected",
                             WORD_TEXT(word));
        status = read_facet(polygons, scan, err);
    }
    if (status == FM_OK)
        status = scan_fail(scan, err, "a solid has no 'endsolid': is the file cut off?");
    return status;
}

static fm_status read_text(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err)
{
    fm_scan scan;
    fm_status status = scan_open(&scan, file, err);
    while (status == FM_OK && (scan_has_word(&scan) || scan_line(&scan))) {
        status = expect(&scan, "solid", err);
        if (status == FM_OK)
            status = read_solid(polygons, &scan, err);
    }
    scan_close(&scan);
    return status;
}

static bool begins_as_text(const fm_file_bytes *file)
{
    const char *start = file->bytes;
    start += strncmp(start, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    start += strspn(start, " \t\r\n");
    return strncasecmp(start, "solid", 5) == 0 || *start == '#';
}

fm_status stl_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err)
{
    const bool is_binary = (file->count >= STL_HEAD_BYTES && file->count == binary_bytes(file)) ||
                           !begins_as_text(file) || memchr(file->bytes, '\0', file->count) != NULL;
    polygons->is_flat = true;
    return is_binary ? read_binary(polygons, file, err) : read_text(polygons, file, err);
}
