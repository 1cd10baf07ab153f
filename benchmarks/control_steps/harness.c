/* Random control steps of a generated package, with its monitor on.
 *
 * Compiled beside a package `arm` and the limits of its formulation, which are
 * emitted apart, in double.  Prints one JSON object of counts; what the package
 * promises and does not keep is counted in "broken".
 */
#include <float.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arm.h"

#define INPUTS (sizeof(arm_in_t) / sizeof(arm_real_t))
#define SINGLE (sizeof(arm_real_t) == sizeof(float))
#define LARGE (SINGLE ? (double)FLT_MAX : DBL_MAX)
#define DENORMAL (SINGLE ? 1e-45 : 5e-324)
#define ROUNDING (SINGLE ? 1e-5 : 1e-12)
#ifdef ARM_LONGEST_STEP
#define STEP (ARM_LONGEST_STEP / 2)
#else
#define STEP ((arm_real_t)0.001)
#endif

void limits_bounds(const double given[], double lower[], double upper[]);

/* About which requests that a robot can fulfil lie. */
static const double centre[INPUTS] = {CENTRE};

static uint64_t seed = 88172645463325252ULL;

static uint32_t draw(void)
{
    seed ^= seed << 13;
    seed ^= seed >> 7;
    seed ^= seed << 17;
    return (uint32_t)(seed >> 16);
}

/* Uniform in (-1, 1). */
static double uniform(void)
{
    return (double)(int32_t)draw() / 2147483649.0;
}

static arm_real_t any_number(void)
{
    const double odd[] = {
        (double)NAN, (double)INFINITY, -(double)INFINITY, LARGE, -LARGE, DENORMAL,
        -DENORMAL, 0.0, -0.0, 1e6, -1e6, 32768.0, 3e9, 1e-20, 1e20,
    };
    arm_real_t any;
    uint8_t bytes[sizeof any];
    size_t i;
    switch (draw() % 6U) {
    case 0:
        return (arm_real_t)odd[draw() % (sizeof odd / sizeof odd[0])];
    case 1:
        for (i = 0; i < sizeof any; ++i) {
            bytes[i] = (uint8_t)draw();
        }
        memcpy(&any, bytes, sizeof any);
        return any;
    case 2: /* so large that limits (10) exclude everything, or nearly */
        return (arm_real_t)(20.0 * uniform());
    default:
        return (arm_real_t)uniform();
    }
}

/* The next request: a walk that a network can follow, a jump, or anything. */
static void next_request(long k, double walk[], arm_real_t in[])
{
    const long turn = k % 96;
    size_t i;
    for (i = 0; i < INPUTS; ++i) {
        walk[i] = fmin(fmax(walk[i] + 0.001 * uniform(), -0.1), 0.1);
        if (turn < 64) {
            in[i] = (arm_real_t)(centre[i] + walk[i]);
        } else if (turn < 80) {
            in[i] = (arm_real_t)(centre[i] + 1.5 * uniform());
        } else {
            in[i] = any_number();
        }
    }
}

/* By how much the output leaves the limits of this request. */
static double excess(const arm_real_t in[], const arm_out_t *out)
{
    double worst = 0.0;
#if ARM_N_BOUNDS > 0
    double given[INPUTS], lower[ARM_N_BOUNDS], upper[ARM_N_BOUNDS];
    size_t i;
    for (i = 0; i < INPUTS; ++i) {
        given[i] = (double)in[i];
    }
    limits_bounds(given, lower, upper);
    for (i = 0; i < ARM_N_BOUNDS; ++i) {
        const double value = (double)out->output[i];
        const double slack = ROUNDING * (1.0 + fabs(value));
        worst = fmax(worst, fmax(lower[i] - value, value - upper[i]) - slack);
    }
#else
    (void)in;
    (void)out;
#endif
    return worst;
}

typedef struct {
    unsigned long status[10];
    unsigned long broken, fell_back, flagged, flagged_outside;
    double worst_promised, worst_flagged;
} counts_t;

/* Judge one call; what was there before it is given. */
static void judge(counts_t *c, const arm_real_t in[], const arm_out_t *out,
                  const arm_monitor_t *seen)
{
    const double beyond = excess(in, out);
    const int fell_back = (out->verdict & ARM_FELL_BACK) != 0U;
    size_t i;
    for (i = 0; i < ARM_N_OUTPUT; ++i) {
        c->broken += isfinite(out->output[i]) ? 0U : 1U;
    }
    c->broken += (seen->residual == out->residual) ? 0U : 1U;
    c->fell_back += fell_back ? 1U : 0U;
    if (fell_back || (out->verdict & ARM_RESIDUAL_LARGE) == 0U) {
        c->worst_promised = fmax(c->worst_promised, beyond);
        c->broken += (beyond <= 2.0 * (double)ARM_TOLERANCE) ? 0U : 1U;
    } else {
        c->flagged += 1U;
        c->flagged_outside += (beyond > 0.0) ? 1U : 0U;
        c->worst_flagged = fmax(c->worst_flagged, beyond);
    }
}

int main(int argc, char **argv)
{
    const long runs = (argc > 1) ? atol(argv[1]) : 20000L;
    arm_param_t param = {STEP, ARM_TOLERANCE};
    arm_real_t in[INPUTS];
    double walk[INPUTS] = {0};
    arm_state_t state;
    counts_t c = {{0}, 0, 0, 0, 0, 0.0, 0.0};
    long k;
    int s;
    seed += (argc > 2) ? (uint64_t)atol(argv[2]) : 0U;
    c.broken += (arm_init(&state, &param) == ARM_OK) ? 0U : 1U;
    for (k = 0; k < runs; ++k) {
        const arm_state_t before = state;
        arm_in_t request;
        arm_out_t out, told;
        arm_monitor_t seen;
        arm_status_t status, watched;
        next_request(k, walk, in);
        memcpy(&request, in, sizeof request);
        memset(&out, 0, sizeof out);
        memset(&seen, 0, sizeof seen);
        told = out;
        watched = arm_monitor(&state, &request, &seen);
        c.broken += (memcmp(&before, &state, sizeof state) == 0) ? 0U : 1U;
        status = arm_step(&state, &request, &out);
        c.status[status] += 1U;
        if (status == ARM_OK) {
            c.broken += (watched == ARM_OK) ? 0U : 1U;
            judge(&c, in, &out, &seen);
        } else { /* told so: nothing may have changed */
            c.broken += (memcmp(&before, &state, sizeof state) == 0) ? 0U : 1U;
            c.broken += (memcmp(&told, &out, sizeof out) == 0) ? 0U : 1U;
        }
    }
    printf("{\"status\": [");
    for (s = 0; s < 10; ++s) {
        printf("%s%lu", (s > 0) ? ", " : "", c.status[s]);
    }
    printf("], \"broken\": %lu, \"fell_back\": %lu, \"flagged\": %lu,"
           " \"flagged_outside\": %lu, \"worst_promised\": %.3g,"
           " \"worst_flagged\": %.3g}\n",
           c.broken, c.fell_back, c.flagged, c.flagged_outside, c.worst_promised,
           c.worst_flagged);
    return 0;
}
