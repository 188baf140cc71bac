#include "describe.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "answer.h"
#include "base/text.h"
#include "process/process.h"
#include "remembered.h"

enum {
    BATCH = 64,      /* plugins that one process is asked for */
    PATIENCE_S = 120 /* it watches the clock itself; this is for one that was stopped */
};

/* Plugins on their way. */
typedef struct reading {
    const fm_plugin_list *list;
    const char *program;
    fm_cache *cache;
    answer *answer; /* the one that is looked at */
    fm_error *err;
} reading;

/* What a plugin says goes to terminals and into JSON. */
static void make_printable(char *text)
{
    text_make_utf8(text);
    for (char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < ' ' || *c == 0x7F)
            *c = ' ';
}

static void refuse(fm_plugin_entry *entry, const char *why, size_t count)
{
    const size_t room = sizeof entry->error.message - 1;
    fm_error *error = &entry->error;
    *error = (fm_error){ .status = FM_INVALID };
    memcpy(error->message, why, count < room ? count : room);
    make_printable(error->message);
    if (error->message[0] == '\0')
        snprintf(error->message, sizeof error->message,
                 "%s: cannot be used: the process that describes it gave no answer",
                 plugin_file_name(entry->path));
}

/* false: no memory. A description that is no good is the plugin's fault. */
static bool adopt(fm_plugin_entry *entry, const reading *of)
{
    const answer *from = of->answer;
    const fm_method_desc *method;
    void *memory;
    fm_error why = { 0 };
    fm_status status = description_read(&method, &memory, (const uint8_t *)from->bytes,
                                        from->head.count, plugin_file_name(entry->path), &why);
    if (status == FM_OK) {
        status = plugin_adopt(&entry->plugin, entry->path, method, memory, &why);
        if (status != FM_OK)
            free(memory);
    }
    if (status == FM_OK)
        status = plugin_check_files(entry->plugin, of->list->common_folder, &why);
    if (status == FM_OK)
        return true;
    plugin_close(entry->plugin);
    entry->plugin = NULL;
    if (status == FM_NO_MEMORY)
        fm_fail(of->err, status, "%s", why.message);
    else
        refuse(entry, why.message, strlen(why.message));
    return status != FM_NO_MEMORY;
}

static bool take_answer(fm_plugin_entry *entry, const reading *of)
{
    const answer *from = of->answer;
    const size_t room = sizeof from->bytes;
    const size_t count = from->head.count < room ? from->head.count : room;
    switch (from->head.kind) {
    case ANSWER_DESCRIBED:
        if (from->head.count <= room)
            return adopt(entry, of);
        break;
    case ANSWER_ENDED:
    case ANSWER_NOT_LOADED:
    case ANSWER_REFUSED:
        refuse(entry, from->bytes, strnlen(from->bytes, count));
        return true;
    default:
        break;
    }
    refuse(entry, "", 0);
    return true;
}

/* The describing process failed, and an answer is missing: no plugin is to blame. */
static fm_status fail_describing(const reading *of, const fm_process_end *end)
{
    char how[64], words[sizeof end->words];
    if (WIFSIGNALED(end->wait_status)) {
        const char *name = sigabbrev_np(WTERMSIG(end->wait_status));
        snprintf(how, sizeof how, "was killed by SIG%s", name != NULL ? name : "?");
    } else
        snprintf(how, sizeof how, "exited with status %d", WEXITSTATUS(end->wait_status));
    memcpy(words, end->words, sizeof words);
    for (size_t length = strlen(words); length > 0 && words[length - 1] == '\n';)
        words[--length] = '\0';
    make_printable(words);
    return fm_fail(of->err, FM_IO, "plugins cannot be read: the process that describes them %s%s%s",
                   how, words[0] != '\0' ? ": " : "", words);
}

