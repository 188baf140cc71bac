#include <errno.h>
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/data.h"
#include "child/child.h"
#include "cli.h"
#include "scene/frame_stream.h"

enum { KEY_FRAMES = 512, KEY_SKIP, KEY_SECONDS, KEY_SIZE, KEY_TRACE };
enum { DISPLAY_WAIT_S = 20, REPLAY_WAIT_S = 3600, ENTRY_BYTES = 2 * FM_PATH_MAX_BYTES };

static const struct argp_option options[] = {
    { "output", 'o', "NAME", 0, "writes NAME.stream and NAME.yml, a scene (required)", 0 },
    { "frames", KEY_FRAMES, "N", 0, "record N frames, 2 to 10000 (60)", 0 },
    { "skip", KEY_SKIP, "N", 0, "leave out the first N frames (0)", 0 },
    { "seconds", KEY_SECONDS, "S", 0, "end the program after S seconds (30)", 0 },
    { "size", KEY_SIZE, "WxH", 0, "of the invisible screen (1196x768)", 0 },
    { "trace", KEY_TRACE, "FILE", 0, "take a trace of apitrace's instead of running a program", 0 },
    { 0 },
};

typedef struct recording {
    const fm_cli *cli;
    const char *name, *given_trace;
    char *const *program; /* ends with NULL; none: NULL */
    uint64_t frames, skip, seconds, width_px, height_px;
    char folder[FM_PATH_MAX_BYTES]; /* temporary */
    char trace[FM_PATH_MAX_BYTES + 16], log[FM_PATH_MAX_BYTES + 16], stream[FM_PATH_MAX_BYTES],
        told[FM_PATH_MAX_BYTES];
    char display[16]; /* ":99" */
    pid_t server;
} recording;

static bool parse_size(recording *r, const char *text)
{
    char copy[64];
    snprintf(copy, sizeof copy, "%s", text);
    char *by = strchr(copy, 'x');
    if (by == NULL)
        return false;
    *by = '\0';
    return text_to_u64(&r->width_px, copy) && text_to_u64(&r->height_px, by + 1) &&
           r->width_px > 0 && r->height_px > 0 && r->width_px <= FRAMES_SIDE_MAX &&
           r->height_px <= FRAMES_SIDE_MAX;
}

static void require(struct argp_state *state, bool is_right, const char *what, const char *legal)
{
    if (!is_right)
        argp_error(state, "%s: legal is %s", what, legal);
}

