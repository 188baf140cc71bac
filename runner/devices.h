/* The devices that are built into this program: the only place that names them all. To add one,
 * write its folder and put its table here. main.c hands the list down to subcommands and workers;
 * tests take the same one. */
#ifndef FM_DEVICES_H
#define FM_DEVICES_H

#include "device/registry.h"

/* In the order in which `list devices` shows them. "osmesa" is missing from builds without
 * FM_OSMESA. */
extern const fm_device_list program_devices;

#endif
