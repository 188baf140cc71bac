#include "journal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/file.h"
#include "base/path.h"
#include "base/text.h"

struct fm_journal {
    int fd;
    char path[FM_PATH_MAX_BYTES];
    char run_id[17];
    char started[32];
    off_t begin; /* of the first line after the plan's */
    bool is_continued;
};

static const char *const event_name[] = {
    [FM_JOURNAL_BEGIN] = "begin",   [FM_JOURNAL_END] = "end",   [FM_JOURNAL_DIED] = "died",
    [FM_JOURNAL_STOP] = "stop",     [FM_JOURNAL_MORE] = "more", [FM_JOURNAL_ENOUGH] = "enough",
    [FM_JOURNAL_FORGET] = "forget",
};
_Static_assert(sizeof event_name / sizeof event_name[0] == FM_JOURNAL_EVENT_COUNT, "one each");

static const char journal_name[] = "journal.jsonl";
static const size_t line_max_bytes = (size_t)256 << 20; /* a worker's answer may be as long */
enum { PLAN_LINE_MAX_BYTES = 1024, DAMAGED_LINES_MAX = 8 };

/* How every journal begins; json_dumps keeps the order of json_pack. */
static const char plan_line_start[] = "{\"event\":\"plan\"";

static fm_status write_line(fm_journal *journal, json_t *line, fm_error *err)
{
    fm_status status = FM_OK;
    char *text = line == NULL ? NULL : json_dumps(line, JSON_COMPACT);
    const size_t length = text == NULL ? 0 : strlen(text);
    const off_t before = lseek(journal->fd, 0, SEEK_END);
    size_t written = 0;
    if (text == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for a line", journal->path);
    text[length] = '\n'; /* in place of the NUL, so that the line goes out in one piece */
    while (written < length + 1) {
        const ssize_t count = write(journal->fd, text + written, length + 1 - written);
        if (count < 0 && errno == EINTR)
            continue;
        if (count < 0) {
            status = fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
            if (written > 0 && ftruncate(journal->fd, before) != 0) /* or the next is glued to it */
                fm_error_prefix(err, "half a line was written");
            goto out;
        }
        written += (size_t)count;
    }
    if (fdatasync(journal->fd) != 0 && errno != EINVAL)
        status = fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
out:
    free(text);
    return status;
}

static fm_status begin_plan(fm_journal *journal, const fm_journal_plan *plan, fm_error *err)
{
    struct timespec now;
    struct tm utc;
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &utc);
    strftime(journal->started, sizeof journal->started, "%Y-%m-%dT%H:%M:%SZ", &utc);
    const int64_t unique[3] = { now.tv_sec, now.tv_nsec, getpid() };
    snprintf(journal->run_id, sizeof journal->run_id, "%016llx",
             (unsigned long long)XXH3_64bits(unique, sizeof unique));
    json_t *line = json_pack("{s:s, s:s, s:s, s:s, s:s*, s:s*}", "event", "plan", "plan",
                             plan->hash, "run_id", journal->run_id, "started", journal->started,
                             "shard", plan->shard, "whole", plan->whole);
    const fm_status status = write_line(journal, line, err);
    json_decref(line);
    journal->begin = lseek(journal->fd, 0, SEEK_END);
    return status;
}

static fm_status foreign(const fm_journal *journal, bool *is_damaged, fm_error *err)
{
    *is_damaged = true;
    return fm_fail(err, FM_IO,
                   "%s:1: damaged: not the journal of a fragmark run; choose another -o, or move "
                   "the folder away and start again",
                   journal->path);
}

static bool is_hash(const char *digits)
{
    return strlen(digits) == 16 && strspn(digits, "0123456789abcdef") == 16;
}

static fm_status other_plan(const fm_journal *journal, const char *shard, fm_error *err)
{
    return fm_fail(err, FM_INVALID,
                   "%s belongs to another plan (%s%s%sother cases, launches, frames or seed, or "
                   "other versions of methods or meshes): repeat its command to continue it, or "
                   "choose another -o",
                   journal->path, shard != NULL ? "it is shard " : "", shard != NULL ? shard : "",
                   shard != NULL ? "; or " : "");
}

