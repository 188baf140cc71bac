/* The mesh loader: a triangle, the cameras, files that are damaged, the bunny. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "generators/generate.h"
#include "scene/scene.h"

static const char bunny[] = "/usr/share/glmark2/models/bunny.obj";
static const char horse[] = "/usr/share/glmark2/models/horse.3ds";
static const char cube[] =
    "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 2 2 0\nv 0 0 2\nv 2 0 2\nv 0 2 2\nv 2 2 2\n"
    "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
static const double rounding = 1e-5; /* floats near 1, a few operations */

static fm_settings mesh_settings(const char *path)
{
    fm_settings s;
    settings_default(&s);
    s.generator = FM_GENERATOR_MESH;
    s.width_px = 64;
    s.height_px = 48;
    s.alpha = 0.5;
    s.fov_deg = 45.0;
    s.zoom = 1.0;
    s.instances = 1;
    s.near_plane = s.far_plane = 0.0;
    for (int i = 0; i < 3; i++)
        s.eye[i] = s.target[i] = s.instance_offset[i] = 0.0;
    s.up[0] = s.up[2] = 0.0;
    s.up[1] = 1.0;
    s.mesh = text_shared(path);
    return s;
}

static void write_temporary(char path[64], const char *suffix, const void *bytes, size_t count)
{
    snprintf(path, 64, "/tmp/fragmark-mesh-XXXXXX%s", suffix);
    const int descriptor = mkstemps(path, (int)strlen(suffix));
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "wb");
    assert_non_null(file);
    assert_true(fwrite(bytes, 1, count, file) == count);
    fclose(file);
}

static fm_scene *create(const fm_settings *settings)
{
    fm_scene *scene = NULL;
    fm_error err = { 0 };
    if (scene_create(&scene, settings, &err) != FM_OK)
        fail_msg("%s", err.message);
    return scene;
}

/* A scene of the cube from (0,0,0) to (2,2,2), changed by its caller. */
static fm_scene *create_cube(fm_settings *settings)
{
    char path[64];
    write_temporary(path, ".obj", cube, sizeof cube - 1);
    settings->mesh = text_shared(path);
    fm_scene *scene = create(settings);
    unlink(path);
    return scene;
}

static void assert_refused(const char *suffix, const char *text, const char *part)
{
    char path[64];
    fm_scene *scene;
    fm_error err = { 0 };
    write_temporary(path, suffix, text, strlen(text));
    const fm_settings s = mesh_settings(path);
    const fm_status status = scene_create(&scene, &s, &err);
    unlink(path);
    assert_int_equal(status, FM_INVALID);
    assert_null(scene);
    assert_non_null(strstr(err.message, path));
    if (strstr(err.message, part) == NULL)
        fail_msg("'%s' is not in: %s", part, err.message);
}

/* x, y, z: in the file's units. */
static void project(double ndc[4], const fm_scene *scene, uint32_t instance, double x, double y,
                    double z)
{
    const float *m = scene->clip_from_object + (size_t)instance * 16;
    double p[3];
    space_point(p, &scene->space, (double[3]){ x, y, z });
    for (int row = 0; row < 4; row++)
        ndc[row] = (double)m[row] * p[0] + (double)m[4 + row] * p[1] + (double)m[8 + row] * p[2] +
                   (double)m[12 + row];
    for (int row = 0; row < 3; row++)
        ndc[row] /= ndc[3];
}

static void cube_has_twelve_triangles_and_no_layers(void **state)
{
    (void)state;
    fm_settings s = mesh_settings("");
    fm_scene *scene = create_cube(&s);
    assert_true(scene->triangles == 12);
    assert_int_equal(scene->index_count, 36);
    assert_int_equal(scene->n, 0);
    assert_null(scene->layers);
    assert_null(scene->order);
    for (uint32_t i = 0; i < scene->index_count; i++)
        assert_true(scene->indices[i] < scene->vertex_count);
    scene_destroy(scene);
}

static void colours_are_premultiplied_and_shaded(void **state)
{
    (void)state;
    fm_settings s = mesh_settings("");
    fm_scene *scene = create_cube(&s);
    for (uint32_t i = 0; i < scene->vertex_count; i++) {
        const uint32_t colour = scene->vertices[i].colour;
        assert_int_equal(colour >> 24, 128);
        assert_in_range(colour & 0xFF, 32,
                        128); /* red of the base colour is full: 64..255 halved */
    }
    scene_destroy(scene);
}

