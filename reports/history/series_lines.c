#include <math.h>

#include "series.h"

void alarm_add_words(fm_text *text, const fm_alarm *alarm)
{
    switch (alarm->verdict) {
    case FM_ALARM_STEP:
        text_add(text, "ALARM: the last %zu nights are %.1f %% slower than the %zu before",
                 alarm->recent, 100.0 * (alarm->factor - 1.0), alarm->before);
        break;
    case FM_ALARM_NONE:
        text_add(text, "no alarm: the last %zu nights are %+.1f %% from the %zu before",
                 alarm->recent, 100.0 * (alarm->factor - 1.0), alarm->before);
        break;
    case FM_ALARM_EARLY:
        text_add(text, "no alarm yet: %zu nights before this one, %zu with it are needed",
                 alarm->before, alarm->needed);
        break;
    case FM_ALARM_UNMEASURED:
        text_add(text, "no alarm: the last night has no ratio");
        break;
    }
    if (alarm->verdict == FM_ALARM_STEP || alarm->verdict == FM_ALARM_NONE)
        text_add(text, " (p %.2g; %.2g is this night's share)", alarm->p, alarm->level);
}

static const fm_step *step_at(const fm_series *series, size_t index)
{
    for (size_t i = 0; i < series->step_count; i++)
        if (series->steps[i].index == index)
            return &series->steps[i];
    return NULL;
}

static void add_number(fm_text *text, int width, int digits, double value)
{
    if (isnan(value))
        text_add(text, "  %*s", width, "");
    else
        text_add(text, "  %*.*g", width, digits, value);
}

static void add_night(fm_text *text, const fm_series *series, size_t index)
{
    const fm_series_night *night = &series->nights[index];
    const fm_step *step = step_at(series, index);
    text_add(text, "  %-20s  %-10.10s", night->started, night->git_commit);
    add_number(text, 7, 4, night->centre.ratio);
    add_number(text, 6, 2, 100.0 * night->centre.standard_error);
    add_number(text, 8, 4, night->frame_ms.median);
    text_add(text, "  %4zu  %s", night->centre.launches, night->status);
    if (night->noisy[0] != '\0')
        text_add(text, ", noisy");
    if (step != NULL)
        text_add(text, "  <- from here on %+.1f %%", 100.0 * (exp(step->shift) - 1.0));
    text_add(text, "\n");
}

void history_add_series(fm_text *text, const fm_series_list *list, const char *reference)
{
    for (size_t i = 0; i < list->count; i++) {
        const fm_series *series = &list->items[i];
        text_add(text, "%s%s\n  machine %s, %s; ratio of frame_ms to %s\n", i > 0 ? "\n" : "",
                 series->title, series->machine,
                 series->device_name[0] != '\0' ? series->device_name : "no device",
                 reference != NULL ? reference : "floor");
        text_add(text, "  %-20s  %-10s  %7s  %6s  %8s  %4s  %s\n", "started", "commit", "ratio",
                 "+- %", "frame_ms", "runs", "status");
        for (size_t j = 0; j < series->count; j++)
            add_night(text, series, j);
        text_add(text, "  ");
        alarm_add_words(text, &series->alarm);
        text_add(text, "\n");
    }
}
