/* Meshes out of files of any format: shape, size, normals, what is told. */
#include "kit/mesh_kit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char horse[] = "/usr/share/glmark2/models/horse.3ds";
static const double rounding = 1e-6; /* floats up to 1 */

static void far_coordinates_keep_their_shape(void **state)
{
    (void)state;
    fm_mesh mesh;
    load(&mesh, ".obj",
         "v 500000.1 4649776.2 100\nv 500000.2 4649776.2 100\nv 500000.15 4649776.3 100\n"
         "v 500000.15 4649776.25 100.1\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    assert_true(fabs(area_of(&mesh) - (0.005 + 0.005 * sqrt(1.25) + 0.01 * sqrt(1.3125))) < 1e-8);
    assert_int_equal(mesh.facts.lost_area, 0);
    for (uint32_t i = 0; i < mesh.vertex_count; i++)
        for (int axis = 0; axis < 3; axis++)
            assert_true(fabsf(mesh.positions[i][axis]) <= 1.0f);
    mesh_free(&mesh);
}

static void any_size_is_read(void **state)
{
    static const int exponents[] = { -307, -30, -8, 30, 300, 307 };
    char text[256];
    (void)state;
    for (size_t i = 0; i < sizeof exponents / sizeof exponents[0]; i++) {
        const int e = exponents[i];
        fm_mesh mesh;
        snprintf(text, sizeof text, "v 1e%d 0 0\nv 2e%d 0 0\nv 0 -1e%d 0\nf 1 2 3\n", e, e, e);
        load(&mesh, ".obj", text);
        assert_int_equal(mesh.index_count, 3);
        assert_int_equal(mesh.facts.lost_area, 0);
        mesh_free(&mesh);
    }
    assert_refused(".obj", "v 0 0 0\nv 1e200 0 0\nv 0 1 0\nf 1 2 3\n", "that a float holds");
}

/* Coordinates about the origin are scaled, and not moved: their bits stay. */
static void near_coordinates_keep_their_bits(void **state)
{
    (void)state;
    fm_mesh mesh;
    load(&mesh, ".obj", "v -0.1 0 0\nv 0.7 0 0\nv 0.3 0.9 0\nf 1 2 3\n");
    const float given[] = { -0.1f, 0.7f, 0.3f };
    for (int i = 0; i < 3; i++)
        assert_true(ldexpf(mesh.positions[i][0], mesh.space.exponent) >= given[i] &&
                    ldexpf(mesh.positions[i][0], mesh.space.exponent) <= given[i]);
    mesh_free(&mesh);
}

static void stray_vertices_stay_out_of_the_box(void **state)
{
    (void)state;
    const fm_mesh_facts facts =
        assert_loads(".obj", CORNERS "v 9 9 9\nv nan 0 0\nf 1 4 4\n" FACE, 1, HALF);
    assert_true(facts.box.high[0] <= 1.0 && facts.box.high[2] <= 0.0);
    assert_int_equal(facts.without_area, 1);
}

static void polygons_of_all_formats_are_cut_alike(void **state)
{
    (void)state;
    assert_loads(".obj", "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n", 3, 10.0);
    assert_loads(".off", "OFF\n5 1 0\n0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n5 0 1 2 3 4\n", 3, 10.0);
    assert_loads(
        ".ply", PLY("ascii") XYZ(5) FACES(1) END "0 0 0\n4 0 0\n4 4 0\n2 1 0\n0 4 0\n5 0 1 2 3 4\n",
        3, 10.0);
    assert_loads(".stl",
                 "solid\nfacet normal 0 0 0\nouter loop\nvertex 0 0 0\nvertex 4 0 0\n"
                 "vertex 4 4 0\nvertex 2 1 0\nvertex 0 4 0\nendloop\nendfacet\nendsolid\n",
                 3, 10.0);
    assert_refused(".obj", "v 0 0 0\nv 1 1 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 4\n",
                   ":5: a face: of 4 corners, it crosses itself");
}

/* AC3D and 3DS come through libassimp. */
#define AC_HEAD                                                                                    \
    "AC3Db\nMATERIAL \"glass\" rgb 1 1 1 amb 1 1 1 emis 0 0 0 spec 0 0 0 shi 0 trans 0.75\n"       \
    "OBJECT world\nkids 1\nOBJECT poly\n"

/* Lines and points are elements, too. */
static void refusals_name_the_face_in_the_file(void **state)
{
    (void)state;
    assert_refused(".off",
                   "OFF\n6 3 0\n0 0 0\n1 1 0\n1 0 0\n0 1 0\n2 2 0\n3 3 0\n2 4 5\n3 0 1 2\n4 0\n"
                   "1 2 3\n",
                   ":11: a face: of 4 corners, it crosses itself");
    assert_refused(
        ".ply", PLY("ascii") XYZ(4) FACES(2) END "0 0 0\n1 1 0\n1 0 0\n0 1 0\n2 0 1\n4 0 1 2 3\n",
        ":16: a face: of 4 corners, it crosses itself");
    assert_refused(".stl",
                   "solid\n" FACET "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 1 0\n"
                   "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n",
                   ":9: a face: of 4 corners, it crosses itself");
    assert_refused(".ac",
                   AC_HEAD "numvert 4\n0 0 0\n1 1 0\n1 0 0\n0 1 0\nnumsurf 2\nSURF 0x20\nmat 0\n"
                           "refs 3\n0 0 0\n1 0 0\n2 0 0\nSURF 0x20\nmat 0\nrefs 4\n0 0 0\n1 0 0\n"
                           "2 0 0\n3 0 0\nkids 0\n",
                   ": face of all meshes 1, from 0: of 4 corners, it crosses itself");
}

/* A line of two corners, and a face with a corner that the file lacks. */
static void elements_of_binary_files_are_counted(void **state)
{
    static const char head[] =
        "ply\nformat binary_little_endian 1.0\n" XYZ(1) "element face 2\nproperty list uchar uchar "
                                                        "vertex_indices\n" END;
    static const unsigned char faces[] = { 2, 0, 0, 3, 0, 0, 7 };
    char bytes[512] = { 0 };
    fm_error err = { 0 };
    fm_mesh mesh;
    (void)state;
    const size_t at = strlen(head) + 12;
    memcpy(bytes, head, strlen(head));
    memcpy(bytes + at, faces, sizeof faces);
    assert_int_equal(read_bytes(&mesh, &err, ".ply", bytes, at + sizeof faces), FM_INVALID);
    assert_non_null(strstr(err.message, ": face 1, from 0: vertex 7 of 1"));
    memset(bytes, 0, sizeof bytes);
    bytes[80] = 2;
    const float nan = NAN;
    memcpy(bytes + 84 + 50 + 12, &nan, sizeof nan);
    assert_int_equal(read_bytes(&mesh, &err, ".stl", bytes, 84 + 100), FM_INVALID);
    assert_non_null(
        strstr(err.message, ": facet 1, from 0: a coordinate of vertex 3 is not finite"));
}

static void facets_are_flat_and_other_meshes_smooth(void **state)
{
    (void)state;
    fm_mesh mesh;
    load(&mesh, ".stl",
         "solid\n" FACET
         "facet normal 9 9 9\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 0 1\nendloop\n"
         "endfacet\nendsolid\n");
    assert_int_equal(mesh.vertex_count, 6);
    assert_true(fabs(mesh.normals[0].z - 1.0) < rounding);
    assert_true(fabs(mesh.normals[3].y + 1.0) < rounding);
    mesh_free(&mesh);
    load(&mesh, ".ply",
         PLY("ascii") FACES(1) XYZ(3) "property float nx\nproperty float ny\nproperty float "
                                      "nz\n" END
                                      "3 0 1 2\n0 0 0 1 0 0\n1 0 0 1 0 0\n0 1 0 1 0 0\n");
    assert_true(mesh.normals[0].x > 0.9);
    mesh_free(&mesh);
    load(&mesh, ".obj", CORNERS "v 0 0 1\nv 1 0 0\nf 1 2 3\nf 1 5 4\n");
    assert_int_equal(mesh.vertex_count, 4); /* the second (1 0 0) is the first */
    mesh_free(&mesh);
    load(&mesh, ".obj", CORNERS "vn 1 0 0\nvn 0 1 0\nvn 0 0 0\nf 1//1 2//2 3//3\n");
    assert_true(mesh.normals[0].x > 0.9 && mesh.normals[1].y > 0.9);
    assert_true(mesh.normals[2].z > 0.0); /* the file's is none */
    mesh_free(&mesh);
}

static void other_formats_are_treated_alike(void **state)
{
    (void)state;
    const fm_mesh_facts facts =
        assert_loads(".ac",
                     AC_HEAD "numvert 4\n0 0 0\n1 0 0\n0 1 0\n1 1 0\nnumsurf 2\n"
                             "SURF 0x20\nmat 0\nrefs 4\n0 0 0\n1 0 0\n3 0 0\n2 0 0\n"
                             "SURF 0x22\nmat 0\nrefs 2\n0 0 0\n1 0 0\nkids 0\n",
                     2, 1.0);
    assert_true(ignores(&facts, FM_MESH_MATERIALS));
    assert_int_equal(facts.lines, 1);
    assert_true(facts.spacing <= 0.0);
}

/* Two nodes that share a mesh of one strip, coloured and glass, and of one line. */
static const char gltf[] =
    "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],\"nodes"
    "\":[{\"mesh\":0,\"translation\":[0,0,0]},{\"mesh\":0,\"translation\":[0,0,2]}],\"mat"
    "erials\":[{\"name\":\"glass\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,0"
    ".25]}}],\"meshes\":[{\"primitives\":[{\"mode\":5,\"material\":0,\"attributes\":{\"PO"
    "SITION\":0,\"COLOR_0\":1}},{\"mode\":1,\"attributes\":{\"POSITION\":0},\"indices\":2"
    "}]}],\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\""
    "VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]},{\"bufferView\":1,\"componentType\":5126,\"c"
    "ount\":4,\"type\":\"VEC4\"},{\"bufferView\":2,\"componentType\":5123,\"count\":2,\"t"
    "ype\":\"SCALAR\"}],\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":48"
    "},{\"buffer\":0,\"byteOffset\":48,\"byteLength\":64},{\"buffer\":0,\"byteOffset\":11"
    "2,\"byteLength\":4}],\"buffers\":[{\"byteLength\":116,\"uri\":\"data:application/oct"
    "et-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAACAPwAAgD8AAAAAAAC"
    "APwAAAAAAAAAAAACAPgAAgD8AAAAAAAAAAAAAgD4AAIA/AAAAAAAAAAAAAIA+AACAPwAAAAAAAAAAAACAPgA"
    "AAQA=\"}]}";

static void instances_and_strips_of_gltf_are_read(void **state)
{
    (void)state;
    const fm_mesh_facts facts = assert_loads(".gltf", gltf, 4, 2.0);
    assert_int_equal(facts.parts, 2);
    assert_int_equal(facts.lines, 2);
    assert_int_equal(facts.ignored, 1u << FM_MESH_VERTEX_COLOURS | 1u << FM_MESH_MATERIALS);
    assert_true(facts.box.high[2] >= 2.0);
}

/* 4097 nodes on one mesh of 32 769 vertices, all zero. */
static void small_files_of_many_vertices_are_refused(void **state)
{
    enum { NODES = 4097, VERTICES = 32769, LETTERS = VERTICES * 16 };
    static char letters[LETTERS + 1];
    fm_text text = { 0 };
    (void)state;
    memset(letters, 'A', LETTERS);
    text_add(&text, "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"nodes\":[");
    for (int i = 0; i < NODES; i++)
        text_add(&text, "%s{\"mesh\":0}", i > 0 ? "," : "");
    text_add(&text, "],\"scenes\":[{\"nodes\":[0");
    for (int i = 1; i < NODES; i++)
        text_add(&text, ",%d", i);
    text_add(
        &text,
        "]}],\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],\"accessors\":[{"
        "\"bufferView\":0,\"componentType\":5126,\"count\":%d,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%d}],\"buffers\":[{\"byteLength\":%d,"
        "\"uri\":\"data:application/octet-stream;base64,",
        VERTICES, VERTICES * 12, VERTICES * 12);
    text_add(&text, "%s\"}]}", letters);
    assert_refused(".gltf", text.bytes, "more than 134217728 vertices or faces");
    text_free(&text);
}

/* assimp rounds to floats before anybody can move the mesh. */
static void coarse_floats_are_told_or_refused(void **state)
{
    (void)state;
#define AC_AT(x)                                                                                   \
    AC_HEAD "loc " x " 0 0\nnumvert 3\n0 0 0\n1 0 0\n0 1 0\nnumsurf 1\nSURF 0x20\nmat 0\n"         \
            "refs 3\n0 0 0\n1 0 0\n2 0 0\nkids 0\n"
    fm_mesh mesh;
    fm_text text = { 0 };
    load(&mesh, ".ac", AC_AT("1024"));
    assert_true(fabs(mesh.facts.spacing - 0x1p-13) < rounding);
    mesh_facts_text(&text, &mesh.facts);
    assert_non_null(strstr(text.bytes, "read as floats, which here are 1.2e-04 of the box apart"));
    text_free(&text);
    mesh_free(&mesh);
    assert_refused(".ac", AC_AT("5000000"), "are read as floats, which here are 0.5 of the mesh's");
}

static void cut_files_of_other_formats_are_refused(void **state)
{
    (void)state;
    static char bytes[1 << 20];
    fm_error err = { 0 };
    fm_mesh mesh;
    FILE *file = fopen(horse, "rb");
    if (file == NULL)
        skip(); /* glmark2-data is not installed */
    const size_t count = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    assert_int_equal(read_bytes(&mesh, &err, ".3ds", bytes, count * 4 / 5), FM_INVALID);
    assert_non_null(strstr(err.message, "is it cut off?"));
    assert_int_equal(read_bytes(&mesh, &err, ".3ds", bytes, 5), FM_INVALID);
}

static void only_regular_files_of_known_endings_are_read(void **state)
{
    (void)state;
    fm_mesh mesh = { 0 };
    fm_error err = { 0 };
    assert_int_equal(mesh_file_read(&mesh, "/dev/zero", &err), FM_INVALID);
    assert_non_null(strstr(err.message, "/dev/zero: is a device, not a file"));
    assert_int_equal(mesh_file_read(&mesh, "/nowhere/a.obj", &err), FM_IO);
    assert_refused(".txt", CORNERS FACE, "no reader for files that end with '.txt'");
    assert_refused("", CORNERS FACE, "no reader for files that end with ''");
}

static void facts_are_one_sentence(void **state)
{
    (void)state;
    fm_text text = { 0 };
    const fm_mesh_facts facts = assert_loads(
        ".obj", CORNERS "v 0.5 0 0 1 0 0\nusemtl a\nf 1 2 3\nf 1 2 2\nl 1 2\np 1\np 2\n", 1, HALF);
    mesh_facts_text(&text, &facts);
    assert_string_equal(text.bytes,
                        "OBJ, 1 triangle in 1 part, box 0 0 0 to 1 1 0; left out: 1 face without "
                        "area, 1 line, 2 points; ignored: colours of vertices, materials with "
                        "their opacity; drawn in one stone colour, with the opacity of key alpha");
    text_free(&text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(far_coordinates_keep_their_shape),
        cmocka_unit_test(any_size_is_read),
        cmocka_unit_test(near_coordinates_keep_their_bits),
        cmocka_unit_test(stray_vertices_stay_out_of_the_box),
        cmocka_unit_test(polygons_of_all_formats_are_cut_alike),
        cmocka_unit_test(refusals_name_the_face_in_the_file),
        cmocka_unit_test(elements_of_binary_files_are_counted),
        cmocka_unit_test(facets_are_flat_and_other_meshes_smooth),
        cmocka_unit_test(other_formats_are_treated_alike),
        cmocka_unit_test(instances_and_strips_of_gltf_are_read),
        cmocka_unit_test(small_files_of_many_vertices_are_refused),
        cmocka_unit_test(coarse_floats_are_told_or_refused),
        cmocka_unit_test(cut_files_of_other_formats_are_refused),
        cmocka_unit_test(only_regular_files_of_known_endings_are_read),
        cmocka_unit_test(facts_are_one_sentence),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
