/* How many bytes of a device are in use, and by whom.
 *
 * Every device has one ledger (fm_device.ledger), which starts as zeros. Whoever wants numbers
 * reads its fields; only implementations of devices call the functions below. A size is booked as
 * it was asked for: alignment, padding and the driver's own needs are not in it. A bound buffer of
 * 1001 bytes is 1001 bytes here; an image has width x height x layers x samples texels of
 * format_bytes() each (model/formats.h). */
#ifndef FM_DEVICE_LEDGER_H
#define FM_DEVICE_LEDGER_H

#include <stdint.h>

/* Whose bytes a buffer or an image is. */
typedef enum fm_owner {
    FM_OWNER_RUNNER, /* the default: output image, truth, scene, counters */
    FM_OWNER_METHOD, /* reported as the method's memory: bytes_allocated of summary.csv */
    FM_OWNER_COUNT
} fm_owner;

/* Sums over all buffers and images of a device. */
typedef struct fm_ledger {
    uint64_t bytes[FM_OWNER_COUNT];      /* asked for and not yet given back */
    uint64_t peak_bytes[FM_OWNER_COUNT]; /* the most that `bytes` was at any time since open */
} fm_ledger;

/* Books what a create function has made. */
void ledger_add(fm_ledger *ledger, fm_owner owner, uint64_t bytes);
/* Takes back what ledger_add booked, when it is destroyed: the same owner and number of bytes. */
void ledger_remove(fm_ledger *ledger, fm_owner owner, uint64_t bytes);

#endif
