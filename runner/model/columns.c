#include "columns.h"

#include <string.h>

#define FACT(id)                                                                                   \
    {                                                                                              \
        .kind = FM_COLUMN_FACT, .fact = FM_FACT_##id                                               \
    }
#define KEY(key)                                                                                   \
    {                                                                                              \
        .kind = FM_COLUMN_KEY, .name = key                                                         \
    }
#define METRIC(id)                                                                                 \
    {                                                                                              \
        .kind = FM_COLUMN_METRIC, .metric = FM_METRIC_##id                                         \
    }
#define ENDS(id, title)                                                                            \
    { .kind = FM_COLUMN_LOW, .name = title "_low", .metric = FM_METRIC_##id },                     \
    {                                                                                              \
        .kind = FM_COLUMN_HIGH, .name = title "_high", .metric = FM_METRIC_##id                    \
    }

/* clang-format off */
const fm_column fm_columns[] = {
    FACT(SCHEMA),
    FACT(CASE_ID),
    FACT(STATUS),
    FACT(MESSAGE),
    FACT(METHOD),
    FACT(METHOD_VERSION),
    FACT(DEVICE),
    FACT(DEVICE_NAME),
    FACT(FEED),
    FACT(SCENE),
    KEY("width_px"),
    KEY("height_px"),
    METRIC(N),
    KEY("k"),
    KEY("r"),
    KEY("pixel_density"),
    KEY("fragment_probability"),
    KEY("tessellation"),
    KEY("order"),
    KEY("seed"),
    FACT(OPTIONS),
    METRIC(LAUNCHES),
    METRIC(SAMPLES),
    METRIC(FRAME_MS),
    ENDS(FRAME_MS, "frame_ms"),
    METRIC(CLEAR_MS),
    METRIC(COUNT_MS),
    METRIC(REFERENCE_MS),
    METRIC(STORE_MS),
    METRIC(RESOLVE_MS),
    METRIC(TIMES_FLOOR),
    METRIC(BYTES_ALLOCATED),
    METRIC(BYTES_PREDICTED),
    METRIC(BYTES_USED),
    METRIC(FRAGMENTS_GENERATED),
    METRIC(FRAGMENTS_STORED),
    METRIC(FRAGMENTS_LOST),
    METRIC(MISSING),
    METRIC(EXTRA),
    METRIC(MISORDERED),
    METRIC(DEPTH_ULP_MAX),
    METRIC(RMSE),
    METRIC(PSNR_DB),
    METRIC(MAX_ABS),
    METRIC(SSIM),
    METRIC(FLIP),
    METRIC(TRUNCATION_RMSE),
    METRIC(DISTINCT_IMAGES),
    METRIC(FRAME_WALL_MS),
    METRIC(FRAGMENTS_PER_S),
    METRIC(TIED_PIXELS),
    METRIC(WRONG_TILES),
    ENDS(CLEAR_MS, "clear_ms"),
    ENDS(COUNT_MS, "count_ms"),
    ENDS(REFERENCE_MS, "reference_ms"),
    ENDS(STORE_MS, "store_ms"),
    ENDS(RESOLVE_MS, "resolve_ms"),
    ENDS(TIMES_FLOOR, "times_floor"),
    ENDS(FRAME_WALL_MS, "frame_wall_ms"),
    ENDS(FRAGMENTS_PER_S, "fragments_per_s"),
    FACT(NOISY),
    FACT(CODE_PROGRAM),
    FACT(CODE_DRIVER),
    FACT(CODE_PLUGIN),
    FACT(CODE_SHADERS),
    METRIC(COVERED_RMSE),
    METRIC(COVERED_PSNR_DB),
    METRIC(COVERED_MAX_ABS),
    METRIC(COVERED_SSIM),
    METRIC(FLIP_MEDIAN),
    METRIC(FLIP_P95),
    METRIC(FLIP_MAX),
    METRIC(COVERED_FLIP),
    METRIC(COVERED_FLIP_MEDIAN),
    METRIC(COVERED_FLIP_P95),
    METRIC(COVERED_FLIP_MAX),
    METRIC(TOTAL_RMSE),
    METRIC(TOTAL_MAX_ABS),
    METRIC(TOTAL_SSIM),
    METRIC(TOTAL_FLIP),
    METRIC(FRAGMENTS_WANTED),
    METRIC(DECLARED_TIES),
    METRIC(DECLARED_AT_ONE),
    METRIC(LOST_TIES),
    METRIC(LOST_AT_ONE),
    METRIC(SELF_MAX_ABS),
    METRIC(SELF_BEYOND),
    METRIC(FRAMES_DRAWN),
    METRIC(FRAMES_RMSE_MAX),
    METRIC(FRAMES_MAX_ABS),
    METRIC(FRAMES_TOTAL_RMSE_MAX),
    METRIC(CAPTURED_FRAMES),
    METRIC(DISTINCT_FRAGMENTS),
    METRIC(MISSING_MAX),
    FACT(REASON),
    METRIC(BYTES_MOVED),
    METRIC(ATOMICS),
    METRIC(BOUND_MS),
    ENDS(BOUND_MS, "bound_ms"),
    METRIC(TIMES_BOUND),
    ENDS(TIMES_BOUND, "times_bound"),
    FACT(LIMITED_BY),
    METRIC(DEVICE_BYTES_PER_S),
    METRIC(DEVICE_ATOMICS_PER_S),
    METRIC(DEVICE_FRAGMENTS_PER_S),
};
/* clang-format on */
_Static_assert(sizeof fm_columns / sizeof fm_columns[0] == FM_COLUMN_COUNT, "FM_COLUMN_COUNT");

static const char *const fact_name[] = {
    [FM_FACT_SCHEMA] = "schema",
    [FM_FACT_CASE_ID] = "case_id",
    [FM_FACT_STATUS] = "status",
    [FM_FACT_MESSAGE] = "message",
    [FM_FACT_METHOD] = "method",
    [FM_FACT_METHOD_VERSION] = "method_version",
    [FM_FACT_DEVICE] = "device",
    [FM_FACT_DEVICE_NAME] = "device_name",
    [FM_FACT_FEED] = "feed",
    [FM_FACT_SCENE] = "scene",
    [FM_FACT_OPTIONS] = "options",
    [FM_FACT_NOISY] = "noisy",
    [FM_FACT_CODE_PROGRAM] = "code_program",
    [FM_FACT_CODE_DRIVER] = "code_driver",
    [FM_FACT_CODE_PLUGIN] = "code_plugin",
    [FM_FACT_CODE_SHADERS] = "code_shaders",
    [FM_FACT_REASON] = "reason",
    [FM_FACT_LIMITED_BY] = "limited_by",
};
_Static_assert(sizeof fact_name / sizeof fact_name[0] == FM_FACT_COUNT, "one name a fact");

const char *column_name(const fm_column *column)
{
    switch (column->kind) {
    case FM_COLUMN_FACT:
        return fact_name[column->fact];
    case FM_COLUMN_KEY:
    case FM_COLUMN_LOW:
    case FM_COLUMN_HIGH:
        return column->name;
    case FM_COLUMN_METRIC:
        break;
    }
    return fm_metrics[column->metric].name;
}

bool summary_has_column(const char *name)
{
    for (size_t i = 0; i < FM_COLUMN_COUNT; i++)
        if (strcmp(column_name(&fm_columns[i]), name) == 0)
            return true;
    return false;
}
