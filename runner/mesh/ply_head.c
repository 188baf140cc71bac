#include <inttypes.h>
#include <stdio.h>

#include "ply.h"

static const struct {
    const char *name;
    ply_type type;
} types[] = {
    { "char", PLY_CHAR },      { "int8", PLY_CHAR },     { "uchar", PLY_UCHAR },
    { "uint8", PLY_UCHAR },    { "short", PLY_SHORT },   { "int16", PLY_SHORT },
    { "ushort", PLY_USHORT },  { "uint16", PLY_USHORT }, { "int", PLY_INT },
    { "int32", PLY_INT },      { "uint", PLY_UINT },     { "uint32", PLY_UINT },
    { "float", PLY_FLOAT },    { "float32", PLY_FLOAT }, { "double", PLY_DOUBLE },
    { "float64", PLY_DOUBLE },
};

static const struct {
    const char *name;
    ply_kind kind;
} kinds[] = {
    { "vertex", PLY_VERTEX },
    { "face", PLY_FACE },
    { "tristrips", PLY_STRIPS },
    { "edge", PLY_EDGE },
};

static const struct {
    const char *name;
    ply_kind kind;
    ply_role role;
} roles[] = {
    { "x", PLY_VERTEX, PLY_X },
    { "y", PLY_VERTEX, PLY_X + 1 },
    { "z", PLY_VERTEX, PLY_X + 2 },
    { "nx", PLY_VERTEX, PLY_NORMAL_X },
    { "ny", PLY_VERTEX, PLY_NORMAL_X + 1 },
    { "nz", PLY_VERTEX, PLY_NORMAL_X + 2 },
    { "red", PLY_VERTEX, PLY_COLOUR },
    { "r", PLY_VERTEX, PLY_COLOUR },
    { "diffuse_red", PLY_VERTEX, PLY_COLOUR },
    { "alpha", PLY_VERTEX, PLY_COLOUR },
    { "red", PLY_FACE, PLY_COLOUR },
    { "r", PLY_FACE, PLY_COLOUR },
    { "diffuse_red", PLY_FACE, PLY_COLOUR },
    { "alpha", PLY_FACE, PLY_COLOUR },
    { "vertex_indices", PLY_FACE, PLY_INDICES },
    { "vertex_index", PLY_FACE, PLY_INDICES },
    { "vertex_indices", PLY_STRIPS, PLY_INDICES },
    { "vertex_index", PLY_STRIPS, PLY_INDICES },
};

bool ply_has(const ply_element *element, ply_role role)
{
    for (size_t i = 0; i < element->property_count; i++)
        if (element->properties[i].role == role)
            return true;
    return false;
}

static fm_status read_type(ply_type *type, fm_scan *scan, fm_error *err)
{
    fm_word word;
    if (!scan_word(&word, scan))
        return scan_fail(scan, err, "a property without a type");
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++)
        if (word_is(word, types[i].name)) {
            *type = types[i].type;
            return FM_OK;
        }
    return scan_fail(scan, err, "a property of type '%.*s'", WORD_TEXT(word));
}

static fm_status read_element(ply_head *head, fm_scan *scan, fm_error *err)
{
    fm_word name, count;
    int64_t number;
    if (!scan_word(&name, scan) || !scan_word(&count, scan) || !word_integer(&number, count) ||
        number < 0)
        return scan_fail(scan, err, "an element without a name and a number");
    if (head->element_count == PLY_MAX_ELEMENTS)
        return scan_fail(scan, err, "more than %d elements", PLY_MAX_ELEMENTS);
    ply_element *element = &head->elements[head->element_count++];
    *element = (ply_element){ .count = (uint64_t)number };
    snprintf(element->name, sizeof element->name, "%.*s", WORD_TEXT(name));
    for (size_t i = 0; i < sizeof kinds / sizeof kinds[0]; i++)
        if (word_is(name, kinds[i].name))
            element->kind = kinds[i].kind;
    return FM_OK;
}

