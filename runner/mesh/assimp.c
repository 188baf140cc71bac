/* Formats without a reader of their own. assimp hands over its polygons as they are: its later
 * steps drop what is told of a file. */
#include <assimp/cfileio.h>
#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "readers.h"

/* Columns 0..2 and a translation, of doubles. */
typedef struct affine {
    double m[3][4];
} affine;

typedef struct assimp_state {
    fm_polygons *polygons;
    const struct aiScene *file;
    const char *path;
    uint64_t face; /* how many were met */
    fm_error *err;
} assimp_state;

enum { NODE_DEPTH_MAX = 1000, HEAD_BYTES = 12 };
/* Vertices and faces as they are placed, each: some GiB. A small file can ask for any number. */
static const uint64_t placed_max = UINT64_C(1) << 27;

bool assimp_knows(const char *ending)
{
    return ending[0] == '.' && aiIsExtensionSupported(ending) == AI_TRUE;
}

static uint32_t word_at(const unsigned char *b)
{
    return (uint32_t)b[0] | (uint32_t)b[1] << 8 | (uint32_t)b[2] << 16 | (uint32_t)b[3] << 24;
}

/* 3DS and binary glTF say how long they are; assimp reads what is left of a file that was cut. */
static fm_status check_size(const char *path, fm_error *err)
{
    unsigned char head[HEAD_BYTES] = { 0 };
    FILE *file = NULL;
    if (file_open_stream(&file, path, err) != FM_OK)
        return err != NULL ? err->status : FM_INVALID;
    if (fread(head, 1, sizeof head, file) < sizeof head || fseeko(file, 0, SEEK_END) != 0) {
        fclose(file);
        return fm_fail(err, FM_INVALID, "%s: too short to be a mesh", path);
    }
    const uint64_t size = (uint64_t)ftello(file);
    fclose(file);
    uint64_t declared = 0;
    if (head[0] == 0x4D && head[1] == 0x4D)
        declared = word_at(head + 2);
    else if (memcmp(head, "glTF", 4) == 0)
        declared = word_at(head + 8);
    if (size < declared)
        return fm_fail(err, FM_INVALID,
                       "%s: it says it has %llu bytes, and has %llu: is it cut off?", path,
                       (unsigned long long)declared, (unsigned long long)size);
    return FM_OK;
}

/* What libassimp opens, which may be files that the file names: regular ones only, to be read. */

static size_t file_read(struct aiFile *file, char *bytes, size_t size, size_t count)
{
    return fread(bytes, size, count, (FILE *)(void *)file->UserData);
}

static size_t file_write(struct aiFile *file, const char *bytes, size_t size, size_t count)
{
    (void)file, (void)bytes, (void)size, (void)count;
    return 0;
}

static size_t file_tell(struct aiFile *file)
{
    return (size_t)ftello((FILE *)(void *)file->UserData);
}

static size_t file_size(struct aiFile *file)
{
    struct stat info;
    return fstat(fileno((FILE *)(void *)file->UserData), &info) == 0 ? (size_t)info.st_size : 0;
}

static enum aiReturn file_seek(struct aiFile *file, size_t at, enum aiOrigin origin)
{
    static const int origins[] = {
        [aiOrigin_SET] = SEEK_SET, [aiOrigin_CUR] = SEEK_CUR, [aiOrigin_END] = SEEK_END
    };
    const bool is_known =
        origin == aiOrigin_SET || origin == aiOrigin_CUR || origin == aiOrigin_END;
    return is_known && fseeko((FILE *)(void *)file->UserData, (off_t)at, origins[origin]) == 0
               ? aiReturn_SUCCESS
               : aiReturn_FAILURE;
}

static void file_flush(struct aiFile *file)
{
    (void)file;
}

