#include "talk.h"

#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum {
    DRAIN_TIMES = 16, /* pipes full, then it is somebody else's turn */
    CHUNK_BYTES = 1 << 16
};

void talk_open(fm_talk *talk, const fm_process_desc *desc)
{
    struct stat info;
    *talk = (fm_talk){ .path = desc->log, .log = -1, .room = UINT64_MAX };
    if (desc->log == NULL)
        talk->room = 0;
    else if (desc->log_bytes != 0) {
        const uint64_t there =
            stat(desc->log, &info) == 0 && info.st_size > 0 ? (uint64_t)info.st_size : 0;
        talk->room = there < desc->log_bytes ? desc->log_bytes - there : 0;
    }
}

static void write_log(fm_talk *talk, const char *bytes, size_t count)
{
    if (talk->path == NULL || talk->error != 0)
        return;
    if (talk->log < 0)
        talk->log = open(talk->path, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    if (talk->log < 0)
        talk->error = errno;
    while (count > 0 && talk->error == 0) {
        const ssize_t written = write(talk->log, bytes, count);
        if (written < 0 && errno != EINTR)
            talk->error = errno;
        else if (written > 0) {
            bytes += written;
            count -= (size_t)written;
        }
    }
}

/* `last` holds up to twice of what is wanted, so that it seldom moves. */
static void keep_last(fm_talk *talk, const char *bytes, size_t count)
{
    const size_t wanted = PROCESS_WORDS_BYTES;
    if (count > wanted) {
        bytes += count - wanted;
        count = wanted;
    }
    if (talk->last_count + count > sizeof talk->last) {
        const size_t kept = wanted < talk->last_count ? wanted : talk->last_count;
        memmove(talk->last, talk->last + talk->last_count - kept, kept);
        talk->last_count = kept;
    }
    memcpy(talk->last + talk->last_count, bytes, count);
    talk->last_count += count;
}

bool talk_drain(fm_talk *talk, int pipe)
{
    char bytes[CHUNK_BYTES];
    for (int i = 0; i < DRAIN_TIMES; i++) {
        const ssize_t count = read(pipe, bytes, sizeof bytes);
        if (count <= 0)
            return count < 0 && (errno == EAGAIN || errno == EINTR);
        const size_t logged = (uint64_t)count < talk->room ? (size_t)count : (size_t)talk->room;
        if (logged > 0)
            write_log(talk, bytes, logged);
        talk->room -= logged;
        talk->dropped += (uint64_t)count - logged;
        keep_last(talk, bytes, (size_t)count);
    }
    return true;
}

/* Beyond the limit, but little: who reads the log looks at its end. */
static void tell_dropped(fm_talk *talk, const char *words, size_t count)
{
    char told[96];
    const uint64_t shown = count < talk->dropped ? count : talk->dropped;
    snprintf(told, sizeof told, "\n[%llu bytes were dropped]\n",
             (unsigned long long)(talk->dropped - shown));
    if (talk->dropped > shown)
        write_log(talk, told, strlen(told));
    write_log(talk, words + (count - shown), (size_t)shown);
}

fm_status talk_close(char words[PROCESS_WORDS_BYTES + 1], fm_talk *talk, int pipe, fm_error *err)
{
    talk_drain(talk, pipe);
    const size_t count =
        talk->last_count < PROCESS_WORDS_BYTES ? talk->last_count : PROCESS_WORDS_BYTES;
    memcpy(words, talk->last + talk->last_count - count, count);
    words[count] = '\0';
    if (talk->dropped > 0)
        tell_dropped(talk, words, count);
    if (talk->log >= 0 && close(talk->log) != 0 && talk->error == 0)
        talk->error = errno;
    talk->log = -1;
    return talk->error == 0 ? FM_OK
                            : fm_fail(err, FM_IO, "%s: %s", talk->path, strerror(talk->error));
}
