/* Stanford PLY, as text and binary in both byte orders: vertices, faces and strips of triangles. */
#include "ply.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "readers.h"

static const size_t type_bytes[PLY_TYPE_COUNT] = { 1, 1, 2, 2, 4, 4, 4, 8 };

typedef struct ply_state {
    fm_scan scan;
    ply_format format;
    fm_polygons *polygons;
    bool has_normals;           /* all vertices have */
    const ply_element *element; /* the one that is read */
    uint64_t number;            /* which of them */
    bool shares_lines;          /* an element began on the line of another */
    uint64_t origin;            /* the same, or in text the line that it begins on */
    double vertex[PLY_NORMAL_X + 3];
    fm_error *err;
} ply_state;

static fm_status fail_at(ply_state *state, const char *what)
{
    if (state->format == PLY_ASCII)
        return scan_fail(&state->scan, state->err, "%s %" PRIu64 ": %s", state->element->name,
                         state->number, what);
    return fm_fail(state->err, FM_INVALID, "%s: %s %" PRIu64 ": %s", state->scan.path,
                   state->element->name, state->number, what);
}

static double number_of(const unsigned char bytes[8], ply_type type)
{
    uint64_t bits = 0;
    float single;
    double whole;
    for (size_t i = 0; i < type_bytes[type]; i++)
        bits |= (uint64_t)bytes[i] << 8 * i;
    const uint32_t low = (uint32_t)bits;
    switch (type) {
    case PLY_CHAR:
        return (double)(int8_t)bits;
    case PLY_SHORT:
        return (double)(int16_t)bits;
    case PLY_INT:
        return (double)(int32_t)bits;
    case PLY_UCHAR:
    case PLY_USHORT:
    case PLY_UINT:
        return (double)bits;
    case PLY_FLOAT:
        memcpy(&single, &low, sizeof single);
        return (double)single;
    case PLY_DOUBLE:
        memcpy(&whole, &bits, sizeof whole);
        return whole;
    case PLY_TYPE_COUNT:
        break;
    }
    return 0.0;
}

/* The next value of an element, whatever the format. */
static fm_status read_value(double *value, ply_state *state, ply_type type)
{
    fm_scan *scan = &state->scan;
    unsigned char bytes[8];
    fm_word word;
    const size_t count = type_bytes[type];
    if (state->format == PLY_ASCII) {
        if (!scan_word(&word, scan))
            return fail_at(state, state->shares_lines
                                      ? "a value is missing, or a line has more than is declared"
                                      : "a value is missing: is the file cut off?");
        return word_real(value, scan, word) ? FM_OK : fail_at(state, "not a number");
    }
    if ((size_t)(scan->end - scan->next) < count)
        return fail_at(state, "the file ends: is it cut off?");
    for (size_t i = 0; i < count; i++)
        bytes[state->format == PLY_BIG_ENDIAN ? count - 1 - i : i] = (unsigned char)scan->next[i];
    scan->next += count;
    *value = number_of(bytes, type);
    return FM_OK;
}

/* -1 ends a strip. */
static fm_status read_index(int64_t *index, ply_state *state, ply_type type)
{
    double value = 0;
    const fm_status status = read_value(&value, state, type);
    if (status != FM_OK)
        return status;
    const bool is_end = state->element->kind == PLY_STRIPS && value >= -1.0 && value <= -1.0;
    if (!is_end && !(value >= 0.0 && value < UINT32_MAX && floor(value) >= value))
        return fail_at(state, "an index that is no vertex's");
    *index = (int64_t)value;
    return FM_OK;
}

static fm_status add_corner(ply_state *state, uint32_t index)
{
    return polygons_corner(state->polygons, index, state->has_normals ? index : FM_NO_NORMAL,
                           state->err);
}

/* Every second triangle is turned about, so that all have one orientation. */
static fm_status add_strip_triangle(ply_state *state, const uint32_t corners[3], bool is_turned)
{
    fm_status status = add_corner(state, corners[is_turned ? 1 : 0]);
    if (status == FM_OK)
        status = add_corner(state, corners[is_turned ? 0 : 1]);
    if (status == FM_OK)
        status = add_corner(state, corners[2]);
    return status == FM_OK ? polygons_end_face(state->polygons, state->origin, state->err) : status;
}

static bool has_twins(const uint32_t corners[3])
{
    return corners[0] == corners[1] || corners[1] == corners[2] || corners[0] == corners[2];
}

/* Strips are sewn together by corners that are named twice: those triangles are no faces. */
static fm_status read_strip(ply_state *state, ply_type type, uint64_t count)
{
    uint32_t last[3] = { 0 };
    uint64_t corners = 0; /* since the strip's begin */
    fm_status status = FM_OK;
    for (uint64_t i = 0; i < count && status == FM_OK; i++) {
        int64_t index = 0;
        status = read_index(&index, state, type);
        if (status != FM_OK || index < 0) {
            corners = 0;
            continue;
        }
        last[0] = last[1];
        last[1] = last[2];
        last[2] = (uint32_t)index;
        corners++;
        if (corners >= 3 && !has_twins(last))
            status = add_strip_triangle(state, last, corners % 2 == 0);
    }
    return status;
}

static fm_status read_corners(ply_state *state, ply_type type, uint64_t count)
{
    fm_status status = FM_OK;
    for (uint64_t i = 0; i < count && status == FM_OK; i++) {
        int64_t index = 0;
        status = read_index(&index, state, type);
        if (status == FM_OK)
            status = add_corner(state, (uint32_t)index);
    }
    return status == FM_OK ? polygons_end_face(state->polygons, state->origin, state->err) : status;
}

