/* The generated package: checks, monitor, whitened rows, exact solver at hand. */
#include "arm.h"
#include "peer.h"

static arm_state_t state;
static arm_out_t out;

void peer_setup(void)
{
    const arm_param_t param = {(real_t)STEP, (real_t)TOLERANCE};
    (void)arm_init(&state, &param);
}

void peer_step(void)
{
    /* the fields of arm_in_t stand in the order of a request */
    (void)arm_step(&state, (const arm_in_t *)request, &out);
}

const real_t *peer_answer(void)
{
    return out.output;
}
