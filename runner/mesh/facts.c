#include "facts.h"

#include <inttypes.h>

static const char *const ignored_names[] = {
    [FM_MESH_VERTEX_COLOURS] = "colours of vertices",
    [FM_MESH_FACE_COLOURS] = "colours of faces",
    [FM_MESH_MATERIALS] = "materials with their opacity",
    [FM_MESH_CURVES] = "curves and surfaces",
    [FM_MESH_UNKNOWN] = "elements of unknown names",
    [FM_MESH_TRAILING] = "data behind the declared end",
};
_Static_assert(sizeof ignored_names / sizeof ignored_names[0] == FM_MESH_IGNORED_COUNT,
               "one name for each fm_mesh_ignored");

const char *mesh_ignored_name(fm_mesh_ignored what)
{
    return ignored_names[what];
}

static void add_count(fm_text *text, const char **before, uint64_t count, const char *one)
{
    if (count == 0)
        return;
    text_add(text, "%s%" PRIu64 " %s%s", *before, count, one, count == 1 ? "" : "s");
    *before = ", ";
}

static void add_point(fm_text *text, const double point[3])
{
    text_add(text, "%.12g %.12g %.12g", point[0], point[1], point[2]);
}

static void add_ignored(fm_text *text, uint32_t ignored)
{
    const char *before = "; ignored: ";
    for (int i = 0; i < FM_MESH_IGNORED_COUNT; i++) {
        if ((ignored >> i & 1u) == 0)
            continue;
        text_add(text, "%s%s", before, ignored_names[i]);
        before = ", ";
    }
}

void mesh_facts_rest(fm_text *text, const fm_mesh_facts *facts)
{
    const char *before = "; left out: ";
    add_count(text, &before, facts->without_area, "face");
    if (facts->without_area > 0)
        text_add(text, " without area");
    add_count(text, &before, facts->lines, "line");
    add_count(text, &before, facts->points, "point");
    add_ignored(text, facts->ignored);
}

void mesh_facts_text(fm_text *text, const fm_mesh_facts *facts)
{
    text_add(text, "%s, %" PRIu64 " triangle%s in %" PRIu64 " part%s, box ", facts->format,
             facts->triangles, facts->triangles == 1 ? "" : "s", facts->parts,
             facts->parts == 1 ? "" : "s");
    add_point(text, facts->box.low);
    text_add(text, " to ");
    add_point(text, facts->box.high);
    mesh_facts_rest(text, facts);
    if (facts->warped > 0)
        text_add(text, "; cut from the first corner, since far from flat: %" PRIu64 " face%s",
                 facts->warped, facts->warped == 1 ? "" : "s");
    if (facts->lost_area > 0)
        text_add(text, "; a float does not hold the area of %" PRIu64 " of the triangles",
                 facts->lost_area);
    if (facts->spacing > 0.0)
        text_add(text, "; coordinates were read as floats, which here are %.1e of the box apart",
                 facts->spacing);
    text_add(text, "; drawn in one stone colour, with the opacity of key alpha");
}
