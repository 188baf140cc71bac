#include "metrics.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define LESS     .better = FM_BETTER_LESS
#define MORE     .better = FM_BETTER_MORE
#define FRAME    .of = FM_OF_FRAME
#define LAUNCH   .of = FM_OF_LAUNCH
#define CASE     .of = FM_OF_CASE
#define SUMMARY  .of = FM_OF_SUMMARY
#define REPORT   .of = FM_OF_REPORT
#define MEASURED .is_measured = true
#define TIMED    .is_measured = true, .is_timed = true
#define WHOLE    .range = FM_RANGE_COUNT
#define BYTES    .range = FM_RANGE_BYTES
#define FINITE   .range = FM_RANGE_FINITE
#define ERRORS   .range = FM_RANGE_ERROR
#define LEVEL    .range = FM_RANGE_LEVEL

const fm_range fm_ranges[FM_RANGE_KINDS] = {
    [FM_RANGE_AMOUNT] = { 0, DBL_MAX, .words = "a number from 0" },
    [FM_RANGE_COUNT] = { 0, 0x1p53, .is_whole = true, .words = "a whole number from 0 to 2^53" },
    [FM_RANGE_BYTES] = { 0, 0x1p48, .is_whole = true, .words = "a whole number from 0 to 2^48" },
    [FM_RANGE_FINITE] = { -DBL_MAX, DBL_MAX, .words = "a finite number" },
    [FM_RANGE_ERROR] = { 0, INFINITY, .may_be_none = true, .words = "a number from 0, or none" },
    [FM_RANGE_LEVEL] = { -INFINITY, INFINITY, .may_be_none = true, .words = "a number, or none" },
};

