/* Test of ${prefix} against the model's operations, ${claim}; the cases were
 * also compared with CasADi ${casadi} in double precision when they were made.
 *
 * Prints one line; exit status 0 when all holds.
 */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "${prefix}.h"
#include "${prefix}_cases.h"

typedef ${prefix}_real_t real_t;

static int differs(real_t got, real_t want)
{
${compare}}

static int differences(const real_t got[], const real_t want[], uint32_t count)
{
    int found = 0;
    uint32_t i;
    for (i = 0U; i < count; ++i) {
        found += differs(got[i], want[i]);
    }
    return found;
}

static int refuses_bad_arguments(void)
{
    ${prefix}_param_t param = {${step_size}, ${never}};
    ${prefix}_state_t state;
    ${prefix}_state_t before;
    ${prefix}_out_t out;
    ${prefix}_monitor_t monitor;
    ${prefix}_in_t in = ${prefix}_cases[0].in;
    int bad = 0;
    (void)memset(&out, 0, sizeof out);
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_OK) ? 1 : 0;
    bad += (${prefix}_step(&state, &in, &out) != ${PREFIX}_OK) ? 1 : 0;
    bad += (state.tick != 1U) ? 1 : 0;
    before = state;
${poison}    bad += (${prefix}_monitor(&state, &in, &monitor) != ${PREFIX}_OK) ? 1 : 0;
    param.step_size = ${zero};
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_BAD_STEP_SIZE) ? 1 : 0;
    param.step_size = (real_t)NAN;
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_NOT_FINITE) ? 1 : 0;
    param.step_size = ${step_size};
    param.tolerance = -${one};
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_BAD_TOLERANCE) ? 1 : 0;
#ifdef ${PREFIX}_LONGEST_STEP
    param.tolerance = ${one};
    param.step_size = 2 * ${PREFIX}_LONGEST_STEP;
    bad += (${prefix}_init(&state, &param) != ${PREFIX}_STEP_TOO_LONG) ? 1 : 0;
#endif
    bad += (memcmp(&state, &before, sizeof state) != 0) ? 1 : 0;
    ${state_ref}[0] = (real_t)NAN;
    bad += (${prefix}_step(&state, &in, &out) != ${PREFIX}_DIVERGED) ? 1 : 0;
    return bad;
}

/* How many cases one call does not do as the model does. */
static int wrong_cases(void)
{
    const ${prefix}_param_t param = {${step_size}, ${never}};
    int bad = 0;
    uint32_t k;
    for (k = 0U; k < ${PREFIX}_CASES; ++k) {
        const ${prefix}_case_t *want = &${prefix}_cases[k];
        ${prefix}_state_t state;
        ${prefix}_out_t out;
        int wrong = (${prefix}_init(&state, &param) != ${PREFIX}_OK) ? 1 : 0;
        (void)memcpy(${state_ref}, want->state, sizeof want->state);
        wrong += (${prefix}_step(&state, &want->in, &out) != ${PREFIX}_OK) ? 1 : 0;
        wrong += differences(${state_ref}, want->next, ${n_state}U);
        wrong += differences(${output_ref}, want->output, ${n_output}U);
        wrong += differs(out.merit, want->merit);
        bad += (wrong != 0) ? 1 : 0;
    }
    return bad;
}

/* With no residual allowed every call falls back, or says why it cannot. */
static int answered_by_fallback(int *refused)
{
    const ${prefix}_param_t param = {${step_size}, ${zero}};
    int found = 0;
    uint32_t k;
    for (k = 0U; k < ${PREFIX}_CASES; ++k) {
        ${prefix}_state_t state;
        ${prefix}_out_t out;
        ${prefix}_status_t status;
        (void)${prefix}_init(&state, &param);
        (void)memcpy(${state_ref}, ${prefix}_cases[k].state, sizeof ${prefix}_cases[k].state);
        status = ${prefix}_step(&state, &${prefix}_cases[k].in, &out);
        if ((status == ${PREFIX}_INFEASIBLE) || (status == ${PREFIX}_NO_ANSWER)) {
            *refused += 1;
        } else if (status == ${PREFIX}_OK) {
            found += ((out.verdict & ${PREFIX}_FELL_BACK) != 0U) ? 1 : 0;
        } else {
            *refused += 1000; /* no other answer is right */
        }
    }
    return found;
}

int main(void)
{
    int refused = 0;
    const int wrong = wrong_cases();
    const int fell_back = answered_by_fallback(&refused);
    const int selftest = (int)${prefix}_selftest();
    int bad = refuses_bad_arguments() + wrong + selftest;
    bad += (refused >= 1000) ? 1 : 0;
    printf("%s: %d cases, %d wrong, %d self-test, %d by the exact solver (%d without an"
           " answer), %d failures\n",
           (bad == 0) ? "PASS" : "FAIL", (int)${PREFIX}_CASES, wrong, selftest, fell_back,
           refused, bad);
    return (bad == 0) ? 0 : 1;
}