static struct aiFile *open_file(struct aiFileIO *io, const char *path, const char *mode)
{
    FILE *stream = NULL;
    struct aiFile *file = NULL;
    (void)io;
    if (strchr(mode, 'w') != NULL || strchr(mode, 'a') != NULL || strchr(mode, '+') != NULL ||
        file_open_stream(&stream, path, NULL) != FM_OK)
        return NULL;
    file = calloc(1, sizeof *file);
    if (file == NULL) {
        fclose(stream);
        return NULL;
    }
    *file = (struct aiFile){ .ReadProc = file_read,
                             .WriteProc = file_write,
                             .TellProc = file_tell,
                             .FileSizeProc = file_size,
                             .SeekProc = file_seek,
                             .FlushProc = file_flush,
                             .UserData = (aiUserData)(void *)stream };
    return file;
}

static void close_file(struct aiFileIO *io, struct aiFile *file)
{
    (void)io;
    fclose((FILE *)(void *)file->UserData);
    free(file);
}

static affine of_node(const struct aiMatrix4x4 *m)
{
    return (affine){ { { (double)m->a1, (double)m->a2, (double)m->a3, (double)m->a4 },
                       { (double)m->b1, (double)m->b2, (double)m->b3, (double)m->b4 },
                       { (double)m->c1, (double)m->c2, (double)m->c3, (double)m->c4 } } };
}

static affine product(const affine *a, const affine *b)
{
    affine c = { 0 };
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++) {
            c.m[row][column] = column == 3 ? a->m[row][3] : 0.0;
            for (int i = 0; i < 3; i++)
                c.m[row][column] += a->m[row][i] * b->m[i][column];
        }
    return c;
}

static void place(double at[3], const affine *a, const struct aiVector3D *v)
{
    for (int row = 0; row < 3; row++)
        at[row] = a->m[row][0] * (double)v->x + a->m[row][1] * (double)v->y +
                  a->m[row][2] * (double)v->z + a->m[row][3];
}

/* Normals take the matrix of cofactors: it keeps them upright on what is stretched. */
static void turn_normal(double normal[3], const affine *a, const struct aiVector3D *v)
{
    for (int row = 0; row < 3; row++) {
        const double *p = a->m[(row + 1) % 3], *q = a->m[(row + 2) % 3];
        normal[row] = (p[1] * q[2] - p[2] * q[1]) * (double)v->x +
                      (p[2] * q[0] - p[0] * q[2]) * (double)v->y +
                      (p[0] * q[1] - p[1] * q[0]) * (double)v->z;
    }
}

static fm_status add_vertices(assimp_state *state, const struct aiMesh *mesh,
                              const affine *to_world)
{
    fm_status status = FM_OK;
    double triple[3];
    for (unsigned i = 0; i < mesh->mNumVertices && status == FM_OK; i++) {
        place(triple, to_world, &mesh->mVertices[i]);
        status = polygons_position(state->polygons, triple, state->err);
        if (status != FM_OK || mesh->mNormals == NULL)
            continue;
        turn_normal(triple, to_world, &mesh->mNormals[i]);
        status = polygons_normal(state->polygons, triple, state->err);
    }
    return status;
}

static fm_status add_face(assimp_state *state, const struct aiFace *face, const struct aiMesh *mesh,
                          uint32_t position, uint32_t normal)
{
    fm_status status = FM_OK;
    for (unsigned i = 0; i < face->mNumIndices && status == FM_OK; i++) {
        const unsigned index = face->mIndices[i];
        if (index >= mesh->mNumVertices)
            return fm_fail(state->err, FM_INVALID, "%s: mesh '%s': vertex %u of %u", state->path,
                           mesh->mName.data, index, mesh->mNumVertices);
        status =
            polygons_corner(state->polygons, position + index,
                            mesh->mNormals == NULL ? FM_NO_NORMAL : normal + index, state->err);
    }
    return status == FM_OK ? polygons_end_face(state->polygons, state->face++, state->err) : status;
}

static bool is_default_material(const assimp_state *state, unsigned index)
{
    struct aiString name = { 0 };
    if (index >= state->file->mNumMaterials ||
        aiGetMaterialString(state->file->mMaterials[index], AI_MATKEY_NAME, &name) != AI_SUCCESS)
        return true;
    return name.length == 0 || strcmp(name.data, AI_DEFAULT_MATERIAL_NAME) == 0;
}