/* clang-format off */
const fm_metric_info fm_metrics[FM_METRIC_COUNT] = {
    [FM_METRIC_FRAME_MS] = { "frame_ms", "frame time", "ms",
        "GPU time of all passes of a frame, each between two timestamps (timers=frame: one interval)",
        FRAME, LESS, TIMED },
    [FM_METRIC_FRAME_WALL_MS] = { "frame_wall_ms", "frame, host", "ms",
        "the host's time for the same frame, with read-backs and waiting", FRAME, LESS, TIMED },
    [FM_METRIC_FRAME_CPU_MS] = { "frame_cpu_ms", "frame, processors", "ms",
        "processor time of all threads of the process for the same frame: of a software rasteriser its "
        "work, which other programs hardly change; of a GPU what the driver does", FRAME, LESS, TIMED },
    [FM_METRIC_CLEAR_MS] = { "clear_ms", "clear", "ms", "pass clear", FRAME, LESS, TIMED },
    [FM_METRIC_COUNT_MS] = { "count_ms", "count", "ms", "pass count", FRAME, LESS, TIMED },
    [FM_METRIC_REFERENCE_MS] = { "reference_ms", "referencing step", "ms", "pass reference", FRAME,
        LESS, TIMED },
    [FM_METRIC_STORE_MS] = { "store_ms", "store", "ms", "pass store", FRAME, LESS, TIMED },
    [FM_METRIC_RESOLVE_MS] = { "resolve_ms", "resolve", "ms", "pass resolve", FRAME, LESS, TIMED },
    [FM_METRIC_CULLING_MS] = { "culling_ms", "culling", "ms", "the passes that make the occupancy map",
        FRAME, LESS, TIMED },
    [FM_METRIC_FLOOR_STORE_MS] = { "floor_store_ms", "floor, store", "ms",
        "pass store of the floor, in the frame beside the method's", FRAME, LESS, TIMED },
    [FM_METRIC_FLOOR_FRAME_MS] = { "floor_frame_ms", "floor, frame", "ms",
        "all passes of the floor, in the frame beside the method's", FRAME, LESS, TIMED },
    [FM_METRIC_CANARY_NS] = { "canary_ns", "canary", "ns",
        "an empty timed interval: where it grows, the GPU's clock has fallen", FRAME, TIMED },
    [FM_METRIC_OFF_CLOCK] = { "off_clock", "off clock", "",
        "1 for a frame that was not at full clock; its times count for nothing", FRAME, MEASURED, WHOLE },
    [FM_METRIC_BYTES_ALLOCATED] = { "bytes_allocated", "memory", "B",
        "what the method asked the device for", CASE, LESS, BYTES },
    [FM_METRIC_BYTES_PREDICTED] = { "bytes_predicted", "memory, formula", "B",
        "what the descriptor's formula says", CASE, LESS, BYTES },
    [FM_METRIC_BYTES_USED] = { "bytes_used", "memory, used", "B",
        "bytes of elements that hold something in a frame", CASE, LESS, BYTES },
    [FM_METRIC_BYTES_MOVED] = { "bytes_moved", "bytes moved", "B",
        "bytes of the method's memory that the shaders of a frame load and store, counted in the checked "
        "build, and those that its clear passes fill; an atomic loads and stores its operand. Attachments "
        "of draws are not in it, nor the image. Empty on devices that do not count: all but vulkan",
        CASE, LESS, MEASURED, WHOLE },
    [FM_METRIC_ATOMICS] = { "atomics", "atomics", "", "of those accesses, the atomics", CASE, LESS,
        MEASURED, WHOLE },
    [FM_METRIC_ACCESSES_OUTSIDE] = { "accesses_outside", "accesses out of range", "",
        "of those accesses, the ones of elements that the buffer or image does not have; the message names "
        "it", CASE, LESS, MEASURED, WHOLE },
    [FM_METRIC_N] = { "n", "n", "", "the most fragments of any pixel: of layers as many as the recipe has, else as truth counted", CASE, WHOLE },
    [FM_METRIC_FRAGMENTS_GENERATED] = { "fragments_generated", "fragments", "",
        "all fragments of the scene", CASE, WHOLE },
    [FM_METRIC_FRAGMENTS_ARRIVED] = { "fragments_arrived", "fragments arrived", "",
        "fragments that pass store saw; an occupancy map culled the others", CASE, WHOLE },
    [FM_METRIC_FRAGMENTS_CULLED] = { "fragments_culled", "fragments culled", "",
        "of those, what the method's own test refused", CASE, MEASURED, WHOLE },
    [FM_METRIC_FRAGMENTS_STORED] = { "fragments_stored", "fragments stored", "",
        "fragments that the method handed over", CASE, WHOLE },
    [FM_METRIC_FRAGMENTS_LOST] = { "fragments_lost", "lost", "",
        "fragments that found no room, or ran out of tries for a lock", CASE, LESS, MEASURED, WHOLE },
    [FM_METRIC_NONEMPTY_PIXELS] = { "nonempty_pixels", "covered pixels", "",
        "pixels with at least one fragment", CASE, WHOLE },
    [FM_METRIC_TRUTH_DIGEST] = { "truth_digest", "truth", "",
        "hash of all fragments of the scene in their order, a number of 48 bits: equal for equal truths", CASE, WHOLE },
    [FM_METRIC_DISCARDED_SHARE] = { "discarded_share", "discarded", "",
        "of the fragments beyond the k nearest, the share that was not stored", CASE, MORE, MEASURED, FINITE },
    [FM_METRIC_TAKEN_PER_KEPT] = { "taken_per_kept", "taken per kept", "",
        "fragments that the method took for each that it keeps", CASE, LESS, MEASURED },
    [FM_METRIC_LOCKS_TAKEN] = { "locks_taken", "locks taken", "", "times that a pixel's lock was taken",
        CASE, LESS, MEASURED, WHOLE },
    [FM_METRIC_PIXELS_REPAIRED] = { "pixels_repaired", "repaired pixels", "",
        "pixels in which the method found and repaired what racing fragments had damaged; 0 of methods "
        "that do not look", CASE, MEASURED, WHOLE },
    [FM_METRIC_PIXELS_UNREPAIRED] = { "pixels_unrepaired", "damaged pixels", "",
        "pixels in which the method found damage that it could not repair", CASE, LESS, MEASURED, WHOLE },
    [FM_METRIC_CULL_WORDS] = { "cull_words", "words of the map", "",
        "words of 32 buckets that a pixel of the occupancy map has", CASE, WHOLE },
    [FM_METRIC_K_CHOSEN] = { "k_chosen", "k chosen", "", "the k that the method chose for the frame",
        CASE, WHOLE },
    [FM_METRIC_SCENE_PASSES] = { "scene_passes", "passes over the scene", "",
        "how often a frame draws the scene", CASE, LESS, WHOLE },
    [FM_METRIC_FRAMES_REDONE] = { "frames_redone", "frames redone", "",
        "frames that were run again because a buffer had to grow", CASE, LESS, WHOLE },
    [FM_METRIC_REDONE_MS] = { "redone_ms", "redone", "ms",
        "the passes of all those frames: the cost of growing beside frame_ms", CASE, LESS, TIMED },
    [FM_METRIC_FRAMES_LOSSY] = { "frames_lossy", "lossy frames", "",
        "frames that were run again because a software rasteriser's lock gave up", CASE, LESS, MEASURED, WHOLE },
    [FM_METRIC_MISSING] = { "missing", "missing", "", "wanted fragments that were not captured", CASE,
        LESS, WHOLE },
    [FM_METRIC_EXTRA] = { "extra", "extra", "", "captured fragments that the pixel does not have", CASE,
        LESS, WHOLE },
    [FM_METRIC_MISORDERED] = { "misordered", "misordered", "", "neighbours in the wrong order", CASE,
        LESS, WHOLE },
    [FM_METRIC_DEPTH_ULP_MAX] = { "depth_ulp_max", "depth off", "ulp",
        "the largest distance of a captured depth from its true one, in units in the last place", CASE,
        LESS, WHOLE },
    [FM_METRIC_WRONG_PIXELS] = { "wrong_pixels", "wrong pixels", "",
        "pixels with a missing, extra or misordered fragment", CASE, LESS, WHOLE },
    [FM_METRIC_FRAGMENTS_WANTED] = { "fragments_wanted", "wanted", "",
        "fragments that the method was to hand over: of each pixel all, the k nearest or the nearest", CASE, WHOLE },
    [FM_METRIC_DECLARED_TIES] = { "declared_ties", "ties to lose", "",
        "of those, what the trait loses_ties, or passes_lose_ties, says may be lost: all but one of each pixel and depth", CASE, WHOLE },
    [FM_METRIC_DECLARED_AT_ONE] = { "declared_at_one", "to lose at 1", "",
        "the same of the trait loses_depth_one", CASE, WHOLE },
    [FM_METRIC_LOST_TIES] = { "lost_ties", "ties lost", "",
        "of declared_ties, those that are missing", CASE, LESS, WHOLE },
    [FM_METRIC_LOST_AT_ONE] = { "lost_at_one", "lost at 1", "",
        "of declared_at_one, those that are missing", CASE, LESS, WHOLE },
    [FM_METRIC_TIED_PIXELS] = { "tied_pixels", "tied pixels", "",
        "pixels where wanted fragments of equal depth differ in colour: truth allows every order of them, "
        "and an image's error is its distance to what these orders reach", CASE, WHOLE },
    [FM_METRIC_SELF_MAX_ABS] = { "self_max_abs", "off its fragments", "",
        "the largest distance, of any channel, of the timed image from the captured fragments composited "
        "in double precision, in any order that ties allow", CASE, LESS, ERRORS },
    [FM_METRIC_SELF_BEYOND] = { "self_beyond", "off beyond rounding", "",
        "self_max_abs less what accumulate may round at that pixel; of float32 that is nothing, and 1e-6, or "
        "2^-23 by the root of n if that is more, is rounding still", CASE, LESS, ERRORS },
    [FM_METRIC_RMSE] = { "rmse", "RMSE", "",
        "root mean squared error over all pixels of the viewport and four channels, linear and "
        "premultiplied, against the picture of the fragments that the method is to keep; where depths "
        "tie, against the nearest of all pictures that truth allows; of a sequence over all its frames, "
        "against the baseline's", CASE, LESS, ERRORS },
    [FM_METRIC_PSNR_DB] = { "psnr_db", "PSNR", "dB", "-20 log10 of rmse; inf for equal images", CASE,
        MORE, LEVEL },
    [FM_METRIC_MAX_ABS] = { "max_abs", "largest error", "",
        "the largest error of any channel of any pixel, in any frame of a sequence", CASE, LESS, ERRORS },
    [FM_METRIC_SSIM] = { "ssim", "SSIM", "",
        "structural similarity (Wang et al. 2004): windows of 11 x 11 with a Gaussian of deviation 1.5, "
        "within the image, range 1, biased covariance; mean over windows and the four channels, linear "
        "and premultiplied; in a sequence over all frames; 1 for equal images; none of images that are "
        "smaller than a window", CASE, MORE, LEVEL },
    [FM_METRIC_FLIP] = { "flip", "FLIP", "",
        "what a person sees of the difference when the images are shown in turns, from 0 to 1 "
        "(Andersson et al. 2020), mean over the pixels of the viewport; in front of white, clamped to "
        "[0,1], at 67 pixels per degree (with exposure: not clamped, HDR-FLIP, Andersson et al. 2021); "
        "in a sequence over all frames", CASE, LESS, ERRORS },
    [FM_METRIC_FLIP_MEDIAN] = { "flip_median", "FLIP, weighted median", "",
        "half of the sum of all pixels' FLIP comes from pixels up to this value", CASE, LESS, ERRORS },
    [FM_METRIC_FLIP_P95] = { "flip_p95", "FLIP, 95 %", "", "95 % of the pixels have a FLIP up to this",
        CASE, LESS, ERRORS },
    [FM_METRIC_FLIP_MAX] = { "flip_max", "FLIP, largest", "", "the largest FLIP of any pixel", CASE, LESS,
        ERRORS },
    [FM_METRIC_COVERED_RMSE] = { "covered_rmse", "RMSE, covered", "",
        "rmse over the pixels that have a fragment, instead of all pixels of the viewport", CASE, LESS,
        ERRORS },
    [FM_METRIC_COVERED_PSNR_DB] = { "covered_psnr_db", "PSNR, covered", "dB", "-20 log10 of covered_rmse",
        CASE, MORE, LEVEL },
    [FM_METRIC_COVERED_MAX_ABS] = { "covered_max_abs", "largest error, covered", "",
        "max_abs over the pixels that have a fragment", CASE, LESS, ERRORS },
    [FM_METRIC_COVERED_SSIM] = { "covered_ssim", "SSIM, covered", "",
        "ssim over the windows around pixels that have a fragment", CASE, MORE, LEVEL },
    [FM_METRIC_COVERED_FLIP] = { "covered_flip", "FLIP, covered", "",
        "flip over the pixels that have a fragment", CASE, LESS, ERRORS },
    [FM_METRIC_COVERED_FLIP_MEDIAN] = { "covered_flip_median", "FLIP, weighted median, covered", "",
        "flip_median over the pixels that have a fragment", CASE, LESS, ERRORS },
    [FM_METRIC_COVERED_FLIP_P95] = { "covered_flip_p95", "FLIP, 95 %, covered", "",
        "flip_p95 over the pixels that have a fragment", CASE, LESS, ERRORS },
    [FM_METRIC_COVERED_FLIP_MAX] = { "covered_flip_max", "FLIP, largest, covered", "",
        "flip_max over the pixels that have a fragment", CASE, LESS, ERRORS },
    [FM_METRIC_TRUNCATION_RMSE] = { "truncation_rmse", "truncation", "",
        "rmse of the fragments that the method is to keep (the k nearest; the nearest; all: 0) against all "
        "of them: what keeping only k costs, however well the method does it", CASE, LESS, ERRORS },
    [FM_METRIC_TOTAL_RMSE] = { "total_rmse", "total", "",
        "rmse of the image against the picture of all fragments", CASE, LESS, ERRORS },
    [FM_METRIC_TOTAL_MAX_ABS] = { "total_max_abs", "total, largest error", "",
        "max_abs of the image against the picture of all fragments", CASE, LESS, ERRORS },
    [FM_METRIC_TOTAL_SSIM] = { "total_ssim", "total, SSIM", "",
        "ssim of the image against the picture of all fragments", CASE, MORE, LEVEL },
    [FM_METRIC_TOTAL_FLIP] = { "total_flip", "total, FLIP", "",
        "flip of the image against the picture of all fragments", CASE, LESS, ERRORS },
    [FM_METRIC_DISTINCT_IMAGES] = { "distinct_images", "distinct images", "",
        "how many different images all timed frames drew, of all launches", SUMMARY, LESS, MEASURED, WHOLE },
    [FM_METRIC_FRAMES_DRAWN] = { "frames_drawn", "frames drawn", "",
        "timed frames of all launches, at full clock or not: what distinct_images counts of", SUMMARY,
        MEASURED, WHOLE },
    [FM_METRIC_FRAMES_RMSE_MAX] = { "frames_rmse_max", "RMSE, worst frame", "",
        "the largest rmse of any timed frame's image; rmse is of one frame, the last of launch 0. Of a "
        "launch: of its images that no launch before drew, none where there is no such; of the case: of "
        "all timed frames of all launches", LAUNCH, LESS, MEASURED, ERRORS },
    [FM_METRIC_FRAMES_MAX_ABS] = { "frames_max_abs", "largest error, worst frame", "",
        "the largest max_abs of the same images", LAUNCH, LESS, MEASURED, ERRORS },
    [FM_METRIC_FRAMES_TOTAL_RMSE_MAX] = { "frames_total_rmse_max", "total, worst frame", "",
        "the largest total_rmse of the same images", LAUNCH, LESS, MEASURED, ERRORS },
    [FM_METRIC_CAPTURED_FRAMES] = { "captured_frames", "captured frames", "",
        "frames of launch 0, beside the timed ones, whose fragments were captured: 4 if the method is "
        "declared racy, or if the launch's timed frames drew different images; else 1. missing, extra and "
        "misordered are of the first; where loops make a method draw anew for each 64 MiB of fragments, "
        "each is put together of several frames", CASE, WHOLE },
    [FM_METRIC_DISTINCT_FRAGMENTS] = { "distinct_fragments", "distinct fragments", "",
        "how many of the captured frames differ from all before in the fragments of any pixel: their "
        "number, depths or colours; in which order they were handed over does not count", CASE, LESS,
        MEASURED, WHOLE },
    [FM_METRIC_MISSING_MAX] = { "missing_max", "missing, worst frame", "",
        "the largest missing of the captured frames", CASE, LESS, MEASURED, WHOLE },
    [FM_METRIC_IMAGE_ULP_MAX] = { "image_ulp_max", "rounding", "ulp",
        "self_max_abs in units in the last place of the format that accumulate names, at the value in "
        "double precision, the largest of all channels; an alpha's unit is that of the larger of alpha "
        "and 1 - alpha", CASE, LESS, ERRORS },
    [FM_METRIC_TIMES_FLOOR] = { "times_floor", "x floor", "",
        "store_ms over floor_store_ms of the same launch, median of the launches (timers=frame: of frames)", SUMMARY, LESS,
        TIMED },
    [FM_METRIC_FRAGMENTS_PER_S] = { "fragments_per_s", "fragments/s", "1/s",
        "fragments_generated over frame_ms", SUMMARY, MORE, TIMED },
    [FM_METRIC_BOUND_MS] = { "bound_ms", "bound", "ms",
        "the least time for the case on this device: floor_frame_ms, or what copying (8 "
        "fragments_generated + 16 fragments_wanted + 16 pixels) bytes takes at device_bytes_per_s if "
        "that is longer; launch by launch, their median", SUMMARY, LESS, TIMED },
    [FM_METRIC_TIMES_BOUND] = { "times_bound", "x bound", "",
        "frame_ms over bound_ms of the same launch, median of the launches", SUMMARY, LESS, TIMED },
    [FM_METRIC_DEVICE_BYTES_PER_S] = { "device_bytes_per_s", "device, bytes", "B/s",
        "bytes that the device reads and writes in a second when it copies large buffers, as `fragmark "
        "calibrate device` measured it; empty without", SUMMARY, MORE, MEASURED },
    [FM_METRIC_DEVICE_ATOMICS_PER_S] = { "device_atomics_per_s", "device, atomics", "1/s",
        "atomics of 32 bits that it does in a second if each invocation has a word of its own; the same",
        SUMMARY, MORE, MEASURED },
    [FM_METRIC_DEVICE_FRAGMENTS_PER_S] = { "device_fragments_per_s", "device, fragments", "1/s",
        "fragments of flat layers that it rasterises in a second for the floor; the same", SUMMARY,
        MORE, MEASURED },
    [FM_METRIC_LAUNCHES] = { "launches", "launches", "", "processes that measured the case", SUMMARY, WHOLE },
    [FM_METRIC_SAMPLES] = { "samples", "samples", "", "timed frames that count, of all launches",
        SUMMARY, MEASURED, WHOLE },
    [FM_METRIC_FPS] = { "fps", "frames per second", "1/s", "1000 over frame_ms", REPORT, MORE, TIMED },
    [FM_METRIC_MIB] = { "mib", "memory", "MiB", "bytes_allocated over 2^20", REPORT, LESS },
    [FM_METRIC_FPS_PER_MIB] = { "fps_per_mib", "frames per second and MiB", "1/(s MiB)", "fps over mib",
        REPORT, MORE, TIMED },
    [FM_METRIC_CYCLES] = { "cycles", "cycles", "",
        "modelled cycles of all frames but the first", CASE, LESS },
    [FM_METRIC_ENERGY_NJ] = { "energy_nj", "energy", "nJ",
        "modelled energy of all frames but the first", CASE, LESS },
    [FM_METRIC_WRONG_TILES] = { "wrong_tiles", "wrong tiles", "",
        "tiles, of all frames, whose colours are not the baseline's", CASE, LESS, WHOLE },
    [FM_METRIC_WRONG_FRAMES] = { "wrong_frames", "wrong frames", "", "frames with such a tile", CASE,
        LESS, WHOLE },
    [FM_METRIC_SIMULATED_RATE] = { "simulated_fragments_per_core_s", "simulated", "1/s",
        "fragments that a core of the host simulates in a second", CASE, MORE, TIMED },
    [FM_METRIC_FRAME_CYCLES] = { "frame.cycles", "cycles of a frame", "", "modelled cycles", FRAME,
        LESS },
    [FM_METRIC_FRAME_ENERGY_NJ] = { "frame.energy_nj", "energy of a frame", "nJ", "modelled energy",
        FRAME, LESS },
    [FM_METRIC_FRAME_TILES_SKIPPED] = { "frame.tiles_skipped", "tiles skipped in a frame", "",
        "tiles that kept their colours", FRAME, MORE, WHOLE },
    [FM_METRIC_FRAME_FRAGMENTS_SHADED] = { "frame.fragments_shaded", "fragments shaded in a frame", "",
        "fragments that were shaded", FRAME, LESS, WHOLE },
    [FM_METRIC_FRAME_WRONG_TILES] = { "frame.wrong_tiles", "wrong tiles in a frame", "",
        "tiles whose colours are not the baseline's", FRAME, LESS, WHOLE },
    [FM_METRIC_LAUNCH_CPU_S] = { "launch_cpu_s", "processor time of the launch", "s",
        "user and system time of the launch's process", LAUNCH, LESS, TIMED },
    [FM_METRIC_TIMED_S] = { "timed_s", "timed part", "s",
        "how long the timed frames took, the floor's too, by the host's clock", LAUNCH, LESS, TIMED },
    [FM_METRIC_TIMED_CPU_S] = { "timed_cpu_s", "processor time of the timed part", "s",
        "user and system time of the process meanwhile", LAUNCH, LESS, TIMED },
    [FM_METRIC_WAITED_S] = { "waited_s", "waited for a processor", "s",
        "how long, in sum, threads of the process stood ready meanwhile and had no processor", LAUNCH,
        LESS, TIMED },
    [FM_METRIC_OTHERS_CPU_S] = { "others_cpu_s", "processor time of others", "s",
        "what all other processes used meanwhile, and what a hypervisor took", LAUNCH, LESS, TIMED },
    [FM_METRIC_INVOLUNTARY_SWITCHES] = { "involuntary_switches", "involuntary switches", "",
        "how often a thread of the process lost its processor meanwhile", LAUNCH, LESS, MEASURED, WHOLE },
    [FM_METRIC_LOAD_BEGIN] = { "load_begin", "load before", "",
        "load average of the last minute before the timed frames: threads that ran or were ready",
        LAUNCH, LESS, MEASURED },
    [FM_METRIC_LOAD_END] = { "load_end", "load after", "", "the same after them", LAUNCH, LESS, MEASURED },
    [FM_METRIC_THROTTLED_S] = { "throttled_s", "throttled", "s",
        "how long the control group's limit stopped its processes meanwhile", LAUNCH, LESS, TIMED },
    [FM_METRIC_THERMAL_EVENTS] = { "thermal_events", "thermal events", "",
        "how often a processor was slowed down for heat meanwhile", LAUNCH, LESS, MEASURED, WHOLE },
    [FM_METRIC_CLOCK_SHARE] = { "clock_share", "share of the clock", "",
        "clock of the slowest processor over the highest, after the timed frames", LAUNCH, MORE,
        MEASURED },
};

