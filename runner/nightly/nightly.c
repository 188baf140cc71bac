#include "nightly.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/state.h"
#include "build.h"
#include "choose.h"
#include "confirm.h"
#include "plan/cost.h"
#include "stages.h"

enum {
    /* Older nights that were not finished stay so: less than a day, for tonight is not last night.
     */
    CONTINUE_S = 16 * 3600,
    NAMES_MOST = 60, /* seconds ahead of now that a folder may be named by */
    LOCK_S = 30      /* in which a run whose nightly was killed has stopped */
};

typedef struct nightly_arguments {
    const char *policy, *output, *state;
    double budget_minutes; /* 0: the policy's */
} nightly_arguments;

enum { KEY_STATE = 256, KEY_BUDGET };

static error_t parse(int key, char *text, struct argp_state *state)
{
    nightly_arguments *given = state->input;
    switch (key) {
    case 'o':
        given->output = text;
        return 0;
    case KEY_STATE:
        given->state = text;
        return 0;
    case KEY_BUDGET:
        if (!text_to_double(&given->budget_minutes, text) || given->budget_minutes <= 0 ||
            given->budget_minutes > 24 * 60)
            argp_error(state, "--budget %s: minutes, above 0 and up to a day", text);
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    case ARGP_KEY_ARG:
        if (given->policy != NULL)
            argp_error(state, "'%s': one policy only", text);
        given->policy = text;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "output", 'o', "DIR", 0,
      "the folder of nights; without it the policy's, or nights in --state", 0 },
    { "state", KEY_STATE, "DIR", 0,
      "where history and baselines are; without it the policy's, $XDG_STATE_HOME/fragmark, or "
      "~/.local/state/fragmark",
      0 },
    { "budget", KEY_BUDGET, "MINUTES", 0, "the time of the night; without it the policy's, or 10",
      0 },
    CLI_HELP_OPTION,
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "[POLICY.yml]",
    .doc = "Measures what fits the time, records it in the history, and says what became worse."
           "\v"
           "Each night has a folder DIR/UTC with the run, its report, summary.md (one page), "
           "junit.xml, history.html and night.json; DIR/latest leads to the last. A night that "
           "was killed goes on when the same command comes within 16 hours, unless its plan is "
           "another.\n\n"
           "A policy, with the defaults; lists are as after --method, --scene, ... of `fragmark "
           "run`:\n\n"
           "  methods: []            # all but controls\n"
           "  scenes: [layers]\n"
           "  devices: [vulkan]\n"
           "  feeds: [raster]\n"
           "  axes: []               # such as [\"k=4,8\", \"n=32\"]\n"
           "  spec: other.yml        # a spec of `fragmark run`; lists stand over it\n"
           "  plugin_dirs: []        # builds of methods, such as [build/methods]\n"
           "  build: []              # executed first, such as [cmake, --build, build]\n"
           "  base: old              # an earlier build: what is slower is held against it\n"
           "  budget_minutes: 10\n"
           "  launches_least: 3      # of each case; below it methods take turns\n"
           "  launches_most: 40\n"
           "  effect_percent: 6      # a step that is to be found in three nights\n"
           "  reference: floor       # or a method, over whose time times are taken\n"
           "  baseline: release-1    # `fragmark baseline set release-1 DIR`\n"
           "  output: nights\n"
           "  state: state\n\n"
           "build is executed without a shell, in the policy's folder, for half of the budget at "
           "most; its output is DIR/UTC/build.log. If it fails the night ends with exit code 3. "
           "With a base (a build, whose own program then measures it, or a folder of methods) "
           "`fragmark gate` measures what was found slower again, in what is left of the budget: "
           "an alarm that it does not confirm is none. Without one such alarms are unconfirmed.\n\n"
           "Without a policy all methods are measured on layers of 214 x 120 pixels, n 32.\n\n"
           "Examples:\n"
           "  fragmark nightly\n"
           "  fragmark nightly policy.yml -o /srv/nights --budget 60\n\n"
           "Exit codes: 0 quiet; 1 alarm: something is slower, takes more memory, is less right, "
           "or fails and did not; 2 usage or policy error; 3 nothing could be built or measured; "
           "4 cases failed in a first night; 5 the world stopped it, or another nightly is at "
           "work: the same command continues; 7 plugins or programs changed while it measured; "
           "8 a damaged history or baseline.",
};