static void fitted_camera_fills_the_view(void **state)
{
    (void)state;
    fm_settings s = mesh_settings("");
    fm_scene *scene = create_cube(&s);
    double largest = 0.0, ndc[4];
    for (unsigned i = 0; i < 8; i++) {
        project(ndc, scene, 0, i & 1 ? 2 : 0, i & 2 ? 2 : 0, i & 4 ? 2 : 0);
        largest = fmax(largest, fmax(fabs(ndc[0]), fabs(ndc[1])));
        assert_true(ndc[2] > 0.0 && ndc[2] < 1.0 && ndc[3] > 0.0);
    }
    assert_true(fabs(largest - 1.0) < rounding);
    scene_destroy(scene);
}

static void zoom_scales_the_fitted_view(void **state)
{
    (void)state;
    fm_settings s = mesh_settings("");
    fm_scene *plain = create_cube(&s);
    s.zoom = 2.0;
    fm_scene *zoomed = create_cube(&s);
    double a[4], b[4];
    project(a, plain, 0, 2, 2, 2);
    project(b, zoomed, 0, 2, 2, 2);
    assert_true(fabs(2.0 * a[0] - b[0]) < rounding && fabs(2.0 * a[1] - b[1]) < rounding);
    assert_true(fabs(a[2] - b[2]) < rounding);
    scene_destroy(plain);
    scene_destroy(zoomed);
}

/* Straight along -z from (1,1,6): worked out by hand. cot(45 deg) = 1, aspect 4/3, near 1, far 11.
 */
static void given_camera_is_vulkans(void **state)
{
    (void)state;
    fm_settings s = mesh_settings("");
    const double eye[3] = { 1, 1, 6 }, target[3] = { 1, 1, 0 };
    memcpy(s.eye, eye, sizeof eye);
    memcpy(s.target, target, sizeof target);
    s.fov_deg = 90.0;
    s.near_plane = 1.0;
    s.far_plane = 11.0;
    fm_scene *scene = create_cube(&s);
    double ndc[4];
    project(ndc, scene, 0, 2, 2, 2); /* right and above, 4 in front */
    assert_true(fabs(ndc[0] - 0.75 / 4.0) < rounding);
    assert_true(fabs(ndc[1] + 1.0 / 4.0) < rounding); /* above is negative */
    assert_true(fabs(ndc[2] - (11.0 / 10.0 - 11.0 / 40.0)) < rounding);
    project(ndc, scene, 0, 1, 1, 5);
    assert_true(fabs(ndc[2]) < rounding); /* the near plane */
    project(ndc, scene, 0, 1, 1, -5);
    assert_true(fabs(ndc[2] - 1.0) < rounding); /* the far plane */
    scene_destroy(scene);
}

static void default_planes_follow_the_box(void **state)
{
    (void)state;
    fm_settings s = mesh_settings("");
    const double eye[3] = { 1, 1, 6 }, target[3] = { 1, 1, 0 };
    memcpy(s.eye, eye, sizeof eye);
    memcpy(s.target, target, sizeof target);
    fm_scene *scene = create_cube(&s);
    double ndc[4];
    project(ndc, scene, 0, 1, 1, 6.0 - 0.4 * 4.0);
    assert_true(fabs(ndc[2]) < rounding);
    project(ndc, scene, 0, 1, 1, 6.0 - 1.7 * 6.0);
    assert_true(fabs(ndc[2] - 1.0) < rounding);
    scene_destroy(scene);
}

static void instances_are_offset_in_box_sizes(void **state)
{
    (void)state;
    fm_settings s = mesh_settings("");
    s.instances = 3;
    s.instance_offset[0] = 1.5;
    fm_scene *scene = create_cube(&s);
    double a[4], b[4];
    assert_int_equal(scene->instances, 3);
    assert_true(scene->triangles == 36);
    project(a, scene, 2, 0.5, 1, 1);
    project(b, scene, 0, 0.5 + 2 * 1.5 * 2.0, 1, 1);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(a[i] - b[i]) < rounding);
    scene_destroy(scene);
}

static void camera_that_looks_away_is_refused(void **state)
{
    (void)state;
    char path[64];
    fm_scene *scene;
    fm_error err;
    write_temporary(path, ".obj", cube, sizeof cube - 1);
    fm_settings s = mesh_settings(path);
    s.eye[2] = 6.0;
    s.target[2] = 9.0;
    const fm_status status = scene_create(&scene, &s, &err);
    unlink(path);
    assert_int_equal(status, FM_INVALID);
    assert_non_null(strstr(err.message, "behind"));
}

