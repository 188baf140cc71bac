#include "settings.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "base/file.h"

enum { DEFAULT_R = 4, READ_BYTES = 65536 };
static const double fragments_max = 1099511627776.0; /* 2^40 */

static void *field(fm_settings *settings, const fm_key *key)
{
    return (char *)settings + key->offset;
}

static const void *const_field(const fm_settings *settings, const fm_key *key)
{
    return (const char *)settings + key->offset;
}

static const char *text_field(const fm_settings *settings, const fm_key *key)
{
    const char *text = NULL;
    memcpy(&text, const_field(settings, key), sizeof text);
    return text;
}

void settings_default(fm_settings *settings)
{
    *settings = (fm_settings){ 0 };
    for (size_t i = 0; i < fm_key_count; i++)
        settings_set(settings, &fm_keys[i], fm_keys[i].fallback, NULL);
}

static fm_status illegal(const fm_key *key, const char *text, fm_error *err)
{
    char domain[FM_TEXT_MAX];
    key_domain(domain, key);
    return fm_fail(err, FM_INVALID, "%s: '%.200s' is not a legal value; legal: %s", key->name, text,
                   domain);
}

static fm_status set_uint(fm_settings *settings, const fm_key *key, const char *text, fm_error *err)
{
    uint64_t value = 0;
    if (key->optional && strcmp(text, "none") == 0) {
        memcpy(field(settings, key), &key->absent, sizeof key->absent);
        return FM_OK;
    }
    if (!text_to_u64(&value, text) || value > FM_KEY_UINT64_MAX || (double)value < key->low ||
        (double)value > key->high)
        return illegal(key, text, err);
    const uint32_t narrow = (uint32_t)value;
    if (key->type == FM_KEY_UINT)
        memcpy(field(settings, key), &narrow, sizeof narrow);
    else
        memcpy(field(settings, key), &value, sizeof value);
    return FM_OK;
}

static bool real_in_range(double *value, const fm_key *key, const char *text)
{
    if (!text_to_double(value, text) || *value < key->low || *value > key->high)
        return false;
    *value += 0.0; /* -0 and 0 are one value */
    return true;
}

static fm_status set_real(fm_settings *settings, const fm_key *key, const char *text, fm_error *err)
{
    double value = 0;
    if (!real_in_range(&value, key, text))
        return illegal(key, text, err);
    memcpy(field(settings, key), &value, sizeof value);
    return FM_OK;
}

static fm_status set_percent(fm_settings *settings, const fm_key *key, const char *text,
                             fm_error *err)
{
    double value = key->absent;
    char digits[FM_TEXT_MAX];
    const size_t length = strlen(text);
    const bool is_absent = key->optional && strcmp(text, "none") == 0;
    const bool has_sign = length > 0 && length < sizeof digits && text[length - 1] == '%';
    if (has_sign) {
        memcpy(digits, text, length);
        digits[length - 1] = '\0';
    }
    if (!is_absent && !(has_sign && real_in_range(&value, key, digits)))
        return illegal(key, text, err);
    memcpy(field(settings, key), &value, sizeof value);
    return FM_OK;
}

static fm_status set_vector(fm_settings *settings, const fm_key *key, const char *text,
                            fm_error *err)
{
    double vector[3] = { 0 };
    char copy[FM_TEXT_MAX], *rest = copy;
    size_t count = 0;
    if (strlen(text) >= sizeof copy)
        return illegal(key, text, err);
    strcpy(copy, text);
    for (char *word; (word = strtok_r(rest, " ", &rest)) != NULL; count++)
        if (count >= 3 || !real_in_range(&vector[count], key, word))
            return illegal(key, text, err);
    if (count != 3)
        return illegal(key, text, err);
    memcpy(field(settings, key), vector, sizeof vector);
    return FM_OK;
}

static fm_status set_enum(fm_settings *settings, const fm_key *key, const char *text, fm_error *err)
{
    for (unsigned i = 0; i < key->value_count; i++) {
        if (strcmp(key->values[i], text) == 0) {
            memcpy(field(settings, key), &i, sizeof i);
            return FM_OK;
        }
    }
    return illegal(key, text, err);
}

