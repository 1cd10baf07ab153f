/* Test of ${prefix} against values computed by CasADi ${casadi} in double precision.
 *
 * Prints one line; exit status 0 when all holds.
 */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "${prefix}.h"

typedef ${prefix}_real_t real_t;

#define CASES ${cases}
#define TOLERANCE ${tolerance}

typedef struct {
    real_t state[${n_state}];
    ${prefix}_in_t in;
    real_t next[${n_state}];
    real_t output[${n_output}];
} vector_t;

static const vector_t vectors[CASES] = {
${vectors}
};

static real_t error_of(const real_t got[], const real_t want[], size_t count)
{
    real_t worst = ${zero};
    size_t i;
    for (i = 0U; i < count; ++i) {
        const real_t scale = (fabs${f}(want[i]) > ${one}) ? fabs${f}(want[i]) : ${one};
        const real_t error = fabs${f}(got[i] - want[i]) / scale;
        if (!(error <= worst)) {
            worst = error; /* NaN included */
        }
    }
    return worst;
}

static int refuses_bad_arguments(void)
{
    ${prefix}_param_t param = {${step_size}};
    ${prefix}_state_t state;
    ${prefix}_state_t before;
    ${prefix}_out_t out;
    ${prefix}_in_t in = vectors[0].in;
    int bad = 0;
    (void)memset(&out, 0, sizeof out);
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_OK) ? 1 : 0;
    bad += (${prefix}_step(&state, &in, &out) != ${PREFIX}_OK) ? 1 : 0;
    bad += (state.tick != 1U) ? 1 : 0;
    before = state;
${poison}    param.step_size = ${zero};
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_BAD_STEP_SIZE) ? 1 : 0;
    param.step_size = (real_t)NAN;
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_NOT_FINITE) ? 1 : 0;
    bad += (memcmp(&state, &before, sizeof state) != 0) ? 1 : 0;
    return bad;
}

int main(void)
{
    const ${prefix}_param_t param = {${step_size}};
    real_t worst = ${zero};
    int bad = refuses_bad_arguments();
    size_t k;
    for (k = 0U; k < CASES; ++k) {
        ${prefix}_state_t state;
        ${prefix}_out_t out;
        real_t error;
        bad += (${prefix}_init(&state, &param) != ${PREFIX}_OK) ? 1 : 0;
        (void)memcpy(${state_ref}, vectors[k].state, sizeof vectors[k].state);
        bad += (${prefix}_step(&state, &vectors[k].in, &out) != ${PREFIX}_OK) ? 1 : 0;
        error = error_of(${state_ref}, vectors[k].next, ${n_state}U);
        worst = (error <= worst) ? worst : error;
        error = error_of(${output_ref}, vectors[k].output, ${n_output}U);
        worst = (error <= worst) ? worst : error;
    }
    bad += (worst <= TOLERANCE) ? 0 : 1;
    printf("%s: %d cases, largest error %.3g (tolerance %.3g), %d failures\n",
           (bad == 0) ? "PASS" : "FAIL", CASES, (double)worst, (double)TOLERANCE, bad);
    return (bad == 0) ? 0 : 1;
}