/* A cube of side 2 at (x, 0, 0), seen as given_camera_is_vulkans sees it: the depth of its near
 * face is the same wherever it lies. In a matrix of floats the eye's offset alone is 0.06 wrong at
 * 1e6. */
static void far_meshes_are_seen_as_near_ones(void **state)
{
    static const double places[] = { 0, 500000.5, 1e6, -4649776.25, 1e9 };
    (void)state;
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        char text[512] = "", path[64];
        const double x = places[i];
        for (int c = 0; c < 8; c++)
            snprintf(text + strlen(text), 64, "v %.17g %d %d\n", x + 2 * (c & 1), c & 2,
                     (c & 4) / 2);
        strcat(text, "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n");
        write_temporary(path, ".obj", text, strlen(text));
        fm_settings s = mesh_settings(path);
        memcpy(s.eye, (double[3]){ x + 1, 1, 6 }, sizeof s.eye);
        memcpy(s.target, (double[3]){ x + 1, 1, 0 }, sizeof s.target);
        s.fov_deg = 90.0;
        s.near_plane = 1.0;
        s.far_plane = 11.0;
        fm_scene *scene = create(&s);
        unlink(path);
        double ndc[4];
        project(ndc, scene, 0, x + 2, 2, 2);
        assert_true(fabs(ndc[0] - 0.75 / 4.0) < rounding);
        assert_true(fabs(ndc[1] + 1.0 / 4.0) < rounding);
        assert_true(fabs(ndc[2] - (11.0 / 10.0 - 11.0 / 40.0)) < rounding);
        scene_destroy(scene);
    }
}

/* The same picture at any size: the matrix takes coordinates that were scaled. */
static void size_changes_nothing_that_is_seen(void **state)
{
    static const char *const sizes[] = { "e-300", "e-8", "e0", "e30", "e300" };
    float first[16] = { 0 };
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        char text[256], path[64];
        const char *e = sizes[i];
        snprintf(text, sizeof text, "v 0 0 0\nv 1%s 0 0\nv 0 1%s 0\nv 0 0 1%s\nf 1 2 3\nf 1 2 4\n",
                 e, e, e);
        write_temporary(path, ".obj", text, strlen(text));
        const fm_settings s = mesh_settings(path);
        fm_scene *scene = create(&s);
        unlink(path);
        for (int j = 0; j < 8;
             j++) { /* x and y of the corners, but for the choice of a power of 2 */
            const float *m = scene->clip_from_object, *p = scene->vertices[j % 4].position;
            float c[4];
            for (int row = 0; row < 4; row++)
                c[row] = m[row] * p[0] + m[4 + row] * p[1] + m[8 + row] * p[2] + m[12 + row];
            const float seen = c[j / 4] / c[3];
            if (i == 0)
                first[j] = seen;
            assert_true(fabs((double)(seen - first[j])) < rounding);
        }
        scene_destroy(scene);
    }
}

static void assert_camera_refused(const double eye[3], const double planes[2], const char *reason)
{
    char path[64];
    fm_scene *scene;
    fm_error err;
    write_temporary(path, ".obj", cube, sizeof cube - 1);
    fm_settings s = mesh_settings(path);
    memcpy(s.eye, eye, sizeof s.eye);
    s.near_plane = planes[0];
    s.far_plane = planes[1];
    const fm_status status = scene_create(&scene, &s, &err);
    unlink(path);
    assert_int_equal(status, FM_INVALID);
    if (strstr(err.message, reason) == NULL)
        fail_msg("'%s' is not in: %s", reason, err.message);
}

/* What rasterise.h drops and a device may draw, or neither can hold, is no scene. */
static void cameras_beyond_floats_are_refused(void **state)
{
    (void)state;
    assert_camera_refused((double[3]){ 0, 0, 1e30 }, (double[2]){ 0, 0 }, "eye: ");
    assert_camera_refused((double[3]){ 1e308, 0, 1e308 }, (double[2]){ 0, 0 }, "eye: ");
    assert_camera_refused((double[3]){ 0, 0, 9 }, (double[2]){ 1, 1e300 }, "far_plane: ");
    assert_camera_refused((double[3]){ 0, 0, 9 }, (double[2]){ 1e-300, 10 }, "near_plane: ");
    assert_camera_refused((double[3]){ 0, 0, 9 }, (double[2]){ 1, 1 + 1e-12 },
                          "by what a float holds");
}

