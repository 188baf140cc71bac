/* The plugins of a bundle. */
#ifndef FM_BUNDLE_METHODS_H
#define FM_BUNDLE_METHODS_H

#include "bundle.h"
#include "items.h"

/* Adds plugins with their GLSL: those of desc->methods with the floors of feeds, or all. GLSL comes
 * from all methods, since one may use another's. ids: of the plugins that were added; plugins:
 * their paths. The first of the folders that has an id wins. FM_INVALID: no such method. */
fm_status bundle_add_methods(bundle_items *items, fm_text_list *ids, fm_text_list *plugins,
                             const fm_bundle_desc *desc, fm_error *err);

#endif
