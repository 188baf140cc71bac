/* Two stages of a night: measured by `fragmark run`, judged by `fragmark-report night`. */
#ifndef FM_NIGHTLY_STAGES_H
#define FM_NIGHTLY_STAGES_H

#include "tonight.h"

/* Measures until all is measured or the budget is spent. *code is what `fragmark run` ended with;
 * CLI_DONE if the budget cut it off with something measured. night.stage is JUDGES once there is
 * something to judge. FM_IO, FM_NO_MEMORY: the state cannot be written, no process started. */
fm_status stage_measure(int *code, fm_tonight *tonight, fm_error *err);
/* Draws the report, records the run and judges it; *code as `fragmark-report night` says. Then the
 * night is done, or night.stage is CONFIRMS: something is slower, and a gate is to be asked. */
fm_status stage_judge(int *code, fm_tonight *tonight, fm_error *err);

#endif