/* Folders of the policy, and what stands over them. */
static fm_status settle(fm_policy *policy, char root[FM_PATH_MAX_BYTES],
                        const nightly_arguments *given, fm_error *err)
{
    fm_status status = FM_OK;
    if (given->budget_minutes > 0)
        policy->budget_minutes = given->budget_minutes;
    if (given->state != NULL &&
        snprintf(policy->state, sizeof policy->state, "%s", given->state) >= FM_PATH_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "--state: too long a path");
    if (strcmp(policy->reference, "floor") == 0)
        policy->reference[0] = '\0';
    const char *output = given->output != NULL ? given->output : policy->output;
    if (output[0] == '\0')
        status =
            state_path(root, policy->state[0] != '\0' ? policy->state : NULL, "nights", true, err);
    else if (snprintf(root, FM_PATH_MAX_BYTES, "%s", output) >= FM_PATH_MAX_BYTES)
        status = fm_fail(err, FM_INVALID, "-o: too long a path");
    return status == FM_OK ? path_make_folders(root, err) : status;
}

/* One nightly in a folder at a time. The lock ends with the process and with the run that it
 * started, which stops by itself when the process is killed. */
static fm_status lock(int *fd, const char *root, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const fm_status status = path_join(path, root, ".lock", err);
    if (status != FM_OK)
        return status;
    *fd = open(path, O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (*fd < 0)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    const double deadline = clock_s() + LOCK_S;
    while (flock(*fd, LOCK_EX | LOCK_NB) != 0) {
        if (clock_s() > deadline)
            return fm_fail(err, FM_IO, "%s: another nightly is at work", root);
        nanosleep(&(struct timespec){ .tv_nsec = 100000000 }, NULL);
    }
    return FM_OK;
}

/* The last night, if it is of this policy, was not finished, and is not too old. */
static fm_status find_unfinished(bool *is_found, fm_tonight *tonight, const char *root,
                                 fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES];
    fm_text_list names = { 0 };
    fm_night_state *night = &tonight->night;
    *is_found = false;
    fm_status status = nights_list(&names, root, err);
    if (status == FM_OK && names.count > 0)
        status = path_join(folder, root, names.items[names.count - 1], err);
    if (status == FM_OK && names.count > 0 && night_state_read(night, folder, NULL) == FM_OK)
        *is_found = night_is_open(night) && strcmp(night->policy, tonight->policy->hash) == 0 &&
                    (int64_t)time(NULL) - night->begun_s < CONTINUE_S;
    if (!*is_found) {
        night_state_free(night);
        *night = (fm_night_state){ 0 };
    }
    tonight->is_continued = *is_found;
    text_list_free(&names);
    return status;
}

static bool copy_arguments(fm_arguments *to, const fm_policy *policy)
{
    return text_list_add_all(&to->methods, &policy->methods) &&
           text_list_add_all(&to->scenes, &policy->scenes) &&
           text_list_add_all(&to->devices, &policy->devices) &&
           text_list_add_all(&to->feeds, &policy->feeds) &&
           text_list_add_all(&to->axes, &policy->axes) &&
           text_list_add_all(&to->plugin_folders, &policy->plugin_folders) &&
           text_list_add(&to->axes, "launches=1");
}

/* A plan of one round says whether the policy can be measured, and how long it may take. */
static fm_status plan_night(fm_tonight *tonight, const char *root, fm_error *err)
{
    char report[FM_PATH_MAX_BYTES]; /* nothing is measured that nobody can judge */
    fm_arguments arguments = { .cli = tonight->cli };
    fm_plan plan = { 0 };
    fm_plugin_list plugins = { 0 };
    fm_night_past past;
    const fm_policy *policy = tonight->policy;
    const char *const specs[] = { policy->spec[0] != '\0' ? policy->spec : NULL, NULL };
    if (!report_find(report))
        return fm_fail(err, FM_UNSUPPORTED, "%s", report_missing());
    fm_status status = copy_arguments(&arguments, policy)
                           ? night_past(&past, root, policy->hash, err)
                           : fm_fail(err, FM_NO_MEMORY, "no memory for a policy");
    if (status == FM_OK)
        status = arguments_plan(&plan, &plugins, &arguments, specs, err);
    if (status == FM_OK)
        status = choose_tonight(&tonight->night, policy, &past, &plan, plan_seconds(&plan), err);
    plan_free(&plan);
    plugin_list_close(&plugins);
    arguments_free(&arguments);
    return status;
}

