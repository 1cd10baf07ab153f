/* ${prefix}: ${title}
 *
 * Written by rrnn_opt ${version}; see ${prefix}.h. Do not edit: generate it again.
 */
#include "${prefix}.h"

${prologue}
${kernel}
static int all_finite(const real_t values[], size_t count)
{
    const real_t largest = ${largest};
    size_t i;
    for (i = 0U; i < count; ++i) {
        if (!(RRNN_FABS(values[i]) <= largest)) {
            return 0;
        }
    }
    return 1;
}

${prefix}_status_t ${prefix}_init(${prefix}_state_t *state, const ${prefix}_param_t *param)
{
    const ${prefix}_state_t rest = {0};
    const real_t step_size = param->step_size;
    if (all_finite(&step_size, 1U) == 0) {
        return ${PREFIX}_NOT_FINITE;
    }
    if (!(step_size > RRNN_C(0.0))) {
        return ${PREFIX}_BAD_STEP_SIZE;
    }
    *state = rest;
    state->step_size = step_size;
    return ${PREFIX}_OK;
}

${prefix}_status_t ${prefix}_step(${prefix}_state_t *state, const ${prefix}_in_t *in,
                                  ${prefix}_out_t *out)
{
    real_t x[${n_state}];
    real_t next[${n_state}];
    real_t output[${n_output}];
    real_t residual[${n_state}];
${bound_arrays}    real_t largest = RRNN_C(0.0);
    uint32_t k;
    size_t i;
${unused}    if (${finite_checks}) {
        return ${PREFIX}_NOT_FINITE;
    }
    for (i = 0U; i < ${n_state}U; ++i) {
        x[i] = ${state_access}[i];
    }
    for (k = 0U; k < ${PREFIX}_STEPS; ++k) {
        ${kernel_call};
        for (i = 0U; i < ${n_state}U; ++i) {
            x[i] = next[i];
        }
    }
${bound_checks}    if ((all_finite(x, ${n_state}U) == 0) || (all_finite(output, ${n_output}U) == 0)
        || (all_finite(residual, ${n_state}U) == 0)) {
        return ${PREFIX}_DIVERGED;
    }
    for (i = 0U; i < ${n_state}U; ++i) {
        const real_t size = RRNN_FABS(residual[i]);
        ${state_access}[i] = x[i];
        largest = (size > largest) ? size : largest;
    }
    for (i = 0U; i < ${n_output}U; ++i) {
        ${output_access}[i] = output[i];
    }
    out->residual = largest;
    state->tick += 1U;
    return ${PREFIX}_OK;
}

const char *${prefix}_model_hash(void)
{
    return "${hash}";
}
