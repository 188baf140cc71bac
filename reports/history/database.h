/* The file of a history: one SQLite database, opened, checked, and brought to this version. */
#ifndef FM_HISTORY_DATABASE_H
#define FM_HISTORY_DATABASE_H

#include "base/error.h"

typedef struct fm_history fm_history;

typedef enum fm_history_use {
    FM_HISTORY_READ, /* it must be there */
    FM_HISTORY_WRITE /* it is made where there is none; its folder must be there */
} fm_history_use;

/* Opens a history. Several processes may read and write one at a time: each change is one
 * transaction, and who comes second waits up to HISTORY_WAIT_MS. An older version's file is changed
 * into this one's, in one transaction.
 *
 * FM_UNSUPPORTED: FM_HISTORY_READ, and there is none. FM_INVALID: no database, a damaged one, one
 * of another program, one of a newer fragmark, or no file but a folder, a device, a pipe; nothing
 * was changed. FM_IO: it cannot be opened or written, or others kept it locked; FM_NO_MEMORY. All
 * functions of the room that take a history return these of it, but FM_UNSUPPORTED. *history is
 * NULL on failure; the caller closes it. path is borrowed. */
fm_status history_open(fm_history **history, const char *path, fm_history_use use, fm_error *err);
void history_close(fm_history *history);

enum { HISTORY_WAIT_MS = 30000 };

/* What user_version is, and application_id: "Fmhi". */
enum { HISTORY_VERSION = 2, HISTORY_APPLICATION = 0x466d6869 };

/* SQL that makes version `version` of the one before it; from 1 on. */
const char *history_migration(int version);

#endif
