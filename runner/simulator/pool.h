/* Threads that wait for work: pool_run calls work(context, i) once for each thread i, the caller's
 * own among them, and returns when all are done. */
#ifndef FM_TBR_POOL_H
#define FM_TBR_POOL_H

#include <stdint.h>

#include "base/error.h"

typedef struct pool pool;
typedef void pool_work(void *context, uint32_t thread);

/* threads: the caller's included, 1 at least. FM_NO_MEMORY: or threads cannot be had. */
fm_status pool_create(pool **made, uint32_t threads, fm_error *err);
void pool_destroy(pool *self);
void pool_run(pool *self, pool_work *work, void *context);

#endif
