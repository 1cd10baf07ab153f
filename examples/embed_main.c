/* A control loop around a generated controller: the tip of a Panda draws a circle.
 *
 *   rrnn generate closed_loop --robot panda --prefix arm --out build
 *   cc -std=c99 -pedantic -Wall -Wextra -Werror -O2 -ffp-contract=off \
 *      -Ibuild/arm/include build/arm/src/arm.c build/arm/src/arm_selftest.c \
 *      examples/embed_main.c -lm -o circle
 */
#include <math.h>
#include <stdio.h>

#include "arm.h"

#define PERIOD 0.001F /* s */
#define RADIUS 0.05F  /* m */
#define PACE 1.0F     /* rad/s, once round in 2 pi seconds */

int main(void)
{
    static arm_state_t state;
    static arm_in_t in = {.q = {0.0F, -0.5F, 0.0F, -2.0F, 0.0F, 1.6F, 0.8F}};
    static arm_out_t out;
    static arm_kinematics_t at, now;
    const arm_param_t param = {ARM_STEP_SIZE, ARM_TOLERANCE};

    if (arm_selftest() != 0U || arm_init(&state, &param) != ARM_OK) {
        return 1; /* this build computes something else than the model */
    }
    (void)arm_kinematics(in.q, &at);
    for (int tick = 0; tick < 6283; tick++) {
        const float angle = PACE * PERIOD * (float)tick;
        in.rd[0] = at.position[0];
        in.rd[1] = at.position[1] + RADIUS * sinf(angle);
        in.rd[2] = at.position[2] + RADIUS * (1.0F - cosf(angle));
        in.rd_dot[1] = RADIUS * PACE * cosf(angle);
        in.rd_dot[2] = RADIUS * PACE * sinf(angle);
        if (arm_step(&state, &in, &out) != ARM_OK) {
            return 2; /* out is as it was: stop the robot */
        }
        for (int joint = 0; joint < ARM_N_OUTPUT; joint++) {
            in.q[joint] += PERIOD * out.output[joint]; /* a robot would move */
        }
    }
    (void)arm_kinematics(in.q, &now);
    printf("back within %.1f mm\n", 1e3 * (double)hypotf(
        now.position[1] - at.position[1], now.position[2] - at.position[2]));
    return 0;
}