/* A folder of its own, named by the second, or by the next one that is free. */
static fm_status make_folder(fm_night_state *night, const char *root, time_t now, fm_error *err)
{
    fm_status status = path_make_folders(root, err);
    for (int ahead = 0; ahead < NAMES_MOST && status == FM_OK; ahead++) {
        char name[32];
        struct tm utc;
        const time_t then = now + ahead;
        gmtime_r(&then, &utc);
        strftime(name, sizeof name, "%Y%m%dT%H%M%SZ", &utc);
        status = path_join(night->folder, root, name, err);
        if (status == FM_OK && mkdir(night->folder, 0777) == 0)
            return FM_OK;
        if (status == FM_OK && errno != EEXIST)
            status = fm_fail(err, FM_IO, "%s: %s", night->folder, strerror(errno));
    }
    return status == FM_OK ? fm_fail(err, FM_IO, "%s: no name for a night is free", root) : status;
}

static fm_status begin_night(fm_tonight *tonight, const char *root, fm_error *err)
{
    char command[FM_PATH_MAX_BYTES];
    fm_night_state *night = &tonight->night;
    const bool is_built = tonight->policy->build.count > 0;
    const time_t now = time(NULL);
    *night = (fm_night_state){ .stage = is_built ? FM_NIGHT_BUILDS : FM_NIGHT_MEASURES,
                               .begun_s = (int64_t)now,
                               .launches = tonight->policy->launches_least,
                               .parts = 1 };
    strcpy(night->policy, tonight->policy->hash);
    fm_status status = is_built ? build_find_command(command, tonight->policy, err)
                                : plan_night(tonight, root, err);
    if (status != FM_OK)
        return status;
    status = make_folder(night, root, now, err);
    return status == FM_OK ? night_state_write(night, err) : status;
}

/* ROOT/latest leads to this night; where that cannot be, all else is as good. */
static void link_latest(const fm_tonight *tonight, const char *root)
{
    char link[FM_PATH_MAX_BYTES], fresh[FM_PATH_MAX_BYTES];
    const char *name = strrchr(tonight->night.folder, '/');
    if (name == NULL || path_join(link, root, "latest", NULL) != FM_OK ||
        path_join(fresh, root, ".latest", NULL) != FM_OK)
        return;
    unlink(fresh);
    if (symlink(name + 1, fresh) == 0 && rename(fresh, link) != 0)
        unlink(fresh);
}

static int fail(const fm_tonight *tonight, fm_status status, const fm_error *err)
{
    fprintf(tonight->cli->talk, "fragmark nightly: %s\n", err->message);
    if (status == FM_INVALID)
        return CLI_USAGE;
    return status == FM_UNSUPPORTED ? CLI_NOTHING : CLI_INCOMPLETE;
}

static void tell_plan(const fm_tonight *tonight)
{
    const fm_night_state *night = &tonight->night;
    fprintf(tonight->cli->talk, "%u launches of each case, for %.3g minutes\n", night->launches,
            tonight->policy->budget_minutes);
    if (night->parts > 1)
        fprintf(tonight->cli->talk, "not all methods fit: part %u of %u\n", night->part + 1,
                night->parts);
}

/* The path of this program, if another one lies there now: it was built anew. */
static bool find_newer(char path[FM_PATH_MAX_BYTES])
{
    static const char gone[] = " (deleted)";
    struct stat own, there;
    const ssize_t length = readlink("/proc/self/exe", path, FM_PATH_MAX_BYTES - 1);
    if (length <= 0 || stat("/proc/self/exe", &own) != 0)
        return false;
    path[length] = '\0';
    char *end = path + length - (sizeof gone - 1);
    if (end > path && strcmp(end, gone) == 0)
        *end = '\0';
    return stat(path, &there) == 0 && access(path, X_OK) == 0 &&
           (there.st_ino != own.st_ino || there.st_dev != own.st_dev);
}

/* What was built is to be measured, and that may be this program. The next one finds the night as
 * it is left here. */
static fm_status become_newer(fm_tonight *tonight, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    if (!find_newer(path))
        return FM_OK;
    fprintf(tonight->cli->talk, "this program was built, too: the new one goes on\n");
    fflush(NULL);
    execv(path, (char *const *)(const void *)tonight->argv);
    return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
}

static fm_status build(int *code, fm_tonight *tonight, fm_error *err)
{
    fm_status status = stage_build(tonight, err);
    if (tonight->night.stage == FM_NIGHT_GIVEN_UP)
        *code = CLI_NOTHING;
    else if (status == FM_OK)
        status = become_newer(tonight, err);
    return status;
}

/* Of a night that was built: what cannot be planned is given up, since the next build may be right.
 */
static fm_status plan_built(fm_tonight *tonight, const char *root, fm_error *err)
{
    fm_night_state *night = &tonight->night;
    const fm_status status = plan_night(tonight, root, err);
    night->stage = status == FM_OK ? FM_NIGHT_MEASURES : FM_NIGHT_GIVEN_UP;
    const fm_status written = night_state_write(night, status == FM_OK ? err : NULL);
    if (status == FM_OK && written == FM_OK)
        tell_plan(tonight);
    return status != FM_OK ? status : written;
}

