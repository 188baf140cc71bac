/* Bodies that hold a scene. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "methods/random_kit.h"
#include "scene/solid.h"

/* A mesh of these points; triangles do not matter here. */
static fm_scene mesh_of(fm_vertex *vertices, uint32_t count)
{
    fm_scene scene = { .vertices = vertices, .vertex_count = count, .instances = 1 };
    scene.settings.generator = FM_GENERATOR_MESH;
    return scene;
}

static void put(fm_vertex *vertex, float x, float y, float z)
{
    *vertex = (fm_vertex){ .position = { x, y, z } };
}

/* Volume that the triangles enclose, whatever their winding: seen from a point within. */
static double volume_from(const fm_solid *solid, const double centre[3])
{
    double volume = 0;
    for (uint32_t i = 0; i < solid->index_count; i += 3) {
        double v[3][3];
        for (int corner = 0; corner < 3; corner++)
            for (int axis = 0; axis < 3; axis++)
                v[corner][axis] =
                    (double)solid->vertices[solid->indices[i + (uint32_t)corner]].position[axis] -
                    centre[axis];
        const double cross[3] = { v[1][1] * v[2][2] - v[1][2] * v[2][1],
                                  v[1][2] * v[2][0] - v[1][0] * v[2][2],
                                  v[1][0] * v[2][1] - v[1][1] * v[2][0] };
        volume += fabs(v[0][0] * cross[0] + v[0][1] * cross[1] + v[0][2] * cross[2]) / 6;
    }
    return volume;
}

static void a_hull_of_a_filled_cube_is_the_cube(void **state)
{
    (void)state;
    enum { POINTS = 2000 };
    static const double middle[3] = { 0.5, 0.5, 0.5 };
    fm_vertex vertices[POINTS];
    uint64_t random = 7;
    for (uint32_t i = 0; i < POINTS; i++)
        put(&vertices[i], draw_real(&random, 0, 1), draw_real(&random, 0, 1),
            draw_real(&random, 0, 1));
    for (uint32_t i = 0; i < 8; i++)
        put(&vertices[i * 100], (float)(i & 1), (float)(i >> 1 & 1), (float)(i >> 2));
    const fm_scene scene = mesh_of(vertices, POINTS);
    fm_solid solid;
    assert_int_equal(solid_hull(&solid, &scene, NULL), FM_OK);
    assert_int_equal(solid.vertex_count, 8);
    assert_int_equal(solid.index_count, 36);
    assert_float_equal(volume_from(&solid, middle), 1.0, 1e-12);
    solid_free(&solid);
}

static void a_box_has_the_volume_of_its_sides(void **state)
{
    (void)state;
    static const double middle[3] = { 0.5, 1, 2 };
    fm_vertex vertices[3];
    put(&vertices[0], 0, 2, 1);
    put(&vertices[1], 1, 0, 4);
    put(&vertices[2], 0.5f, 1, 0);
    const fm_scene scene = mesh_of(vertices, 3);
    fm_solid solid;
    assert_int_equal(solid_box(&solid, &scene, NULL), FM_OK);
    assert_float_equal(volume_from(&solid, middle), 1.0 * 2 * 4, 1e-12);
    solid_free(&solid);
}

/* Points in a plane, on a line, one point, two equal points: the box stands for the hull. */
static void flat_meshes_have_their_box(void **state)
{
    (void)state;
    fm_vertex vertices[16];
    for (uint32_t count = 1; count <= 16; count++) {
        for (uint32_t i = 0; i < count; i++)
            put(&vertices[i], (float)(i % 4), count > 4 ? (float)(i / 4) : 0, 0.25f);
        const fm_scene scene = mesh_of(vertices, count);
        fm_solid solid;
        assert_int_equal(solid_hull(&solid, &scene, NULL), FM_OK);
        assert_int_equal(solid.index_count, 36);
        assert_true(solid.vertices[0].position[2] == 0.25f);
        solid_free(&solid);
    }
}

/* Two planes that cross: at each corner the nearer and the farther. */
static void layers_have_the_extremes_of_their_corners(void **state)
{
    (void)state;
    fm_layer layers[2] = { { .depth = 0.5f, .slope_x = 0.25f },
                           { .depth = 0.5f, .slope_x = -0.25f } };
    fm_scene scene = {
        .layers = layers, .n = 2, .width_px = 4, .height_px = 4, .rect = { 0, 0, 4, 4 }
    };
    fm_solid solid;
    assert_int_equal(solid_hull(&solid, &scene, NULL), FM_OK);
    for (uint32_t i = 0; i < 8; i++)
        assert_true(solid.vertices[i].position[2] == (i < 4 ? 0.25f : 0.75f));
    solid_free(&solid);
    layers[1].depth = 0.625f; /* its left side is now the farther one by more */
    assert_int_equal(solid_box(&solid, &scene, NULL), FM_OK);
    for (uint32_t i = 0; i < 8; i++)
        assert_true(solid.vertices[i].position[2] == (i < 4 ? 0.25f : 0.875f));
    solid_free(&solid);
}

static void write_at(const char *path, long offset, const void *bytes, size_t count)
{
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, offset, SEEK_SET), 0);
    assert_int_equal(fwrite(bytes, 1, count, file), count);
    fclose(file);
}

static void a_hull_is_kept_in_a_file_that_is_checked(void **state)
{
    (void)state;
    char path[] = "/tmp/fm-hull-XXXXXX";
    fm_vertex vertices[8];
    for (uint32_t i = 0; i < 8; i++)
        put(&vertices[i], (float)(i & 1), (float)(i >> 1 & 1), (float)(i >> 2));
    fm_scene scene = mesh_of(vertices, 8);
    fm_solid hull, read;
    const uint32_t wrong_index = 8, too_many = UINT32_MAX;
    close(mkstemp(path));
    assert_int_equal(solid_hull(&hull, &scene, NULL), FM_OK);
    assert_int_equal(solid_write(&hull, path, &scene, NULL), FM_OK);
    assert_int_equal(solid_read(&read, path, &scene, NULL), FM_OK);
    assert_int_equal(read.index_count, hull.index_count);
    assert_memory_equal(read.indices, hull.indices, hull.index_count * sizeof hull.indices[0]);
    assert_memory_equal(read.vertices, hull.vertices, 8 * sizeof hull.vertices[0]);
    solid_free(&read);
    scene.vertex_count = 7;
    assert_int_equal(solid_read(&read, path, &scene, NULL), FM_INVALID);
    scene.vertex_count = 8;
    write_at(path, 24 + 8 * 16, &wrong_index, sizeof wrong_index);
    assert_int_equal(solid_read(&read, path, &scene, NULL), FM_INVALID);
    write_at(path, 12, &too_many, sizeof too_many); /* vertices */
    assert_int_equal(solid_read(&read, path, &scene, NULL), FM_INVALID);
    assert_int_equal(truncate(path, 20), 0);
    assert_int_equal(solid_read(&read, path, &scene, NULL), FM_INVALID);
    unlink(path);
    assert_int_equal(solid_read(&read, path, &scene, NULL), FM_IO);
    solid_free(&hull);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_hull_of_a_filled_cube_is_the_cube),
        cmocka_unit_test(a_box_has_the_volume_of_its_sides),
        cmocka_unit_test(flat_meshes_have_their_box),
        cmocka_unit_test(layers_have_the_extremes_of_their_corners),
        cmocka_unit_test(a_hull_is_kept_in_a_file_that_is_checked),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
