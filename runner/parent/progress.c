#include "progress.h"

#include <math.h>

#include "base/clock.h"

static const double plain_interval_s = 10.0;

void duration_text(char text[32], double seconds)
{
    const long all = lround(fmin(fmax(seconds, 0.0), 3.6e8));
    if (all >= 3600)
        snprintf(text, 32, "%ld h %02ld min", all / 3600, all / 60 % 60);
    else if (all >= 60)
        snprintf(text, 32, "%ld min %02ld s", all / 60, all % 60);
    else
        snprintf(text, 32, "%ld s", all);
}

/* By the mean: launches come in random order, and few long ones make up most of the time. */
static double seconds_left(const fm_progress *progress)
{
    return progress->finished_s / progress->finished * (progress->total - progress->done);
}

static void write_state(fm_progress *progress, double now)
{
    char elapsed[32], left[32] = "";
    duration_text(elapsed, now - progress->started_s);
    if (progress->finished > 0)
        duration_text(left, seconds_left(progress));
    if (progress->is_terminal) /* over the last one, and cut off at the border, not wrapped */
        fputs("\r\033[K\033[?7l", progress->out);
    fprintf(progress->out, "%u/%u  %s%s%s%s  %s", progress->done, progress->total, elapsed,
            left[0] != '\0' ? ", about " : "", left, left[0] != '\0' ? " left" : "",
            progress->current);
    fputs(progress->is_terminal ? "\033[?7h" : "\n", progress->out);
    fflush(progress->out);
    progress->written_s = now;
}

void progress_tick(fm_progress *progress)
{
    const double now = clock_s();
    if (progress->out != NULL && progress->started_s > 0.0 &&
        (progress->is_terminal || now - progress->written_s >= plain_interval_s))
        write_state(progress, now);
}

void progress_tell(fm_progress *progress, const char *subject, const char *sentence)
{
    if (progress->out == NULL)
        return;
    fprintf(progress->out, "%s%s: %s\n", progress->is_terminal ? "\r\033[K" : "", subject,
            sentence);
    if (progress->started_s > 0.0)
        progress_tick(progress);
}

void progress_tell_always(fm_progress *progress, const char *subject, const char *sentence)
{
    if (progress->out == NULL && progress->always != NULL)
        fprintf(progress->always, "%s: %s\n", subject, sentence);
    progress_tell(progress, subject, sentence);
}

void progress_begin(fm_progress *progress, const char *current)
{
    snprintf(progress->current, sizeof progress->current, "%s", current);
    if (progress->started_s <= 0.0)
        progress->started_s = clock_s();
    progress_tick(progress);
}

void progress_end(fm_progress *progress, double seconds)
{
    progress->finished_s += seconds;
    progress->finished++;
    progress_skip(progress);
}

void progress_skip(fm_progress *progress)
{
    progress->done++;
    if (progress->done == progress->total)
        progress->written_s = 0.0; /* the last one is always told */
    progress_tick(progress);
}

void progress_close(fm_progress *progress)
{
    if (progress->out != NULL && progress->is_terminal && progress->started_s > 0.0)
        fputc('\n', progress->out);
}
