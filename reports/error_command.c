#include "error_command.h"

#include <argp.h>
#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "draw/image_file.h"
#include "draw/pictures.h"
#include "image/flip.h"
#include "image/image_error.h"
#include "model/exit_code.h"

typedef struct error_arguments {
    const char *paths[2]; /* the image, the reference */
    int path_count;
    fm_transfer transfer;
    double pixels_per_degree;
    const char *map;
    bool is_hdr, wants_yee, wants_json;
} error_arguments;

enum { KEY_HDR = 512, KEY_YEE, KEY_JSON };

static void take_transfer(error_arguments *given, const char *word, struct argp_state *state)
{
    static const char *const words[] = { "by-format", "srgb", "linear" };
    for (int i = 0; i < 3; i++)
        if (strcmp(word, words[i]) == 0) {
            given->transfer = (fm_transfer)i;
            return;
        }
    argp_error(state, "--transfer %s: by-format, srgb or linear", word);
}

static void take_degrees(error_arguments *given, const char *text, struct argp_state *state)
{
    double value;
    if (!text_to_double(&value, text) || value < 1 || value > FLIP_PIXELS_PER_DEGREE_MOST)
        argp_error(state, "--pixels-per-degree %s: a number from 1 to %d", text,
                   FLIP_PIXELS_PER_DEGREE_MOST);
    given->pixels_per_degree = value;
}