const fm_metric_family fm_metric_families[FM_METRIC_FAMILY_COUNT] = {
    { "pass.", "_ms", { "pass.NAME_ms", "pass NAME", "ms", "a pass of the method's own", FRAME, LESS,
        TIMED } },
    { "moved.", "_b", { "moved.RESOURCE_b", "bytes moved, RESOURCE", "B",
        "bytes_moved of one buffer or image of the method, or of its locks (fm_locks)", CASE, LESS,
        MEASURED, WHOLE } },
    { "launch.", "_ms", { "launch.PART_ms", "launch, PART", "ms", "where a launch's time goes, by the "
        "host's clock: start (loading the program, by processor time; plugins, device), scene (scene and truth "
        "loaded), compile (GLSL and pipelines; what a driver compiles at a first frame is warmup's and floor's), "
        "warmup, frames (the method's), floor (all frames of the floor), images (hashing and comparing them), "
        "check (capturing and comparing fragments), errors (of the checked image), end (writing images)",
        LAUNCH, LESS, TIMED } },
    { "energy_corner.", "_nj", { "energy_corner.CORNER_nj", "energy at CORNER", "nJ",
        "modelled energy with every uncertain parameter at one end of its range", CASE, LESS } },
    { "energy.", "_nj", { "energy.PART_nj", "energy, PART", "nJ", "modelled energy of a part of the GPU",
        CASE, LESS } },
    { "cycles.", "", { "cycles.PART", "cycles, PART", "",
        "modelled cycles of a part, or with one parameter at an end of its range", CASE, LESS } },
    { "", "_low", { "METRIC_low", "METRIC, low", "",
        "lower end of the 95 % interval of METRIC, by launches; empty with one launch", SUMMARY, TIMED } },
    { "", "_high", { "METRIC_high", "METRIC, high", "", "upper end of it", SUMMARY, TIMED } },
};
/* clang-format on */

