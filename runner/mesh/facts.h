/* What is told of a mesh that was loaded: what a scene is made of, and what of the file is not. */
#ifndef FM_MESH_FACTS_H
#define FM_MESH_FACTS_H

#include <stdint.h>

#include "base/text.h"
#include "space.h"

/* What a file may hold that is not drawn as the file says. */
typedef enum fm_mesh_ignored {
    FM_MESH_VERTEX_COLOURS,
    FM_MESH_FACE_COLOURS,
    FM_MESH_MATERIALS,
    FM_MESH_CURVES,
    FM_MESH_UNKNOWN,  /* elements or lines with a name that no reader knows */
    FM_MESH_TRAILING, /* bytes behind what the file itself declares */
    FM_MESH_IGNORED_COUNT
} fm_mesh_ignored;

typedef struct fm_mesh_facts {
    char format[16]; /* "OBJ", "3ds"; "": no mesh was loaded */
    uint64_t triangles, vertices;
    uint64_t parts; /* pieces that the file keeps apart: groups of OBJ, solids of STL, meshes */
    uint64_t without_area;  /* faces that were dropped */
    uint64_t warped;        /* faces so far from flat that another cut would be another surface */
    uint64_t lost_area;     /* triangles that are drawn, but whose area a float does not hold */
    uint64_t lines, points; /* left out */
    uint32_t ignored;       /* bit i: fm_mesh_ignored i */
    fm_box box;             /* of what triangles use, in the file's units */
    double spacing;         /* between neighbours that the reader could tell apart at the box, as a
                               part of its largest side; 0: it read doubles */
} fm_mesh_facts;

/* "colours of vertices" */
const char *mesh_ignored_name(fm_mesh_ignored what);
/* "; left out: 2 lines; ignored: colours of faces", or nothing. */
void mesh_facts_rest(fm_text *text, const fm_mesh_facts *facts);
/* One sentence for people, without the file's name: "OBJ, 12 triangles in 1 part, box ...". */
void mesh_facts_text(fm_text *text, const fm_mesh_facts *facts);

#endif
