#include "dump.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/csv.h"
#include "frame_lines.h"
#include "kept_cases.h"
#include "pixel_lines.h"

enum {
    KEY_PIXEL = 512,
    KEY_RECT,
    KEY_WRONG,
    KEY_FRAME,
    KEY_CASE,
    KEY_METHOD,
    KEY_DEVICE,
    KEY_FEED,
    KEY_SCENE
};

typedef struct dump_arguments {
    const char *path; /* a run's folder, or a file */
    const char *wanted[KEPT_FACT_COUNT];
    pixel_area area;
    uint64_t most, frame;
    bool has_area, has_wrong, has_frame;
} dump_arguments;

/* All of a dump. */
typedef struct dump {
    const fm_cli *cli;
    const dump_arguments *given;
    kept_cases cases;
    kept_files files;
    const char *name; /* of the case, or of the file, for people */
    fm_text text;
} dump;

static const struct argp_option options[] = {
    { "pixel", KEY_PIXEL, "X,Y", 0, "all fragments of one pixel", 1 },
    { "rect", KEY_RECT, "X,Y,W,H", 0, "the same of each pixel of a rectangle", 1 },
    { "wrong", KEY_WRONG, "N", 0, "the first N wrong pixels; of a sequence, tiles", 1 },
    { "frame", KEY_FRAME, "N", 0, "the wrong pixels of a sequence's frame, from 0", 1 },
    { "case", KEY_CASE, "ID", 0, "the case with this id, as summary.csv has it", 2 },
    { "method", KEY_METHOD, "M", 0, "the case of this method", 2 },
    { "device", KEY_DEVICE, "D", 0, "... and of this device", 2 },
    { "feed", KEY_FEED, "F", 0, "... and of this feed", 2 },
    { "scene", KEY_SCENE, "S", 0, "... and of this scene", 2 },
    CLI_HELP_OPTION,
    { 0 },
};

/* "3,4": so many numbers below 2^32. */
static bool parse_numbers(uint32_t *numbers, size_t count, const char *text)
{
    for (size_t i = 0; i < count; i++) {
        char number[24];
        uint64_t value;
        const size_t length = strcspn(text, ",");
        const bool is_last = text[length] == '\0';
        if (length >= sizeof number || is_last != (i + 1 == count))
            return false;
        snprintf(number, sizeof number, "%.*s", (int)length, text);
        if (!text_to_u64(&value, number) || value > UINT32_MAX)
            return false;
        numbers[i] = (uint32_t)value;
        text += length + !is_last;
    }
    return true;
}

static void parse_area(dump_arguments *given, bool is_pixel, const char *text,
                       struct argp_state *state)
{
    uint32_t numbers[4] = { 0, 0, 1, 1 };
    if (given->has_area)
        argp_error(state, "one of --pixel and --rect, once");
    if (!parse_numbers(numbers, is_pixel ? 2 : 4, text) || numbers[2] == 0 || numbers[3] == 0)
        argp_error(state, "%s %s: whole numbers, please: %s", is_pixel ? "--pixel" : "--rect", text,
                   is_pixel ? "X,Y" : "X,Y,WIDTH,HEIGHT");
    given->area = (pixel_area){ numbers[0], numbers[1], numbers[2], numbers[3] };
    given->has_area = true;
}

static void parse_count(uint64_t *count, const char *name, const char *text,
                        struct argp_state *state)
{
    if (!text_to_u64(count, text))
        argp_error(state, "%s %s: a whole number, please", name, text);
}