static fm_status check_plan(fm_journal *journal, const fm_text *text, const fm_journal_plan *wanted,
                            bool *is_damaged, fm_error *err)
{
    const char *event, *plan, *run_id, *started, *shard = NULL;
    json_t *line = json_loadb(text->bytes, text->length, JSON_REJECT_DUPLICATES, NULL);
    fm_status status = FM_OK;
    if (json_unpack(line, "{s:s, s:s, s:s, s:s, s?s}", "event", &event, "plan", &plan, "run_id",
                    &run_id, "started", &started, "shard", &shard) != 0 ||
        strcmp(event, "plan") != 0 || !is_hash(plan) || !is_hash(run_id) ||
        strspn(started, "0123456789-T:Z") != strlen(started) ||
        strlen(started) >= sizeof journal->started)
        status = foreign(journal, is_damaged, err);
    else if (strcmp(plan, wanted->hash) != 0)
        status = other_plan(journal, shard, err);
    else {
        snprintf(journal->run_id, sizeof journal->run_id, "%s", run_id);
        snprintf(journal->started, sizeof journal->started, "%s", started);
    }
    json_decref(line);
    return status;
}

/* What the next line of a file is; text holds it without its end. */
typedef enum line_kind { LINE_WHOLE, LINE_TORN, LINE_LONG, LINE_NONE } line_kind;

static line_kind read_line(fm_text *text, FILE *file)
{
    bool is_long = false;
    text->length = 0;
    for (int c; (c = getc_unlocked(file)) != EOF;) {
        const char byte = (char)c;
        if (c == '\n')
            return is_long ? LINE_LONG : LINE_WHOLE;
        is_long = is_long || text->length >= line_max_bytes;
        if (!is_long)
            text_add_raw(text, &byte, 1);
    }
    return is_long ? LINE_LONG : text->length > 0 ? LINE_TORN : LINE_NONE;
}

static fm_status reading_stream(FILE **file, const fm_journal *journal, off_t from, fm_error *err)
{
    const fm_status status = file_open_stream(file, journal->path, err);
    if (status != FM_OK || fseeko(*file, from, SEEK_SET) == 0)
        return status;
    fclose(*file);
    *file = NULL;
    return fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
}

/* Reads the plan's line, or writes it in a new file. A first line without its end is that of a run
 * which was killed at once, if it looks like one. */
