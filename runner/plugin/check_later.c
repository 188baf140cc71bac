#include "check_later.h"

#include <stddef.h>

typedef struct later_field {
    const char *name;
    size_t offset_bytes, size_bytes;
} later_field;

#define LATER(STRUCT, FIELD)                                                                       \
    {                                                                                              \
#FIELD, offsetof(STRUCT, FIELD), sizeof((STRUCT *)0)->FIELD                                \
    }
#define COUNT(LIST) (sizeof(LIST) / sizeof(LIST)[0])

static const later_field of_method[] = {
    LATER(fm_method_desc, needs_interlock),
};

static const later_field of_pass[] = {
    LATER(fm_pass, ordered_interlock),
    LATER(fm_pass, targets_after_lock),
    LATER(fm_pass, writes_sample_mask),
    LATER(fm_pass, shared_sort),
};

static bool is_set(const void *item, const later_field *field)
{
    const unsigned char *bytes = (const unsigned char *)item + field->offset_bytes;
    for (size_t i = 0; i < field->size_bytes; i++)
        if (bytes[i] != 0)
            return true;
    return false;
}

static fm_status check_fields(const void *item, const later_field *fields, size_t count,
                              fm_error *err)
{
    for (size_t i = 0; i < count; i++)
        if (is_set(item, &fields[i]))
            return fm_fail(err, FM_INVALID,
                           "%s: not yet: ABI 5 has it, this program cannot do it; leave it zero",
                           fields[i].name);
    return FM_OK;
}

fm_status check_later_method(const fm_method_desc *method, fm_error *err)
{
    return check_fields(method, of_method, COUNT(of_method), err);
}

fm_status check_later_pass(const fm_pass *pass, fm_error *err)
{
    return check_fields(pass, of_pass, COUNT(of_pass), err);
}
