/* One case in one process: warm-up, timed frames with the floor's between, then the check of every
 * fragment. */
#ifndef FM_MEASURE_H
#define FM_MEASURE_H

#include "host_load.h"
#include "image/image_error.h"
#include "image/image_range.h"
#include "instance/instance.h"
#include "parts.h"
#include "truth/check.h"
#include "truth/truth.h"

/* A frame over this is sampled twice only. */
#define MEASURE_LONG_FRAME_NS 2000000000ull

/* Frames whose fragments are captured of a method that is declared racy, or whose timed frames drew
 * different images. Of others it is one. */
enum { MEASURE_CAPTURES = 4 };

/* A timed frame of the method, and the frame of the floor that ran beside it. */
typedef struct fm_sample {
    uint64_t pass_ns[FM_MAX_PASSES]; /* with timers=frame 0, as floor_store_ns */
    uint64_t frame_ns;               /* of all passes together */
    uint64_t wall_ns;
    uint64_t cpu_ns; /* of all threads of the process */
    uint64_t canary_ns;
    uint64_t floor_store_ns, floor_frame_ns;
} fm_sample;

/* What a frame did with one of the method's resources. */
typedef struct fm_resource_accesses {
    char name[64]; /* or "fm_locks" */
    fm_accesses counts;
} fm_resource_accesses;

typedef struct fm_measurement {
    fm_sample *samples; /* [sample_count]; owned */
    uint32_t sample_count;
    bool is_floors;          /* what failed was the floor, not the method */
    bool is_long;            /* a frame took over MEASURE_LONG_FRAME_NS: two samples only */
    fm_host_load begin, end; /* around the timed frames */
    uint64_t bytes_allocated, bytes_predicted, bytes_used;
    uint64_t lost;
    uint32_t scene_passes;  /* of the last timed frame */
    uint32_t k_chosen;      /* where the method chooses its k; 0: it does not */
    uint64_t frames_redone; /* because something had to grow; warm-up and check included */
    uint64_t redone_ns;     /* of the passes of the frames that were thrown away for it */
    bool gave_up;           /* a frame was lossy in all its tries there */
    uint64_t frames_lossy;  /* run again on a software rasteriser, since a lock gave up */
    fm_image *image;        /* of the last timed frame, once it is checked exposed; owned */
    uint64_t *image_hashes; /* [distinct_images], of all timed frames, by the device; owned */
    uint32_t distinct_images;
    /* Of an exact method where depths tie: the largest distance of any timed frame's image from
     * what truth allows, beyond what the case rounds (truth/reference.h). */
    double frames_beyond;
    bool may_differ; /* it is such a method: its frames may draw different images */
    /* Of the images of timed frames that were not known: the worst, and what they reach, exposed.
     * range is of no image where a checked launch drew one alone: it is `image`. */
    fm_worst_error frames_worst;
    fm_image_range range; /* owned */
    bool has_new_images;  /* else these are of none */

    /* checked launches only */
    bool is_checked;
    fm_check check;       /* of the first captured frame */
    fm_check worst_check; /* of the one with the most faults (check_faults) */
    uint32_t captured_frames, distinct_fragments;
    uint64_t missing_max;             /* of any captured frame */
    uint64_t culled, locked, arrived; /* as of a frame: fm_frame_result */
    uint64_t repaired, unrepaired;    /* pixels, as of a frame */
    fm_resource_accesses *accesses;   /* [accesses_count], of the first captured frame; owned. None
                                         where the device does not count, or `uncounted` says why */
    size_t accesses_count;
    char uncounted[256];
    /* Timed image against its own fragments composited in double; where a tie leaves their order
     * open, against what that allows (truth/reference.h), as in all that follows. */
    double self_max_abs;
    /* The same beyond what the case rounds (truth/rounding.h), and how much that is there. */
    double self_beyond, self_bound;
    double image_ulp_max;       /* self_max_abs in ulps of what the case accumulates in */
    uint64_t tied_pixels;       /* where such ties are among the wanted fragments */
    fm_image_error error;       /* against the picture of the fragments that it was to hand over */
    double truncation_rmse;     /* of that picture against the picture of all fragments */
    fm_image_error total_error; /* of the image against the picture of all fragments */
    fm_image *truth_image;      /* the nearest that truth allows; owned */
} fm_measurement;

typedef struct fm_measure_desc {
    const fm_instance_desc *method; /* its is_capture and capture_slots are set here */
    const fm_instance_desc *floor;
    const fm_truth *truth;
    uint32_t frames, warmup;
    bool check;
    const uint64_t *known_images; /* [known_count]: hashes of images that earlier launches drew and
                                     compared; they are not compared again */
    size_t known_count;
    launch_parts *parts; /* NULL: nobody asks */
    const char *keep;    /* file for the captured fragments (truth/kept_file.h); NULL or "": none */
} fm_measure_desc;

/* Fragments of a pixel that truth wants of a method: UINT32_MAX means all. */
uint32_t measure_wanted(const fm_method_desc *method, uint32_t k);
/* Fragments of a pixel that it has places for, as truth_kept counts them: 0 means all. */
uint32_t measure_places(const fm_method_desc *method, uint32_t k);

/* Of all resources together. */
fm_accesses measure_accesses(const fm_measurement *measurement);

/* FM_IO with is_own: the fragments cannot be kept. */
fm_status measure_case(fm_measurement *measurement, const fm_measure_desc *desc, fm_error *err);
void measurement_free(fm_measurement *measurement);

#endif