bool metric_find(fm_metric *metric, const char *name)
{
    for (int i = 0; i < FM_METRIC_COUNT; i++) {
        if (strcmp(fm_metrics[i].name, name) != 0)
            continue;
        *metric = (fm_metric)i;
        return true;
    }
    return false;
}

bool metric_in_range(fm_metric_range range, double value)
{
    const fm_range *of = &fm_ranges[range];
    if (isnan(value))
        return of->may_be_none;
    return value >= of->least && value <= of->most && (!of->is_whole || fmod(value, 1.0) == 0.0);
}

/* What is before the ending of an interval's end is a metric. */
static bool is_metric(const char *name, size_t length)
{
    for (int i = 0; i < FM_METRIC_COUNT; i++)
        if (strlen(fm_metrics[i].name) == length && strncmp(fm_metrics[i].name, name, length) == 0)
            return true;
    return false;
}

static bool is_of_family(const fm_metric_family *family, const char *name)
{
    const size_t prefix = strlen(family->prefix), suffix = strlen(family->suffix);
    const size_t length = strlen(name);
    return length > prefix + suffix && strncmp(name, family->prefix, prefix) == 0 &&
           strcmp(name + length - suffix, family->suffix) == 0 &&
           (prefix > 0 || is_metric(name, length - suffix));
}

const fm_metric_info *metric_describe(const char *name)
{
    fm_metric metric;
    if (metric_find(&metric, name))
        return &fm_metrics[metric];
    for (size_t i = 0; i < FM_METRIC_FAMILY_COUNT; i++)
        if (is_of_family(&fm_metric_families[i], name))
            return &fm_metric_families[i].info;
    return NULL;
}

bool metric_is_time(const char *name)
{
    const fm_metric_info *info = metric_describe(name);
    return info != NULL && info->is_timed;
}
