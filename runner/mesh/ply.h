/* What the head of a PLY file declares. */
#ifndef FM_PLY_H
#define FM_PLY_H

#include "scan.h"

typedef enum ply_format { PLY_ASCII, PLY_LITTLE_ENDIAN, PLY_BIG_ENDIAN } ply_format;

typedef enum ply_type {
    PLY_CHAR,
    PLY_UCHAR,
    PLY_SHORT,
    PLY_USHORT,
    PLY_INT,
    PLY_UINT,
    PLY_FLOAT,
    PLY_DOUBLE,
    PLY_TYPE_COUNT
} ply_type;

typedef enum ply_kind {
    PLY_OTHER,
    PLY_VERTEX,
    PLY_FACE,
    PLY_STRIPS, /* of triangles, each turned about */
    PLY_EDGE
} ply_kind;

/* What a property means where it stands: x of a vertex, indices of a face. */
typedef enum ply_role {
    PLY_NO_ROLE,
    PLY_X, /* y and z follow, then the normal's */
    PLY_NORMAL_X = PLY_X + 3,
    PLY_INDICES = PLY_NORMAL_X + 3,
    PLY_COLOUR
} ply_role;

enum { PLY_MAX_ELEMENTS = 32, PLY_MAX_PROPERTIES = 64 };

typedef struct ply_property {
    ply_role role;
    ply_type type, count_type;
    bool is_list;
} ply_property;

typedef struct ply_element {
    char name[32];
    ply_kind kind;
    uint64_t count;
    ply_property properties[PLY_MAX_PROPERTIES];
    size_t property_count;
} ply_element;

typedef struct ply_head {
    ply_format format;
    ply_element elements[PLY_MAX_ELEMENTS];
    size_t element_count;
} ply_head;

/* Reads up to `end_header`; what follows its line is the body. FM_INVALID. */
fm_status ply_head_read(ply_head *head, fm_scan *scan, fm_error *err);
/* Whether the element has a property of this role. */
bool ply_has(const ply_element *element, ply_role role);

#endif
