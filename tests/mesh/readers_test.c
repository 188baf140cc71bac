/* OBJ, PLY, OFF and STL: what is read, what is said of the rest, and what is refused why. */
#include "kit/mesh_kit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static void obj_is_read_in_all_its_spellings(void **state)
{
    (void)state;
    assert_loads(".obj", CORNERS FACE, 1, HALF);
    assert_loads(".OBJ", CORNERS FACE, 1, HALF);
    assert_loads(".obj", "\xEF\xBB\xBF" CORNERS FACE, 1, HALF);
    assert_loads(".obj", CORNERS "f 1 2 3", 1, HALF);
    assert_loads(".obj", CORNERS "f 1 \\\n 2 \\\r\n3\n", 1, HALF);
    assert_loads(".obj", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", 1, HALF);
    assert_loads(".obj", "v 0 0 0\r\nv 1 0 0 # x\n\n#\nv\t0 1e0 0\nf -3 -2 -1\n", 1, HALF);
    assert_loads(".obj", CORNERS "vt 0 0\nvn 0 0 1\nf 1/1 2/1/1 3//1\n", 1, HALF);
    assert_loads(".obj", FACE CORNERS, 1, HALF);
    assert_loads(".obj", CORNERS FACE "v 0 0 1\nv 2 0 1\nv 0 2 1\nf -3 -2 -1\n", 2, 2.5);
    assert_loads(".obj", "v 0 0 0 1\nv 1 0 0 1.0\nv 0 1 0\n" FACE, 1, HALF);
}

static void obj_says_what_it_leaves_out(void **state)
{
    (void)state;
    fm_mesh_facts facts =
        assert_loads(".obj", CORNERS FACE "l 1 2 3\np 1 2\nf 1 2\nf 3\n", 1, HALF);
    assert_int_equal(facts.lines, 2);
    assert_int_equal(facts.points, 3);
    facts = assert_loads(".obj", "l 1 2\n" CORNERS FACE, 1, HALF);
    assert_int_equal(facts.lines, 1);
    assert_int_equal(facts.ignored, 0);
    facts = assert_loads(".obj", "v 0 0 0 1 0 0\nv 1 0 0 0 1 0 0.5\nv 0 1 0\n" FACE, 1, HALF);
    assert_true(ignores(&facts, FM_MESH_VERTEX_COLOURS));
    facts = assert_loads(".obj", "mtllib a.mtl\n" CORNERS "usemtl glass\n" FACE, 1, HALF);
    assert_true(ignores(&facts, FM_MESH_MATERIALS));
    facts = assert_loads(".obj", CORNERS FACE "curv 0 1 1 2\n", 1, HALF);
    assert_true(ignores(&facts, FM_MESH_CURVES));
    facts = assert_loads(".obj", CORNERS FACE "fcae 1 2 3\n", 1, HALF);
    assert_true(ignores(&facts, FM_MESH_UNKNOWN));
    facts = assert_loads(".obj", "o a\n" CORNERS "g x\n" FACE "g y\ng z\n" FACE FACE, 3, 1.5);
    assert_int_equal(facts.parts, 2);
}

static void obj_is_refused_with_its_line(void **state)
{
    (void)state;
    assert_refused(".obj", CORNERS "f 1 2 3\nf 1 2", ":5: the last face has 2 corners");
    assert_refused(".obj", CORNERS "f 1 2 9\n", ":4: a face: vertex 9 is out of range");
    assert_refused(".obj", CORNERS "f 1 2 0\n", ":4: a face: vertex 0 of 3");
    assert_refused(".obj", CORNERS "f 1 2 -4\n", ":4: a face: vertex -4 of 3");
    assert_refused(".obj", CORNERS "f 1//1 2//1 3//1\n", ":4: a face: normal 1 is out of range");
    assert_refused(".obj", CORNERS "f 1 2 -9223372036854775808\n",
                   ":4: a face: vertex -9223372036");
    assert_refused(".obj", CORNERS "f 1 2 x\n", ":4: a face: 'x' names no vertex");
    assert_refused(".obj", CORNERS "f 1/1/1/1 2 3\n", ":4: a face: '1/1/1/1'");
    assert_refused(".obj", "v 0 0\n", ":1: a vertex of 2 numbers, not 3");
    assert_refused(".obj", "v 0 0 1x\n", ":1: a vertex: '1x' is not a number");
    assert_refused(".obj", "v 0 0 0x1p3\n", "is not a number");
    assert_refused(".obj", "v 0 0 0 1 2\n", ":1: a vertex of 5 numbers");
    assert_refused(".obj", "v 0 0 0 2\n", ":1: a vertex of weight 2");
    assert_refused(".obj", "v 0 0 0\nv 1 \\\n 0 0\nv 0 \\\n 1 y\n", ":4: a vertex: 'y'");
    assert_refused(".obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\n" FACE, "vertex 0 is not finite");
    assert_refused(".obj", CORNERS "l 1 2\n", "no triangles; left out: 1 line");
    assert_refused(".obj", "\xFF\xFEv", "UTF-16");
}

/* assimp drops faces of more than 9 corners. */
static void off_is_read_in_all_its_spellings(void **state)
{
    char text[1024] = "OFF # twelve corners\n12 1 12\n";
    (void)state;
    for (int i = 0; i < 12; i++)
        snprintf(text + strlen(text), 64, "%.17g %.17g 0\n", cos(i * 0.52359877559829887),
                 sin(i * 0.52359877559829887));
    strcat(text, "12 0 1 2 3\n4 5 6 7 8 9\n10 11\n");
    assert_loads(".off", text, 10, 3.0);
    assert_loads(".off", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 1, HALF);
    assert_loads(".off", "OFF 3 1 0 0 0 0 \n1 0 0\n0 1 0\n3 0 1 2", 1, HALF);
    assert_loads(".off", "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", 1, HALF);
    assert_loads(".off", "COFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2", 1, HALF);
    assert_loads(".off", "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2", 1, HALF);
}

#define OFF_CORNERS "0 0 0\n1 0 0\n0 1 0\n"

static void off_says_what_it_leaves_out(void **state)
{
    (void)state;
    fm_mesh_facts facts =
        assert_loads(".off", "OFF\n3 4 0\n" OFF_CORNERS "3 0 1 2\n2 0 1\n1 2\n3 1 1 1\n", 1, HALF);
    assert_int_equal(facts.lines, 1);
    assert_int_equal(facts.points, 1);
    assert_int_equal(facts.without_area, 1);
    facts = assert_loads(".off", "OFF\n3 1 0\n" OFF_CORNERS "3 0 1 2 200 40 40 90\n", 1, HALF);
    assert_true(ignores(&facts, FM_MESH_FACE_COLOURS));
    facts = assert_loads(
        ".off", "COFF\n3 1 0\n0 0 0 1 0 0 1\n1 0 0 1 0 0 1\n0 1 0 1 0 0 1\n3 0 1 2\n", 1, HALF);
    assert_true(ignores(&facts, FM_MESH_VERTEX_COLOURS));
    facts = assert_loads(".off", "OFF\n3 1 0\n" OFF_CORNERS "3 0 1 2\n3 0 1 2\n", 1, HALF);
    assert_true(ignores(&facts, FM_MESH_TRAILING));
}

static void off_is_refused_with_its_line(void **state)
{
    (void)state;
    assert_refused(".off", "", "an empty file");
    assert_refused(".off", "OFF\n3 2 0\n" OFF_CORNERS "3 0 1 2\n", "before the end of face 1 of 2");
    assert_refused(".off", "OFF\n3 1 0\n0 0 0\n1 0 0\n", "before the end of vertex 2 of 3");
    assert_refused(".off", "OFF\n3 1 0\n" OFF_CORNERS "3 0 1 7\n", ":6: face 0: vertex 7 of 3");
    assert_refused(".off", "OFF\n3 1 0\n" OFF_CORNERS "3 0 1 -1\n", ":6: face 0: vertex -1 of 3");
    assert_refused(".off", "OFF\n3 1 0\n0 0 zero\n", ":3: vertex 0: 'zero' is not a number");
    assert_refused(".off", "OFF BINARY\n", ":1: binary OFF is not read");
    assert_refused(".off", "OFF3x 1 0\n", ":1: number of vertices: '3x'");
    assert_refused(".off", "OFFER\n3 1 0\n", ":1: 'OFFER'");
    assert_refused(".off", "4OFF\n3 1 0\n", ":1: '4OFF'");
    assert_refused(".off", "OFF\n-3 1 0\n", ":2: number of vertices: '-3'");
    assert_refused(".off", "OFF\n3 0 0\n" OFF_CORNERS, "no triangles");
}

/* 0 1 2 3 is two triangles; a corner named twice, or -1, ends a strip. */
static void ply_strips_are_read(void **state)
{
    (void)state;
#define STRIP_HEAD                                                                                 \
    PLY("ascii")                                                                                   \
    XYZ(6)                                                                                         \
    "element tristrips 1\nproperty list int int vertex_indices\n" END                              \
    "0 0 0\n1 0 0\n0 1 0\n1 1 0\n0 2 0\n1 2 0\n"
    assert_loads(".ply", STRIP_HEAD "6 0 1 2 3 4 5\n", 4, 2.0);
    assert_loads(".ply", STRIP_HEAD "7 0 1 2 -1 2 3 4\n", 2, 1.0);
    assert_loads(".ply", STRIP_HEAD "8 0 1 2 2 3 3 4 5\n", 2, 1.0);
    assert_refused(".ply", STRIP_HEAD "3 0 1 6\n", ":17: a face: vertex 6 of 6");
    assert_refused(".ply", STRIP_HEAD "3 0 1 -2\n", "tristrips 0: an index that is no vertex's");
}

static void ply_strips_turn_one_way(void **state)
{
    (void)state;
    fm_mesh mesh;
    load(&mesh, ".ply", STRIP_HEAD "6 0 1 2 3 4 5\n");
    for (uint32_t i = 0; i < mesh.vertex_count; i++) /* else neighbours cancel each other out */
        assert_true(mesh.normals[i].z > 0.0);
    mesh_free(&mesh);
}

static void put_reversed(char *to, const void *value, size_t bytes)
{
    for (size_t i = 0; i < bytes; i++)
        to[i] = ((const char *)value)[bytes - 1 - i];
}

/* Three vertices of doubles, a face of unsigned shorts; this machine is little-endian. */
static size_t binary_ply(char *to, const char *format, bool is_reversed)
{
    static const double at[9] = { 1e6, 1e6, 0, 1e6 + 0.001, 1e6, 0, 1e6, 1e6 + 0.001, 0 };
    static const uint16_t face[3] = { 0, 1, 2 };
    size_t length = (size_t)sprintf(to,
                                    "ply\nformat %s 1.0\nelement vertex 3\nproperty double x\n"
                                    "property double y\nproperty double z\nproperty uchar red\n"
                                    "element face 1\nproperty list uchar ushort vertex_index\n" END,
                                    format);
    for (int i = 0; i < 9; i++) {
        is_reversed ? put_reversed(to + length, &at[i], 8) : (void)memcpy(to + length, &at[i], 8);
        length += 8;
        if (i % 3 == 2)
            to[length++] = '\n';
    }
    to[length++] = 3;
    for (int i = 0; i < 3; i++, length += 2)
        is_reversed ? put_reversed(to + length, &face[i], 2)
                    : (void)memcpy(to + length, &face[i], 2);
    return length;
}

static void ply_is_read_in_both_byte_orders(void **state)
{
    char bytes[512];
    fm_error err = { 0 };
    fm_mesh mesh;
    (void)state;
    for (int reversed = 0; reversed < 2; reversed++) {
        const size_t count = binary_ply(
            bytes, reversed ? "binary_big_endian" : "binary_little_endian", reversed != 0);
        load_bytes(&mesh, ".ply", bytes, count);
        assert_int_equal(mesh.index_count, 3);
        assert_true(fabs(area_of(&mesh) - 0.5e-6) < 1e-12);
        assert_true(ignores(&mesh.facts, FM_MESH_VERTEX_COLOURS));
        mesh_free(&mesh);
        assert_int_equal(read_bytes(&mesh, &err, ".ply", bytes, count - 1), FM_INVALID);
        assert_non_null(strstr(err.message, "face 0: the file ends: is it cut off?"));
        bytes[count] = 0;
        load_bytes(&mesh, ".ply", bytes, count + 1);
        assert_true((mesh.facts.ignored >> FM_MESH_TRAILING & 1u) != 0);
        mesh_free(&mesh);
    }
}

static void ply_says_what_it_leaves_out(void **state)
{
    (void)state;
    fm_mesh_facts facts = assert_loads(".ply",
                                       PLY("ascii") XYZ(4) FACES(4) END
                                       "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 3 3 3\n2 0 1\n1 0\n",
                                       1, HALF);
    assert_int_equal(facts.without_area, 1);
    assert_int_equal(facts.lines, 1);
    assert_int_equal(facts.points, 1);
    facts = assert_loads(".ply",
                         PLY("ascii") XYZ(3) "element edge 2\nproperty int vertex1\n"
                                             "property int vertex2\n" FACES(
                                                 1) "property uchar red\n" END
                                                    "0 0 0\n1 0 0\n0 1 0\n0 1\n1 2\n3 0 1 2 255\n",
                         1, HALF);
    assert_int_equal(facts.lines, 2);
    assert_true(ignores(&facts, FM_MESH_FACE_COLOURS));
    facts = assert_loads(".ply",
                         PLY("ascii") "element camera 1\nproperty list uchar float p\n" FACES(1)
                             XYZ(3) END "2 1 1\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n",
                         1, HALF);
    assert_true(ignores(&facts, FM_MESH_UNKNOWN));
}

/* But what a line has beyond the head does not become the next element. */
static void ply_lines_hold_whole_elements(void **state)
{
    (void)state;
#define LINES PLY("ascii") XYZ(3) FACES(1) END
    assert_loads(".ply", LINES "0 0 0 1 0 0\n0 1 0\n3 0 1 2\n", 1, HALF);
    assert_loads(".ply", LINES "0 0 0 1 0 0 0 1 0 3 0 1 2\n", 1, HALF);
    assert_refused(".ply", LINES "0 0 0 9\n1 0 0 9\n0 1 0 9\n3 0 1 2\n",
                   ":11: vertex 1: a value is missing, or a line has more than is declared");
    assert_refused(".ply", PLY("ascii") XYZ(2) FACES(1) END "0 0 0 1 0 0\n3 0 0 1\n3 0 0 1\n",
                   ":13: face 0: more values than the head declares");
    assert_refused(".ply", LINES "0 0\n0 1 0 0\n0 1 0\n3 0 1 2\n",
                   ":11: vertex 0: a value is missing");
}

static void ply_is_refused_with_its_element(void **state)
{
    (void)state;
#define ONE_FACE PLY("ascii") XYZ(3) FACES(1) END "0 0 0\n1 0 0\n0 1 0\n"
    assert_refused(".ply", ONE_FACE, "face 0: the file ends: is it cut off?");
    assert_refused(".ply", ONE_FACE "3 0 1\n", ":14: face 0: a value is missing");
    assert_refused(".ply", ONE_FACE "3 0 1 2 9\n", ":14: face 0: more values");
    assert_refused(".ply", ONE_FACE "3 0 1 0.5\n", ":14: face 0: an index");
    assert_refused(".ply", ONE_FACE "3 0 1 7\n", "vertex 7 of 3");
    assert_refused(".ply", ONE_FACE "-3 0 1 2\n", ":14: face 0: a list with no legal length");
    assert_refused(".ply", "obj\n", ":1: no PLY file");
    assert_refused(".ply", PLY("ascii") XYZ(3), "no end_header");
    assert_refused(".ply", "ply\nelement vertex 1\n" END, "names no format");
    assert_refused(".ply", PLY("ascii") "element vertex 1\nproperty float x\n" END,
                   "element vertex has no property y");
    assert_refused(".ply", PLY("ascii") XYZ(1) "element face 1\nproperty int a\n" END,
                   "element face has no list vertex_indices");
    assert_refused(".ply", PLY("ascii") "element vertex 1\nproperty quad x\n" END, "type 'quad'");
    assert_refused(".ply", PLY("ascii") XYZ(1) END "0 0 0\n", "no triangles");
}

static void stl_is_read_in_all_its_spellings(void **state)
{
    (void)state;
    fm_mesh_facts facts =
        assert_loads(".stl", "solid a\n" FACET "endsolid a\nsolid b\nendsolid b\n", 1, HALF);
    assert_int_equal(facts.parts, 1);
    facts = assert_loads(".stl", "solid a facet\n" FACET "endsolid\n\nsolid\n" FACET "endsolid", 2,
                         1.0);
    assert_int_equal(facts.parts, 2);
    assert_loads(".stl",
                 "SOLID A\nFACET NORMAL 0 0 1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 1 0 0\n"
                 "VERTEX 0 1 0\nENDLOOP\nENDFACET\nENDSOLID A\n",
                 1, HALF);
    assert_loads(".stl",
                 "solid a\nfacet normal 0 0 1 outer loop\nvertex 0 0 0 vertex 1 0\n0 vertex 0 1 0 "
                 "endloop endfacet endsolid a\n",
                 1, HALF);
    assert_loads(".stl",
                 "solid\nfacet\nouter loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop\n"
                 "endfacet\nendsolid",
                 1, HALF);
    assert_loads(".stl",
                 "solid a facet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 "
                 "endloop endfacet endsolid a",
                 1, HALF);
    assert_refused(".stl", "solid\nendsolid solid facet normal 0 0 1\n",
                   ":2: 'facet', where 'solid'");
    assert_refused(".stl", "solid a\nfacet normal 0 0 1 0 outer loop\n", ":2: '0', where 'outer'");
    assert_refused(".stl", "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 z\n",
                   ":2: a vertex: 'z' is not a number");
    assert_refused(".stl", "solid a\nfacet normal 0 0 1 outer loop vertex 0 0",
                   ":2: a vertex of 2 numbers, not 3: is the file cut off?");
    assert_refused(".stl", "solid a\n" FACET, "no 'endsolid': is the file cut off?");
    assert_refused(".stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
                   "no 'endloop'");
    assert_refused(".stl", "solid a\nfacte\n", ":2: 'facte', where 'facet'");
    assert_refused(".stl", "solid a\nendsolid\n", "no triangles");
}

/* A binary file may begin with `solid`, as text does. */
static void binary_stl_is_measured(void **state)
{
    char bytes[84 + 50 + 1] = "solid, but binary";
    const float corners[9] = { 0, 0, 0, 1, 0, 0, 0, 1, 0 };
    fm_error err = { 0 };
    fm_mesh mesh;
    (void)state;
    bytes[80] = 1;
    memcpy(bytes + 84 + 12, corners, sizeof corners);
    load_bytes(&mesh, ".stl", bytes, 84 + 50);
    assert_int_equal(mesh.facts.triangles, 1);
    assert_int_equal(mesh.facts.ignored, 0);
    mesh_free(&mesh);
    bytes[84 + 49] = (char)0x80;
    load_bytes(&mesh, ".stl", bytes, 84 + 50);
    assert_true(ignores(&mesh.facts, FM_MESH_FACE_COLOURS));
    mesh_free(&mesh);
    assert_int_equal(read_bytes(&mesh, &err, ".stl", bytes, 84 + 49), FM_INVALID);
    assert_non_null(strstr(err.message, "1 triangles need 134 bytes, the file has 133"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_is_read_in_all_its_spellings),
        cmocka_unit_test(obj_says_what_it_leaves_out),
        cmocka_unit_test(obj_is_refused_with_its_line),
        cmocka_unit_test(off_is_read_in_all_its_spellings),
        cmocka_unit_test(off_says_what_it_leaves_out),
        cmocka_unit_test(off_is_refused_with_its_line),
        cmocka_unit_test(ply_strips_are_read),
        cmocka_unit_test(ply_strips_turn_one_way),
        cmocka_unit_test(ply_is_read_in_both_byte_orders),
        cmocka_unit_test(ply_says_what_it_leaves_out),
        cmocka_unit_test(ply_lines_hold_whole_elements),
        cmocka_unit_test(ply_is_refused_with_its_element),
        cmocka_unit_test(stl_is_read_in_all_its_spellings),
        cmocka_unit_test(binary_stl_is_measured),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
