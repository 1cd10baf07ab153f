/* The emitted step: kinematics, limits, contact rows, one Euler step, merit V. */
#include "peer.h"

void arm_step(const real_t y[12], const real_t q[7], const real_t rd[3],
              const real_t ball[4], const real_t h[1], real_t next[12], real_t V[1]);

static real_t state[12];
static real_t merit;

void peer_setup(void)
{
}

void peer_step(void)
{
    static const real_t h = (real_t)STEP;
    arm_step(state, request, &request[7], &request[10], &h, state, &merit);
}

const real_t *peer_answer(void)
{
    return state;
}
