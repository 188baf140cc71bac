/* What a plan has workers look at, with a shell script in a worker's place. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "kit/fake_plan.h"
#include "parent/plan_look.h"

/* What happens is told by the mesh's name; each call leaves a line. */
static const char worker_script[] =
    "#!/bin/sh\n"
    "echo called >>\"$(dirname \"$0\")/calls\"\n"
    "grep -q '\"job\": \"mesh\"' \"$2\" || exit 3\n"
    "mesh=$(sed -n 's,.*\"mesh\": \"\\(.*\\)\".*,\\1,p' \"$2\")\n"
    "case $mesh in\n"
    "*stop*) kill -TERM $FAKE_PARENT; sleep 60 ;;\n"
    "*crash*) kill -ABRT $$ ;;\n"
    "*bad*) echo '{\"status\":\"not_supported\",\"reason\":\"scene\",\"message\":\"'$mesh':7: "
    "no\"}' >\"$3\" ;;\n"
    "*unseen*) echo '{\"status\":\"not_supported\",\"reason\":\"scene\",\"message\":\"eye: too "
    "far\"}' >\"$3\" ;;\n"
    "*) echo '{\"status\":\"ok\",\"message\":\"\",\"mesh\":{\"told\":\"a cube\"}}' >\"$3\" ;;\n"
    "esac\n";

static void each_mesh_is_looked_at_once_and_may_crash(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", "c", "d", "e", "f", NULL };
    static const char *const files[] = { "/m/good.obj",   "/m/crash.3ds", "/m/good.obj",
                                         "/m/unseen.obj", "/m/bad.ply",   NULL };
    fake_plan fake;
    char told[96];
    fm_error err = { 0 };
    fm_mesh_look found = { 0 };
    fake_open(&fake, ids, 1);
    fake_write(&fake, "worker.sh", worker_script, "w");
    assert_int_equal(chmod(fake.worker, 0755), 0);
    for (size_t i = 0; files[i] != NULL; i++) { /* the last case has layers */
        fake.cases[i].settings.generator = FM_GENERATOR_MESH;
        fake.cases[i].settings.mesh = text_shared(files[i]);
    }
    snprintf(told, sizeof told, "%s/told", fake.folder);
    FILE *talk = fopen(told, "w");
    if (mesh_look(&found, talk, &fake.plan, fake.worker, &err) != FM_OK)
        fail_msg("%s", err.message);
    fclose(talk);
    char *text = fake_read(&fake, "told"), *calls = fake_read(&fake, "calls");
    assert_string_equal(text, "/m/good.obj: a cube\n"
                              "not loaded: killed by SIGABRT; its scene reads /m/crash.3ds\n"
                              "/m/unseen.obj: not loaded: eye: too far\n"
                              "not loaded: /m/bad.ply:7: no\n");
    assert_int_equal(found.stop_signal, 0);
    assert_int_equal(text_index_find(&found.unread, "/m/good.obj"), FM_TEXT_INDEX_NONE);
    for (size_t i = 0; files[i] != NULL; i++)
        if (strstr(files[i], "good") == NULL)
            assert_int_equal(text_index_find(&found.unread, files[i]), 0);
    text_index_free(&found.unread);
    assert_string_equal(calls, "called\ncalled\ncalled\ncalled\n");
    free(text);
    free(calls);
    fake_close(&fake);
}

static void signal_ends_the_look_and_is_told(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    char self[16];
    fm_error err = { 0 };
    fm_mesh_look found = { 0 };
    fake_open(&fake, ids, 1);
    fake_write(&fake, "worker.sh", worker_script, "w");
    assert_int_equal(chmod(fake.worker, 0755), 0);
    snprintf(self, sizeof self, "%d", getpid());
    setenv("FAKE_PARENT", self, 1); /* between it and the worker is a guard */
    for (size_t i = 0; ids[i] != NULL; i++) {
        fake.cases[i].settings.generator = FM_GENERATOR_MESH;
        fake.cases[i].settings.mesh = text_shared(i == 0 ? "/m/stop.obj" : "/m/good.obj");
    }
    FILE *talk = fopen("/dev/null", "w");
    if (mesh_look(&found, talk, &fake.plan, fake.worker, &err) != FM_OK)
        fail_msg("%s", err.message);
    fclose(talk);
    char *calls = fake_read(&fake, "calls");
    assert_string_equal(calls, "called\n");
    assert_int_equal(found.stop_signal, SIGTERM);
    free(calls);
    text_index_free(&found.unread);
    fake_close(&fake);
}

/* What the worker answers of the device, or why it has none. */
static void a_device_is_looked_at_by_a_worker(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    static const char script[] =
        "#!/bin/sh\n"
        "case $(cat \"$2\") in\n"
        "*vulkan:7*) echo '{\"status\":\"skipped\",\"is_runs_fault\":true,\"message\":\"no such "
        "device\"}' >\"$3\" ;;\n"
        "*'\"device\"'*) echo '{\"status\":\"ok\",\"message\":\"\",\"device_name\":\"A GPU\","
        "\"is_software\":false,\"image_layers\":2048,\"image_max_bytes\":4096}' >\"$3\" ;;\n"
        "esac\n";
    fake_plan fake;
    fm_auto_device device;
    fm_error err = { .message = "" };
    fake_open(&fake, ids, 1);
    fake_write(&fake, "worker.sh", script, "w");
    assert_int_equal(chmod(fake.worker, 0755), 0);
    if (device_look(&device, fake.worker, "vulkan", &err) != FM_OK)
        fail_msg("%s", err.message);
    assert_false(device.is_software);
    assert_int_equal(device.image_layers, 2048);
    assert_int_equal(device.image_max_bytes, 4096);
    assert_int_equal(device_look(&device, fake.worker, "vulkan:7", &err), FM_IO);
    assert_string_equal(err.message, "no such device");
    fake_close(&fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_device_is_looked_at_by_a_worker),
        cmocka_unit_test(each_mesh_is_looked_at_once_and_may_crash),
        cmocka_unit_test(signal_ends_the_look_and_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
