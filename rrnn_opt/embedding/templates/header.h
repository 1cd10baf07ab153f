/* ${prefix}: ${title}
 *
 * Written by rrnn_opt ${version} from the model
 * ${hash}.
 * Do not edit: generate it again.
 *
 * No globals, no allocation, no input or output; every call is re-entrant and
 * works on the caller's structs only, which must not overlap.
 */
#ifndef ${PREFIX}_H
#define ${PREFIX}_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef ${real} ${prefix}_real_t;

/* Euler steps of the network in one call of ${prefix}_step. */
#define ${PREFIX}_STEPS ${steps}
${step_macro}
typedef enum {
    ${PREFIX}_OK = 0,
    ${PREFIX}_NOT_FINITE = 1,    /* an argument is NaN or infinite */
    ${PREFIX}_BAD_STEP_SIZE = 2, /* not positive */
    ${PREFIX}_EMPTY_LIMITS = 3,  /* a lower limit exceeds its upper limit */
    ${PREFIX}_DIVERGED = 4       /* the result is not finite: too large a step or angle */
} ${prefix}_status_t;

/* What is fixed for a run. */
typedef struct {
    ${prefix}_real_t step_size; /* Euler step of the network [s] */
} ${prefix}_param_t;

/* The network's memory; owned by the caller, written by init and step only. */
typedef struct {
${state_fields}
    ${prefix}_real_t step_size; /* copy of the parameter [s] */
    uint32_t tick; /* calls of step that succeeded, modulo 2^32 */
} ${prefix}_state_t;

/* What is measured or wanted, one struct a call. */
typedef struct {
${in_fields}
} ${prefix}_in_t;

/* What the robot is told. */
typedef struct {
${out_fields}
    ${prefix}_real_t residual; /* largest KKT residual before the last step; 0 at the optimum */
} ${prefix}_out_t;

/* Check the parameters and put the network at rest (state 0).
 * On failure the state is left as it was. */
${prefix}_status_t ${prefix}_init(${prefix}_state_t *state, const ${prefix}_param_t *param);

/* ${PREFIX}_STEPS Euler steps. On failure state and output are left as they were:
 * stop the robot, or go on with the last output, as the application demands. */
${prefix}_status_t ${prefix}_step(${prefix}_state_t *state, const ${prefix}_in_t *in,
                                  ${prefix}_out_t *out);

/* Fingerprint of the model, as in MANIFEST.json. */
const char *${prefix}_model_hash(void);

#ifdef __cplusplus
}
#endif

#endif
