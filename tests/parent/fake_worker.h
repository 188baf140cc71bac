/* A shell script in a worker's place, and runs with it. After cmocka.h. */
#ifndef FM_TESTS_FAKE_WORKER_H
#define FM_TESTS_FAKE_WORKER_H

#include <sys/stat.h>

#include "kit/fake_plan.h"
#include "parent/run.h"

/* $2 is the request, $3 the result. Each launch leaves a line in calls; a truth job its file. What
 * a method does is told by its name, what its frames take by a line "METHOD LAUNCH MS" in times, if
 * there is one. */
static const char fake_worker_script[] =
    "#!/bin/sh\n"
    "here=$(dirname \"$0\")\n"
    "good='{\"status\":\"ok\",\"message\":\"\",\"image_hashes\":[\"00000000000000aa\"],'\n"
    "good=$good'\"device_name\":\"fake\",\"metrics\":{\"rmse\":0.0,\"n\":4,\"tied_pixels\":0},"
    "\"samples\":['\n"
    "good=$good'{\"frame\":0,\"metric\":\"frame_ms\",\"value\":2.0,\"unit\":\"ms\"},'\n"
    "good=$good'{\"frame\":1,\"metric\":\"frame_ms\",\"value\":4.0,\"unit\":\"ms\"}]}'\n"
    "method=$(sed -n 's,.*\"plugin\": \"/fake/\\(.*\\).so\".*,\\1,p' \"$2\")\n"
    "launch=$(sed -n 's,.*\"launch\": \\([0-9]*\\).*,\\1,p' \"$2\")\n"
    "mesh=$(sed -n 's,.*\"mesh\": \"\\(.*\\)\".*,\\1,p' \"$2\")\n"
    "[ -z \"$mesh\" ] || good=$(echo \"$good\" |\n"
    "    sed 's|{|{\"mesh\":{\"file\":\"'\"$mesh\"'\",\"told\":\"a cube\"},|')\n"
    "if grep -q '\"job\": \"truth\"' \"$2\"; then\n"
    "    echo truth >>\"$here/calls\"\n"
    "    [ ! -e \"$here/deep-truth\" ] || { echo "
    "'{\"status\":\"not_supported\",\"reason\":\"suite-limit\",\"message\":\"too deep\"}' >\"$3\"\n"
    "        exit 0; }\n"
    "    if [ -e \"$here/no-truth\" ]; then\n"
    "        echo '{\"status\":\"out_of_memory\",\"message\":\"too many fragments\"}' >\"$3\"\n"
    "        exit 0\n"
    "    fi\n"
    "    touch \"$(sed -n 's,.*\"truth\": \"\\(.*\\)\".*,\\1,p' \"$2\")\"\n"
    "    echo \"$good\" >\"$3\"\n"
    "    exit 0\n"
    "fi\n"
    "echo \"$method $launch\" >>\"$here/calls\"\n"
    "ms=$(sed -n \"s,^$method $launch ,,p\" \"$here/times\" 2>/dev/null)\n"
    "[ -z \"$ms\" ] || good=$(echo \"$good\" | sed \"s/[24]\\.0,/$ms,/g\")\n"
    "case $method in\n"
    "crash) echo 'last words' >&2; kill -SEGV $$ ;;\n"
    "flood) head -c 9000000 /dev/zero | tr '\\0' x; printf end; exit 9 ;;\n"
    "garbage) echo 'not JSON' >\"$3\" ;;\n"
    "full) [ -e \"$here/room\" ] && echo \"$good\" >\"$3\" && exit 0\n"
    "    mkdir -p \"$3.partial\"; exit 74 ;;\n"
    "hang) sleep 60 ;;\n"
    "heir) setsid sh -c 'echo $$ >\"$0/pid\"; exec sleep 60' \"$here\" &\n"
    "    while [ ! -s \"$here/pid\" ]; do sleep 0.01; done; echo \"$good\" >\"$3\" ;;\n"
    "killed) [ -e \"$here/spared\" ] || kill -$(cat \"$here/how\") $$; echo \"$good\" >\"$3\" ;;\n"
    "mortal) [ -e \"$here/dead\" ] || { touch \"$here/dead\"; kill -SEGV $$; }\n"
    "    echo \"$good\" >\"$3\" ;;\n"
    "parricide) [ -e \"$here/done\" ] || kill -KILL \"$FAKE_PARENT\"; echo \"$good\" >\"$3\" ;;\n"
    "starved) echo '{\"status\":\"wrong_image\",\"is_starved\":true,\"message\":\"lost 3\"}' "
    ">\"$3\" ;;\n"
    "liar) exit 74 ;;\n"
    "lost) [ -e \"$here/room\" ] && echo \"$good\" >\"$3\" && exit 0\n"
    "    echo '{\"status\":\"skipped\",\"is_runs_fault\":true,\"message\":\"disk full\"}' >\"$3\" "
    ";;\n"
    "silent) [ ! -e \"$here/room\" ] && exit 3; echo \"$good\" >\"$3\" ;;\n"
    "status) echo '{\"status\":\"splendid\"}' >\"$3\" ;;\n"
    "stops) [ -e \"$here/stopped\" ] || { touch \"$here/stopped\"; kill -TERM $FAKE_PARENT; sleep "
    "60; }\n"
    "    echo \"$good\" >\"$3\" ;;\n"
    "together) [ -e \"$here/stopped\" ] || { touch \"$here/stopped\"; kill -HUP $$; }\n"
    "    echo \"$good\" >\"$3\" ;;\n"
    "unlike) [ \"$launch\" = 0 ] || good=$(echo \"$good\" | sed s/aa/bb/)\n"
    "    echo \"$good\" >\"$3\" ;;\n"
    "unsupported) echo '{\"status\":\"not_supported\",\"reason\":\"feature\",\"message\":\"no "
    "interlock\"}' >\"$3\" ;;\n"
    "unreasoned) echo '{\"status\":\"not_supported\",\"message\":\"no interlock\"}' >\"$3\" ;;\n"
    "*) echo \"$good\" >\"$3\" ;;\n"
    "esac\n";

