#include "mesh.h"

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "shade.h"

static const uint64_t max_indices = UINT64_C(1) << 31;

static bool is_finite(const struct aiVector3D *v)
{
    return isfinite(v->x) && isfinite(v->y) && isfinite(v->z);
}

/* What assimp hands over where a file ends early: faces of one or two corners, or faces that name
 * one vertex for all corners. */
static fm_status check_face(const struct aiFace *face, unsigned number, unsigned vertex_count,
                            const char *path, fm_error *err)
{
    bool is_point = true;
    if (face->mNumIndices < 3)
        return fm_fail(err, FM_INVALID,
                       "%s: face %u has %u corners of at least 3: is the file cut off?", path,
                       number, face->mNumIndices);
    for (unsigned i = 0; i < face->mNumIndices; i++) {
        if (face->mIndices[i] >= vertex_count)
            return fm_fail(err, FM_INVALID, "%s: face %u: vertex %u of %u", path, number,
                           face->mIndices[i], vertex_count);
        is_point = is_point && face->mIndices[i] == face->mIndices[0];
    }
    if (is_point)
        return fm_fail(err, FM_INVALID, "%s: face %u is one vertex: is the file cut off?", path,
                       number);
    return FM_OK;
}

static fm_status check_faces(const struct aiScene *file, const char *path, fm_error *err)
{
    fm_status status = FM_OK;
    for (unsigned i = 0; i < file->mNumMeshes; i++) {
        const struct aiMesh *mesh = file->mMeshes[i];
        for (unsigned j = 0; j < mesh->mNumFaces && status == FM_OK; j++)
            status = check_face(&mesh->mFaces[j], j, mesh->mNumVertices, path, err);
    }
    return status;
}

/* The caller releases the result. Components that would keep identical vertices apart are dropped.
 */
static const struct aiScene *import_with(const char *path, unsigned steps)
{
    struct aiPropertyStore *store = aiCreatePropertyStore();
    if (store == NULL)
        return NULL;
    aiSetImportPropertyInteger(store, AI_CONFIG_PP_RVC_FLAGS,
                               aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                   aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS |
                                   aiComponent_ANIMATIONS | aiComponent_TEXTURES |
                                   aiComponent_LIGHTS | aiComponent_CAMERAS);
    const struct aiScene *file = aiImportFileExWithProperties(path, steps, NULL, store);
    aiReleasePropertyStore(store);
    return file;
}

/* On success the caller releases *file. The file is read twice: once as it is, because the later
 * steps drop what tells that it was cut off, and because assimp 5.2 frees a scene twice when
 * aiApplyPostProcessing fails on it. */
static fm_status import(const struct aiScene **file, const char *path, fm_error *err)
{
    *file = import_with(path, 0);
    if (*file == NULL)
        return fm_fail(err, FM_INVALID, "%s: %s", path, aiGetErrorString());
    const fm_status status = check_faces(*file, path, err);
    aiReleaseImport(*file);
    *file = NULL;
    if (status != FM_OK)
        return status;
    *file = import_with(path, aiProcess_ValidateDataStructure | aiProcess_RemoveComponent |
                                  aiProcess_Triangulate | aiProcess_SortByPType |
                                  aiProcess_GenSmoothNormals | aiProcess_JoinIdenticalVertices |
                                  aiProcess_PreTransformVertices);
    if (*file == NULL)
        return fm_fail(err, FM_INVALID, "%s: %s", path, aiGetErrorString());
    return FM_OK;
}

static fm_status check_mesh(const struct aiMesh *mesh, const char *path, fm_error *err)
{
    for (unsigned i = 0; i < mesh->mNumVertices; i++)
        if (!is_finite(&mesh->mVertices[i]))
            return fm_fail(err, FM_INVALID, "%s: vertex %u: a coordinate is not finite", path, i);
    for (unsigned i = 0; i < mesh->mNumFaces; i++) {
        const struct aiFace *face = &mesh->mFaces[i];
        if (face->mNumIndices != 3)
            return fm_fail(err, FM_INVALID, "%s: face %u: %u corners, not 3", path, i,
                           face->mNumIndices);
        for (unsigned j = 0; j < 3; j++)
            if (face->mIndices[j] >= mesh->mNumVertices)
                return fm_fail(err, FM_INVALID, "%s: face %u: vertex %u of %u", path, i,
                               face->mIndices[j], mesh->mNumVertices);
    }
    return FM_OK;
}