static fm_status open_plan(fm_journal *journal, const fm_journal_plan *plan, bool *is_damaged,
                           fm_error *err)
{
    fm_text text = { 0 };
    FILE *file = NULL;
    fm_status status = reading_stream(&file, journal, 0, err);
    if (status != FM_OK)
        return status;
    const line_kind kind = read_line(&text, file);
    const size_t start_length = sizeof plan_line_start - 1;
    if (kind == LINE_WHOLE && !text.failed) {
        journal->begin = ftello(file);
        journal->is_continued = true;
        status = check_plan(journal, &text, plan, is_damaged, err);
    } else if (kind == LINE_LONG || text.length > PLAN_LINE_MAX_BYTES ||
               strncmp(text.bytes != NULL ? text.bytes : "", plan_line_start,
                       text.length < start_length ? text.length : start_length) != 0)
        status = foreign(journal, is_damaged, err);
    else if (ftruncate(journal->fd, 0) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
    else
        status = begin_plan(journal, plan, err);
    text_free(&text);
    fclose(file);
    return status;
}

bool journal_is_begun(const char *directory)
{
    char path[FM_PATH_MAX_BYTES];
    fm_text text = { 0 };
    FILE *file = NULL;
    if (path_join(path, directory, journal_name, NULL) != FM_OK ||
        file_open_stream(&file, path, NULL) != FM_OK)
        return access(path, F_OK) == 0; /* what it is will be told */
    const line_kind kind = read_line(&text, file);
    const bool is_begun = kind == LINE_WHOLE || text.length > PLAN_LINE_MAX_BYTES;
    text_free(&text);
    fclose(file);
    return is_begun;
}

fm_status journal_open(fm_journal **journal, const char *directory, const fm_journal_plan *plan,
                       bool *is_damaged, fm_error *err)
{
    fm_status status = FM_OK;
    fm_error below = { 0 };
    *journal = NULL;
    *is_damaged = false;
    fm_journal *opened = calloc(1, sizeof *opened);
    if (opened == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the journal");
    opened->fd = -1;
    status = path_join(opened->path, directory, journal_name, err);
    if (status != FM_OK)
        goto out;
    status = file_check_replaceable(opened->path, err);
    *is_damaged = status != FM_OK;
    if (status == FM_OK && file_open_append(&opened->fd, opened->path, &below) != FM_OK)
        status = fm_fail(err, errno == ENOSPC || errno == EDQUOT ? FM_IO : FM_INVALID, "%s",
                         below.message);
    if (status != FM_OK)
        goto out;
    if (flock(opened->fd, LOCK_EX | LOCK_NB) != 0) {
        status = fm_fail(err, FM_INVALID, "%s: %s", opened->path,
                         errno == EWOULDBLOCK ? "another run is writing here" : strerror(errno));
        goto out;
    }
    status = open_plan(opened, plan, is_damaged, err);
    if (status != FM_OK)
        goto out;
    *journal = opened;
    opened = NULL;
out:
    journal_close(opened);
    return status;
}

void journal_close(fm_journal *journal)
{
    if (journal == NULL)
        return;
    if (journal->fd >= 0)
        close(journal->fd); /* gives the lock back */
    free(journal);
}

/* What replay meets that cannot be used. */
typedef struct damage {
    char why[512]; /* of the first line */
    unsigned lines[DAMAGED_LINES_MAX];
    unsigned count, first;
} damage;

/* The event of a line; FM_JOURNAL_EVENT_COUNT: none that fragmark writes. */
static fm_journal_event event_of(json_t *line, const char **case_id, uint32_t *launch)
{
    const char *name = NULL;
    json_int_t number = -1;
    int event = 0;
    if (json_unpack(line, "{s:s, s:s, s?I}", "event", &name, "case", case_id, "launch", &number) !=
        0)
        return FM_JOURNAL_EVENT_COUNT;
    while (event < FM_JOURNAL_EVENT_COUNT && strcmp(name, event_name[event]) != 0)
        event++;
    if (event == FM_JOURNAL_FORGET) /* a case's, not a launch's */
        number = 0;
    if (number < 0 || number > UINT32_MAX)
        return FM_JOURNAL_EVENT_COUNT;
    *launch = (uint32_t)number;
    const bool has_result = json_is_object(json_object_get(line, "result"));
    return (event == FM_JOURNAL_END || event == FM_JOURNAL_DIED) == has_result
               ? (fm_journal_event)event
               : FM_JOURNAL_EVENT_COUNT;
}

/* FM_INVALID: the line cannot be used, and err says why. */
static fm_status replay_line(const fm_text *text, const fm_journal_reader *reader, fm_error *err)
{
    json_error_t fault;
    const char *case_id = NULL;
    uint32_t launch = 0;
    json_t *line = json_loadb(text->bytes != NULL ? text->bytes : "", text->length,
                              JSON_REJECT_DUPLICATES, &fault);
    if (line == NULL)
        return fm_fail(err, FM_INVALID, "not JSON: %s", fault.text);
    const fm_journal_event event = event_of(line, &case_id, &launch);
    const fm_status status = event == FM_JOURNAL_EVENT_COUNT
                                 ? fm_fail(err, FM_INVALID, "not a line that fragmark writes")
                                 : reader->line(reader->context, event, case_id, launch,
                                                json_object_get(line, "result"), err);
    json_decref(line);
    return status;
}

static void note_damage(damage *all, unsigned line, const char *why)
{
    if (all->count == 0) {
        all->first = line;
        snprintf(all->why, sizeof all->why, "%s", why);
    }
    if (all->count < DAMAGED_LINES_MAX)
        all->lines[all->count] = line;
    all->count++;
}

/* A way on that loses nothing: sed keeps the file as it is under another name. */
static fm_status tell_damage(const fm_journal *journal, const damage *all, unsigned line_count,
                             fm_error *err)
{
    fm_text script = { 0 };
    const bool is_few = all->count <= DAMAGED_LINES_MAX;
    for (unsigned i = 0; is_few && i < all->count; i++)
        text_add(&script, "%s%ud", i > 0 ? ";" : "", all->lines[i]);
    if (!is_few)
        text_add(&script, "%u,$d", all->first);
    const unsigned usable = is_few ? line_count - all->count : all->first - 1;
    const fm_status status = fm_fail(
        err, FM_IO,
        "%s:%u: damaged: %s; nothing was changed, and %u of %u lines can be used: `sed "
        "-i.damaged '%s' '%s'` keeps the file as %s.damaged, and the same command then goes "
        "on from those lines",
        journal->path, all->first, all->why, usable, line_count, script.failed ? "" : script.bytes,
        journal->path, journal_name);
    text_free(&script);
    return status;
}

static fm_status replay_all(damage *all, off_t *good, const fm_journal *journal, FILE *file,
                            const fm_journal_reader *reader, fm_error *err)
{
    fm_status status = FM_OK;
    fm_text text = { 0 };
    unsigned number = 1;
    for (line_kind kind; status == FM_OK && (kind = read_line(&text, file)) != LINE_NONE;) {
        fm_error below = { 0 };
        if (kind == LINE_TORN)
            break;
        number++;
        *good = ftello(file);
        if (text.failed)
            status = fm_fail(err, FM_NO_MEMORY, "%s: no memory for a line", journal->path);
        else if (kind == LINE_LONG)
            note_damage(all, number, "a line without an end");
        else if ((status = replay_line(&text, reader, &below)) == FM_INVALID) {
            note_damage(all, number, below.message);
            status = FM_OK;
        } else if (status != FM_OK)
            status = fm_fail(err, status, "%s", below.message);
    }
    text_free(&text);
    if (status == FM_OK && all->count > 0)
        status = tell_damage(journal, all, number, err);
    return status;
}

fm_status journal_replay(fm_journal *journal, const fm_journal_reader *reader, bool *is_damaged,
                         fm_error *err)
{
    damage all = { .count = 0 };
    off_t good = journal->begin;
    FILE *file = NULL;
    fm_status status = reading_stream(&file, journal, journal->begin, err);
    if (status != FM_OK)
        return status;
    status = replay_all(&all, &good, journal, file, reader, err);
    *is_damaged = all.count > 0;
    if (status == FM_OK && (ferror(file) || ftruncate(journal->fd, good) != 0))
        status = fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
    fclose(file);
    return status;
}

fm_status journal_write(fm_journal *journal, fm_journal_event event, const char *case_id,
                        uint32_t launch, json_t *result, fm_error *err)
{
    json_t *line = json_pack("{s:s, s:s}", "event", event_name[event], "case", case_id);
    if (line != NULL && event != FM_JOURNAL_FORGET)
        json_object_set_new(line, "launch", json_integer((json_int_t)launch));
    if (line != NULL && result != NULL)
        json_object_set(line, "result", result);
    const fm_status status = write_line(journal, line, err);
    json_decref(line);
    return status;
}

bool journal_is_continued(const fm_journal *journal)
{
    return journal->is_continued;
}

const char *journal_run_id(const fm_journal *journal)
{
    return journal->run_id;
}

const char *journal_started(const fm_journal *journal)
{
    return journal->started;
}
