/* For tests of mesh files: a text becomes a file, and is read. */
#ifndef FM_MESH_KIT_H
#define FM_MESH_KIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "mesh/mesh_file.h"

/* mesh_file_read of a file with these bytes and this ending of its name. */
fm_status read_bytes(fm_mesh *mesh, fm_error *err, const char *ending, const void *bytes,
                     size_t count);
/* The same, and the test fails where it does. */
void load_bytes(fm_mesh *mesh, const char *ending, const void *bytes, size_t count);
void load(fm_mesh *mesh, const char *ending, const char *text);
/* FM_INVALID, the file's name first, the reason somewhere. */
void assert_refused(const char *ending, const char *text, const char *reason);
/* Of all triangles, in the file's units. */
double area_of(const fm_mesh *mesh);
/* Loads, and compares triangles and area. */
fm_mesh_facts assert_loads(const char *ending, const char *text, uint64_t triangles, double area);
/* Nothing but this is ignored. */
bool ignores(const fm_mesh_facts *facts, fm_mesh_ignored what);

/* Parts of files. */
#define CORNERS     "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define FACE        "f 1 2 3\n"
#define HALF        0.5
#define PLY(format) "ply\nformat " format " 1.0\ncomment of a test\n"
#define XYZ(n)      "element vertex " #n "\nproperty float x\nproperty float y\nproperty float z\n"
#define FACES(n)    "element face " #n "\nproperty list uchar int vertex_indices\n"
#define END         "end_header\n"
#define FACET                                                                                      \
    "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "                      \
    "0\nendloop\nendfacet\n"

#endif
