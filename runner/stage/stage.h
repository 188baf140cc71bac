/* A scene on a device, ready for one feed: what all methods of a launch share. Only what the scene
 * and the feed use is allocated.
 *
 * The room stage puts scenes on devices and GLSL together from parts (shader.h). It knows feeds and
 * the runner's own buffers; it knows no method: what a method adds is the instance's. */
#ifndef FM_STAGE_H
#define FM_STAGE_H

#include "scene/scene.h"
#include "scene/triangles.h"
#include "shader.h"
#include "truth/truth.h"

enum {
    STAGE_LAYERS,         /* fm_layer: the layers recipe */
    STAGE_ORDER,          /* uint: arrival -> layer */
    STAGE_CLIP,           /* vec4: matrices of mesh instances */
    STAGE_VERTICES,       /* uvec4 (position bits, colour): feed triangles, as the next */
    STAGE_INDICES,        /* uint */
    STAGE_LIST,           /* uvec2 (depth bits, colour): captured fragments to replay */
    STAGE_LIST_PIXELS,    /* uint: pixel of each */
    STAGE_LIST_OFFSETS,   /* uint: where each pixel's begin (compute-pixel) */
    STAGE_OUTPUT,         /* vec4: the image, with 1 - A for A */
    STAGE_OUTPUT_BACK,    /* vec4: what was emitted from the back */
    STAGE_COUNTERS,       /* uint: [STAGE_COUNTER_*] */
    STAGE_CAPTURE,        /* uvec2 (depth bits, colour): emitted fragments of a band of pixels */
    STAGE_CAPTURE_COUNTS, /* uvec2: how many, from the front and from the back */
    STAGE_SLOT_COUNT,
};

enum {
    STAGE_COUNTER_LOST,
    STAGE_COUNTER_CULLED,
    STAGE_COUNTER_LOCKED,
    STAGE_COUNTER_ARRIVED,
    STAGE_COUNTER_REPAIRED,
    STAGE_COUNTER_UNREPAIRED,
    STAGE_COUNTER_IMAGE_LOW, /* hash of the image, after instance_image_hash */
    STAGE_COUNTER_IMAGE_HIGH,
    STAGE_COUNTER_GO_ON, /* invocations that want their pass to run again; added up */
    STAGE_COUNTER_CUT,   /* bits: passes in which the device ended loops */
    STAGE_COUNTER_COUNT
};

/* Invocations of a workgroup, of every compute shader. */
enum { STAGE_GROUP_SIZE = FM_GROUP_LANES };

/* What a scene pass draws. */
typedef enum fm_geometry {
    FM_GEOMETRY_SCENE,
    FM_GEOMETRY_FLAT, /* layers with t = 1 */
    FM_GEOMETRY_HULL, /* covers: see fm_cover */
    FM_GEOMETRY_BOX,
    FM_GEOMETRY_COUNT
} fm_geometry;

typedef struct fm_stage_cover {
    fm_buffer *vertices, *indices; /* NULL: not drawn by any method */
    uint32_t index_count;
} fm_stage_cover;

typedef struct fm_stage {
    fm_device *device;
    const fm_scene *scene;
    uint32_t feed;          /* one of FM_FEED_* */
    uint32_t n;             /* most fragments of a pixel */
    uint64_t invocations;   /* of a compute feed */
    bool replays;           /* a compute feed from the captured list */
    fm_triangles_view view; /* feed triangles */
    fm_buffers buffers;     /* how storage buffers are reached */
    fm_slot slots[STAGE_SLOT_COUNT];
    fm_buffer *params;
    fm_buffer *vertices, *indices;
    fm_buffer *flat_indices; /* of the same layers with t = 1 */
    fm_stage_cover covers[FM_GEOMETRY_COUNT];
    const char *hull_cache; /* file that keeps the mesh's hull for later launches; NULL: none */
} fm_stage;

/* truth may be NULL: only when the raster feed captures it. The capture slots start unallocated.
 * FM_UNSUPPORTED: this feed cannot carry this scene, with the number. */
fm_status stage_create(fm_stage **stage, fm_device *device, const fm_scene *scene,
                       const fm_truth *truth, uint32_t feed, fm_error *err);
void stage_destroy(fm_stage *stage);

/* A storage buffer behind a slot; bound, or by address beyond the device's range (or as forced). */
fm_status slot_create_buffer(fm_slot *slot, fm_device *device, fm_buffers buffers,
                             const fm_buffer_desc *desc, fm_error *err);
void slot_destroy(fm_slot *slot, fm_device *device);

/* Room for `fragments` emitted fragments in each of `pixels` pixels. */
fm_status stage_create_capture(fm_stage *stage, uint64_t pixels, uint64_t fragments, fm_error *err);

/* The second image of methods that emit from the back. */
fm_status stage_create_back(fm_stage *stage, fm_error *err);

/* Defines that describe the scene and the feed, and the vertex shader of the raster feed. */
void stage_define(fm_text *text, const fm_stage *stage, fm_geometry geometry);
fm_status stage_vertex_shader(fm_text *text, const fm_use *uses, size_t use_count,
                              const fm_stage *stage, const fm_shader_folders *folders,
                              fm_geometry geometry, fm_error *err);
/* The slots that the feed itself reads; returns how many were added. */
size_t stage_uses(fm_use *uses, fm_stage *stage, fm_geometry geometry);
/* Fills the geometry part of a draw of the whole scene, or of its cover. */
void stage_draw(fm_draw *draw, const fm_stage *stage, fm_geometry geometry);
/* Fills the vertex part of a pipeline. */
void stage_vertex_layout(fm_pipeline_desc *desc, const fm_stage *stage, fm_geometry geometry);

static inline bool geometry_is_cover(fm_geometry geometry)
{
    return geometry == FM_GEOMETRY_HULL || geometry == FM_GEOMETRY_BOX;
}
/* Makes a cover ready to be drawn, unless it is (stage_cover.c). FM_UNSUPPORTED: of a compute feed.
 */
fm_status stage_create_cover(fm_stage *stage, fm_geometry geometry, fm_error *err);
void stage_destroy_covers(fm_stage *stage);
/* stage_buffers.c: vertex and index buffers. Data NULL: to be written later. */
fm_status stage_create_vertices(fm_buffer **buffer, fm_device *device, const void *vertices,
                                uint64_t bytes, fm_error *err);
fm_status stage_create_indices(fm_buffer **buffer, fm_device *device, const uint32_t *indices,
                               uint64_t count, fm_error *err);
/* Two triangles for each quad of four corners (0 1 / 2 3). */
fm_status stage_create_quad_indices(fm_buffer **buffer, fm_device *device, uint32_t quads,
                                    fm_error *err);

/* Workgroups of STAGE_GROUP_SIZE for so many invocations, within the device's limits, in two
 * dimensions. */
fm_status stage_groups(uint32_t groups[3], const fm_device_caps *caps, uint64_t invocations,
                       fm_error *err);

#endif
