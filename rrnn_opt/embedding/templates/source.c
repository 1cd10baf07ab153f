/* ${prefix}: ${title}
 *
 * Written by rrnn_opt ${version}; see ${prefix}.h. Do not edit: generate it again.
 */
#include "${prefix}.h"

#include "${prefix}_math.h"
${fallback_include}
${kernels}
/* Whether all are finite. */
static int all_finite(const real_t values[], uint32_t count)
{
    int finite = 1;
    uint32_t i;
    for (i = 0U; i < count; ++i) {
        if (!(RRNN_FABS(values[i]) <= RRNN_LARGEST_FINITE)) {
            finite = 0;
        }
    }
    return finite;
}

/* Why inputs of such an extent are refused. */
static ${prefix}_status_t refusal(const ${prefix}_in_t *in)
{
    int finite = 1;
${unused_in}${finite_checks}    return (finite != 0) ? ${PREFIX}_OUT_OF_RANGE : ${PREFIX}_NOT_FINITE;
}

/* What inputs and results say of a call. */
static ${prefix}_status_t judged(const ${prefix}_in_t *in, real_t extent, real_t room,
                                 real_t size)
{
    ${prefix}_status_t status = ${PREFIX}_OK;
    if (!(extent <= (${PREFIX}_LARGEST * ${PREFIX}_LARGEST))) {
        status = refusal(in);
    } else if (!(room >= RRNN_C(0.0))) {
        status = ${PREFIX}_EMPTY_LIMITS;
    } else if (!(size <= RRNN_LARGEST_FINITE)) {
        status = ${PREFIX}_DIVERGED;
    } else {
        /* nothing is wrong */
    }
    return status;
}
${fallback}
${prefix}_status_t ${prefix}_init(${prefix}_state_t *state, const ${prefix}_param_t *param)
{
    ${prefix}_status_t status = ${PREFIX}_OK;
    if ((all_finite(&param->step_size, 1U) == 0)
        || (all_finite(&param->tolerance, 1U) == 0)) {
        status = ${PREFIX}_NOT_FINITE;
    } else if (!(param->step_size > RRNN_C(0.0))) {
        status = ${PREFIX}_BAD_STEP_SIZE;
    } else if (param->tolerance < RRNN_C(0.0)) {
        status = ${PREFIX}_BAD_TOLERANCE;
${step_check}    } else {
        const ${prefix}_state_t rest = {0};
        *state = rest;
        state->step_size = param->step_size;
        state->tolerance = param->tolerance;
    }
    return status;
}

${prefix}_status_t ${prefix}_step(${prefix}_state_t *state, const ${prefix}_in_t *in,
                                  ${prefix}_out_t *out)
{
    ${prefix}_status_t status;
    real_t next[${n_state}];
    real_t output[${n_output}];
    real_t merit;
    real_t residual;
    real_t extent;
    real_t size;
    real_t room${room_default};
    uint32_t verdict;
    uint32_t iterations = 0U;
    uint32_t i;
${run_steps}    status = judged(in, extent, room, size);
    verdict = (residual <= state->tolerance) ? 0U : ${PREFIX}_RESIDUAL_LARGE;
${take_fallback}    if (status == ${PREFIX}_OK) {
        for (i = 0U; i < ${n_state}U; ++i) {
            ${state_access}[i] = next[i];
        }
        for (i = 0U; i < ${n_output}U; ++i) {
            ${output_access}[i] = output[i];
        }
        out->residual = residual;
        out->merit = merit;
        out->merit_change = merit - state->merit;
        out->verdict = verdict | ((merit > state->merit) ? ${PREFIX}_MERIT_ROSE : 0U);
        out->iterations = iterations;
        state->merit = merit;
        state->tick += 1U;
    }
    return status;
}

${prefix}_status_t ${prefix}_monitor(const ${prefix}_state_t *state, const ${prefix}_in_t *in,
                                     ${prefix}_monitor_t *monitor)
{
    ${prefix}_status_t status;
    ${prefix}_monitor_t seen = {0};
    real_t extent;
    real_t size;
${monitor_arrays}    ${monitor_call};
    status = judged(in, extent, room, size);
${monitor_bounds}${monitor_rows}    seen.verdict |= (seen.residual <= state->tolerance) ? 0U : ${PREFIX}_RESIDUAL_LARGE;
    seen.verdict |= (seen.merit_change > RRNN_C(0.0)) ? ${PREFIX}_MERIT_ROSE : 0U;
    if (status == ${PREFIX}_OK) {
        *monitor = seen;
    }
    return status;
}
${kinematics}
const char *${prefix}_model_hash(void)
{
    return "${hash}";
}