static fm_status read_property(ply_head *head, fm_scan *scan, fm_error *err)
{
    fm_word word;
    ply_property property = { .role = PLY_NO_ROLE };
    if (head->element_count == 0)
        return scan_fail(scan, err, "a property before any element");
    ply_element *element = &head->elements[head->element_count - 1];
    if (element->property_count == PLY_MAX_PROPERTIES)
        return scan_fail(scan, err, "more than %d properties", PLY_MAX_PROPERTIES);
    const char *start = scan->at;
    property.is_list = scan_word(&word, scan) && word_is(word, "list");
    if (!property.is_list)
        scan->at = start;
    fm_status status = property.is_list ? read_type(&property.count_type, scan, err) : FM_OK;
    if (status == FM_OK)
        status = read_type(&property.type, scan, err);
    if (status == FM_OK && !scan_word(&word, scan))
        status = scan_fail(scan, err, "a property without a name");
    if (status == FM_OK && property.is_list && property.count_type >= PLY_FLOAT)
        status = scan_fail(scan, err, "a list whose length is a fraction");
    if (status != FM_OK)
        return status;
    for (size_t i = 0; i < sizeof roles / sizeof roles[0]; i++)
        if (roles[i].kind == element->kind && word_is(word, roles[i].name) &&
            property.is_list == (roles[i].role == PLY_INDICES))
            property.role = roles[i].role;
    element->properties[element->property_count++] = property;
    return FM_OK;
}

static fm_status read_format(ply_head *head, fm_scan *scan, fm_error *err)
{
    static const char *const formats[] = { [PLY_ASCII] = "ascii",
                                           [PLY_LITTLE_ENDIAN] = "binary_little_endian",
                                           [PLY_BIG_ENDIAN] = "binary_big_endian" };
    fm_word word = { "", 0 };
    scan_word(&word, scan);
    for (size_t i = 0; i < sizeof formats / sizeof formats[0]; i++)
        if (word_is(word, formats[i])) {
            head->format = (ply_format)i;
            return FM_OK;
        }
    return scan_fail(scan, err, "format '%.*s'", WORD_TEXT(word));
}

/* What cannot be left out: without it the file's triangles would be others. */
static fm_status check_element(const ply_element *element, fm_scan *scan, fm_error *err)
{
    const bool has_corners = element->kind == PLY_FACE || element->kind == PLY_STRIPS;
    if (element->count == 0)
        return FM_OK;
    if (has_corners && !ply_has(element, PLY_INDICES))
        return scan_fail(scan, err, "element %s has no list vertex_indices", element->name);
    for (int axis = 0; axis < 3; axis++)
        if (element->kind == PLY_VERTEX && !ply_has(element, (ply_role)(PLY_X + axis)))
            return scan_fail(scan, err, "element %s has no property %c", element->name,
                             "xyz"[axis]);
    return FM_OK;
}

fm_status ply_head_read(ply_head *head, fm_scan *scan, fm_error *err)
{
    fm_word word;
    bool has_format = false;
    fm_status status = FM_OK;
    *head = (ply_head){ 0 };
    if (!scan_line(scan) || !scan_word(&word, scan) || !word_is(word, "ply"))
        return scan_fail(scan, err, "no PLY file: it does not begin with 'ply'");
    while (status == FM_OK) {
        if (!scan_line(scan))
            return scan_fail(scan, err, "the head has no end_header: is the file cut off?");
        scan_word(&word, scan);
        if (word_is(word, "end_header"))
            break;
        if (word_is(word, "element"))
            status = read_element(head, scan, err);
        else if (word_is(word, "property"))
            status = read_property(head, scan, err);
        else if (word_is(word, "format")) {
            status = read_format(head, scan, err);
            has_format = true;
        } else if (!word_is(word, "comment") && !word_is(word, "obj_info"))
            status = scan_fail(scan, err, "'%.*s' in the head", WORD_TEXT(word));
    }
    if (status == FM_OK && !has_format)
        status = scan_fail(scan, err, "the head names no format");
    for (size_t i = 0; i < head->element_count && status == FM_OK; i++)
        status = check_element(&head->elements[i], scan, err);
    return status;
}
