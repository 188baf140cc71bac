/* What methods see of a reversed depth: in order, kept apart, and no denormal. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "scene/hand_on.h"

enum { ONE = 0x3F800000, LEAST_NORMAL = 0x00800000 };

static float float_of(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint32_t seen(float depth)
{
    const float handed = hand_on(FM_DEPTH_REVERSED, depth);
    uint32_t bits;
    memcpy(&bits, &handed, sizeof bits);
    return bits;
}

static void a_normal_depth_stays_to_the_bit(void **state)
{
    (void)state;
    const float denormal = float_of(1), handed = hand_on(FM_DEPTH_NORMAL, denormal);
    assert_memory_equal(&handed, &denormal, sizeof denormal);
}

static void the_ends_change_places(void **state)
{
    (void)state;
    assert_int_equal(seen(1.0f), 0);
    assert_int_equal(seen(0.0f), ONE);
    assert_int_equal(seen(-0.0f), ONE);
    assert_int_equal(seen(float_of(LEAST_NORMAL - 1)), ONE); /* as flushed */
}

/* Each step of a normal depth is a step of one float the other way: nothing is lost, and the order
 * turns. Every 1009th float, and both sides of each end. */
static void each_float_has_a_normal_float_of_its_own(void **state)
{
    (void)state;
    for (uint32_t bits = LEAST_NORMAL; bits < ONE - 1; bits += 1009) {
        const uint32_t far = seen(float_of(bits)), near = seen(float_of(bits + 1));
        assert_int_equal(far, near + 1);
        assert_true(near >= LEAST_NORMAL && far < ONE);
    }
    assert_int_equal(seen(float_of(ONE - 1)), LEAST_NORMAL);
    assert_int_equal(seen(float_of(LEAST_NORMAL)), ONE - 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_normal_depth_stays_to_the_bit),
        cmocka_unit_test(the_ends_change_places),
        cmocka_unit_test(each_float_has_a_normal_float_of_its_own),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