static fm_status take_answers(const reading *of, int file, const fm_process_end *end,
                              fm_plugin_entry *const *entries, const answer_key *keys, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        answer_head *head = &of->answer->head;
        *head = (answer_head){ 0 };
        const ssize_t got =
            pread(file, of->answer, sizeof *of->answer, (off_t)(i * ANSWER_SLOT_BYTES));
        if (got < 0)
            return fm_fail(of->err, FM_IO, "what plugins are: %s", strerror(errno));
        if ((size_t)got < sizeof *head + head->count) /* it was cut off */
            *head = (answer_head){ 0 };
        if (head->kind == ANSWER_NONE && end->wait_status != 0)
            return fail_describing(of, end);
        if (!take_answer(entries[i], of))
            return FM_NO_MEMORY;
        remembered_write(of->cache, entries[i]->path, &keys[i], of->answer);
    }
    return FM_OK;
}

/* At most BATCH of them. */
static fm_status ask(const reading *of, fm_plugin_entry *const *entries, const answer_key *keys,
                     size_t count)
{
    char out[64];
    const char *arguments[BATCH + 4] = { "fragmark", "describe", out };
    fm_process_end end;
    const int file = memfd_create("fragmark-descriptions", MFD_CLOEXEC);
    if (file < 0)
        return fm_fail(of->err, FM_NO_MEMORY, "no memory for what plugins are: %s",
                       strerror(errno));
    snprintf(out, sizeof out, "/proc/self/fd/%d", file);
    for (size_t i = 0; i < count; i++)
        arguments[3 + i] = entries[i]->path;
    const fm_process_desc desc = {
        .path = of->program, .argv = arguments, .kept_fd = file, .timeout_s = PATIENCE_S
    };
    fm_status status = process_run(&end, NULL, &desc, of->err);
    if (status == FM_OK)
        status = take_answers(of, file, &end, entries, keys, count);
    else
        status = fm_error_prefix(of->err, "plugins cannot be read");
    close(file);
    return status;
}

/* Takes what is remembered; what is not goes to the front of both lists. */
static fm_status recall(size_t *unknown, const reading *of, fm_plugin_entry **entries,
                        answer_key *keys, size_t count)
{
    *unknown = 0;
    for (size_t i = 0; i < count; i++) {
        const answer_key key = answer_key_of(of->cache, entries[i]->path);
        if (remembered_read(of->answer, of->cache, &key)) {
            if (!take_answer(entries[i], of))
                return FM_NO_MEMORY;
            continue;
        }
        keys[*unknown] = key;
        entries[(*unknown)++] = entries[i];
    }
    return FM_OK;
}

static fm_status read_all(const reading *of, fm_plugin_entry **entries, answer_key *keys,
                          size_t count)
{
    size_t unknown;
    fm_status status = recall(&unknown, of, entries, keys, count);
    for (size_t i = 0; i < unknown && status == FM_OK; i += BATCH)
        status = ask(of, &entries[i], &keys[i], unknown - i < BATCH ? unknown - i : BATCH);
    return status;
}

fm_status describe_plugins(const fm_plugin_list *list, fm_plugin_entry *const *entries,
                           size_t count, fm_error *err)
{
    const fm_describer usual = { 0 };
    const fm_describer *desc = list->reader_context != NULL ? list->reader_context : &usual;
    fm_cache cache;
    const reading of = { .list = list,
                         .program = desc->program,
                         .cache = &cache,
                         .answer = malloc(sizeof *of.answer),
                         .err = err };
    fm_plugin_entry **unread = calloc(count + 1, sizeof *unread);
    answer_key *keys = calloc(count + 1, sizeof *keys);
    fm_status status = FM_OK;
    if (of.answer == NULL || unread == NULL || keys == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu plugins", count);
    } else {
        memcpy(unread, entries, count * sizeof *unread);
        remembered_open(&cache, desc->cache, of.program != NULL ? of.program : "/proc/self/exe");
        status = read_all(&of, unread, keys, count);
        cache_close(&cache);
    }
    free(keys);
    free(unread);
    free(of.answer);
    return status;
}
