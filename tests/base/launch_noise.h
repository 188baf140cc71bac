/* Launches that were measured, and draws from them: what intervals are tried on. */
#ifndef FM_LAUNCH_NOISE_H
#define FM_LAUNCH_NOISE_H

#include <assert.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "base/stats.h"

enum { NOISE_CASES = 3, NOISE_LAUNCHES = 120 };

/* Medians of frame_ms of launches of three methods (layers, n 64, k 8, 214 x 120 pixels, lavapipe):
 * two runs of 60 launches each on a machine of two processors that other programs used too. */
typedef struct launch_noise {
    double frame_ms[NOISE_CASES][NOISE_LAUNCHES];
    double median[NOISE_CASES]; /* of all launches */
} launch_noise;

/* From launch_medians.csv beside this file; the rows of a method follow one another. */
static inline void launch_noise_read(launch_noise *noise)
{
    char path[512], line[128];
    size_t count = 0;
    snprintf(path, sizeof path, "%s/tests/base/launch_medians.csv", getenv("FRAGMARK_SOURCE_DIR"));
    FILE *file = fopen(path, "r");
    assert(file != NULL && fgets(line, sizeof line, file) != NULL); /* the head */
    while (fgets(line, sizeof line, file) != NULL && count < NOISE_CASES * NOISE_LAUNCHES) {
        noise->frame_ms[count / NOISE_LAUNCHES][count % NOISE_LAUNCHES] =
            atof(strrchr(line, ',') + 1);
        count++;
    }
    fclose(file);
    assert(count == NOISE_CASES * NOISE_LAUNCHES);
    for (size_t i = 0; i < NOISE_CASES; i++) {
        double values[NOISE_LAUNCHES];
        memcpy(values, noise->frame_ms[i], sizeof values);
        noise->median[i] = stats_median(values, NOISE_LAUNCHES);
    }
}

/* One launch of a case. */
static inline double launch_noise_draw(const launch_noise *noise, size_t index, uint64_t *state)
{
    return noise->frame_ms[index][random_below(state, NOISE_LAUNCHES)];
}

#endif