static void check_end(struct argp_state *state, const recording *r)
{
    if (r->name == NULL)
        argp_error(state, "-o NAME: where to?");
    else if ((r->program == NULL) == (r->given_trace == NULL))
        argp_error(state, "name a program after --, or a trace with --trace");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    recording *r = state->input;
    switch (key) {
    case 'o':
        r->name = text;
        return 0;
    case KEY_FRAMES:
        require(state, text_to_u64(&r->frames, text) && r->frames >= 2 && r->frames <= 10000,
                "--frames", "2..10000");
        return 0;
    case KEY_SKIP:
        require(state, text_to_u64(&r->skip, text) && r->skip <= 1000000, "--skip", "0..1000000");
        return 0;
    case KEY_SECONDS:
        require(state, text_to_u64(&r->seconds, text) && r->seconds > 0 && r->seconds <= 86400,
                "--seconds", "1..86400");
        return 0;
    case KEY_SIZE:
        require(state, parse_size(r, text), "--size", "WxH, each 1..4096");
        return 0;
    case KEY_TRACE:
        r->given_trace = text;
        return 0;
    case ARGP_KEY_ARGS:
        r->program = state->argv + state->next;
        return 0;
    case ARGP_KEY_END:
        check_end(state, r);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "-- PROGRAM [ARGUMENTS]",
    .doc = "Records the primitives that an OpenGL program draws, as a scene for the simulated GPU."
           "\v"
           "The program runs on an invisible screen under apitrace (Debian: apitrace, xvfb); its "
           "trace is replayed through OpenGL's feedback mode. Fixed-function and compatibility "
           "contexts can be recorded, core profiles cannot.\n"
           "\n"
           "Examples:\n"
           "  fragmark record -o maze -- /usr/games/neverball\n"
           "  fragmark run --device tbr --scene maze.yml --method tbr-base,tbr-re,tbr-evr-safe\n"
           "\n" CLI_EXIT_CODES,
};

/* ---- files ---- */

static fm_status open_folder(recording *r, fm_error *err)
{
    const fm_status status = path_make_temporary(r->folder, "fragmark-record", err);
    if (status != FM_OK)
        return status;
    snprintf(r->trace, sizeof r->trace, "%s/program.trace", r->folder);
    snprintf(r->log, sizeof r->log, "%s/log", r->folder);
    const int length = snprintf(r->stream, sizeof r->stream, "%s.stream", r->name);
    if (length < 0 || (size_t)length + 5 >= sizeof r->stream)
        return fm_fail(err, FM_INVALID, "%.200s...: too long a name", r->name);
    snprintf(r->told, sizeof r->told, "%.*s.txt", length, r->stream);
    if (access(r->stream, F_OK) == 0)
        return fm_fail(err, FM_INVALID, "%s: exists; name another, or remove it", r->stream);
    return FM_OK;
}

/* A log that tells why is kept, and named. */
static void close_folder(const recording *r, bool keeps_log)
{
    unlink(r->trace);
    unlink(r->told);
    if (keeps_log && access(r->log, F_OK) == 0) {
        fprintf(r->cli->talk, "what the programs said: %s\n", r->log);
        return;
    }
    unlink(r->log);
    rmdir(r->folder);
}

/* The folder of the recorder. */
static fm_status find_recorder(char folder[FM_PATH_MAX_BYTES], fm_error *err)
{
    if (data_find(folder, DATA_RECORDER, "libGL", ".so.1", err) != FM_OK)
        return fm_fail(err, FM_UNSUPPORTED,
                       "built without the recorder; on Debian: apt-get install "
                       "libgl-dev libx11-dev, then configure and build again");
    *strrchr(folder, '/') = '\0';
    return FM_OK;
}

/* ---- the screen ---- */

/* The server writes its display's number into the pipe once it listens. */
static fm_status read_display(recording *r, int from, fm_error *err)
{
    char number[8] = "";
    size_t count = 0;
    ssize_t got;
    while (count < sizeof number - 1 && strchr(number, '\n') == NULL &&
           (got = read(from, number + count, sizeof number - 1 - count)) > 0)
        count += (size_t)got;
    number[strcspn(number, "\n")] = '\0';
    if (number[0] == '\0')
        return fm_fail(err, FM_IO, "Xvfb: no display");
    snprintf(r->display, sizeof r->display, ":%s", number);
    return FM_OK;
}

static fm_status start_screen(recording *r, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], fd[16], screen[64];
    int ends[2];
    char name[] = "Xvfb", number[] = "-displayfd", which[] = "-screen", zero[] = "0";
    char no_listen[] = "-nolisten", tcp[] = "tcp", no_reset[] = "-noreset"; /* between programs */
    fm_status status = child_find(path, sizeof path, "Xvfb", "xvfb", err);
    if (status != FM_OK)
        return status;
    if (pipe(ends) != 0)
        return fm_fail(err, FM_IO, "no pipe: %s", strerror(errno));
    snprintf(fd, sizeof fd, "%d", ends[1]);
    snprintf(screen, sizeof screen, "%ux%ux24", (unsigned)r->width_px, (unsigned)r->height_px);
    char *const argv[] = { name, number, fd, which, zero, screen, no_listen, tcp, no_reset, NULL };
    status = child_start(
        &r->server,
        &(fm_child_desc){ .path = path, .argv = argv, .log = r->log, .kept_fd = ends[1] }, err);
    close(ends[1]);
    if (status == FM_OK)
        status = read_display(r, ends[0], err);
    close(ends[0]);
    return status;
}

/* ---- the program, and its trace ---- */

static size_t count_arguments(char *const *program)
{
    size_t count = 0;
    while (program[count] != NULL)
        count++;
    return count;
}

static fm_status trace_program(recording *r, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], display[32], software[] = "LIBGL_ALWAYS_SOFTWARE=1";
    char name[] = "apitrace", trace[] = "trace", output[] = "-o";
    const size_t count = count_arguments(r->program);
    fm_status status = child_find(path, sizeof path, "apitrace", "apitrace", err);
    if (status != FM_OK)
        return status;
    char **argv = calloc(count + 5, sizeof *argv);
    if (argv == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu arguments", count);
    argv[0] = name;
    argv[1] = trace;
    argv[2] = output;
    argv[3] = r->trace;
    memcpy(&argv[4], r->program, count * sizeof *argv);
    snprintf(display, sizeof display, "DISPLAY=%s", r->display);
    const char *const added[] = { display, software, NULL };
    pid_t pid = 0;
    int code = 0;
    status = child_start(
        &pid, &(fm_child_desc){ .path = path, .argv = argv, .added = added, .log = r->log }, err);
    if (status == FM_OK && child_wait(&code, pid, (double)r->seconds, NULL) && code != 0)
        fprintf(r->cli->talk, "%s ended with status %d\n", r->program[0], code);
    free(argv);
    if (status == FM_OK && access(r->trace, R_OK) != 0)
        status = fm_fail(err, FM_UNSUPPORTED, "%s: apitrace saw no OpenGL call", r->program[0]);
    return status;
}

