/* Runs a target on mutated seeds, where no libFuzzer is linked: TARGET FOLDER SECONDS SEED [LAST].
 * First each file of FOLDER as it is, then mutations of them until SECONDS are over. The input that
 * runs is in the file LAST: after a crash it is the one that did it. */
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/clock.h"
#include "base/path.h"
#include "base/random.h"
#include "base/text.h"
#include "fuzz.h"

enum { INPUT_BYTES = 1 << 16, SEEDS = 256, STEPS = 8, SECONDS_OF_ONE = 10 };

typedef struct input {
    size_t count;
    uint8_t bytes[INPUT_BYTES + 1]; /* the last ends texts */
} input;

typedef struct driver {
    input seeds[SEEDS];
    size_t seed_count;
    uint64_t random;
    int last_file; /* -1: none */
    uint64_t runs;
} driver;

static uint32_t below(driver *from, size_t count)
{
    return random_below(&from->random, (uint32_t)count);
}

static bool read_seed(driver *to, const char *path)
{
    fm_error err = { 0 };
    char *bytes = NULL;
    size_t count = 0;
    if (to->seed_count == SEEDS ||
        text_read_file(&bytes, &count, path, INPUT_BYTES, &err) != FM_OK) {
        fprintf(stderr, "%s\n", to->seed_count == SEEDS ? "too many seeds" : err.message);
        return false;
    }
    input *seed = &to->seeds[to->seed_count++];
    seed->count = count;
    memcpy(seed->bytes, bytes, count);
    free(bytes);
    return true;
}

static bool read_seeds(driver *to, const char *folder)
{
    struct dirent **entries = NULL;
    const int count = scandir(folder, &entries, NULL, alphasort);
    bool is_good = count > 0;
    for (int i = 0; i < count; i++) {
        char path[FM_PATH_MAX_BYTES];
        if (entries[i]->d_name[0] != '.')
            is_good = is_good && path_join(path, folder, entries[i]->d_name, NULL) == FM_OK &&
                      read_seed(to, path);
        free(entries[i]);
    }
    free(entries);
    return is_good && to->seed_count > 0;
}

/* Takes `less` bytes at a place out, and puts `more` bytes in. */
static void replace(input *to, size_t at, size_t less, const void *bytes, size_t more)
{
    if (to->count - less + more > INPUT_BYTES)
        return;
    static uint8_t piece[INPUT_BYTES];
    memcpy(piece, bytes, more); /* it may be a piece of the same input */
    memmove(to->bytes + at + more, to->bytes + at + less, to->count - at - less);
    memcpy(to->bytes + at, piece, more);
    to->count += more - less;
}

static void put_number(driver *from, input *to, size_t at)
{
    static const char *const numbers[] = {
        "0",
        "-1",
        "1e308",
        "1e-308",
        "4294967296",
        "18446744073709551616",
        "2147483648",
        "nan",
        "inf",
        "0x10",
        "",
        "9007199254740993",
        "\"",
        "[",
        "{",
        "\0",
        "\n",
        "\xff\xfe",
        "-9223372036854775808",
    };
    static const uint32_t words[] = {
        0, 1, 0x7FFFFFFF, 0x80000000, 0xFFFFFFFF, 0xFFFFFFFE, 1u << 16
    };
    const size_t digits = strspn((const char *)to->bytes + at, "0123456789.eE+-");
    const size_t left = to->count - at;
    const char *number = numbers[below(from, sizeof numbers / sizeof numbers[0])];
    if (digits > 0 || below(from, 2) == 0)
        replace(to, at, digits < left ? digits : left, number, strlen(number));
    else
        replace(to, at, left < 4 ? left : 4, &words[below(from, 7)], 4);
}

static size_t piece_at(driver *from, const input *of, size_t at)
{
    const size_t left = of->count - at;
    const char *end = memchr(of->bytes + at, '\n', left);
    if (end != NULL && below(from, 2) == 0)
        return (size_t)(end - (const char *)of->bytes) + 1 - at;
    return left == 0 ? 0 : 1 + below(from, left < 64 ? left : 64);
}

static void mutate(driver *from, input *to)
{
    const size_t at = below(from, to->count + 1), piece = piece_at(from, to, at);
    const input *other = &from->seeds[below(from, from->seed_count)];
    const size_t there = below(from, other->count + 1);
    const uint8_t byte = (uint8_t)below(from, 256);
    switch (below(from, 8)) {
    case 0:
        replace(to, at, piece > 0, &byte, 1);
        break;
    case 1:
        if (piece > 0)
            to->bytes[at] ^= (uint8_t)(1u << below(from, 8));
        break;
    case 2:
        replace(to, at, piece, "", 0);
        break;
    case 3: /* twice, or many times */
        for (uint32_t times = 1 + below(from, 2) * below(from, 64); times > 0; times--)
            replace(to, at, 0, to->bytes + at, piece);
        break;
    case 4:
        replace(to, at, piece, other->bytes + there, piece_at(from, other, there));
        break;
    case 5: /* cut off */
        to->count = at;
        break;
    case 6:
        replace(to, at, 0, other->bytes + there, piece_at(from, other, there));
        break;
    default:
        put_number(from, to, at);
    }
}

/* After a crash the file holds the input that did it. */
static void keep(const driver *on, const input *of)
{
    if (on->last_file >= 0 &&
        (pwrite(on->last_file, of->bytes, of->count, 0) != (ssize_t)of->count ||
         ftruncate(on->last_file, (off_t)of->count) != 0)) {
        perror("the last input cannot be kept");
        abort();
    }
}

static void run(driver *on, const input *of)
{
    /* A copy of just these bytes, so that reading beyond them is seen. */
    uint8_t *copy = malloc(of->count > 0 ? of->count : 1);
    if (copy == NULL)
        abort();
    memcpy(copy, of->bytes, of->count);
    keep(on, of);
    alarm(SECONDS_OF_ONE);
    LLVMFuzzerTestOneInput(copy, of->count);
    alarm(0);
    free(copy);
    on->runs++;
}

static void run_mutations(driver *on, double seconds)
{
    static input changed;
    for (const double end = clock_s() + seconds; clock_s() < end;) {
        const input *seed = &on->seeds[below(on, on->seed_count)];
        changed.count = seed->count;
        memcpy(changed.bytes, seed->bytes, seed->count);
        for (uint32_t step = below(on, STEPS) + 1; step > 0; step--)
            mutate(on, &changed);
        run(on, &changed);
    }
}

int main(int argc, char **argv)
{
    driver *on = calloc(1, sizeof *on);
    double seconds = 0;
    if (on == NULL || argc < 4 || argc > 5 || !text_to_double(&seconds, argv[2]) ||
        !text_to_u64(&on->random, argv[3]) || !read_seeds(on, argv[1])) {
        fprintf(stderr, "usage: %s FOLDER SECONDS SEED [LAST]\n", argv[0]);
        free(on);
        return 2;
    }
    on->last_file = argc == 5 ? open(argv[4], O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, 0666) : -1;
    for (size_t i = 0; i < on->seed_count; i++)
        run(on, &on->seeds[i]);
    run_mutations(on, seconds);
    printf("%llu inputs, %zu of them seeds, in %s s from seed %s\n", (unsigned long long)on->runs,
           on->seed_count, argv[2], argv[3]);
    if (on->last_file >= 0)
        close(on->last_file);
    free(on);
    return 0;
}
