/* handeye: where the camera sits on the robot, and how sure that is.
 *
 * Text is UTF-8 and ends with a zero. Lengths are metres, but where a name ends in _mm. Matrices are 4 x 4, row by
 * row. Every function may be called from any thread. Answers are JSON, those of the program `handeye --json`; whoever
 * gets one gives it back with handeye_free.
 *
 * Link with -lhandeye_c. */
#ifndef HANDEYE_H
#define HANDEYE_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    HANDEYE_ACCEPTED = 0,     /* an answer, and it can be used */
    HANDEYE_UNUSABLE = 1,     /* the input cannot be used: {"error": {"code", "message", "file", "line", "capture"}} */
    HANDEYE_WRONG_CALL = 2,   /* a null pointer, an unknown name, text that is no UTF-8: {"error": ...} */
    HANDEYE_NOT_ACCEPTED = 3, /* an answer or none, rejected or undetermined; the JSON says why */
    HANDEYE_FAILED = 4        /* a fault of this library; please report it with its data */
} handeye_status;

/* The library's version, such as "0.1.0"; not to be freed. */
const char *handeye_version(void);

/* Gives back an answer. NULL is fine. */
void handeye_free(char *answer);

/* Calibrates from poses: `poses_json` is what `handeye solve` reads,
 * {"setup": "eye-in-hand", "pairs": [{"base_from_flange": {...}, "camera_from_target": {...}}, ...]}.
 * `method` is a published method to run as published, or NULL. */
handeye_status handeye_solve(const char *poses_json, const char *method, char **answer);

/* Calibrates a folder with its manifest (or the manifest itself). `root` is where the captures lie, or NULL where they
 * lie beside the manifest. `out` is where calibration.json and report.html are written, or NULL. */
handeye_status handeye_calibrate(const char *dataset, const char *root, const char *out, char **answer);

/* Points of a scan: x y z of each, m; NaN where nothing was seen. Those of a camera's grid row by row, `height` rows of
 * `width`; of a cloud in any order `height` is 1. */
typedef struct {
    const float *points;
    size_t width;
    size_t height;
} handeye_scan;

/* Where `source` lies in `target`. `target_from_source` is a start that is right to some centimetres and 10 degrees,
 * or NULL where both lie as they are. `options_json` is NULL or any of
 * {"method": "symmetric", "max_distance_mm": 50, "max_iterations": 60, "global": false, "threads": 1}. */
handeye_status handeye_register(const handeye_scan *source, const handeye_scan *target,
                                const double *target_from_source, const char *options_json, char **answer);

/* One published method and nothing else, in microseconds: `count` matrices of each pose in, `mount_from_camera` and
 * `anchor_from_target` out. `setup` is "eye-in-hand" or "eye-to-hand"; `method` is "shah", "park-martin", ...
 * On failure `error` gets JSON, else NULL; it may be NULL itself. */
handeye_status handeye_closed_form(const char *setup, const char *method, size_t count, const double *base_from_flange,
                                   const double *camera_from_target, double mount_from_camera[16],
                                   double anchor_from_target[16], char **error);

/* Poses of a robot whose error depends on its pose, corrected: `calibration_json` is a calibration.json whose data offer
 * that, `base_from_flange` `count` matrices. With `reported` 0 they are where the flange should be, computed with the
 * transform of the calibration, and `corrected` (`count` matrices) is where to send the robot; otherwise they are what
 * the robot reported, and `corrected` is where its flange was. `sigma_m` takes `count` standard deviations of the
 * flange's position per axis (m), or is NULL. HANDEYE_NOT_ACCEPTED where nothing is offered; `error` gets JSON then and
 * on failure, else NULL; it may be NULL itself. */
handeye_status handeye_compensate(const char *calibration_json, int reported, size_t count,
                                  const double *base_from_flange, double *corrected, double *sigma_m, char **error);

#ifdef __cplusplus
}
#endif

#endif
