/* Every field of a descriptor, in one table: what is walked to write a description, to read one,
 * and to compare two. A field that the interface gains is a row; a test holds the rows against the
 * structs, byte for byte. */
#ifndef FM_FIELDS_H
#define FM_FIELDS_H

#include <stddef.h>

typedef enum fm_field_kind {
    FM_FIELD_NUMBER,  /* or an enum, or an array of numbers: bytes that may have any value */
    FM_FIELD_BOOL,    /* a byte that may have two */
    FM_FIELD_TEXT,    /* const char *; NULL: none */
    FM_FIELD_HOOK,    /* a pointer to a function; NULL: none */
    FM_FIELD_STRUCT,  /* one within the other: `inside` */
    FM_FIELD_POINTER, /* to the only one of its kind, a technique: `inside`; NULL: none */
} fm_field_kind;

typedef struct fm_layout fm_layout;

/* A field: `count` items side by side. */
typedef struct fm_field {
    const char *name;
    fm_field_kind kind;
    size_t offset_bytes;
    size_t unit_bytes; /* of one item */
    size_t count;
    const fm_layout *inside; /* of FM_FIELD_STRUCT and FM_FIELD_POINTER */
} fm_field;

/* A struct: all its fields, in the order in which they lie. */
struct fm_layout {
    const char *name;
    size_t size_bytes;
    const fm_field *fields;
    size_t count;
};

/* Of fm_method_desc, which holds all others. */
extern const fm_layout method_layout;

#endif