/* Checks everything, then counts: nothing after it looks for bad input. */
static fm_status check_file(fm_scene *scene, const struct aiScene *file, const char *path,
                            fm_error *err)
{
    uint64_t vertices = 0, indices = 0;
    if (file->mFlags & AI_SCENE_FLAGS_INCOMPLETE)
        return fm_fail(err, FM_INVALID, "%s: incomplete", path);
    for (unsigned i = 0; i < file->mNumMeshes; i++) {
        const fm_status status = check_mesh(file->mMeshes[i], path, err);
        if (status != FM_OK)
            return status;
        vertices += file->mMeshes[i]->mNumVertices;
        indices += (uint64_t)file->mMeshes[i]->mNumFaces * 3;
    }
    if (indices == 0)
        return fm_fail(err, FM_INVALID, "%s: no triangles", path);
    if (indices > max_indices || vertices > max_indices)
        return fm_fail(err, FM_INVALID,
                       "%s: %" PRIu64 " vertices and %" PRIu64 " indices; at most %" PRIu64, path,
                       vertices, indices, max_indices);
    scene->vertex_count = (uint32_t)vertices;
    scene->index_count = (uint32_t)indices;
    return FM_OK;
}

static uint32_t colour_of(const struct aiVector3D *normal, double alpha)
{
    vec3 n = { 0 };
    if (normal != NULL && is_finite(normal))
        n = (vec3){ (double)normal->x, (double)normal->y, (double)normal->z };
    return shade(n, FM_STONE, alpha);
}

static void copy_mesh(fm_vertex *vertices, uint32_t *indices, const struct aiMesh *mesh,
                      uint32_t first_vertex, double alpha)
{
    for (unsigned i = 0; i < mesh->mNumVertices; i++) {
        const struct aiVector3D *p = &mesh->mVertices[i];
        vertices[i] =
            (fm_vertex){ { p->x, p->y, p->z },
                         colour_of(mesh->mNormals == NULL ? NULL : &mesh->mNormals[i], alpha) };
    }
    for (unsigned i = 0; i < mesh->mNumFaces; i++)
        for (unsigned j = 0; j < 3; j++)
            indices[3 * (size_t)i + j] = first_vertex + mesh->mFaces[i].mIndices[j];
}

static fm_status copy_file(fm_scene *scene, const struct aiScene *file, fm_error *err)
{
    uint32_t vertex = 0;
    size_t index = 0;
    scene->vertices = calloc(scene->vertex_count, sizeof *scene->vertices);
    scene->indices = calloc(scene->index_count, sizeof *scene->indices);
    if (scene->vertices == NULL || scene->indices == NULL)
        return fm_fail(err, FM_NO_MEMORY, "mesh of %" PRIu32 " vertices and %" PRIu32 " indices",
                       scene->vertex_count, scene->index_count);
    for (unsigned i = 0; i < file->mNumMeshes; i++) {
        const struct aiMesh *mesh = file->mMeshes[i];
        copy_mesh(scene->vertices + vertex, scene->indices + index, mesh, vertex,
                  scene->settings.alpha);
        vertex += mesh->mNumVertices;
        index += (size_t)mesh->mNumFaces * 3;
    }
    return FM_OK;
}

/* The box of the vertices that triangles use: a stray vertex must not move the camera. */
static void mesh_box(fm_box *box, const fm_scene *scene)
{
    *box = (fm_box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    for (uint32_t i = 0; i < scene->index_count; i++)
        for (int axis = 0; axis < 3; axis++) {
            const double p = (double)scene->vertices[scene->indices[i]].position[axis];
            box->low[axis] = fmin(box->low[axis], p);
            box->high[axis] = fmax(box->high[axis], p);
        }
}

/* Twice the area of the triangle at indices[first]. */
static double doubled_area(const fm_scene *scene, uint32_t first)
{
    double edge[2][3], cross[3];
    const float *origin = scene->vertices[scene->indices[first]].position;
    for (uint32_t i = 0; i < 2; i++)
        for (int axis = 0; axis < 3; axis++)
            edge[i][axis] = (double)scene->vertices[scene->indices[first + 1 + i]].position[axis] -
                            (double)origin[axis];
    for (int axis = 0; axis < 3; axis++) {
        const int next = (axis + 1) % 3, last = (axis + 2) % 3;
        cross[axis] = edge[0][next] * edge[1][last] - edge[0][last] * edge[1][next];
    }
    return sqrt(cross[0] * cross[0] + cross[1] * cross[1] + cross[2] * cross[2]);
}

static bool has_area(const fm_scene *scene)
{
    for (uint32_t i = 0; i < scene->index_count; i += 3)
        if (doubled_area(scene, i) > 0.0)
            return true;
    return false;
}

fm_status mesh_read(fm_scene *scene, fm_box *box, fm_error *err)
{
    const char *path = scene->settings.mesh;
    const struct aiScene *file;
    if (path[0] == '\0')
        return fm_fail(err, FM_INVALID, "mesh: no file is named");
    if (access(path, R_OK) != 0)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    fm_status status = import(&file, path, err);
    if (status != FM_OK)
        return status;
    status = check_file(scene, file, path, err);
    if (status == FM_OK)
        status = copy_file(scene, file, err);
    if (status == FM_OK && !has_area(scene))
        status = fm_fail(err, FM_INVALID, "%s: no triangle has an area", path);
    if (status == FM_OK)
        mesh_box(box, scene);
    aiReleaseImport(file);
    return status;
}
