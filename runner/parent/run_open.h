/* A run whose launches somebody else chooses, one after the other: two runs that take turns, or one
 * that stops where it has seen enough. What is written, who is blamed and what a killed process
 * leaves is as in run.h, whose rounds are made of this. */
#ifndef FM_RUN_OPEN_H
#define FM_RUN_OPEN_H

#include "results/results.h"
#include "run.h"

typedef struct fm_open_run fm_open_run;

/* Takes what an earlier run in the directory left; launches nothing. plan, plugins and desc are
 * borrowed until run_close. *run is to be closed after a failure, too; NULL: no memory. Runs that
 * are open together are closed in reverse order, since each hears the signals that stop us.
 * Statuses as run_cases. */
fm_status run_open(fm_open_run **run, const fm_plan *plan, const fm_plugin_list *plugins,
                   const fm_run_desc *desc, fm_error *err);

/* Launches a case, and first captures its truth where this process has not. Does nothing if that
 * launch is done, the case has ended badly, or a signal has come. launch < plan->launches, in any
 * order; launch 0 is checked against truth. FM_IO, FM_INVALID as run_cases; a method that fails is
 * FM_OK, and its row says so. */
fm_status run_launch(fm_open_run *run, size_t case_index, uint32_t launch, fm_error *err);

/* What was measured so far; lives until run_close. */
const fm_results *run_results(const fm_open_run *run);
/* The signal that asks to stop, heard now or before; 0: none. */
int run_stop_signal(fm_open_run *run);
/* Another run that is open beside it heard this signal: it is stopped, too. 0: none. */
void run_stop(fm_open_run *run, int signal);

/* No further launch is wanted: cases with any are finished, however many the plan has. */
void run_settle(fm_open_run *run);

/* Writes the end of the run, frees it, and returns the status of all: `status` is how it went so
 * far, and err tells of it if it is a failure. NULL is allowed. */
fm_status run_close(fm_run_result *result, fm_open_run *run, fm_status status, fm_error *err);

#endif
