/* For tests of plugin_check: a descriptor is refused, in these words. */
#ifndef FM_TESTS_CHECK_KIT_H
#define FM_TESTS_CHECK_KIT_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "plugin/plugin.h"

/* The plugin is called x.so. */
static inline void assert_check_fails(const fm_method_desc *method, const char *message)
{
    fm_error err = { 0 };
    assert_int_equal(plugin_check(method, "x.so", &err), FM_INVALID);
    if (strncmp(err.message, "x.so: ", 6) != 0 || strstr(err.message, message) == NULL)
        fail_msg("'%s' is not in: %s", message, err.message);
}

#endif
