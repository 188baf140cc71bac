/* Wavefront OBJ. Polygons are read; points, lines, curves and surfaces are left out. */
#include <inttypes.h>
#include <string.h>

#include "readers.h"

/* What messages call a place: position, texture coordinate, normal. */
enum { OBJ_REFERENCES = 3 };
static const char *const reference_names[OBJ_REFERENCES] = { "vertex", "texture coordinate",
                                                             "normal" };

typedef struct obj_state {
    fm_scan scan;
    fm_polygons *polygons;
    uint64_t counts[OBJ_REFERENCES];
    uint64_t furthest[OBJ_REFERENCES];      /* largest number named so far */
    uint64_t furthest_line[OBJ_REFERENCES]; /* and where: it may be given later */
    bool is_part_open;                      /* a face was met since the last group */
    fm_error *err;
} obj_state;

/* x y z; x y z w; or x y z r g b, perhaps with alpha. */
static fm_status read_vertex(obj_state *state)
{
    double at[3], more[4] = { 1, 0, 0, 0 };
    int count = 0;
    fm_word word;
    fm_status status = scan_reals(at, 3, &state->scan, "a vertex", state->err);
    for (; status == FM_OK && scan_word(&word, &state->scan); count++)
        if (count == 4 || !word_real(&more[count], &state->scan, word))
            status = scan_fail(&state->scan, state->err, "a vertex: '%.*s' is not expected",
                               WORD_TEXT(word));
    if (status == FM_OK && count == 2)
        status = scan_fail(&state->scan, state->err,
                           "a vertex of 5 numbers: legal are 3, 4 with a weight, 6 or 7 with a "
                           "colour");
    if (status == FM_OK && count == 1 && (more[0] < 1.0 || more[0] > 1.0))
        status = scan_fail(&state->scan, state->err, "a vertex of weight %g: only weight 1 is read",
                           more[0]);
    if (status != FM_OK)
        return status;
    if (count >= 3)
        polygons_ignore(state->polygons, FM_MESH_VERTEX_COLOURS);
    state->counts[0]++;
    return polygons_position(state->polygons, at, state->err);
}

static fm_status read_normal(obj_state *state)
{
    double normal[3];
    const fm_status status = scan_reals(normal, 3, &state->scan, "a normal", state->err);
    if (status != FM_OK)
        return status;
    state->counts[2]++;
    return polygons_normal(state->polygons, normal, state->err);
}

/* Numbers count from 1, or from the end as -1, -2. *index counts from 0. */
static fm_status take_reference(uint32_t *index, obj_state *state, int which, int64_t number)
{
    const uint64_t count = state->counts[which];
    const uint64_t back = number < 0 ? 0 - (uint64_t)number : 0;
    if (number == 0 || number > UINT32_MAX || back > count)
        return scan_fail(&state->scan, state->err, "a face: %s %" PRId64 " of %" PRIu64,
                         reference_names[which], number, count);
    const uint64_t from_one = number > 0 ? (uint64_t)number : count - back + 1;
    if (from_one > state->furthest[which]) {
        state->furthest[which] = from_one;
        state->furthest_line[which] = state->scan.line;
    }
    *index = (uint32_t)(from_one - 1);
    return FM_OK;
}

/* "7", "7/2", "7//3" or "7/2/3". */
static fm_status read_corner(obj_state *state, fm_word word)
{
    uint32_t indices[OBJ_REFERENCES] = { 0, 0, FM_NO_NORMAL };
    const char *at = word.bytes, *const end = word.bytes + word.length;
    for (int which = 0; which < OBJ_REFERENCES && at <= end; which++) {
        int64_t number;
        const char *slash = memchr(at, '/', (size_t)(end - at));
        const fm_word part = { at, (size_t)((slash != NULL ? slash : end) - at) };
        at += part.length + 1;
        if (part.length == 0 && which > 0)
            continue;
        if (!word_integer(&number, part))
            return scan_fail(&state->scan, state->err, "a face: '%.*s' names no vertex",
                             WORD_TEXT(word));
        const fm_status status = take_reference(&indices[which], state, which, number);
        if (status != FM_OK)
            return status;
    }
    if (at <= end)
        return scan_fail(&state->scan, state->err, "a face: '%.*s' has more than three numbers",
                         WORD_TEXT(word));
    return polygons_corner(state->polygons, indices[0], indices[2], state->err);
}

