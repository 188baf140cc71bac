#include "handshake.h"

#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>

#include "base/data.h"
#include "base/text.h"
#include "describe/description.h"
#include "model/metrics.h"
#include "model/settings.h"
#include "parent/machine.h"
#include "parent/manifest.h"
#include "process/process.h"
#include "worker/protocol.h"

enum { PATIENCE_S = 30, ANSWER_MAX_BYTES = 1 << 20, WHY_BYTES = 512 };

static json_t *keys_json(void)
{
    json_t *keys = json_array();
    for (size_t i = 0; i < fm_key_count; i++)
        json_array_append_new(keys, json_string(fm_keys[i].name));
    return keys;
}

static json_t *metrics_json(void)
{
    json_t *metrics = json_array();
    for (int i = 0; i < FM_METRIC_COUNT; i++)
        json_array_append_new(metrics, json_string(fm_metrics[i].name));
    return metrics;
}

/* What this program answers; NULL: no memory. */
static json_t *own_answer(void)
{
    fm_machine machine;
    machine_describe(&machine);
    return json_pack("{s:s, s:i, s:s, s:s, s:o, s:o, s:o}", "fragmark", FM_VERSION, "protocol",
                     FM_PROTOCOL, "git_commit", manifest_commit(), "compiler", machine.compiler,
                     "descriptions", json_sprintf("%016" PRIx64, description_form()), "keys",
                     keys_json(), "metrics", metrics_json());
}

int handshake_main(const char *out)
{
    json_t *answer = own_answer();
    const int failed = answer == NULL || json_dump_file(answer, out, JSON_COMPACT) != 0;
    json_decref(answer);
    if (failed)
        perror(out);
    return failed ? EXIT_FAILURE : EXIT_SUCCESS;
}

/* NULL: it is no answer. */
static json_t *read_answer(int file)
{
    char *bytes = malloc(ANSWER_MAX_BYTES);
    const ssize_t count = bytes != NULL ? pread(file, bytes, ANSWER_MAX_BYTES, 0) : -1;
    json_t *answer =
        count > 0 ? json_loadb(bytes, (size_t)count, JSON_REJECT_DUPLICATES, NULL) : NULL;
    free(bytes);
    return answer;
}

/* NULL: the program gives none that can be read, with why not. */
static json_t *ask(char why[WHY_BYTES], const char *program)
{
    char out[64];
    const char *const argv[] = { "fragmark", "protocol", out, NULL };
    fm_process_end end;
    fm_error below = { 0 };
    const int file = memfd_create("fragmark-protocol", MFD_CLOEXEC);
    snprintf(out, sizeof out, "/proc/self/fd/%d", file);
    const fm_process_desc desc = {
        .path = program, .argv = argv, .kept_fd = file, .timeout_s = PATIENCE_S
    };
    json_t *answer = NULL;
    if (file < 0)
        snprintf(why, WHY_BYTES, "no memory for what it answers: %s", strerror(errno));
    else if (process_run(&end, NULL, &desc, &below) != FM_OK)
        snprintf(why, WHY_BYTES, "%.400s", below.message);
    else if (end.wait_status != 0 || (answer = read_answer(file)) == NULL)
        snprintf(why, WHY_BYTES, "it does not answer `fragmark protocol`, as programs of before");
    if (file >= 0)
        close(file);
    return answer;
}

/* The first name of a list that the other one lacks; NULL: none. */
static const char *lacking(const json_t *names, const json_t *known)
{
    for (size_t i = 0; i < json_array_size(names); i++) {
        const char *name = json_string_value(json_array_get(names, i));
        bool is_known = false;
        for (size_t j = 0; j < json_array_size(known) && name != NULL && !is_known; j++)
            is_known = json_equal(json_array_get(names, i), json_array_get(known, j));
        if (!is_known)
            return name != NULL ? name : "(no text)";
    }
    return NULL;
}

static const char *text_of(const json_t *answer, const char *field)
{
    const char *text = json_string_value(json_object_get(answer, field));
    return text != NULL ? text : "";
}

/* Why a program that answered is foreign; "": it is not. */
static void compare(char why[WHY_BYTES], const json_t *own, const json_t *other)
{
    const char *key = lacking(json_object_get(own, "keys"), json_object_get(other, "keys"));
    const char *metric =
        lacking(json_object_get(other, "metrics"), json_object_get(own, "metrics"));
    if (strcmp(text_of(own, "fragmark"), text_of(other, "fragmark")) != 0)
        snprintf(why, WHY_BYTES, "it is fragmark %.40s, and not %s", text_of(other, "fragmark"),
                 text_of(own, "fragmark"));
    else if (!json_equal(json_object_get(own, "protocol"), json_object_get(other, "protocol")))
        snprintf(why, WHY_BYTES, "it speaks protocol %lld, and not %d",
                 (long long)json_integer_value(json_object_get(other, "protocol")), FM_PROTOCOL);
    else if (strcmp(text_of(own, "descriptions"), text_of(other, "descriptions")) != 0)
        snprintf(why, WHY_BYTES, "its descriptors of methods have other fields");
    else if (key != NULL)
        snprintf(why, WHY_BYTES, "it does not know the key '%.40s'", key);
    else if (metric != NULL)
        snprintf(why, WHY_BYTES, "it measures '%.40s', which is not known here", metric);
}

static fm_status refuse(const fm_build *build, const char *why, fm_error *err)
{
    char own[FM_PATH_MAX_BYTES];
    if (data_program_folder(own, NULL) != FM_OK)
        own[0] = '\0';
    return fm_fail(err, FM_INVALID,
                   "%s cannot measure for %s/fragmark %s: %s. `--program this` has this program "
                   "measure both sides",
                   build->program, own, FM_VERSION, why);
}

fm_status handshake_ask(bool *is_foreign, fm_build *build, fm_error *err)
{
    char why[WHY_BYTES] = "";
    json_t *own = own_answer();
    *is_foreign = false;
    if (own == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a program's answer");
    json_t *other = ask(why, build->program);
    if (other != NULL)
        compare(why, own, other);
    snprintf(build->commit, sizeof build->commit, "%s", text_of(other, "git_commit"));
    snprintf(build->compiler, sizeof build->compiler, "%s", text_of(other, "compiler"));
    json_decref(other);
    json_decref(own);
    *is_foreign = why[0] != '\0';
    return *is_foreign ? refuse(build, why, err) : FM_OK;
}
