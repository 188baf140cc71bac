#include "journal.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>
#include <xxhash.h>

#include "model/settings.h"

struct fm_journal {
    int fd;
    char path[FM_PATH_MAX_BYTES];
    char plan_hash[17];
    char run_id[17];
    char started[32];
    off_t begin; /* of the first line after the plan's */
    bool is_continued;
};

static const char *const event_name[] = {
    [FM_JOURNAL_BEGIN] = "begin", [FM_JOURNAL_END] = "end",       [FM_JOURNAL_DIED] = "died",
    [FM_JOURNAL_STOP] = "stop",   [FM_JOURNAL_FORGET] = "forget",
};
_Static_assert(sizeof event_name / sizeof event_name[0] == FM_JOURNAL_EVENT_COUNT, "one each");

/* How every journal begins; json_dumps keeps the order of json_pack. */
static const char plan_line_start[] = "{\"event\":\"plan\"";
static const char forget_line_start[] = "{\"event\":\"forget\"";

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

static fm_status begin_plan(fm_journal *journal, fm_error *err)
{
    struct timespec now;
    struct tm utc;
    clock_gettime(CLOCK_REALTIME, &now);
    gmtime_r(&now.tv_sec, &utc);
    strftime(journal->started, sizeof journal->started, "%Y-%m-%dT%H:%M:%SZ", &utc);
    const int64_t unique[3] = { now.tv_sec, now.tv_nsec, getpid() };
    snprintf(journal->run_id, sizeof journal->run_id, "%016llx",
             (unsigned long long)XXH3_64bits(unique, sizeof unique));
    json_t *line = json_pack("{s:s, s:s, s:s, s:s}", "event", "plan", "plan", journal->plan_hash,
                             "run_id", journal->run_id, "started", journal->started);
    const fm_status status = write_line(journal, line, err);
    json_decref(line);
    journal->begin = lseek(journal->fd, 0, SEEK_END);
    return status;
}

static fm_status damaged(const fm_journal *journal, bool *is_damaged, unsigned line,
                         const char *why, fm_error *err)
{
    *is_damaged = true;
    return fm_fail(err, FM_IO, "%s:%u: damaged: %s; move the folder away and start again",
                   journal->path, line, why);
}

static fm_status check_plan(fm_journal *journal, const char *text, bool *is_damaged, fm_error *err)
{
    const char *event, *plan, *run_id, *started;
    json_t *line = json_loads(text, 0, NULL);
    fm_status status = FM_OK;
    if (json_unpack(line, "{s:s, s:s, s:s, s:s}", "event", &event, "plan", &plan, "run_id", &run_id,
                    "started", &started) != 0 ||
        strcmp(event, "plan") != 0)
        status = damaged(journal, is_damaged, 1, "not the journal of a fragmark run", err);
    else if (strcmp(plan, journal->plan_hash) != 0)
        status = fm_fail(err, FM_INVALID,
                         "%s belongs to another plan (other cases, launches, frames or seed): "
                         "repeat its command to continue it, or choose another -o",
                         journal->path);
    else {
        snprintf(journal->run_id, sizeof journal->run_id, "%s", run_id);
        snprintf(journal->started, sizeof journal->started, "%s", started);
    }
    json_decref(line);
    return status;
}

static FILE *reading_stream(const fm_journal *journal, off_t from)
{
    FILE *file = fopen(journal->path, "rbe");
    if (file != NULL && fseeko(file, from, SEEK_SET) != 0) {
        fclose(file);
        return NULL;
    }
    return file;
}

/* Reads the plan's line, or writes it in a new file. A first line without its end is that of a run
 * which was killed at once, if it looks like one. */
