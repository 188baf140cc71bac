/* What this machine can see: how much pairs of one and the same build differ. */
#ifndef FM_AB_NOISE_H
#define FM_AB_NOISE_H

#include "base/path.h"
#include "judge.h"
#include "parent/machine.h"

/* One statistic of A/A pairs. */
typedef struct ab_noise_statistic {
    double deviation;      /* standard deviation of the logarithms of ratios */
    double standard_error; /* of the median of `planned` pairs; 0: not known */
    uint32_t gates;        /* sets of `planned` pairs, one after the other */
    uint32_t alarms;       /* of them: those that a first look would call worse or better */
} ab_noise_statistic;

/* What was calibrated on one device. */
typedef struct ab_noise {
    char device_name[128];
    char measured[256];                                /* the case */
    uint32_t pairs;                                    /* that it rests on */
    uint32_t planned;                                  /* pairs of a first look */
    ab_noise_statistic statistics[AB_STATISTIC_COUNT]; /* {0}: not measured */
} ab_noise;

typedef struct ab_noise_list {
    ab_noise *items; /* [count], one a device; owned */
    size_t count;
} ab_noise_list;

/* From differences of A/A pairs, [count], NAN: no such pair. FM_INVALID: fewer than a look has;
 * FM_NO_MEMORY. */
fm_status noise_of_pairs(ab_noise_statistic *noise, const double *differences, size_t count,
                         const ab_policy *policy, fm_error *err);
/* The smallest effect that counts at this many pairs, as a share: 0.031 is 3.1 %. */
double noise_detectable(const ab_noise_statistic *noise, const ab_noise *of, uint32_t pairs,
                        double band);

/* The standard error of the median of `planned` pairs on a device; 0: it was not calibrated. */
double noise_find(const ab_noise_list *list, const char *device_name, ab_statistic statistic,
                  uint32_t planned);
/* Takes the place of what the list has of that device. FM_NO_MEMORY. */
fm_status noise_keep(ab_noise_list *list, const ab_noise *noise, fm_error *err);
void noise_free(ab_noise_list *list);

/* 16 hex digits: processor, cores and memory. Kernel, driver and governor are not among them. */
void noise_fingerprint(char digits[17], const fm_machine *machine);
/* Where the calibration of this machine lies: $XDG_STATE_HOME/fragmark/calibration/FINGERPRINT.json
 * (without the variable ~/.local/state). FM_INVALID: neither XDG_STATE_HOME nor HOME is set, or too
 * long a path. */
fm_status noise_path(char path[FM_PATH_MAX_BYTES], const fm_machine *machine, fm_error *err);
/* A file that is not there is an empty list. FM_INVALID, with the file: it is no calibration, or
 * another machine's (nothing of it is taken then); FM_IO, FM_NO_MEMORY. */
fm_status noise_read(ab_noise_list *list, const char *path, const fm_machine *machine,
                     fm_error *err);
/* Writes it, with the folders that are missing. FM_IO, FM_INVALID, FM_NO_MEMORY. */
fm_status noise_write(const char *path, const ab_noise_list *list, const fm_machine *machine,
                      fm_error *err);

#endif
