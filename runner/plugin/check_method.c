#include "check_method.h"

#include <inttypes.h>
#include <string.h>

#include "base/text.h"
#include "check_later.h"
#include "check_words.h"
#include "plugin.h"

static fm_status take_lists(fm_checked_method *check, fm_error *err)
{
    const fm_method_desc *m = check->method;
    fm_status status = check_names(&check->options, &m->options[0].name, sizeof m->options[0],
                                   FM_MAX_OPTIONS, err);
    if (status == FM_OK)
        status = check_names(&check->resources, &m->resources[0].name, sizeof m->resources[0],
                             FM_MAX_RESOURCES, err);
    if (status == FM_OK)
        status = check_names(&check->totals, &m->totals[0].name, sizeof m->totals[0], FM_MAX_TOTALS,
                             err);
    if (status == FM_OK)
        status = check_names(&check->passes, &m->passes[0].name, sizeof m->passes[0], FM_MAX_PASSES,
                             err);
    return status;
}

static fm_status check_id(const char *id, fm_error *err)
{
    const size_t room = sizeof((fm_plugin_entry *)0)->id;
    if (id == NULL || !check_is_word(id, "-") || strstr(id, "--") != NULL ||
        id[strlen(id) - 1] == '-')
        return fm_fail(err, FM_INVALID, "id: '%s': needs lower-case letters, digits and hyphens",
                       id == NULL ? "" : id);
    if (strlen(id) >= room)
        return fm_fail(err, FM_INVALID, "id: '%s': %zu letters at most", id, room - 1);
    if (strcmp(id, "common") == 0)
        return fm_fail(err, FM_INVALID, "id: 'common' is the folder of the runner's GLSL");
    return FM_OK;
}

static fm_status check_text(const char *text, const char *field, fm_error *err)
{
    if (text == NULL || *text == '\0')
        return fm_fail(err, FM_INVALID, "%s: missing", field);
    if (!text_is_utf8(text))
        return fm_fail(err, FM_INVALID, "%s: not UTF-8", field);
    return FM_OK;
}

static fm_status check_bits(uint32_t bits, uint32_t all, const char *field, fm_error *err)
{
    if ((bits & ~all) != 0)
        return fm_fail(err, FM_INVALID, "%s: unknown bits 0x%" PRIX32, field, bits & ~all);
    return FM_OK;
}

static fm_status check_head(const fm_method_desc *m, fm_error *err)
{
    fm_status status = check_id(m->id, err);
    if (status == FM_OK)
        status = check_text(m->title, "title", err);
    if (status == FM_OK)
        status = check_text(m->citation, "citation", err);
    if (status == FM_OK)
        status = check_text(m->version, "version", err);
    if (status == FM_OK)
        status = check_bits(m->traits, FM_TRAITS_ALL, "traits", err);
    if (status == FM_OK)
        status = check_bits(m->features, FM_FEATURES_ALL, "features", err);
    if (status == FM_OK)
        status = check_bits(m->features_optional, FM_FEATURES_ALL, "features_optional", err);
    if (status == FM_OK)
        status = check_bits(m->feeds, FM_FEEDS_ALL, "feeds", err);
    if (status == FM_OK && (m->feeds & FM_FEED_TRIANGLES) != 0 && m->feeds != FM_FEED_TRIANGLES)
        status = fm_fail(err, FM_INVALID, "feeds: FM_FEED_TRIANGLES stands alone");
    if (status == FM_OK)
        status = check_range(m->keeps, FM_KEEPS_COUNT, "keeps", err);
    if (status == FM_OK)
        status = check_range(m->family, FM_FAMILY_COUNT, "family", err);
    if (status == FM_OK)
        status = check_range(m->marker, FM_MARKER_COUNT, "marker", err);
    if (status == FM_OK && (m->traits & FM_TRAIT_EXACT) && (m->traits & FM_TRAIT_APPROXIMATE))
        status = fm_fail(err, FM_INVALID, "traits: exact and approximate exclude each other");
    if (status == FM_OK && (m->traits & FM_TRAIT_EMITS_BACK) && (m->traits & FM_TRAIT_EMITS_EITHER))
        status = fm_fail(err, FM_INVALID, "traits: emits_back and emits_either exclude each other");
    if (status == FM_OK)
        status = check_later_method(m, err);
    return status;
}

static fm_status check_body(const fm_checked_method *check, fm_error *err)
{
    if (check->method->technique != NULL)
        return check_technique(check, err);
    if ((check->method->feeds & FM_FEED_FRAMES) != 0)
        return fm_fail(err, FM_INVALID, "feeds: 'frames' is for methods with a technique");
    fm_status status = check_resources(check, err);
    if (status == FM_OK)
        status = check_multisampled(check, err);
    if (status == FM_OK)
        status = check_totals(check, err);
    if (status == FM_OK)
        status = check_passes(check, err);
    if (status == FM_OK)
        status = check_loops(check, err);
    return status;
}

static fm_status check_all(const fm_method_desc *method, fm_error *err)
{
    fm_checked_method check = {
        .method = method,
        .options = { .what = "option", .list = "options" },
        .resources = { .what = "resource", .list = "resources", .may_repeat = true },
        .totals = { .what = "total", .list = "totals" },
        .passes = { .what = "pass", .list = "passes" }
    };
    if (method->abi != FM_ABI)
        return fm_fail(err, FM_INVALID,
                       "abi: the plugin has %" PRIu32 ", which is %s than this program's %u: %s",
                       method->abi, method->abi < FM_ABI ? "older" : "newer", FM_ABI,
                       method->abi < FM_ABI ? "build it again; CHANGELOG.md says what changed"
                                            : "build it with this program's headers, or use a "
                                              "newer fragmark");
    if (method->size_bytes != sizeof *method)
        return fm_fail(err, FM_INVALID,
                       "size_bytes: the plugin has %" PRIu32 ", this program takes %zu",
                       method->size_bytes, sizeof *method);
    fm_status status = check_head(method, err);
    if (status == FM_OK)
        status = take_lists(&check, err);
    if (status == FM_OK)
        status = check_options(&check, err);
    return status == FM_OK ? check_body(&check, err) : status;
}

fm_status plugin_check(const fm_method_desc *method, const char *name, fm_error *err)
{
    fm_error ignored;
    if (err == NULL)
        err = &ignored;
    const fm_status status = check_all(method, err);
    return status == FM_OK ? FM_OK : fm_error_prefix(err, "%s", name);
}