static fm_status read_list(ply_state *state, const ply_property *property)
{
    double count = 0, value;
    fm_status status = read_value(&count, state, property->count_type);
    if (status != FM_OK)
        return status;
    if (!(count >= 0.0 && count <= UINT32_MAX && floor(count) >= count))
        return fail_at(state, "a list with no legal length");
    if (property->role == PLY_INDICES && state->element->kind == PLY_STRIPS)
        return read_strip(state, property->type, (uint64_t)count);
    if (property->role == PLY_INDICES)
        return read_corners(state, property->type, (uint64_t)count);
    for (uint64_t i = 0; i < (uint64_t)count && status == FM_OK; i++)
        status = read_value(&value, state, property->type);
    return status;
}

static fm_status read_properties(ply_state *state)
{
    double value = 0;
    fm_status status = FM_OK;
    for (size_t i = 0; i < state->element->property_count && status == FM_OK; i++) {
        const ply_property *property = &state->element->properties[i];
        if (property->is_list) {
            status = read_list(state, property);
            continue;
        }
        status = read_value(&value, state, property->type);
        if (property->role >= PLY_X && property->role < PLY_INDICES)
            state->vertex[property->role] = value;
    }
    return status;
}

/* A line holds whole elements, in most files one. */
static bool begin_element(ply_state *state)
{
    if (!scan_has_word(&state->scan))
        return scan_line(&state->scan);
    state->shares_lines = true;
    return true;
}

static fm_status read_one(ply_state *state)
{
    const bool is_text = state->format == PLY_ASCII;
    if (is_text && !begin_element(state))
        return fail_at(state, "the file ends: is it cut off?");
    state->origin = is_text ? state->scan.line : state->number;
    fm_status status = read_properties(state);
    if (status == FM_OK && state->element->kind == PLY_VERTEX)
        status = polygons_position(state->polygons, &state->vertex[PLY_X], state->err);
    if (status == FM_OK && state->has_normals && state->element->kind == PLY_VERTEX)
        status = polygons_normal(state->polygons, &state->vertex[PLY_NORMAL_X], state->err);
    return status;
}

static void note_element(fm_polygons *polygons, const ply_element *element)
{
    if (element->count == 0)
        return;
    if (ply_has(element, PLY_COLOUR))
        polygons_ignore(polygons, element->kind == PLY_VERTEX ? FM_MESH_VERTEX_COLOURS
                                                              : FM_MESH_FACE_COLOURS);
    if (element->kind == PLY_OTHER)
        polygons_ignore(polygons, FM_MESH_UNKNOWN);
    if (element->kind == PLY_EDGE)
        polygons->facts.lines += element->count;
}

/* Bytes have no lines. */
static void note_origin(ply_state *state, ply_kind kind)
{
    const char *name = kind == PLY_FACE ? "face" : "tristrips";
    if (state->format == PLY_ASCII || (kind != PLY_FACE && kind != PLY_STRIPS))
        return;
    state->polygons->element = state->polygons->face_count > 0 ? "face or tristrips" : name;
}

static fm_status read_elements(ply_state *state, const ply_element *element)
{
    fm_status status = FM_OK;
    note_element(state->polygons, element);
    note_origin(state, element->kind);
    state->element = element;
    if (element->property_count == 0) /* nothing stands in the body */
        return FM_OK;
    for (uint64_t i = 0; i < element->count && status == FM_OK; i++) {
        state->number = i;
        status = read_one(state);
    }
    return status;
}

/* Faces may stand before the vertices. */
static bool all_have_normals(const ply_head *head)
{
    for (size_t i = 0; i < head->element_count; i++)
        for (int axis = 0; axis < 3; axis++)
            if (head->elements[i].kind == PLY_VERTEX &&
                !ply_has(&head->elements[i], (ply_role)(PLY_NORMAL_X + axis)))
                return false;
    return true;
}

/* Lines behind the last element are left out. What is left of lines with several elements may be
 * values of each that the head does not declare: then all of them were read wrong. */
static fm_status check_end(ply_state *state)
{
    fm_scan *scan = &state->scan;
    const bool is_text = state->format == PLY_ASCII,
               is_within_line = is_text && scan_has_word(scan);
    const bool has_more = is_within_line || (is_text ? scan_line(scan) : scan->next < scan->end);
    if (has_more && (is_within_line || state->shares_lines))
        return fail_at(state, "more values than the head declares");
    if (has_more)
        polygons_ignore(state->polygons, FM_MESH_TRAILING);
    return FM_OK;
}

fm_status ply_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err)
{
    ply_state state = { .polygons = polygons, .err = err };
    ply_head *head = malloc(sizeof *head);
    if (head == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the head of %s", file->path);
    fm_status status = scan_open(&state.scan, file, err);
    if (status == FM_OK)
        status = ply_head_read(head, &state.scan, err);
    if (status == FM_OK) {
        state.format = head->format;
        state.scan.at = state.scan.line_end; /* of end_header */
        state.has_normals = all_have_normals(head);
    }
    for (size_t i = 0; status == FM_OK && i < head->element_count; i++)
        status = read_elements(&state, &head->elements[i]);
    if (status == FM_OK)
        status = check_end(&state);
    polygons->facts.parts = 1;
    scan_close(&state.scan);
    free(head);
    return status;
}
