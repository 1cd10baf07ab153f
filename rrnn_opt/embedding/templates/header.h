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
/* Elements of state and output; bounds and inequality rows that are watched. */
#define ${PREFIX}_N_STATE ${n_state}
#define ${PREFIX}_N_OUTPUT ${n_output}
#define ${PREFIX}_N_BOUNDS ${n_bounds}
#define ${PREFIX}_N_ROWS ${n_rows}
/* Norm of all inputs together that is still accepted. */
#define ${PREFIX}_LARGEST ${extent}
/* KKT residual that is suggested as param.tolerance. */
#define ${PREFIX}_TOLERANCE ${tolerance}
/* Whether the exact solver stands behind the network. */
#define ${PREFIX}_HAS_FALLBACK ${has_fallback}
${step_macro}
typedef enum {
    ${PREFIX}_OK = 0,
    ${PREFIX}_NOT_FINITE = 1,    /* an argument is NaN or infinite */
    ${PREFIX}_BAD_STEP_SIZE = 2, /* not positive */
    ${PREFIX}_EMPTY_LIMITS = 3,  /* a lower limit exceeds its upper limit */
    ${PREFIX}_DIVERGED = 4,      /* state or result not finite: too large a step */
    ${PREFIX}_OUT_OF_RANGE = 5,  /* finite inputs beyond ${PREFIX}_LARGEST */
    ${PREFIX}_STEP_TOO_LONG = 6, /* step size above ${PREFIX}_LONGEST_STEP */
    ${PREFIX}_BAD_TOLERANCE = 7, /* negative */
    ${PREFIX}_INFEASIBLE = 8,    /* fallback: the rows contradict each other */
    ${PREFIX}_NO_ANSWER = 9      /* fallback: its iterations were not enough */
} ${prefix}_status_t;

/* Bits of a verdict. */
#define ${PREFIX}_RESIDUAL_LARGE 1U /* KKT residual above the tolerance */
#define ${PREFIX}_MERIT_ROSE 2U     /* V is larger than it was */
#define ${PREFIX}_BOUND_ACTIVE 4U   /* an output is at its bound (monitor) */
#define ${PREFIX}_ROW_ACTIVE 8U     /* an inequality row is active (monitor) */
#define ${PREFIX}_FELL_BACK 16U     /* the output is the exact solver's (step) */

/* What is fixed for a run. */
typedef struct {
    ${prefix}_real_t step_size; /* Euler step of the network [s] */
    ${prefix}_real_t tolerance; /* KKT residual above which the fallback answers [1] */
} ${prefix}_param_t;

/* The network's memory; owned by the caller, written by init and step only. */
typedef struct {
${state_fields}
    ${prefix}_real_t step_size; /* copy of the parameter [s] */
    ${prefix}_real_t tolerance; /* copy of the parameter [1] */
    ${prefix}_real_t merit; /* V before the last step [1] */
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
    ${prefix}_real_t merit; /* V = 1/2 |residual|^2 before the last step [1] */
    ${prefix}_real_t merit_change; /* V less that of the call before [1] */
    uint32_t verdict; /* bits ${PREFIX}_RESIDUAL_LARGE .. ${PREFIX}_FELL_BACK */
    uint32_t iterations; /* partial steps of the fallback, 0 without */
} ${prefix}_out_t;

/* What the monitor sees at a state; nothing is moved by looking. */
typedef struct {
    ${prefix}_real_t merit; /* V = 1/2 |residual|^2 [1] */
    ${prefix}_real_t merit_change; /* of V in one Euler step with these inputs [1] */
    ${prefix}_real_t residual; /* largest KKT residual */
    int8_t bound[${room_bounds}]; /* -1 at the lower, 1 at the upper bound, 0 between */
    int8_t row[${room_rows}]; /* 1 where an inequality row is active or violated */
    uint32_t verdict; /* bits ${PREFIX}_RESIDUAL_LARGE .. ${PREFIX}_ROW_ACTIVE */
} ${prefix}_monitor_t;
${kinematics_struct}
/* Check the parameters and put the network at rest (state 0).
 * On failure the state is left as it was. */
${prefix}_status_t ${prefix}_init(${prefix}_state_t *state, const ${prefix}_param_t *param);

/* ${PREFIX}_STEPS Euler steps, and the fallback where the residual is above the
 * tolerance. On failure state and output are left as they were: stop the robot,
 * or go on with the last output, as the application demands. */
${prefix}_status_t ${prefix}_step(${prefix}_state_t *state, const ${prefix}_in_t *in,
                                  ${prefix}_out_t *out);

/* Watch the state that the next step would start from.
 * On failure the monitor is left as it was. */
${prefix}_status_t ${prefix}_monitor(const ${prefix}_state_t *state, const ${prefix}_in_t *in,
                                     ${prefix}_monitor_t *monitor);
${kinematics_part}
/* Number of reference vectors that this build does not reproduce${selftest_how};
 * 0: all is well. Call it once at start-up. */
uint32_t ${prefix}_selftest(void);

/* Fingerprint of the model, as in MANIFEST.json. */
const char *${prefix}_model_hash(void);

#ifdef __cplusplus
}
#endif

#endif
