/* A launch: one process that measures one case and the floor, and answers on a file (protocol.h).
 *
 * This room runs in worker processes only. It opens devices and plugins, runs what may crash or
 * hang, and writes nothing but truth files, images and its answer: results are the parent's. */
#ifndef FM_WORKER_H
#define FM_WORKER_H

#include "device/registry.h"

/* The whole life of a worker process, which opens the request's device among `devices`. Returns its
 * exit status: 0 when the answer was written. */
int worker_main(const char *request_path, const char *answer_path, const fm_device_list *devices);

#endif