static error_t parse(int key, char *value, struct argp_state *state)
{
    error_arguments *given = state->input;
    switch (key) {
    case 't':
        take_transfer(given, value, state);
        return 0;
    case 'p':
        take_degrees(given, value, state);
        return 0;
    case 'm':
        given->map = value;
        return 0;
    case KEY_HDR:
        given->is_hdr = true;
        return 0;
    case KEY_YEE:
        given->wants_yee = true;
        return 0;
    case KEY_JSON:
        given->wants_json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (given->path_count == 2)
            argp_error(state, "two images; '%s' is a third one", value);
        given->paths[given->path_count++] = value;
        return 0;
    case ARGP_KEY_END:
        if (given->path_count < 2)
            argp_error(state, "which images? IMAGE and REFERENCE");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* The rows that are printed; the metrics of a run have the same names where it has them. */
typedef struct row {
    const char *name;
    size_t offset; /* in fm_region_error */
} row;
#define ROW(text, member)                                                                          \
    {                                                                                              \
        text, offsetof(fm_region_error, member)                                                    \
    }
static const row rows[] = {
    ROW("rmse", difference.rmse),
    ROW("psnr_db", difference.psnr_db),
    ROW("max_abs", difference.max_abs),
    ROW("abs_mean", absolute.mean),
    ROW("abs_median", absolute.weighted_median),
    ROW("abs_p95", absolute.p95),
    ROW("abs_p99", absolute.p99),
    ROW("ssim", ssim),
    ROW("flip", flip.mean),
    ROW("flip_median", flip.weighted_median),
    ROW("flip_p95", flip.p95),
    ROW("flip_p99", flip.p99),
    ROW("flip_max", flip.max),
};
enum { ROWS = sizeof rows / sizeof rows[0] };

static double number(const fm_image_error *error, fm_region region, size_t index)
{
    const char *of = (const char *)&error->region[region];
    return *(const double *)(const void *)(of + rows[index].offset);
}

/* All that was found. */
typedef struct findings {
    fm_image *images[2];
    bool *covered;
    fm_image_error error;
    uint64_t yee_pixels;
    size_t pixels;
    float *maps[3]; /* absolute, ssim, flip */
} findings;

static const char *const map_names[3] = { "absolute", "ssim", "flip" };

/* Numbers of spreadsheets: empty where there is none. */
static void print_number(double value)
{
    if (!isnan(value))
        printf("%.9g", value);
}

static void print_csv(const error_arguments *given, const findings *found)
{
    printf("metric,viewport,covered\n");
    printf("pixels,%" PRIu64 ",%" PRIu64 "\n", found->error.region[FM_REGION_VIEWPORT].pixels,
           found->error.region[FM_REGION_COVERED].pixels);
    for (size_t i = 0; i < ROWS; i++) {
        printf("%s,", rows[i].name);
        print_number(number(&found->error, FM_REGION_VIEWPORT, i));
        putchar(',');
        print_number(number(&found->error, FM_REGION_COVERED, i));
        putchar('\n');
    }
    if (given->wants_yee)
        printf("yee_pixels,%" PRIu64 ",\n", found->yee_pixels);
}

/* JSON has no infinite numbers: they are texts. */
static json_t *json_number(double value)
{
    if (isfinite(value))
        return json_real(value);
    return isnan(value) ? json_null() : json_string(value > 0 ? "inf" : "-inf");
}

static void print_json(const error_arguments *given, const findings *found)
{
    static const char *const names[FM_REGION_COUNT] = { "viewport", "covered" };
    json_t *object = json_object();
    for (int region = 0; region < FM_REGION_COUNT; region++) {
        json_t *numbers = json_object();
        json_object_set_new(numbers, "pixels",
                            json_integer((json_int_t)found->error.region[region].pixels));
        for (size_t i = 0; i < ROWS; i++)
            json_object_set_new(numbers, rows[i].name,
                                json_number(number(&found->error, (fm_region)region, i)));
        json_object_set_new(object, names[region], numbers);
    }
    if (given->wants_yee)
        json_object_set_new(object, "yee_pixels", json_integer((json_int_t)found->yee_pixels));
    json_dumpf(object, stdout, JSON_INDENT(2));
    putchar('\n');
    json_decref(object);
}

/* A pixel is covered if the reference has anything there. */
static fm_status find_covered(findings *found, fm_error *err)
{
    const float *rgba = found->images[1]->rgba;
    found->covered = malloc(found->pixels * sizeof *found->covered);
    if (found->covered == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%zu pixels", found->pixels);
    for (size_t i = 0; i < found->pixels; i++)
        found->covered[i] = rgba[4 * i + 3] != 0;
    return FM_OK;
}

static fm_status compare(findings *found, const error_arguments *given, fm_error *err)
{
    fm_status status = FM_OK;
    for (int i = 0; i < 3 && given->map != NULL && status == FM_OK; i++) {
        found->maps[i] = malloc(found->pixels * sizeof(float));
        if (found->maps[i] == NULL)
            status = fm_fail(err, FM_NO_MEMORY, "%zu pixels", found->pixels);
    }
    if (status != FM_OK)
        return status;
    const image_compare_desc desc = { .image = found->images[0],
                                      .reference = found->images[1],
                                      .covered = found->covered,
                                      .pixels_per_degree = given->pixels_per_degree,
                                      .is_hdr = given->is_hdr,
                                      .absolute_map = found->maps[0],
                                      .ssim_map = found->maps[1],
                                      .flip_map = found->maps[2] };
    return image_compare(&found->error, &desc, err);
}

static bool is_all_opaque(const findings *found)
{
    for (size_t i = 0; i < found->pixels; i++)
        if (found->images[1]->rgba[4 * i + 3] < 1.0F)
            return false;
    return true;
}

/* Pixels of either image with a colour that a display of low range cannot show. */
static size_t count_beyond(const findings *found)
{
    size_t count = 0;
    for (size_t i = 0; i < found->pixels; i++) {
        bool is_beyond = false;
        for (int image = 0; image < 2; image++)
            for (int channel = 0; channel < 3; channel++) {
                const float value = found->images[image]->rgba[4 * i + (size_t)channel];
                is_beyond |= value < 0.0F || value > 1.0F;
            }
        count += is_beyond;
    }
    return count;
}

/* What a reader of the numbers would not expect. */
static void tell_notes(const findings *found, const error_arguments *given)
{
    const size_t beyond = given->is_hdr ? 0 : count_beyond(found);
    if (beyond > 0)
        fprintf(stderr,
                "fragmark: note: %zu pixels are beyond [0,1], where FLIP clamps them; "
                "--hdr does not\n",
                beyond);
    if (is_all_opaque(found))
        fprintf(stderr, "fragmark: note: the reference is opaque everywhere: all pixels are "
                        "covered (a run's PNG files stand in front of white, its EXR files have "
                        "alpha)\n");
}

static fm_status read_pair(findings *found, const error_arguments *given, fm_error *err)
{
    fm_status status = FM_OK;
    for (int i = 0; i < 2 && status == FM_OK; i++)
        status = image_file_read(&found->images[i], given->paths[i], given->transfer, err);
    if (status == FM_OK)
        status = image_check_pair(found->images[0], found->images[1], err);
    if (status == FM_OK)
        found->pixels = (size_t)found->images[0]->width_px * found->images[0]->height_px;
    return status;
}

static fm_status find(findings *found, const error_arguments *given, fm_error *err)
{
    static const fm_map_scale scales[3] = { FM_MAP_DECADES, FM_MAP_SIMILARITY, FM_MAP_SHARE };
    fm_status status = find_covered(found, err);
    if (status == FM_OK)
        status = compare(found, given, err);
    if (status == FM_OK && given->wants_yee)
        status = image_file_yee(&found->yee_pixels, found->images[0], found->images[1], err);
    for (int i = 0; i < 3 && given->map != NULL && status == FM_OK; i++)
        status = pictures_write_map(given->map, map_names[i], found->maps[i], found->images[0],
                                    scales[i], err);
    return status;
}

static void findings_free(findings *found)
{
    for (int i = 0; i < 2; i++)
        image_destroy(found->images[i]);
    for (int i = 0; i < 3; i++)
        free(found->maps[i]);
    free(found->covered);
}

static const struct argp_option options[] = {
    { "transfer", 't', "CODING", 0,
      "how the colours of both files are coded: srgb, linear or by-format, the default: sRGB where "
      "channels are "
      "integers (PNG), linear where they are floats (EXR, PFM)",
      0 },
    { "pixels-per-degree", 'p', "NUMBER", 0,
      "of FLIP; 67.02, the default, is a 4K display 0.7 m wide seen from 0.7 m", 0 },
    { "hdr", KEY_HDR, NULL, 0,
      "HDR-FLIP: the largest over exposures; without it what is beyond [0,1] is clamped", 0 },
    { "yee", KEY_YEE, NULL, 0,
      "also count the pixels that differ by the metric of Yee and Newman (OpenImageIO's)", 0 },
    { "map", 'm', "PREFIX", 0,
      "write the error of each pixel: PREFIX.absolute, .ssim and .flip, as .exr (values) and .png",
      0 },
    { "json", KEY_JSON, NULL, 0, "JSON instead of CSV", 0 },
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "IMAGE REFERENCE",
    .doc = "How far an image is from a reference, by several measures; prints CSV.\v"
           "Files: whatever OpenImageIO reads, such as EXR, PNG and PFM, of 1 to 4 channels. "
           "Values are made linear and premultiplied by alpha. rmse, psnr_db, max_abs, abs_* and "
           "ssim are of these, all four channels; FLIP and Yee's metric are of the pictures in "
           "front of white. Column `covered` is over the pixels where the reference's alpha is not "
           "0. abs_* pool the largest channel's error of each pixel, flip_* the FLIP of each; "
           "median: half of the sum of all errors comes from pixels up to it. ssim needs 11 x 11 "
           "pixels.\n\n"
           "Examples:\n"
           "  fragmark error mine.exr truth.exr\n"
           "  fragmark error a.png b.png --map difference && xdg-open difference.flip.png\n\n"
           "Exit codes: 0 done; 2 wrong use, files that cannot be read, of two sizes, or with "
           "pixels that are infinite or no numbers; 5 a map cannot be written.",
};

int error_main(int argc, char **argv)
{
    error_arguments given = { 0 };
    findings found = { 0 };
    fm_error err = { 0 };
    argp_err_exit_status = FM_EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    int code = FM_EXIT_DONE;
    if (read_pair(&found, &given, &err) != FM_OK)
        code = err.status == FM_NO_MEMORY ? FM_EXIT_INCOMPLETE : FM_EXIT_USAGE;
    else if (find(&found, &given, &err) != FM_OK)
        code = FM_EXIT_INCOMPLETE;
    if (code != FM_EXIT_DONE)
        fprintf(stderr, "fragmark: %s\n", err.message);
    else if (given.wants_json)
        print_json(&given, &found);
    else
        print_csv(&given, &found);
    if (code == FM_EXIT_DONE)
        tell_notes(&found, &given);
    findings_free(&found);
    if (code != FM_EXIT_DONE || (fflush(stdout) == 0 && !ferror(stdout)))
        return code;
    fprintf(stderr, "fragmark: the output cannot be written\n");
    return FM_EXIT_INCOMPLETE;
}
