/* manifest.json: what ran, where, and how methods look.
 *
 * Missing fields are "" or false, unknown ones are ignored: manifests of older versions, and of
 * newer ones with the same schema, are read. A file that is not a JSON object, or whose parts have
 * the wrong shape, is damaged. */
#ifndef FM_PROVENANCE_H
#define FM_PROVENANCE_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"
#include "fragmark/method.h"
#include "model/hardware.h"

/* A method of the run, as its descriptor described it. */
typedef struct fm_method_info {
    const char *id, *title, *citation, *version; /* title: the id where it has none */
    const char *defaults; /* of its options, as column `options` spells them; "": not known */
    fm_family family;     /* gives the colour in charts */
    fm_marker marker;
    bool is_dashed;
    uint32_t traits; /* FM_TRAIT_*; those of newer programs are left out */
    bool is_control; /* a control, or the floor */
} fm_method_info;

typedef struct fm_device_info {
    const char *selector; /* as it was asked for: "vulkan:0" */
    const char *name, *driver, *api;
    bool is_software;
} fm_device_info;

/* A line of "machine", or of the head of the manifest, as text. */
typedef struct fm_manifest_fact {
    const char *name;
    char value[512];
} fm_manifest_fact;

typedef struct fm_provenance {
    fm_method_info *methods;
    size_t method_count;
    fm_device_info *devices;
    size_t device_count;
    fm_manifest_fact *machine; /* machine's scalars, in the file's order */
    size_t machine_count;
    fm_manifest_fact
        *facts; /* the head's scalars: command, git_commit, seed, started, schema, ... */
    size_t fact_count;
    const char **figures; /* ids of the figures that the run was made for */
    size_t figure_count;
    void *json; /* holds all texts */
} fm_provenance;

/* FM_IO, FM_NO_MEMORY; FM_INVALID: damaged, naming file and line or field. The caller closes
 * *manifest, which is NULL on failure. */
fm_status provenance_read(fm_provenance **manifest, const char *path, fm_error *err);
void provenance_close(fm_provenance *manifest);

const fm_method_info *provenance_method(const fm_provenance *manifest,
                                        const char *id); /* or NULL */
/* The device of a selector, else of that name, else NULL. */
const fm_device_info *provenance_device(const fm_provenance *manifest, const char *selector,
                                        const char *name);
const char *provenance_fact(const fm_provenance *manifest, const char *name); /* "": none */
/* The same of "machine". */
const char *provenance_machine_fact(const fm_provenance *manifest, const char *name);
/* Which machine it was; texts are the manifest's. */
fm_hardware provenance_hardware(const fm_provenance *manifest);

#endif