static fm_status measure(int *code, fm_tonight *tonight, fm_error *err)
{
    const fm_status status = stage_measure(code, tonight, err);
    if (status == FM_OK && tonight->night.stage != FM_NIGHT_JUDGES)
        fprintf(tonight->cli->talk, "fragmark nightly: measuring ended with %d: see %s/run.log\n",
                *code, tonight->night.folder);
    return status;
}

/* One stage; it stays the same where it is to be tried again by the next command. */
static fm_status advance(int *code, fm_tonight *tonight, const char *root, fm_error *err)
{
    switch (tonight->night.stage) {
    case FM_NIGHT_BUILDS:
        return build(code, tonight, err);
    case FM_NIGHT_PLANS:
        return plan_built(tonight, root, err);
    case FM_NIGHT_MEASURES:
        return measure(code, tonight, err);
    case FM_NIGHT_JUDGES:
        return stage_judge(code, tonight, err);
    case FM_NIGHT_CONFIRMS:
        return stage_confirm(tonight, err);
    case FM_NIGHT_DONE:
    case FM_NIGHT_GIVEN_UP:
    case FM_NIGHT_STAGES:
        break;
    }
    return FM_OK;
}

/* From the stage that the night is in. */
static int work(fm_tonight *tonight, const char *root)
{
    int code = CLI_DONE;
    fm_error err = { 0 };
    fm_status status = FM_OK;
    fm_night_stage before = FM_NIGHT_STAGES;
    fprintf(tonight->cli->talk, "%s %s\n", tonight->is_continued ? "continues" : "begins",
            tonight->night.folder);
    if (tonight->night.stage > FM_NIGHT_PLANS)
        tell_plan(tonight);
    link_latest(tonight, root);
    while (status == FM_OK && night_is_open(&tonight->night) && tonight->night.stage != before) {
        before = tonight->night.stage;
        status = advance(&code, tonight, root, &err);
    }
    return status == FM_OK ? code : fail(tonight, status, &err);
}

/* A night whose code or plan changed under it is given up, and another one begun. */
static int run_nights(fm_tonight *tonight, const char *root)
{
    bool is_found;
    fm_error err = { 0 };
    fm_status status = find_unfinished(&is_found, tonight, root, &err);
    if (status == FM_OK && !is_found)
        status = begin_night(tonight, root, &err);
    if (status != FM_OK)
        return fail(tonight, status, &err);
    const int code = work(tonight, root);
    if (tonight->night.stage != FM_NIGHT_GIVEN_UP || !tonight->is_continued)
        return code;
    night_state_free(&tonight->night);
    tonight->night = (fm_night_state){ 0 };
    tonight->is_continued = false;
    status = begin_night(tonight, root, &err);
    return status == FM_OK ? work(tonight, root) : fail(tonight, status, &err);
}

/* As this program was executed; argp has changed the order at most. NULL: no memory. */
static const char **own_arguments(int argc, char **argv)
{
    const char **made = calloc((size_t)argc + 2, sizeof *made);
    if (made == NULL)
        return NULL;
    made[0] = "fragmark";
    made[1] = "nightly";
    for (int i = 1; i < argc; i++)
        made[i + 1] = argv[i];
    return made;
}

int nightly_command(const fm_cli *cli, int argc, char **argv)
{
    char root[FM_PATH_MAX_BYTES];
    int code;
    nightly_arguments given = { 0 };
    fm_policy policy;
    fm_error err = { 0 };
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    fm_tonight tonight = {
        .cli = cli, .policy = &policy, .lock = -1, .argv = own_arguments(argc, argv)
    };
    fm_status status = policy_read(&policy, given.policy, &err);
    if (tonight.argv == NULL)
        status = fm_fail(&err, FM_NO_MEMORY, "no memory for the arguments");
    if (status == FM_OK)
        status = settle(&policy, root, &given, &err);
    if (status == FM_OK)
        status = lock(&tonight.lock, root, &err);
    if (status == FM_IO && tonight.lock < 0 && given.policy != NULL &&
        access(given.policy, R_OK) != 0)
        status = FM_INVALID; /* a policy that is not there */
    code = status == FM_OK ? run_nights(&tonight, root) : fail(&tonight, status, &err);
    night_state_free(&tonight.night);
    policy_free(&policy);
    if (tonight.lock >= 0)
        close(tonight.lock);
    free(tonight.argv);
    return code;
}
