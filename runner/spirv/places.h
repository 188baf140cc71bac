/* Which resource an instruction reaches, and how. Of accesses.c alone. */
#ifndef FM_SPIRV_PLACES_H
#define FM_SPIRV_PLACES_H

#include "accesses.h"
#include "module.h"

/* The counted resources as one module names them. */
typedef struct spirv_places {
    const spirv_module *module;
    const spirv_counting *counting;
    uint32_t *resource_of;    /* [bound]: of variables, and of types behind addresses: number of the
                                 resource plus 1; 0: none. Owned */
    uint32_t *length_members; /* [resource_count]: of the table; UINT32_MAX: not there. Owned */
    uint32_t table;           /* variable; 0: none */
} spirv_places;

/* What an instruction does to a counted resource. */
typedef struct spirv_access {
    bool is_counted; /* else the rest is 0 */
    bool loads, stores, is_atomic;
    uint32_t resource;
    uint32_t bytes;
    uint32_t index; /* id of the element's number; 0: not told */
    uint32_t image; /* of an image: id of its value, and of the coordinates; 0: a buffer */
    uint32_t coordinates;
    bool is_fetched;       /* it is read as a texture */
    bool is_image_pointer; /* image is the id of a pointer to the value */
} spirv_access;

fm_status places_open(spirv_places *places, const spirv_module *module,
                      const spirv_counting *counting, fm_error *err);
void places_close(spirv_places *places);

/* FM_UNSUPPORTED: it may reach a counted resource, but which is not to be seen. */
fm_status places_find(spirv_access *access, const spirv_places *places,
                      const spirv_instruction *instruction, fm_error *err);

#endif
