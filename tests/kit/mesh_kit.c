#include "mesh_kit.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const double rounding = 1e-6; /* floats up to 1 */

fm_status read_bytes(fm_mesh *mesh, fm_error *err, const char *ending, const void *bytes,
                     size_t count)
{
    char path[64];
    *mesh = (fm_mesh){ 0 };
    snprintf(path, sizeof path, "/tmp/fragmark-mesh-file-XXXXXX%s", ending);
    const int descriptor = mkstemps(path, (int)strlen(ending));
    assert_true(descriptor >= 0);
    assert_true(write(descriptor, bytes, count) == (ssize_t)count);
    close(descriptor);
    const fm_status status = mesh_file_read(mesh, path, err);
    unlink(path);
    return status;
}

void load_bytes(fm_mesh *mesh, const char *ending, const void *bytes, size_t count)
{
    fm_error err = { 0 };
    if (read_bytes(mesh, &err, ending, bytes, count) != FM_OK)
        fail_msg("%s", err.message);
}

void load(fm_mesh *mesh, const char *ending, const char *text)
{
    load_bytes(mesh, ending, text, strlen(text));
}

void assert_refused(const char *ending, const char *text, const char *reason)
{
    fm_mesh mesh;
    fm_error err = { 0 };
    assert_int_equal(read_bytes(&mesh, &err, ending, text, strlen(text)), FM_INVALID);
    mesh_free(&mesh);
    assert_memory_equal(err.message, "/tmp/fragmark-mesh-file-", 24);
    if (strstr(err.message, reason) == NULL)
        fail_msg("'%s' is not in: %s", reason, err.message);
}

double area_of(const fm_mesh *mesh)
{
    double sum = 0.0;
    for (uint32_t i = 0; i < mesh->index_count; i += 3) {
        vec3 p[3];
        for (uint32_t j = 0; j < 3; j++) {
            const float *at = mesh->positions[mesh->indices[i + j]];
            p[j] = (vec3){ (double)at[0], (double)at[1], (double)at[2] };
        }
        const vec3 n = cross(minus(p[1], p[0]), minus(p[2], p[0]));
        sum += 0.5 * sqrt(dot(n, n));
    }
    return ldexp(sum, 2 * mesh->space.exponent);
}

fm_mesh_facts assert_loads(const char *ending, const char *text, uint64_t triangles, double area)
{
    fm_mesh mesh;
    load(&mesh, ending, text);
    const fm_mesh_facts facts = mesh.facts;
    assert_int_equal(facts.triangles, triangles);
    assert_int_equal(mesh.index_count, 3 * triangles);
    const double found = area_of(&mesh);
    if (!(fabs(found - area) < rounding * area))
        fail_msg("area %g, not %g: %s", found, area, text);
    mesh_free(&mesh);
    return facts;
}

bool ignores(const fm_mesh_facts *facts, fm_mesh_ignored what)
{
    return facts->ignored == 1u << what;
}