static fm_status read_face(obj_state *state)
{
    fm_word word;
    int corners = 0;
    fm_status status = FM_OK;
    for (; status == FM_OK && scan_word(&word, &state->scan); corners++)
        status = read_corner(state, word);
    if (status == FM_OK && corners < 3 && scan_is_open_line(&state->scan))
        return scan_fail(&state->scan, state->err,
                         "the last face has %d corners of at least 3: is the file cut off?",
                         corners);
    if (status == FM_OK && corners >= 3 && !state->is_part_open) {
        state->is_part_open = true;
        state->polygons->facts.parts++;
    }
    return status == FM_OK ? polygons_end_face(state->polygons, state->scan.line, state->err)
                           : status;
}

static fm_status skip_texture_coordinate(obj_state *state)
{
    state->counts[1]++;
    return FM_OK;
}

static fm_status begin_part(obj_state *state)
{
    state->is_part_open = false;
    return FM_OK;
}

static fm_status count_line(obj_state *state)
{
    state->polygons->facts.lines++;
    return FM_OK;
}

static fm_status count_points(obj_state *state)
{
    fm_word word;
    while (scan_word(&word, &state->scan))
        state->polygons->facts.points++;
    return FM_OK;
}

static fm_status ignore_material(obj_state *state)
{
    polygons_ignore(state->polygons, FM_MESH_MATERIALS);
    return FM_OK;
}

static fm_status ignore_curve(obj_state *state)
{
    polygons_ignore(state->polygons, FM_MESH_CURVES);
    return FM_OK;
}

static fm_status skip(obj_state *state)
{
    (void)state;
    return FM_OK;
}

static const struct {
    const char *word;
    fm_status (*read)(obj_state *state);
} statements[] = {
    { "v", read_vertex },
    { "vn", read_normal },
    { "vt", skip_texture_coordinate },
    { "f", read_face },
    { "fo", read_face },
    { "g", begin_part },
    { "o", begin_part },
    { "l", count_line },
    { "p", count_points },
    { "mtllib", skip },
    { "usemtl", ignore_material },
    { "s", skip },
    { "mg", skip },
    { "curv", ignore_curve },
    { "curv2", ignore_curve },
    { "surf", ignore_curve },
    { "vp", skip },
    { "cstype", skip },
    { "deg", skip },
    { "bmat", skip },
    { "step", skip },
    { "parm", skip },
    { "trim", skip },
    { "hole", skip },
    { "scrv", skip },
    { "sp", skip },
    { "end", skip },
    { "con", skip },
    { "bevel", skip },
    { "c_interp", skip },
    { "d_interp", skip },
    { "lod", skip },
    { "maplib", skip },
    { "usemap", ignore_material },
    { "shadow_obj", skip },
    { "trace_obj", skip },
    { "ctech", skip },
    { "stech", skip },
};

static fm_status read_statement(obj_state *state)
{
    fm_word word;
    scan_word(&word, &state->scan);
    for (size_t i = 0; i < sizeof statements / sizeof statements[0]; i++)
        if (word_is(word, statements[i].word))
            return statements[i].read(state);
    polygons_ignore(state->polygons, FM_MESH_UNKNOWN);
    return FM_OK;
}

/* Faces may name what comes later in the file, but not what never comes. */
static fm_status check_references(obj_state *state)
{
    for (int which = 0; which < OBJ_REFERENCES; which++)
        if (state->furthest[which] > state->counts[which]) {
            state->scan.line = state->furthest_line[which];
            return scan_fail(&state->scan, state->err,
                             "a face: %s %" PRIu64 " is out of range: the file has %" PRIu64,
                             reference_names[which], state->furthest[which], state->counts[which]);
        }
    return FM_OK;
}

fm_status obj_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err)
{
    obj_state state = { .polygons = polygons, .err = err };
    fm_status status = scan_open(&state.scan, file, err);
    state.scan.joins = true;
    while (status == FM_OK && scan_line(&state.scan))
        status = read_statement(&state);
    if (status == FM_OK)
        status = check_references(&state);
    scan_close(&state.scan);
    return status;
}