static void check_arguments(const dump_arguments *given, struct argp_state *state)
{
    if (given->path == NULL)
        argp_error(state, "which DIR or FILE?");
    if (given->has_wrong && (given->has_area || given->has_frame))
        argp_error(state, "--wrong lists; --pixel, --rect and --frame come after it");
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    dump_arguments *given = state->input;
    static const kept_fact facts[] = { KEPT_CASE_ID, KEPT_METHOD, KEPT_DEVICE, KEPT_FEED,
                                       KEPT_SCENE };
    switch (key) {
    case KEY_PIXEL:
    case KEY_RECT:
        parse_area(given, key == KEY_PIXEL, text, state);
        return 0;
    case KEY_WRONG:
        given->has_wrong = true;
        parse_count(&given->most, "--wrong", text, state);
        return 0;
    case KEY_FRAME:
        given->has_frame = true;
        parse_count(&given->frame, "--frame", text, state);
        return 0;
    case KEY_CASE:
    case KEY_METHOD:
    case KEY_DEVICE:
    case KEY_FEED:
    case KEY_SCENE:
        given->wanted[facts[key - KEY_CASE]] = text;
        return 0;
    case ARGP_KEY_ARG:
        if (given->path != NULL)
            argp_error(state, "'%s': one DIR or FILE only", text);
        given->path = text;
        return 0;
    case ARGP_KEY_END:
        check_arguments(given, state);
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "DIR|FILE",
    .doc =
        "Prints as CSV what `fragmark run --keep` kept: of a pixel, which fragments the method "
        "handed over, and which are missing, extra or out of order; of a sequence, what is wrong."
        "\v"
        "DIR is a run's folder. Alone, its cases are listed of which something was kept. FILE is "
        "one "
        "of DIR/kept: with fragments or truth alone nothing is compared.\n"
        "\n"
        "Examples:\n"
        "  fragmark run --method kb --feed compute-adjacent -a n=32 -a k=8 \\\n"
        "      -a width_px=32 -a height_px=24 --keep fragments,truth -o look\n"
        "  fragmark dump look\n"
        "  fragmark dump look --wrong 5\n"
        "  fragmark dump look --pixel 8,6\n"
        "\n"
        "State of a fragment: ok; missing: it was to be handed over, and was not; extra: it is not "
        "the pixel's, or was beyond the count; behind: it is the pixel's, and took the place of a "
        "nearer one that is missing; +misordered: it is nearer than the one before it.\n"
        "\n"
        "Exit codes: 0 done; 2 no such case, pixel or frame, or nothing was kept; 8 a damaged "
        "file.",
};

static fm_status write_text(dump *of, fm_error *err)
{
    if (of->text.failed)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the lines");
    if (of->text.length > 0)
        fwrite(of->text.bytes, 1, of->text.length, of->cli->out); /* main asks how that went */
    of->text.length = 0;
    return FM_OK;
}

static fm_status list_cases(dump *of, fm_error *err)
{
    for (int i = 0; i < KEPT_FACT_COUNT; i++)
        text_add(&of->text, "%s,", kept_facts[i]);
    text_add(&of->text, "kept\n");
    for (size_t i = 0; i < of->cases.count; i++) {
        bool is_first = true;
        for (int fact = 0; fact < KEPT_FACT_COUNT; fact++) {
            csv_add(&of->text, of->cases.cases[i].facts[fact]);
            text_add(&of->text, ",");
        }
        for (int kind = 0; kind < KEPT_KIND_COUNT; kind++) {
            if ((of->cases.cases[i].kinds & 1u << kind) == 0)
                continue;
            text_add(&of->text, "%s%s", is_first ? "" : "+", kept_names[kind]);
            is_first = false;
        }
        text_add(&of->text, "\n");
    }
    return write_text(of, err);
}

/* The area that is asked for, within the picture. */
static fm_status check_area(const dump *of, const kept_header *header, fm_error *err)
{
    const pixel_area *area = &of->given->area;
    if ((uint64_t)area->x + area->width > header->width_px ||
        (uint64_t)area->y + area->height > header->height_px)
        return fm_fail(err, FM_INVALID,
                       "pixel %" PRIu64 ",%" PRIu64 " is outside: the picture of %s has %u x %u, "
                       "from 0,0",
                       (uint64_t)area->x + area->width - 1, (uint64_t)area->y + area->height - 1,
                       of->name, header->width_px, header->height_px);
    return FM_OK;
}

static void tell_counts(const dump *of, const pixel_counts *sums, const pixel_source *source)
{
    fprintf(of->cli->talk, "%s:", of->name);
    if (source->truth != NULL)
        fprintf(of->cli->talk, " %" PRIu64 " true", sums->own);
    if (source->fragments != NULL && source->truth != NULL)
        fprintf(of->cli->talk, ", %" PRIu64 " wanted,", sums->wanted);
    if (source->fragments != NULL)
        fprintf(of->cli->talk, " %" PRIu64 " handed over", sums->handed_over);
    if (source->fragments != NULL && source->truth != NULL)
        fprintf(of->cli->talk, ": %" PRIu64 " missing, %" PRIu64 " extra, %" PRIu64 " misordered",
                sums->missing, sums->extra, sums->misordered);
    if (sums->uncaptured > 0)
        fprintf(of->cli->talk,
                "; %" PRIu64 " of those handed over have no line: there was no room for so many",
                sums->uncaptured);
    if (source->fragments == NULL || source->truth == NULL)
        fprintf(of->cli->talk, "; without %s nothing is compared",
                source->truth == NULL ? "truth" : "fragments");
    fputc('\n', of->cli->talk);
}

static fm_status dump_area(dump *of, const pixel_source *source, fm_error *err)
{
    const kept_map *map = source->fragments != NULL ? source->fragments : source->truth;
    const pixel_area *area = &of->given->area;
    pixel_counts sums = { 0 };
    fm_status status = check_area(of, map->header, err);
    if (status == FM_OK)
        text_add(&of->text, PIXEL_LINES_HEAD);
    for (uint64_t i = 0; i < (uint64_t)area->width * area->height && status == FM_OK; i++) {
        const uint64_t x = area->x + i % area->width, y = area->y + i / area->width;
        status = pixel_lines_add(&of->text, &sums, source, y * map->header->width_px + x, err);
        if (status == FM_OK)
            status = write_text(of, err);
    }
    if (status == FM_OK)
        tell_counts(of, &sums, source);
    return status;
}

static fm_status dump_wrong(dump *of, const pixel_source *source, fm_error *err)
{
    pixel_counts sums = { 0 };
    uint64_t wrong = 0;
    if (source->fragments == NULL || source->truth == NULL)
        return fm_fail(err, FM_INVALID,
                       "%s: has no kept %s, and only with both it is known what is wrong", of->name,
                       source->truth == NULL ? "truth" : "fragments");
    text_add(&of->text, WRONG_PIXELS_HEAD);
    fm_status status = pixel_lines_wrong(&of->text, &sums, &wrong, source, of->given->most, err);
    if (status == FM_OK)
        status = write_text(of, err);
    if (status != FM_OK)
        return status;
    fprintf(of->cli->talk, "%" PRIu64 " pixels are wrong; ", wrong);
    tell_counts(of, &sums, source);
    return FM_OK;
}

static fm_status dump_pixels(dump *of, fm_error *err)
{
    const pixel_source source = { of->files.files[KEPT_FRAGMENTS], of->files.files[KEPT_TRUTH] };
    if (of->given->has_frame)
        return fm_fail(err, FM_INVALID, "%s is no sequence: it has no frame %" PRIu64, of->name,
                       of->given->frame);
    if (of->given->has_wrong)
        return dump_wrong(of, &source, err);
    if (of->given->has_area)
        return dump_area(of, &source, err);
    return fm_fail(err, FM_INVALID, "%s: what of it? --wrong N, --pixel X,Y or --rect X,Y,W,H",
                   of->name);
}

static fm_status dump_frame(dump *of, const kept_map *frames, fm_error *err)
{
    const dump_arguments *given = of->given;
    uint64_t wrong;
    fm_status status = given->has_area ? check_area(of, frames->header, err) : FM_OK;
    if (status == FM_OK) {
        text_add(&of->text, FRAME_LINES_HEAD);
        status = frame_lines_add(&of->text, &wrong, frames, given->frame,
                                 given->has_area ? &given->area : NULL, err);
    }
    if (status == FM_OK)
        status = write_text(of, err);
    if (status != FM_OK)
        return status;
    if (frames->offsets[given->frame] == frames->offsets[given->frame + 1])
        fprintf(of->cli->talk, "%s: frame %" PRIu64 " is right, and its picture is not kept\n",
                of->name, given->frame);
    else
        fprintf(of->cli->talk, "%s: frame %" PRIu64 ": %" PRIu64 " wrong pixels\n", of->name,
                given->frame, wrong);
    return FM_OK;
}

static fm_status dump_frames(dump *of, const kept_map *frames, fm_error *err)
{
    frame_counts counts;
    if (of->given->has_frame)
        return dump_frame(of, frames, err);
    if (!of->given->has_wrong)
        return fm_fail(err, FM_INVALID, "%s is a sequence: --wrong N or --frame N, please",
                       of->name);
    text_add(&of->text, WRONG_TILES_HEAD);
    frame_lines_wrong(&of->text, &counts, frames, of->given->most);
    const fm_status status = write_text(of, err);
    if (status == FM_OK)
        fprintf(of->cli->talk,
                "%s: %" PRIu64 " of %" PRIu64 " frames are wrong, in %" PRIu64 " tiles and %" PRIu64
                " pixels\n",
                of->name, counts.wrong_frames, counts.frames, counts.wrong_tiles,
                counts.wrong_pixels);
    return status;
}

static fm_status dump_files(dump *of, fm_error *err)
{
    const kept_map *frames = of->files.files[KEPT_FRAMES];
    return frames != NULL ? dump_frames(of, frames, err) : dump_pixels(of, err);
}

static fm_status dump_folder(dump *of, fm_error *err)
{
    const dump_arguments *given = of->given;
    const kept_case *chosen = NULL;
    bool is_chosen = false;
    fm_status status = kept_cases_read(&of->cases, given->path, err);
    for (int i = 0; i < KEPT_FACT_COUNT; i++)
        is_chosen = is_chosen || given->wanted[i] != NULL;
    if (status == FM_OK && !is_chosen && !given->has_wrong && !given->has_area && !given->has_frame)
        return list_cases(of, err);
    if (status == FM_OK)
        status = kept_cases_choose(&chosen, &of->cases, given->wanted, err);
    if (status != FM_OK)
        return status;
    of->name = chosen->facts[KEPT_CASE_ID];
    status = kept_files_open(&of->files, given->path, chosen, err);
    return status == FM_OK ? dump_files(of, err) : status;
}

static fm_status dump_file(dump *of, fm_error *err)
{
    for (int i = 0; i < KEPT_FACT_COUNT; i++)
        if (of->given->wanted[i] != NULL)
            return fm_fail(err, FM_INVALID, "%s is one file: a %s is chosen in a folder",
                           of->given->path, kept_facts[i]);
    of->name = of->given->path;
    const fm_status status = kept_files_open_one(&of->files, of->given->path, err);
    return status == FM_OK ? dump_files(of, err) : status;
}

int inspect_dump(const fm_cli *cli, int argc, char **argv)
{
    fm_error err = { 0 };
    dump_arguments given = { .path = NULL };
    struct stat info;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    dump of = { .cli = cli, .given = &given };
    const bool is_folder = stat(given.path, &info) == 0 && S_ISDIR(info.st_mode);
    const fm_status status = is_folder ? dump_folder(&of, &err) : dump_file(&of, &err);
    int code = status == FM_OK ? CLI_DONE : cli_fail(cli, &err);
    if (status == FM_IO && of.files.is_damaged)
        code = CLI_DAMAGED;
    kept_files_close(&of.files);
    kept_cases_free(&of.cases);
    text_free(&of.text);
    return code;
}