static fm_status add_mesh(assimp_state *state, const struct aiMesh *mesh, const affine *to_world)
{
    const uint32_t position = (uint32_t)state->polygons->position_count;
    const uint32_t normal = (uint32_t)state->polygons->normal_count;
    const size_t faces = state->polygons->face_count;
    fm_status status = add_vertices(state, mesh, to_world);
    for (unsigned i = 0; i < mesh->mNumFaces && status == FM_OK; i++)
        status = add_face(state, &mesh->mFaces[i], mesh, position, normal);
    state->polygons->facts.parts += state->polygons->face_count > faces;
    if (mesh->mColors[0] != NULL)
        polygons_ignore(state->polygons, FM_MESH_VERTEX_COLOURS);
    if (!is_default_material(state, mesh->mMaterialIndex))
        polygons_ignore(state->polygons, FM_MESH_MATERIALS);
    return status;
}

typedef struct placed_counts {
    uint64_t vertices, faces;
} placed_counts;

static fm_status count_mesh(placed_counts *placed, const assimp_state *state,
                            const struct aiMesh *mesh)
{
    placed->vertices += mesh->mNumVertices;
    placed->faces += mesh->mNumFaces;
    if (placed->vertices > placed_max || placed->faces > placed_max)
        return fm_fail(state->err, FM_INVALID,
                       "%s: its nodes place its meshes so often that there are more than %" PRIu64
                       " vertices or faces: no more are read",
                       state->path, placed_max);
    return FM_OK;
}

/* Before a vertex is placed: checks what nodes name, how deep they lie, and how much they place. */
static fm_status check_node(placed_counts *placed, const assimp_state *state,
                            const struct aiNode *node, int depth)
{
    fm_status status = FM_OK;
    if (depth > NODE_DEPTH_MAX)
        return fm_fail(state->err, FM_INVALID, "%s: nodes lie more than %d deep", state->path,
                       NODE_DEPTH_MAX);
    for (unsigned i = 0; i < node->mNumMeshes && status == FM_OK; i++) {
        if (node->mMeshes[i] >= state->file->mNumMeshes)
            return fm_fail(state->err, FM_INVALID, "%s: node '%s': mesh %u of %u", state->path,
                           node->mName.data, node->mMeshes[i], state->file->mNumMeshes);
        status = count_mesh(placed, state, state->file->mMeshes[node->mMeshes[i]]);
    }
    for (unsigned i = 0; i < node->mNumChildren && status == FM_OK; i++)
        status = check_node(placed, state, node->mChildren[i], depth + 1);
    return status;
}

/* A mesh that several nodes name is there several times. */
static fm_status add_node(assimp_state *state, const struct aiNode *node, const affine *above)
{
    const affine own = of_node(&node->mTransformation), to_world = product(above, &own);
    fm_status status = FM_OK;
    for (unsigned i = 0; i < node->mNumMeshes && status == FM_OK; i++)
        status = add_mesh(state, state->file->mMeshes[node->mMeshes[i]], &to_world);
    for (unsigned i = 0; i < node->mNumChildren && status == FM_OK; i++)
        status = add_node(state, node->mChildren[i], &to_world);
    return status;
}

fm_status assimp_read(fm_polygons *polygons, const char *path, fm_error *err)
{
    static const affine identity = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };
    fm_status status = check_size(path, err);
    if (status != FM_OK)
        return status;
    struct aiFileIO io = { .OpenProc = open_file, .CloseProc = close_file };
    const struct aiScene *file = aiImportFileEx(path, 0, &io);
    assimp_state state = { .polygons = polygons, .file = file, .path = path, .err = err };
    placed_counts placed = { 0 };
    if (file == NULL)
        return fm_fail(err, FM_INVALID, "%s: %s", path, aiGetErrorString());
    polygons->is_single = true;
    polygons->element = "face of all meshes";
    if ((file->mFlags & AI_SCENE_FLAGS_INCOMPLETE) != 0 || file->mRootNode == NULL)
        status = fm_fail(err, FM_INVALID, "%s: incomplete", path);
    else
        status = check_node(&placed, &state, file->mRootNode, 0);
    if (status == FM_OK)
        status = add_node(&state, file->mRootNode, &identity);
    aiReleaseImport(file);
    return status;
}
