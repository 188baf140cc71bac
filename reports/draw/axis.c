#include "axis.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TICK_VALUES_MAX = 12, BIN_CLEAR_PX = 20 };

/* Less would magnify noise to a trend. */
static const double least_log_span = 0.5; /* decades */
static const double least_linear_share = 0.1;

void axis_label(char label[24], double value)
{
    double size = fabs(value);
    if (size == 0.0 || (size >= 0.001 && size < 1e5)) {
        snprintf(label, 24, "%.6g", value);
        return;
    }
    int exponent = (int)floor(log10(size) + 1e-9);
    snprintf(label, 24, "%.3ge%d", value / pow(10.0, exponent), exponent);
}

static void axis_add_tick(fm_axis *axis, double value, const char *label)
{
    if (axis->tick_count == FM_AXIS_TICKS)
        return;
    fm_tick *tick = &axis->ticks[axis->tick_count++];
    tick->value = value;
    if (label != NULL)
        snprintf(tick->label, sizeof tick->label, "%s", label);
    else
        axis_label(tick->label, value);
}

/* Digits of a decade that get a tick, so that 4 to 10 ticks fill the span. */
static size_t log_digits(double digits[9], double span_decades)
{
    static const double few[] = { 1 }, some[] = { 1, 2, 5 }, many[] = { 1, 1.5, 2, 3, 4, 5, 6, 8 };
    if (span_decades <= 1.0) {
        memcpy(digits, many, sizeof many);
        return sizeof many / sizeof many[0];
    }
    if (span_decades <= 3.0) {
        memcpy(digits, some, sizeof some);
        return sizeof some / sizeof some[0];
    }
    memcpy(digits, few, sizeof few);
    return 1;
}

/* Its label would touch the bin's. */
static bool is_near_bin(const fm_axis *axis, double value)
{
    return axis->zero_below > 0.0 && axis_position(axis, value) < FM_AXIS_BIN_PX + BIN_CLEAR_PX;
}

static void axis_log_ticks(fm_axis *axis)
{
    double digits[9];
    int first = (int)floor(log10(axis->low)), last = (int)ceil(log10(axis->high));
    double span = log10(axis->high / axis->low);
    size_t digit_count = log_digits(digits, span);
    int stride = (int)ceil(span / 8.0);
    for (int decade = first; decade <= last; decade += stride)
        for (size_t i = 0; i < digit_count; i++) {
            double value = digits[i] * pow(10.0, decade);
            if (value >= axis->low * (1 - 1e-9) && value <= axis->high * (1 + 1e-9) &&
                !is_near_bin(axis, value))
                axis_add_tick(axis, value, NULL);
        }
}

static void axis_fit_log(fm_axis *axis, const double *values, size_t count)
{
    double low = INFINITY, high = 0.0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i]) && values[i] > axis->zero_below && values[i] > 0.0) {
            low = fmin(low, values[i]);
            high = fmax(high, values[i]);
        }
    if (high == 0.0) {
        low = 0.1;
        high = 10.0;
    }
    double span = log10(high / low);
    double pad = span < least_log_span ? (least_log_span - span) / 2 + 0.1 : 0.08 * span;
    axis->low = low * pow(10.0, -pad);
    axis->high = high * pow(10.0, pad);
    if (axis->zero_below > 0.0)
        axis_add_tick(axis, 0.0, "exact");
    axis_log_ticks(axis);
}

/* Between ticks, so that there are about six. */
static double linear_step(double span)
{
    const double raw = span / 6.0, decade = pow(10.0, floor(log10(raw)));
    return decade * (raw <= decade ? 1 : raw <= 2 * decade ? 2 : raw <= 5 * decade ? 5 : 10);
}

static void add_linear_ticks(fm_axis *axis, double step)
{
    const long first = lround(ceil(axis->low / step - 1e-9));
    const long last = lround(floor(axis->high / step + 1e-9));
    for (long i = first; i <= last; i++)
        axis_add_tick(axis, (double)i * step, NULL);
}

static void axis_fit_linear(fm_axis *axis, const double *values, size_t count)
{
    double low = 0.0, high = 0.0;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i])) {
            low = fmin(low, values[i]);
            high = fmax(high, values[i]);
        }
    if (high == low)
        high = low + 1.0;
    const double step = linear_step(high - low);
    axis->low = low < 0.0 ? step * floor(low / step) : 0.0;
    axis->high = high + 0.05 * (high - low);
    add_linear_ticks(axis, step);
}

void axis_fit_near(fm_axis *axis, const double *values, size_t count)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t i = 0; i < count; i++)
        if (isfinite(values[i])) {
            low = fmin(low, values[i]);
            high = fmax(high, values[i]);
        }
    if (high < low)
        low = high = 0.0;
    const double greatest = fmax(fabs(low), fabs(high));
    const double least_span = greatest > 0.0 ? least_linear_share * greatest : 1.0;
    const double pad = fmax(0.1 * (high - low), (least_span - (high - low)) / 2);
    axis->scale = FM_SCALE_LINEAR;
    axis->tick_count = 0;
    axis->low = low - pad;
    axis->high = high + pad;
    add_linear_ticks(axis, linear_step(axis->high - axis->low));
}

void axis_fit(fm_axis *axis, const double *values, size_t count)
{
    axis->tick_count = 0;
    if (axis->scale == FM_SCALE_LOG)
        axis_fit_log(axis, values, count);
    else
        axis_fit_linear(axis, values, count);
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

void axis_tick_values(fm_axis *axis, const double *values, size_t count)
{
    double distinct[TICK_VALUES_MAX];
    size_t found = 0;
    for (size_t i = 0; i < count; i++) {
        bool known = !isfinite(values[i]);
        for (size_t j = 0; j < found && !known; j++)
            known = distinct[j] == values[i];
        if (known)
            continue;
        if (found == TICK_VALUES_MAX)
            return;
        distinct[found++] = values[i];
    }
    if (found == 0)
        return;
    qsort(distinct, found, sizeof distinct[0], compare_doubles);
    axis->tick_count = 0;
    for (size_t i = 0; i < found; i++)
        axis_add_tick(axis, distinct[i], NULL);
}

double axis_position(const fm_axis *axis, double value)
{
    double start_px = 0.0, share;
    if (axis->scale == FM_SCALE_LOG) {
        if (axis->zero_below > 0.0) {
            if (!(value > axis->zero_below))
                return FM_AXIS_BIN_PX / 2.0;
            start_px = FM_AXIS_BIN_PX;
        }
        if (!(value > axis->low))
            return start_px;
        share = log(value / axis->low) / log(axis->high / axis->low);
    } else {
        share = (value - axis->low) / (axis->high - axis->low);
    }
    share = share < 0.0 ? 0.0 : share > 1.0 ? 1.0 : share;
    return start_px + share * (axis->length_px - start_px);
}