static inline void open_with_worker(fake_plan *fake, const char *const *ids, uint32_t launches)
{
    char self[16];
    fake_open(fake, ids, launches);
    snprintf(self, sizeof self, "%d", getpid());
    setenv("FAKE_PARENT", self, 1); /* between it and the worker is a guard */
    fake_write(fake, "worker.sh", fake_worker_script, "w");
    assert_int_equal(chmod(fake->worker, 0755), 0);
}

static inline fm_status run_in(fm_run_result *result, const fake_plan *fake, uint32_t timeout_s,
                               fm_error *err)
{
    char directory[96];
    snprintf(directory, sizeof directory, "%s/out", fake->folder);
    const fm_run_desc desc = { .directory = directory,
                               .command = "fragmark run -o caf\xE9", /* Latin-1 */
                               .timeout_s = timeout_s,
                               .worker = fake->worker };
    return run_cases(result, &fake->plan, &fake->list, &desc, err);
}

static inline fm_run_result run_well(const fake_plan *fake)
{
    fm_run_result result;
    fm_error err = { 0 };
    if (run_in(&result, fake, 20, &err) != FM_OK)
        fail_msg("%s", err.message);
    return result;
}

static inline void assert_in_file(const fake_plan *fake, const char *name, const char *words)
{
    char *text = fake_read(fake, name);
    assert_non_null(text);
    if (strstr(text, words) == NULL)
        fail_msg("'%s' is not in %s:\n%s", words, name, text);
    free(text);
}

static inline size_t count_in_file(const fake_plan *fake, const char *name, const char *words)
{
    size_t count = 0;
    char *text = fake_read(fake, name);
    for (const char *at = text; at != NULL && (at = strstr(at, words)) != NULL; at++)
        count++;
    free(text);
    return count;
}

#endif
