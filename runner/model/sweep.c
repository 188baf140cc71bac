#include "sweep.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* One "LOW:HIGH:*FACTOR" or "LOW:HIGH:+STEP", cut into its parts. */
typedef struct range {
    const char *text; /* the whole, for messages */
    const char *low, *high, *step;
    bool is_factor;
} range;

fm_status sweep_create(fm_sweep *sweep, const char *name, const char *origin, fm_error *err)
{
    *sweep = (fm_sweep){ 0 };
    if (strlen(name) >= sizeof sweep->name || name[0] == '\0')
        return fm_fail(err, FM_INVALID, "%s: '%.200s' is no key and no option", origin, name);
    strcpy(sweep->name, name);
    sweep->key = key_find(name);
    sweep->origin = strdup(origin);
    return sweep->origin != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "%s: no memory", origin);
}

void sweep_destroy(fm_sweep *sweep)
{
    free(sweep->origin);
    text_list_free(&sweep->values);
    *sweep = (fm_sweep){ 0 };
}

static fm_status add_value(fm_sweep *sweep, const char *text, fm_error *err)
{
    char canonical[FM_PATH_MAX_BYTES];
    if (sweep->key != NULL) {
        fm_settings scratch = { 0 };
        if (settings_set(&scratch, sweep->key, text, err) != FM_OK)
            return fm_error_prefix(err, "%s", sweep->origin);
        settings_text(canonical, &scratch, sweep->key);
        text = canonical;
    }
    if (text_list_has(&sweep->values, text))
        return FM_OK;
    if (sweep->values.count >= FM_SWEEP_MAX_VALUES)
        return fm_fail(err, FM_INVALID, "%s: more than %d values", sweep->origin,
                       FM_SWEEP_MAX_VALUES);
    if (!text_list_add(&sweep->values, text))
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for its values", sweep->origin);
    return FM_OK;
}

static fm_status bad_range(const fm_sweep *sweep, const range *span, const char *why, fm_error *err)
{
    return fm_fail(err, FM_INVALID,
                   "%s: range '%.100s': %s; write LOW:HIGH:*FACTOR or LOW:HIGH:+STEP",
                   sweep->origin, span->text, why);
}

static fm_status add_whole_range(fm_sweep *sweep, const range *span, const uint64_t parts[3],
                                 fm_error *err)
{
    const uint64_t low = parts[0], high = parts[1], step = parts[2];
    if (low > high)
        return bad_range(sweep, span, "LOW is above HIGH", err);
    if (span->is_factor ? step < 2 || low == 0 : step == 0)
        return bad_range(sweep, span, "it would never end", err);
    for (uint64_t value = low;;) {
        char text[32];
        snprintf(text, sizeof text, "%llu", (unsigned long long)value);
        const fm_status status = add_value(sweep, text, err);
        if (status != FM_OK)
            return status;
        if (span->is_factor ? value > high / step : value > high - step || step > high)
            return FM_OK;
        value = span->is_factor ? value * step : value + step;
    }
}

static fm_status add_real_range(fm_sweep *sweep, const range *span, const double parts[3],
                                fm_error *err)
{
    const double low = parts[0], high = parts[1], step = parts[2];
    /* Room for rounding: 0.1:0.3:+0.1 ends with 0.3. */
    const double end = span->is_factor ? high * (1 + 1e-9) : high + step * 1e-9;
    if (low > high)
        return bad_range(sweep, span, "LOW is above HIGH", err);
    if (span->is_factor ? step <= 1 || low <= 0 : step <= 0)
        return bad_range(sweep, span, "it would never end", err);
    double value = low;
    for (uint32_t i = 1; value <= end; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.12g", value);
        const fm_status status = add_value(sweep, text, err);
        if (status != FM_OK)
            return status;
        if (i > FM_SWEEP_MAX_VALUES)
            return bad_range(sweep, span, "the step is too small", err);
        value = span->is_factor ? value * step : low + i * step;
    }
    return FM_OK;
}

static fm_status add_range(fm_sweep *sweep, const range *span, fm_error *err)
{
    const char *const texts[3] = { span->low, span->high, span->step };
    uint64_t whole[3];
    double real[3];
    bool is_whole = true;
    for (size_t i = 0; i < 3; i++) {
        is_whole = text_to_u64(&whole[i], texts[i]) && is_whole;
        if (!text_to_double(&real[i], texts[i]))
            return bad_range(sweep, span, "not three numbers", err);
    }
    return is_whole ? add_whole_range(sweep, span, whole, err)
                    : add_real_range(sweep, span, real, err);
}

static fm_status add_item(fm_sweep *sweep, const char *item, fm_error *err)
{
    char copy[FM_TEXT_MAX];
    const bool takes_ranges = sweep->key == NULL || sweep->key->type == FM_KEY_UINT ||
                              sweep->key->type == FM_KEY_UINT64 || sweep->key->type == FM_KEY_REAL;
    if (!takes_ranges || strchr(item, ':') == NULL)
        return add_value(sweep, item, err);
    if (strlen(item) >= sizeof copy)
        return fm_fail(err, FM_INVALID, "%s: a value longer than %zu bytes", sweep->origin,
                       sizeof copy - 1);
    strcpy(copy, item);
    range parts = { .text = item, .low = copy };
    char *high = strchr(copy, ':');
    *high++ = '\0';
    char *step = strchr(high, ':');
    if (step == NULL || (step[1] != '*' && step[1] != '+'))
        return bad_range(sweep, &parts, "no step", err);
    *step++ = '\0';
    parts.high = high;
    parts.is_factor = *step == '*';
    parts.step = step + 1;
    return add_range(sweep, &parts, err);
}

fm_status sweep_add(fm_sweep *sweep, const char *text, fm_error *err)
{
    fm_status status = FM_OK;
    if (sweep->key != NULL && sweep->key->type == FM_KEY_TEXT &&
        sweep->key->scope == FM_SCOPE_SCENE) /* a path: commas are its own */
        return add_value(sweep, text, err);
    char *copy = strdup(text), *rest = copy;
    if (copy == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", sweep->origin);
    for (char *item; status == FM_OK && (item = strsep(&rest, ",")) != NULL;) {
        if (*item == '\0')
            status = fm_fail(err, FM_INVALID, "%s: an empty value", sweep->origin);
        else
            status = add_item(sweep, item, err);
    }
    free(copy);
    return status;
}
