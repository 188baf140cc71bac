/* What a bundle says of itself. */
#ifndef FM_BUNDLE_PAPERS_H
#define FM_BUNDLE_PAPERS_H

#include "base/text.h"
#include "items.h"

/* Writes ROOT/bundle.json and ROOT/README. */
fm_status bundle_write_papers(const char *root, const bundle_items *items, const fm_text_list *ids,
                              fm_error *err);

#endif