static fm_status open_plan(fm_journal *journal, bool *is_damaged, fm_error *err)
{
    fm_status status;
    char *text = NULL;
    size_t room = 0;
    FILE *file = reading_stream(journal, 0);
    if (file == NULL)
        return fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
    const ssize_t length = getline(&text, &room, file);
    const size_t start_length = sizeof plan_line_start - 1;
    if (length > 0 && text[length - 1] == '\n') {
        journal->begin = (off_t)length;
        journal->is_continued = true;
        status = check_plan(journal, text, is_damaged, err);
    } else if (length > 0 &&
               strncmp(text, plan_line_start,
                       (size_t)length < start_length ? (size_t)length : start_length) != 0)
        status = damaged(journal, is_damaged, 1, "not the journal of a fragmark run", err);
    else if (ftruncate(journal->fd, 0) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
    else
        status = begin_plan(journal, err);
    free(text);
    fclose(file);
    return status;
}

fm_status journal_open(fm_journal **journal, const char *directory, const char *plan_hash,
                       bool *is_damaged, fm_error *err)
{
    fm_status status = FM_OK;
    *journal = NULL;
    *is_damaged = false;
    fm_journal *opened = calloc(1, sizeof *opened);
    if (opened == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the journal");
    opened->fd = -1;
    snprintf(opened->plan_hash, sizeof opened->plan_hash, "%s", plan_hash);
    status = path_join(opened->path, directory, "journal.jsonl", err);
    if (status != FM_OK)
        goto out;
    opened->fd = open(opened->path, O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (opened->fd < 0) {
        status = fm_fail(err, errno == ENOSPC || errno == EDQUOT ? FM_IO : FM_INVALID, "%s: %s",
                         opened->path, strerror(errno));
        goto out;
    }
    if (flock(opened->fd, LOCK_EX | LOCK_NB) != 0) {
        status = fm_fail(err, FM_INVALID, "%s: %s", opened->path,
                         errno == EWOULDBLOCK ? "another run is writing here" : strerror(errno));
        goto out;
    }
    status = open_plan(opened, is_damaged, err);
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

/* What is wrong with a line; NULL: nothing, and the reader was told. */
static const char *replay_line(const char *text, const fm_journal_reader *reader, fm_error *below)
{
    const char *why = NULL, *name = NULL, *case_id = NULL;
    int launch = -1;
    json_t *line = json_loads(text, 0, NULL);
    const json_t *result = json_object_get(line, "result");
    int event = FM_JOURNAL_EVENT_COUNT;
    if (json_unpack(line, "{s:s, s:s, s:i}", "event", &name, "case", &case_id, "launch", &launch) ==
        0)
        for (event = 0; event < FM_JOURNAL_EVENT_COUNT; event++)
            if (strcmp(name, event_name[event]) == 0)
                break;
    if (event == FM_JOURNAL_EVENT_COUNT || launch < 0 ||
        (event == FM_JOURNAL_END || event == FM_JOURNAL_DIED) != json_is_object(result))
        why = "not a line that fragmark writes";
    else if (reader->line(reader->context, (fm_journal_event)event, case_id, (uint32_t)launch,
                          result, below) != FM_OK)
        why = below->message;
    json_decref(line);
    return why;
}

fm_status journal_replay(fm_journal *journal, const fm_journal_reader *reader, bool *is_damaged,
                         fm_error *err)
{
    fm_status status = FM_OK;
    fm_error below = { 0 };
    char *text = NULL;
    size_t room = 0;
    off_t good = journal->begin;
    ssize_t length;
    FILE *file = reading_stream(journal, journal->begin);
    if (file == NULL)
        return fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
    for (unsigned number = 2; (length = getline(&text, &room, file)) > 0; number++) {
        if (text[length - 1] != '\n')
            break; /* torn */
        const bool is_told = !reader->only_forgets ||
                             strncmp(text, forget_line_start, sizeof forget_line_start - 1) == 0;
        const char *why = is_told ? replay_line(text, reader, &below) : NULL;
        if (why != NULL) {
            status = damaged(journal, is_damaged, number, why, err);
            goto out;
        }
        good += (off_t)length;
    }
    if (ferror(file) || ftruncate(journal->fd, good) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", journal->path, strerror(errno));
out:
    free(text);
    fclose(file);
    return status;
}

fm_status journal_write(fm_journal *journal, fm_journal_event event, const char *case_id,
                        uint32_t launch, json_t *result, fm_error *err)
{
    json_t *line = json_pack("{s:s, s:s, s:i}", "event", event_name[event], "case", case_id,
                             "launch", (int)launch);
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
