/* A robot under one network, control period by control period.
 *
 * Given before this text: real_t, RRNN_EXPORT, the sizes LOOP_NV and LOOP_STATE,
 * and emitted from the same graph as everything else
 *     loop_tip(q, tip)
 *     loop_step(state, q, rd, rd_dot, h, next, residual)
 *     loop_output(state, q, rd, rd_dot, u)
 *
 * In every period k: measure; run the network for at most `most` steps, or until
 * its residual is within the tolerance; command its output u for dt; integrate
 * q += dt (u + joint_noise).  The plant is of first order: it does as told.
 * Returns the network steps made; `unsettled` counts the periods that ended
 * above the tolerance.
 */
typedef struct {
    int64_t rows, most;
    double dt, h, kappa, tolerance;
    const double *rd, *rd_dot;               /* rows x 3 */
    const double *task_noise;                /* rows x 3, on the rd_dot told */
    const double *joint_noise;               /* rows x nv, on the velocity done */
    double *state;                           /* in and out */
    double *q, *u, *qd, *tip;                /* records; row 0 of q is the start */
    int64_t unsettled;
} rrnn_loop_t;

RRNN_EXPORT int64_t rrnn_loop(rrnn_loop_t *run);

static int64_t loop_think(rrnn_loop_t *run, const double *q, const double *rd,
                          const double *wanted)
{
    double next[LOOP_STATE];
    double residual = 0.0;
    int64_t k;
    size_t i;
    for (k = 0; k < run->most; ++k) {
        loop_step(run->state, q, rd, wanted, run->h, next, &residual);
        if (residual <= run->tolerance) return k;
        for (i = 0; i < LOOP_STATE; ++i) run->state[i] = next[i];
    }
    if (run->tolerance >= 0.0) {
        loop_step(run->state, q, rd, wanted, run->h, next, &residual);
        if (!(residual <= run->tolerance)) ++run->unsettled;
    }
    return k;
}

int64_t rrnn_loop(rrnn_loop_t *run)
{
    int64_t row, steps = 0;
    size_t i;
    for (row = 0; row < run->rows; ++row) {
        double *q = run->q + row * LOOP_NV;
        double *u = run->u + row * LOOP_NV;
        double *qd = run->qd + row * LOOP_NV;
        double *tip = run->tip + row * 3;
        const double *rd = run->rd + row * 3;
        double wanted[3];
        loop_tip(q, tip);
        for (i = 0; i < 3; ++i) {
            wanted[i] = run->rd_dot[row * 3 + (int64_t)i]
                        + run->task_noise[row * 3 + (int64_t)i]
                        + run->kappa * (rd[i] - tip[i]);
        }
        steps += loop_think(run, q, rd, wanted);
        loop_output(run->state, q, rd, wanted, u);
        for (i = 0; i < LOOP_NV; ++i) {
            qd[i] = u[i] + run->joint_noise[row * LOOP_NV + (int64_t)i];
            if (row + 1 < run->rows) q[LOOP_NV + i] = q[i] + run->dt * qd[i];
        }
    }
    return steps;
}
