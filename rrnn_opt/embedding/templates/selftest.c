/* ${prefix}: what this build must reproduce. See ${prefix}.h. */
#include "${prefix}.h"

#include "${prefix}_vectors.h"

static int differs(${prefix}_real_t got, ${prefix}_real_t want)
{
${compare}}

/* 0 when one call does what the model does. */
static uint32_t mismatch(const ${prefix}_vector_t *vector)
{
    const ${prefix}_param_t param = {${step_size}, ${tolerance}};
    ${prefix}_state_t state;
    ${prefix}_out_t out;
    uint32_t wrong = 0U;
    uint32_t i;
    if (${prefix}_init(&state, &param) != ${PREFIX}_OK) {
        wrong = 1U;
    } else {
        for (i = 0U; i < ${n_state}U; ++i) {
            ${state_ref}[i] = vector->state[i];
        }
        state.tolerance = ${never};
        if (${prefix}_step(&state, &vector->in, &out) != ${PREFIX}_OK) {
            wrong = 1U;
        } else {
            for (i = 0U; i < ${n_state}U; ++i) {
                if (differs(${state_ref}[i], vector->next[i]) != 0) {
                    wrong = 1U;
                }
            }
            for (i = 0U; i < ${n_output}U; ++i) {
                if (differs(${output_ref}[i], vector->output[i]) != 0) {
                    wrong = 1U;
                }
            }
            if (differs(out.merit, vector->merit) != 0) {
                wrong = 1U;
            }
        }
    }
    return wrong;
}

uint32_t ${prefix}_selftest(void)
{
    uint32_t wrong = 0U;
    uint32_t k;
    for (k = 0U; k < ${PREFIX}_VECTORS; ++k) {
        wrong += mismatch(&${prefix}_vectors[k]);
    }
    return wrong;
}
