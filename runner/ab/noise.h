/* What this machine can see: how much pairs of one and the same build differ. */
#ifndef FM_AB_NOISE_H
#define FM_AB_NOISE_H

#include "base/path.h"
#include "judge.h"
#include "parent/machine.h"

/* One statistic of A/A pairs. */
typedef struct ab_noise_statistic {
    double deviation;      /* standard deviation of the logarithms of ratios */
    double standard_error; /* of the estimates of a first look's pairs: judge.h; 0: not measured */
    double detectable_first; /* logarithm of the smallest effect that 94 % of gates find that look
                                at the first look's pairs alone, and confirm it on as many */
    double detectable;       /* the same with all looks of the policy */
    uint32_t gates;          /* sets of pairs of a first look, one after the other */
    uint32_t alarms;         /* of them: those that a first look would call worse or better */
} ab_noise_statistic;

/* What was calibrated on one device. */
typedef struct ab_noise {
    char device_name[128];
    char measured[256]; /* the case */
    uint32_t pairs;     /* that it rests on */
    uint32_t planned;   /* pairs of the first look */
    ab_noise_statistic statistics[AB_STATISTIC_COUNT];
} ab_noise;

typedef struct ab_noise_list {
    ab_noise *items; /* [count], one a device; owned */
    size_t count;
} ab_noise_list;

/* Fills pairs, planned and statistics from differences of A/A pairs, [count] of each statistic;
 * NAN: no such pair; NULL: the statistic is not used. Standard errors and detectable effects are
 * those of sets of pairs that are drawn from them (draws.h). The two are told apart since, of pairs
 * some of which are far off, three standard errors are found in 60 to 90 % of gates. The alarms are
 * those of the pairs as they were measured. Takes a second or two. FM_INVALID: fewer pairs than a
 * first look has; FM_NO_MEMORY. */
fm_status noise_of_pairs(ab_noise *noise, const double *const differences[AB_STATISTIC_COUNT],
                         size_t count, const ab_policy *policy, fm_error *err);

/* The logarithm of the smallest effect that counts on a device, with so many pairs at the first
 * look; 0: it was not calibrated. */
double noise_least(const ab_noise_list *list, const char *device_name, ab_statistic statistic,
                   const ab_policy *policy);
/* Takes the place of what the list has of that device. FM_NO_MEMORY. */
fm_status noise_keep(ab_noise_list *list, const ab_noise *noise, fm_error *err);
/* The same, if it is noisier than that: if the smallest change of processor time that can be
 * detected is larger; of frame time where no processor time was measured. FM_NO_MEMORY. */
fm_status noise_keep_noisiest(ab_noise_list *list, const ab_noise *noise, fm_error *err);
void noise_free(ab_noise_list *list);

/* Where calibrations lie: $XDG_STATE_HOME/fragmark/calibration (without the variable
 * ~/.local/state). FM_INVALID: neither XDG_STATE_HOME nor HOME is set, or too long a path. */
fm_status noise_folder(char folder[FM_PATH_MAX_BYTES], fm_error *err);
/* The file of this machine in the folder: the one that was written last of those whose machine is
 * the same (model/hardware.h), whatever its name; FINGERPRINT.json where there is none, or no
 * folder. FM_INVALID: a file that does not tell its machine, which may be this one, or too long a
 * path; FM_IO, FM_NO_MEMORY. */
fm_status noise_find(char path[FM_PATH_MAX_BYTES], const char *folder, const fm_machine *machine,
                     fm_error *err);
/* A file that is not there is an empty list. FM_INVALID, with the file: it is no calibration, or
 * another machine's (nothing of it is taken then); FM_IO, FM_NO_MEMORY. */
fm_status noise_read(ab_noise_list *list, const char *path, const fm_machine *machine,
                     fm_error *err);
/* Writes it, with the folders that are missing. FM_IO, FM_INVALID, FM_NO_MEMORY. */
fm_status noise_write(const char *path, const ab_noise_list *list, const fm_machine *machine,
                      fm_error *err);

#endif