static fm_status set_text(fm_settings *settings, const fm_key *key, const char *text, fm_error *err)
{
    if (strlen(text) >= FM_PATH_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "%s: longer than %d bytes", key->name,
                       FM_PATH_MAX_BYTES - 1);
    for (const char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < ' ')
            return fm_fail(err, FM_INVALID, "%s: control characters", key->name);
    if (!text_is_utf8(text))
        return fm_fail(err, FM_INVALID, "%s: not UTF-8", key->name);
    const char *shared = text_shared(text);
    if (shared == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", key->name);
    memcpy(field(settings, key), &shared, sizeof shared);
    return FM_OK;
}

fm_status settings_set(fm_settings *settings, const fm_key *key, const char *text, fm_error *err)
{
    switch (key->type) {
    case FM_KEY_UINT:
    case FM_KEY_UINT64:
        return set_uint(settings, key, text, err);
    case FM_KEY_REAL:
        return set_real(settings, key, text, err);
    case FM_KEY_PERCENT:
        return set_percent(settings, key, text, err);
    case FM_KEY_VECTOR:
        return set_vector(settings, key, text, err);
    case FM_KEY_ENUM:
        return set_enum(settings, key, text, err);
    case FM_KEY_TEXT:
        return set_text(settings, key, text, err);
    }
    return fm_fail(err, FM_INVALID, "%s: a key without a type", key->name);
}

static void uint_text(char text[FM_PATH_MAX_BYTES], const fm_settings *settings, const fm_key *key)
{
    uint32_t value = 0;
    memcpy(&value, const_field(settings, key), sizeof value);
    if (key->optional && value == key->absent)
        strcpy(text, "none");
    else
        snprintf(text, FM_PATH_MAX_BYTES, "%u", value);
}

static void percent_text(char text[FM_PATH_MAX_BYTES], const fm_settings *settings,
                         const fm_key *key)
{
    double value = 0;
    memcpy(&value, const_field(settings, key), sizeof value);
    text_from_double(text, value);
    if (key->optional && value <= key->absent)
        strcpy(text, "none");
    else
        strcat(text, "%");
}

static void vector_text(char text[FM_PATH_MAX_BYTES], const fm_settings *settings,
                        const fm_key *key)
{
    double vector[3];
    char words[3][32];
    memcpy(vector, const_field(settings, key), sizeof vector);
    for (size_t i = 0; i < 3; i++)
        text_from_double(words[i], vector[i]);
    snprintf(text, FM_PATH_MAX_BYTES, "%s %s %s", words[0], words[1], words[2]);
}

void settings_text(char text[FM_PATH_MAX_BYTES], const fm_settings *settings, const fm_key *key)
{
    uint64_t wide = 0;
    double real = 0;
    unsigned index = 0;
    switch (key->type) {
    case FM_KEY_UINT:
        uint_text(text, settings, key);
        return;
    case FM_KEY_UINT64:
        memcpy(&wide, const_field(settings, key), sizeof wide);
        snprintf(text, FM_PATH_MAX_BYTES, "%llu", (unsigned long long)wide);
        return;
    case FM_KEY_REAL:
        memcpy(&real, const_field(settings, key), sizeof real);
        text_from_double(text, real);
        return;
    case FM_KEY_PERCENT:
        percent_text(text, settings, key);
        return;
    case FM_KEY_VECTOR:
        vector_text(text, settings, key);
        return;
    case FM_KEY_ENUM:
        memcpy(&index, const_field(settings, key), sizeof index);
        strcpy(text, key->values[index]);
        return;
    case FM_KEY_TEXT:
        snprintf(text, FM_PATH_MAX_BYTES, "%s", text_field(settings, key));
        return;
    }
}

const char *settings_file_key(const fm_settings *settings)
{
    if (settings->generator == FM_GENERATOR_STREAM)
        return "stream";
    return key_is_read(key_find("mesh"), settings->generator) ? "mesh" : NULL;
}

const char *settings_file(const fm_settings *settings)
{
    const char *key = settings_file_key(settings);
    return key != NULL ? text_field(settings, key_find(key)) : NULL;
}

bool generator_makes_frames(fm_generator generator)
{
    return (FM_MAKES_FRAMES >> generator & 1) != 0;
}

bool settings_key_matters(const fm_settings *settings, const fm_key *key)
{
    char value[FM_PATH_MAX_BYTES];
    const fm_key *other = key->with != NULL ? key_find(key->with) : NULL;
    if (other == NULL)
        return true;
    settings_text(value, settings, other);
    return strcmp(value, other->fallback) != 0;
}

static fm_status require_file(const fm_settings *settings, fm_error *err)
{
    const char *file = settings_file(settings);
    if (file == NULL || file[0] != '\0')
        return FM_OK;
    return fm_fail(err, FM_INVALID, "%s: generator %s needs a file", settings_file_key(settings),
                   key_find("generator")->values[settings->generator]);
}

static fm_status finish_mesh(fm_settings *settings, fm_error *err)
{
    settings->n = 0;
    settings->r = 0;
    const fm_status status = require_file(settings, err);
    if (status != FM_OK)
        return status;
    const bool is_fitted =
        fpclassify(settings->near_plane) == FP_ZERO && fpclassify(settings->far_plane) == FP_ZERO;
    if (!is_fitted && !(settings->near_plane > 0 && settings->near_plane < settings->far_plane))
        return fm_fail(err, FM_INVALID,
                       "near_plane %g, far_plane %g: legal are 0 and 0, or 0 < near < far",
                       settings->near_plane, settings->far_plane);
    return FM_OK;
}

/* n = r k. Settings that were finished before hold all three, or n, r and no k. */
static fm_status complete_n(fm_settings *settings, fm_error *err)
{
    const bool has_n = settings->n != FM_NOT_GIVEN;
    if (!has_n && settings->k == 0)
        return fm_fail(err, FM_INVALID, "n: not given, and r k needs a k");
    if (!has_n && settings->r == 0)
        settings->r = DEFAULT_R;
    if (settings->k == 0 || settings->r == 0)
        return FM_OK;
    const uint64_t n = (uint64_t)settings->r * settings->k;
    if (has_n && n != settings->n)
        return fm_fail(err, FM_INVALID, "n = %u and r = %u with k = %u: give n or r, not both",
                       settings->n, settings->r, settings->k);
    if ((double)n > key_find("n")->high)
        return fm_fail(err, FM_INVALID, "n = r k = %u x %u is above %g", settings->r, settings->k,
                       key_find("n")->high);
    settings->n = (uint32_t)n;
    return FM_OK;
}

fm_status settings_finish(fm_settings *settings, fm_error *err)
{
    if (generator_makes_frames(settings->generator)) {
        settings->n = settings->r = 0;
        return require_file(settings, err);
    }
    if (settings->generator != FM_GENERATOR_LAYERS)
        return finish_mesh(settings, err);
    const fm_status status = complete_n(settings, err);
    if (status != FM_OK)
        return status;
    const double fragments =
        (double)settings->n * settings->width_px * settings->height_px * settings->pixel_density;
    if (fragments > fragments_max)
        return fm_fail(err, FM_INVALID, "n = %u over %u x %u px: %.3g fragments; at most 2^40",
                       settings->n, settings->width_px, settings->height_px, fragments);
    return FM_OK;
}

void settings_for_truth(fm_settings *truth, const fm_settings *settings)
{
    *truth = *settings;
    for (size_t i = 0; i < fm_key_count; i++)
        if (fm_keys[i].scope == FM_SCOPE_CASE)
            settings_set(truth, &fm_keys[i], fm_keys[i].fallback, NULL);
    truth->r = 0; /* n is known, and r would contradict the default k */
}

fm_status settings_mesh_digest(uint64_t *digest, const char *path, fm_error *err)
{
    char block[READ_BYTES];
    FILE *file = NULL;
    XXH64_state_t *state = NULL;
    fm_status status = file_open_stream(&file, path, err);
    if (status != FM_OK)
        return status;
    state = XXH64_createState();
    if (state == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory for its digest", path);
        goto out;
    }
    XXH64_reset(state, 0);
    for (size_t count; (count = fread(block, 1, sizeof block, file)) > 0;)
        XXH64_update(state, block, count);
    if (ferror(file)) {
        status = fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
        goto out;
    }
    *digest = XXH64_digest(state);
out:
    XXH64_freeState(state);
    fclose(file);
    return status;
}

static bool in_scene_hash(const fm_key *key, fm_generator generator)
{
    return key->scope == FM_SCOPE_SCENE && key_is_read(key, generator) &&
           key->offset != offsetof(fm_settings, r);
}

uint32_t generator_version(fm_generator generator)
{
    /* As many as key masks can name. A generator that is not named has version 0. */
    static const uint32_t versions[32] = {
        [FM_GENERATOR_MESH] = 1, [FM_GENERATOR_BUNNY_IN_CUBE] = 1
    };
    return versions[generator];
}

void settings_scene_hash_with(char hash[17], const fm_settings *settings, uint64_t mesh_digest,
                              uint32_t version)
{
    char value[FM_PATH_MAX_BYTES];
    uint64_t mixed = version;
    for (size_t i = 0; i < fm_key_count; i++) {
        const fm_key *key = &fm_keys[i];
        if (!in_scene_hash(key, settings->generator))
            continue;
        settings_text(value, settings, key);
        if (key->is_quiet && strcmp(value, key->fallback) == 0)
            continue;
        mixed = XXH64(key->name, strlen(key->name) + 1, mixed);
        if (key->type == FM_KEY_TEXT)
            mixed = XXH64(&mesh_digest, sizeof mesh_digest, mixed);
        else
            mixed = XXH64(value, strlen(value) + 1, mixed);
    }
    snprintf(hash, 17, "%016llx", (unsigned long long)mixed);
}

void settings_scene_hash_of(char hash[17], const fm_settings *settings, uint64_t mesh_digest)
{
    settings_scene_hash_with(hash, settings, mesh_digest, generator_version(settings->generator));
}

void settings_scene_hash(char hash[17], const fm_settings *settings)
{
    uint64_t digest = 0;
    const char *file = settings_file(settings);
    if (file != NULL && settings_mesh_digest(&digest, file, NULL) != FM_OK)
        digest = XXH64(file, strlen(file), 0);
    settings_scene_hash_of(hash, settings, digest);
}
