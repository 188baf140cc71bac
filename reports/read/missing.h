/* What a folder of results lacks, in sentences for the first lines of its report. */
#ifndef FM_READ_MISSING_H
#define FM_READ_MISSING_H

#include "base/text.h"
#include "result_files.h"

/* Adds a sentence where samples.csv is not there, or has no row of cases that were measured; and
 * where journal.jsonl is damaged: its first line that is none, by its number. A last line without
 * its end is of a run that was killed, or still runs. Of merged shards also those that are missing
 * or not finished, as manifest.json has them. FM_IO: the journal cannot be read; FM_NO_MEMORY. */
fm_status missing_find(fm_text_list *missing, const fm_result_files *results, fm_error *err);

#endif
