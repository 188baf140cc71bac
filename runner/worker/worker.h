/* A launch: one process that measures one case and the floor, and answers on a file.
 *
 * The parent executes `fragmark worker REQUEST.json RESULT.json`. The request:
 *   { "job": "measure" | "truth",
 *     "plugin": "path of the method's .so", "floor": "path of the floor's .so",
 *     "common": "folder of the runner's GLSL",
 *     "device": "vulkan:0", "validation": false, "no_timers": false,
 *     "feed": "raster",
 *     "settings": { "k": "8", ... }      every key of fm_keys, as text
 *     "options": { "layout": "layer" },  the method's own, only those given
 *     "truth": "path of the truth file", "launch": 0,
 *     "check": true,                     capture and compare all fragments
 *     "image": "path to write the image to, or empty" }
 * The result, written at the end; a worker that dies leaves none:
 *   { "status": "ok" | "not_supported" | "wrong_image" | "out_of_memory" | "device_lost" |
 *               "plugin_error",
 *     "message": "",
 *     "device_name": "...", "device_driver": "...", "device_api": "...", "has_gpu_clock": false,
 *     "is_software": true,
 *     "modelled": { "scene": [...], "passes": [...], "buffers": [...] },     names
 *     "image_hash": "16 hex digits",
 *     "metrics": { "n": 128, "bytes_allocated": ..., ... }   one number a case
 *     "samples": [ { "frame": 0, "metric": "store_ms", "value": 1.25, "unit": "ms" }, ... ] }
 * Metrics of a case: n, bytes_allocated, bytes_predicted, bytes_used, fragments_generated,
 *   fragments_stored, fragments_lost, frames_redone, frames_lossy, fragments_culled, locks_taken;
 *   fragments_arrived (at pass `store`; the others an occupancy map culled; these counts not in the
 *   feed triangles, where nothing arrives), cull_words; of methods that keep the k nearest
 *   discarded_share (of the fragments beyond those, what was not stored) and taken_per_kept;
 *   redone_ms, the passes of all frames thrown away because something had to grow: what a growing
 *   method costs beside frame_ms; scene_passes, of one frame; k_chosen, where the method chooses k;
 * and with "check": missing, extra, misordered, depth_ulp_max, wrong_pixels, nonempty_pixels,
 *   self_max_abs (timed image against its own fragments, where ties do not leave their order open),
 *   rmse, psnr_db ("inf" for equal images), max_abs, ssim, truncation_rmse, total_rmse (against the
 *   picture of all fragments).
 * Metrics of samples (ms): frame_ms, frame_wall_ms, clear_ms, count_ms, reference_ms, store_ms,
 *   resolve_ms, pass.NAME_ms for other passes; culling_ms, those that make the map; floor_store_ms,
 *   floor_frame_ms; canary_ns. With timers=frame only frame_ms, frame_wall_ms, floor_frame_ms and
 *   canary_ns.
 * A "truth" job writes the truth file and answers status, message and metrics n,
 *   fragments_generated, nonempty_pixels. */
#ifndef FM_WORKER_H
#define FM_WORKER_H

#include "base/error.h"

/* The whole life of a worker process. Returns its exit status: 0 when RESULT was written. */
int worker_main(const char *request_path, const char *result_path);

#endif
