/* Shared by the files of protocol.h: protocol.c (answers) and request.c (requests). */
#ifndef FM_PROTOCOL_JSON_H
#define FM_PROTOCOL_JSON_H

#include "protocol.h"

/* The text of a field; "": it has none. */
const char *json_text_in(const json_t *object, const char *field);
/* Whether a field is true. */
bool json_is_set(const json_t *object, const char *field);
/* A list of hashes, 16 hex digits each. */
json_t *json_hashes(const uint64_t *hashes, size_t count);

#endif
