/* How far a night came, and what the next one learns of it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "nightly/state.h"

static const char night_name[] = "20260131T010000Z";

/* A folder of nights, with one in it. */
typedef struct kit_night {
    char root[64];
    fm_night_state state;
} kit_night;

/* A night that was done in 60 seconds, of 100 launches of four cases. */
static void begin(kit_night *kit)
{
    *kit = (kit_night){ .root = "/tmp/fragmark-nights-XXXXXX" };
    assert_non_null(mkdtemp(kit->root));
    kit->state = (fm_night_state){ .stage = FM_NIGHT_DONE,
                                   .policy = "0123456789abcdef",
                                   .begun_s = 1,
                                   .launches = 100,
                                   .cases = 4,
                                   .parts = 1,
                                   .measured_s = 60.0 };
    snprintf(kit->state.folder, sizeof kit->state.folder, "%s/%s", kit->root, night_name);
}

/* launches: that ended, one after the other of each case. */
static void write_night(const kit_night *kit, unsigned launches)
{
    char path[FM_PATH_MAX_BYTES];
    assert_int_equal(path_join(path, kit->state.folder, "run", NULL), FM_OK);
    assert_int_equal(path_make_folders(path, NULL), FM_OK);
    assert_int_equal(night_state_write(&kit->state, NULL), FM_OK);
    assert_int_equal(path_join(path, kit->state.folder, "run/journal.jsonl", NULL), FM_OK);
    FILE *journal = fopen(path, "w");
    assert_non_null(journal);
    fputs("{\"event\":\"plan\",\"plan\":\"0\",\"run_id\":\"r\"}\n", journal);
    for (unsigned i = 0; i < launches; i++) {
        fprintf(journal, "{\"event\":\"begin\",\"case\":\"c%u\",\"launch\":%u}\n", i % 4, i / 4);
        fprintf(journal,
                "{\"event\":\"end\",\"case\":\"c%u\",\"launch\":%u,\"result\":"
                "{\"message\":\"\\\"event\\\":\\\"end\\\"\"}}\n",
                i % 4, i / 4);
    }
    fputs("{\"event\":\"begin\",\"case\":\"c0\",\"launch\":99}\n", journal);
    assert_int_equal(fclose(journal), 0);
}

static fm_night_past past_of(const kit_night *kit)
{
    fm_night_past past;
    assert_int_equal(night_past(&past, kit->root, kit->state.policy, NULL), FM_OK);
    assert_int_equal(past.nights, 1);
    return past;
}

static void end(kit_night *kit)
{
    char command[128];
    snprintf(command, sizeof command, "rm -r '%s'", kit->root);
    assert_int_equal(system(command), 0);
}

static void a_round_of_a_whole_night_costs_its_share(void **state)
{
    kit_night kit;
    (void)state;
    begin(&kit);
    write_night(&kit, 400);
    assert_true(fabs(past_of(&kit).seconds_per_round - 0.6) < 1e-12);
    end(&kit);
}

/* Of the hundred rounds that were planned the time was enough for ten, or for a half. */
static void a_round_of_a_night_that_was_cut_off_costs_what_was_measured(void **state)
{
    kit_night kit;
    (void)state;
    begin(&kit);
    kit.state.is_cut_off = true;
    write_night(&kit, 40);
    assert_int_equal(night_launches_ended(&kit.state), 40);
    assert_true(fabs(past_of(&kit).seconds_per_round - 6.0) < 1e-12);
    write_night(&kit, 2);
    assert_true(fabs(past_of(&kit).seconds_per_round - 120.0) < 1e-12);
    end(&kit);
}

/* Then the plan's guess is better: nightly.json of an older version, or a run that is gone. */
static void a_round_of_unknown_length_is_not_guessed(void **state)
{
    kit_night kit;
    (void)state;
    begin(&kit);
    kit.state.is_cut_off = true;
    kit.state.cases = 0;
    write_night(&kit, 40);
    assert_true(past_of(&kit).seconds_per_round == 0.0);
    kit.state.cases = 4;
    write_night(&kit, 0);
    assert_true(past_of(&kit).seconds_per_round == 0.0);
    end(&kit);
}

static void what_was_written_is_read(void **state)
{
    kit_night kit;
    fm_night_state read;
    (void)state;
    begin(&kit);
    write_night(&kit, 0);
    assert_int_equal(night_state_read(&read, kit.state.folder, NULL), FM_OK);
    assert_int_equal(read.stage, FM_NIGHT_DONE);
    assert_int_equal(read.launches, 100);
    assert_int_equal(read.cases, 4);
    assert_string_equal(read.policy, kit.state.policy);
    night_state_free(&read);
    end(&kit);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_round_of_a_whole_night_costs_its_share),
        cmocka_unit_test(a_round_of_a_night_that_was_cut_off_costs_what_was_measured),
        cmocka_unit_test(a_round_of_unknown_length_is_not_guessed),
        cmocka_unit_test(what_was_written_is_read),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
