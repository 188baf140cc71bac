/* Findings on time, held against what `fragmark gate` said of their cases. */
#ifndef FM_NIGHT_GATE_H
#define FM_NIGHT_GATE_H

#include "base/table.h"
#include "night.h"

typedef struct fm_gate_answers {
    fm_table *table;                         /* ab.csv: a row a case */
    size_t case_id, verdict, why, time, cpu; /* columns */
} fm_gate_answers;

/* Reads the ab.csv of a gate that came to its end; NEW's cases are the night's. FM_IO: it cannot be
 * read; FM_INVALID: it is none. The caller closes, after a failure too. */
fm_status gate_answers_open(fm_gate_answers *answers, const char *path, fm_error *err);
void gate_answers_close(fm_gate_answers *answers);

/* context: fm_gate_answers. `worse` confirms a finding; any other verdict dismisses it, and the
 * text says which. A case that the gate does not have, or could not measure, stands unconfirmed. */
fm_night_confirm gate_confirm;

#endif