static fm_status replay_trace(recording *r, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], library[FM_PATH_MAX_BYTES];
    char entries[6][ENTRY_BYTES], name[] = "glretrace", brief[] = "-b";
    char *trace = strdup(r->given_trace != NULL ? r->given_trace : r->trace);
    pid_t pid = 0;
    int code = 0;
    fm_status status = child_find(path, sizeof path, "glretrace", "apitrace", err);
    if (status == FM_OK)
        status = find_recorder(library, err);
    if (status == FM_OK && trace == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "no memory for a path");
    if (status == FM_OK) {
        snprintf(entries[0], ENTRY_BYTES, "DISPLAY=%s", r->display);
        snprintf(entries[1], ENTRY_BYTES, "LIBGL_ALWAYS_SOFTWARE=1");
        snprintf(entries[2], ENTRY_BYTES, "LD_LIBRARY_PATH=%s", library);
        snprintf(entries[3], ENTRY_BYTES, "FRAGMARK_RECORD_STREAM=%s", r->stream);
        snprintf(entries[4], ENTRY_BYTES, "FRAGMARK_RECORD_FIRST=%u", (unsigned)r->skip);
        snprintf(entries[5], ENTRY_BYTES, "FRAGMARK_RECORD_FRAMES=%u", (unsigned)r->frames);
        const char *const added[] = { entries[0], entries[1], entries[2], entries[3],
                                      entries[4], entries[5], NULL };
        char *const argv[] = { name, brief, trace, NULL };
        status = child_start(
            &pid, &(fm_child_desc){ .path = path, .argv = argv, .added = added, .log = r->log },
            err);
    }
    if (status == FM_OK && child_wait(&code, pid, REPLAY_WAIT_S, r->stream) && code != 0)
        fprintf(r->cli->talk, "glretrace ended with status %d\n", code);
    free(trace);
    return status;
}

/* ---- the scene ---- */

static fm_status read_head(fm_stream_head *head, const recording *r, fm_error *err)
{
    FILE *file = fopen(r->stream, "rb");
    if (file == NULL)
        return fm_fail(err, FM_UNSUPPORTED,
                       "no frame was recorded: the program drew none with OpenGL's feedback "
                       "(a core profile has none), or ended before frame %u",
                       (unsigned)r->skip);
    const bool is_whole = fread(head, sizeof *head, 1, file) == 1;
    fclose(file);
    return is_whole ? FM_OK : fm_fail(err, FM_IO, "%s: cut off", r->stream);
}

static fm_status write_scene(const recording *r, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_stream_head head = { 0 };
    fm_text text = { 0 };
    const char *file = strrchr(r->stream, '/');
    fm_status status = read_head(&head, r, err);
    if (status == FM_OK && head.frame_count < 2)
        status = fm_fail(err, FM_UNSUPPORTED, "%s: a sequence has two frames or more", r->stream);
    if (status != FM_OK)
        return status;
    text_add(&text,
             "title: recorded\ngenerator: stream\nstream: %s\nwidth_px: %u\nheight_px: %u\n"
             "sequence_frames: %u\n",
             file != NULL ? file + 1 : r->stream, head.width_px, head.height_px, head.frame_count);
    snprintf(path, sizeof path, "%.*s.yml", (int)(strlen(r->stream) - strlen(".stream")),
             r->stream);
    status = text.failed ? fm_fail(err, FM_NO_MEMORY, "%s", path)
                         : text_write_file(path, text.bytes, text.length, err);
    text_free(&text);
    return status;
}

static void tell(const recording *r)
{
    char *words = NULL;
    size_t count = 0;
    if (text_read_file(&words, &count, r->told, 4096, NULL) == FM_OK)
        fprintf(r->cli->talk, "%s: %s", r->stream, words);
    free(words);
    fprintf(r->cli->out, "%s.yml\n", r->name);
}

static fm_status record(recording *r, fm_error *err)
{
    fm_status status = open_folder(r, err);
    if (status == FM_OK)
        status = start_screen(r, err);
    if (status == FM_OK && r->given_trace == NULL)
        status = trace_program(r, err);
    if (status == FM_OK)
        status = replay_trace(r, err);
    if (status == FM_OK)
        status = write_scene(r, err);
    if (status == FM_OK)
        tell(r);
    child_end(r->server);
    return status;
}

int cli_record(const fm_cli *cli, int argc, char **argv)
{
    fm_error err = { 0 };
    recording r = { .cli = cli, .frames = 60, .seconds = 30, .width_px = 1196, .height_px = 768 };
    argp_parse(&argp, argc, argv, 0, NULL, &r);
    const fm_status status = record(&r, &err);
    close_folder(&r, status != FM_OK);
    return status == FM_OK ? CLI_DONE : cli_fail(cli, &err);
}