static void missing_file_is_an_io_error(void **state)
{
    (void)state;
    const fm_settings s = mesh_settings("/nonexistent/mesh.obj");
    fm_scene *scene;
    fm_error err;
    assert_int_equal(scene_create(&scene, &s, &err), FM_IO);
    assert_non_null(strstr(err.message, "/nonexistent/mesh.obj"));
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void damaged_obj_files_are_refused(void **state)
{
    (void)state;
    assert_refused(".obj", "", "");
    assert_refused(".obj", TRIANGLE, "");
    assert_refused(".obj", TRIANGLE "f 1 2 9\n", "out of range");
    assert_refused(".obj", TRIANGLE "f 1 2 -9\n", ":4: a face: vertex -9 of 3");
    assert_refused(".obj", TRIANGLE "f 1 2 3\nf 1 2", "cut off");
    assert_refused(".obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n", "not finite");
    assert_refused(".obj", "v 0 0 0\nv 1 0 0\nv 0 1e309 0\nf 1 2 3\n", "not finite");
    assert_refused(".obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\n", "area");
    assert_refused(".obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n", "area");
    assert_refused(".txt", "not a mesh\n", "");
}

#define PLY_HEADER                                                                                 \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"

static void damaged_ply_files_are_refused(void **state)
{
    (void)state;
    assert_refused(".ply", PLY_HEADER "0 0 0\n1 0 0\n", "cut off");
    assert_refused(".ply", PLY_HEADER "0 0 0\n1 0 0\n0 1 0\n", "");
    assert_refused(".ply", PLY_HEADER "0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n", "vertex 7 of 3");
}

static void file_of(char **bytes, size_t *count, const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        skip(); /* glmark2-data is not installed */
    *bytes = calloc(1, 1u << 22);
    *count = fread(*bytes, 1, 1u << 22, file);
    fclose(file);
}

static void assert_cut_is_refused(const char *path, const char *suffix, double part)
{
    char *bytes, cut[64];
    size_t count;
    fm_scene *scene;
    fm_error err;
    file_of(&bytes, &count, path);
    write_temporary(cut, suffix, bytes, (size_t)(part * (double)count));
    const fm_settings s = mesh_settings(cut);
    const fm_status status = scene_create(&scene, &s, &err);
    unlink(cut);
    free(bytes);
    assert_int_equal(status, FM_INVALID);
}

static void truncated_3ds_is_refused(void **state)
{
    (void)state;
    assert_cut_is_refused(horse, ".3ds", 0.8);
    assert_cut_is_refused(horse, ".3ds", 0.2);
}

/* 40 % of the bunny's file are vertices without faces. */
static void truncated_obj_is_refused(void **state)
{
    (void)state;
    assert_cut_is_refused(bunny, ".obj", 0.4);
}

static void bunny_has_its_69666_faces(void **state)
{
    (void)state;
    if (access(bunny, R_OK) != 0)
        skip();
    const fm_settings s = mesh_settings(bunny);
    fm_scene *scene = create(&s);
    assert_true(scene->triangles == 69666);
    assert_true(scene->vertex_count < 69666); /* vertices are shared */
    scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cube_has_twelve_triangles_and_no_layers),
        cmocka_unit_test(colours_are_premultiplied_and_shaded),
        cmocka_unit_test(fitted_camera_fills_the_view),
        cmocka_unit_test(zoom_scales_the_fitted_view),
        cmocka_unit_test(given_camera_is_vulkans),
        cmocka_unit_test(default_planes_follow_the_box),
        cmocka_unit_test(instances_are_offset_in_box_sizes),
        cmocka_unit_test(camera_that_looks_away_is_refused),
        cmocka_unit_test(far_meshes_are_seen_as_near_ones),
        cmocka_unit_test(size_changes_nothing_that_is_seen),
        cmocka_unit_test(cameras_beyond_floats_are_refused),
        cmocka_unit_test(missing_file_is_an_io_error),
        cmocka_unit_test(damaged_obj_files_are_refused),
        cmocka_unit_test(damaged_ply_files_are_refused),
        cmocka_unit_test(truncated_3ds_is_refused),
        cmocka_unit_test(truncated_obj_is_refused),
        cmocka_unit_test(bunny_has_its_69666_faces),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
