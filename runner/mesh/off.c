/* Geomview's OFF, as text. */
#include <ctype.h>
#include <inttypes.h>
#include <string.h>

#include "readers.h"

typedef struct off_state {
    fm_scan scan;
    fm_polygons *polygons;
    uint64_t vertices, faces; /* declared */
    bool has_normals;
    fm_error *err;
} off_state;

static fm_status ends_early(off_state *state, const char *what, uint64_t number, uint64_t count)
{
    return scan_fail(&state->scan, state->err,
                     "the file ends before the end of %s %" PRIu64 " of %" PRIu64
                     ": is it cut off?",
                     what, number, count);
}

/* Some writers put no space between the kind and the first count: "OFF490 518 0". */
static fm_word without_count(off_state *state, fm_word word)
{
    enum { KIND_BYTES = 3 };
    if (word.length > KIND_BYTES && isdigit((unsigned char)word.bytes[KIND_BYTES])) {
        state->scan.at = word.bytes + KIND_BYTES;
        word.length = KIND_BYTES;
    }
    return word;
}

/* [ST][C][N][4][n]OFF [BINARY]. A file may begin with its counts at once. */
static fm_status read_kind(off_state *state, fm_word word)
{
    static const char *const prefixes[] = { "ST", "C", "N" };
    fm_word left = word;
    for (size_t i = 0; i < sizeof prefixes / sizeof prefixes[0]; i++) {
        const size_t length = strlen(prefixes[i]);
        if (left.length <= length || memcmp(left.bytes, prefixes[i], length) != 0)
            continue;
        state->has_normals = state->has_normals || i == 2;
        left = (fm_word){ left.bytes + length, left.length - length };
    }
    if (!word_is(without_count(state, left), "OFF"))
        return scan_fail(&state->scan, state->err, "'%.*s': an OFF of this kind is not read",
                         WORD_TEXT(word));
    return FM_OK;
}

static fm_status read_count(uint64_t *count, off_state *state, const char *what)
{
    fm_word word;
    int64_t number = -1;
    if (!scan_word_on(&word, &state->scan))
        return scan_fail(&state->scan, state->err, "the file ends before its number of %s", what);
    if (word_is(word, "BINARY"))
        return scan_fail(&state->scan, state->err, "binary OFF is not read");
    if (!word_integer(&number, word) || number < 0)
        return scan_fail(&state->scan, state->err, "number of %s: '%.*s'", what, WORD_TEXT(word));
    *count = (uint64_t)number;
    return FM_OK;
}

static fm_status read_head(off_state *state)
{
    fm_word word;
    uint64_t edges;
    int64_t number;
    if (!scan_line(&state->scan))
        return fm_fail(state->err, FM_INVALID, "%s: an empty file", state->scan.path);
    const char *start = state->scan.at;
    scan_word(&word, &state->scan);
    fm_status status = FM_OK;
    if (word_integer(&number, word))
        state->scan.at = start;
    else
        status = read_kind(state, word);
    if (status == FM_OK)
        status = read_count(&state->vertices, state, "vertices");
    if (status == FM_OK)
        status = read_count(&state->faces, state, "faces");
    return status == FM_OK ? read_count(&edges, state, "edges") : status;
}

/* What stands behind a vertex or a face on its line. */
static int skip_rest(off_state *state)
{
    fm_word word;
    int count = 0;
    while (scan_word(&word, &state->scan))
        count++;
    return count;
}

static fm_status read_real(double *value, off_state *state, uint64_t number)
{
    fm_word word;
    if (!scan_word_on(&word, &state->scan))
        return ends_early(state, "vertex", number, state->vertices);
    if (!word_real(value, &state->scan, word))
        return scan_fail(&state->scan, state->err, "vertex %" PRIu64 ": '%.*s' is not a number",
                         number, WORD_TEXT(word));
    return FM_OK;
}

static fm_status read_vertex(off_state *state, uint64_t number)
{
    double at[3], normal[3];
    fm_status status = FM_OK;
    for (int axis = 0; axis < 3 && status == FM_OK; axis++)
        status = read_real(&at[axis], state, number);
    for (int axis = 0; axis < 3 && status == FM_OK && state->has_normals; axis++)
        status = read_real(&normal[axis], state, number);
    if (status == FM_OK)
        status = polygons_position(state->polygons, at, state->err);
    if (status == FM_OK && state->has_normals)
        status = polygons_normal(state->polygons, normal, state->err);
    if (status == FM_OK && skip_rest(state) >= 3)
        polygons_ignore(state->polygons, FM_MESH_VERTEX_COLOURS);
    return status;
}

/* The corners may go on over lines; what follows the last one on its line is a colour. */
static fm_status read_face(off_state *state, uint64_t number)
{
    fm_word word;
    int64_t corners = 0, index = 0;
    fm_status status = FM_OK;
    if (!scan_word_on(&word, &state->scan))
        return ends_early(state, "face", number, state->faces);
    const uint64_t line = state->scan.line;
    if (!word_integer(&corners, word) || corners < 0)
        return scan_fail(&state->scan, state->err, "face %" PRIu64 ": '%.*s' corners", number,
                         WORD_TEXT(word));
    for (int64_t i = 0; i < corners && status == FM_OK; i++) {
        if (!scan_word_on(&word, &state->scan))
            return ends_early(state, "face", number, state->faces);
        if (!word_integer(&index, word) || index < 0 || (uint64_t)index >= state->vertices)
            return scan_fail(&state->scan, state->err, "face %" PRIu64 ": vertex %.*s of %" PRIu64,
                             number, WORD_TEXT(word), state->vertices);
        status = polygons_corner(state->polygons, (uint32_t)index,
                                 state->has_normals ? (uint32_t)index : FM_NO_NORMAL, state->err);
    }
    if (status == FM_OK && skip_rest(state) > 0)
        polygons_ignore(state->polygons, FM_MESH_FACE_COLOURS);
    return status == FM_OK ? polygons_end_face(state->polygons, line, state->err) : status;
}

fm_status off_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err)
{
    off_state state = { .polygons = polygons, .err = err };
    fm_status status = scan_open(&state.scan, file, err);
    if (status == FM_OK)
        status = read_head(&state);
    for (uint64_t i = 0; i < state.vertices && status == FM_OK; i++)
        status = read_vertex(&state, i);
    for (uint64_t i = 0; i < state.faces && status == FM_OK; i++)
        status = read_face(&state, i);
    if (status == FM_OK && scan_line(&state.scan))
        polygons_ignore(polygons, FM_MESH_TRAILING);
    polygons->facts.parts = 1;
    scan_close(&state.scan);
    return status;
}
