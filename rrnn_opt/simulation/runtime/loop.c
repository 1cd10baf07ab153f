/* A robot under one network, control period by control period.
 *
 * Given before this text: real_t, RRNN_EXPORT, the sizes LOOP_NV, LOOP_STATE,
 * LOOP_MEMORY, LOOP_COEFFICIENTS, the level LOOP_LEVEL, and emitted from the
 * same graph as everything else
 *     loop_sense(q, qd, memory, rd, rd_dot, rd_ddot, settings,
 *                tip, following, coefficients)
 *     loop_step(state, h, coefficients, next, residual)
 *     loop_output(state, h, coefficients, u)
 *
 * In every period: measure; run the network for at most `most` steps, or until
 * its residual is within the tolerance; command its output u for dt.  The plant
 * does as told, plus noise:
 *     LOOP_VELOCITY      q' = u + velocity noise
 *     LOOP_ACCELERATION  q' = v + velocity noise, v' = u + acceleration noise
 *     LOOP_INCREMENT     q' = u / dt + velocity noise
 * each held for dt and integrated exactly.  Returns the network steps made;
 * `unsettled` counts the periods that ended above the tolerance.
 */
#define LOOP_VELOCITY 0
#define LOOP_ACCELERATION 1
#define LOOP_INCREMENT 2

typedef struct {
    int64_t rows, most;
    double h, tolerance;
    const double *settings;                       /* dt, kappa */
    const double *rd, *rd_dot, *rd_ddot;          /* rows x 3, as told */
    const double *velocity_noise;                 /* rows x nv */
    const double *acceleration_noise;             /* rows x nv */
    double *state, *memory;                       /* in and out */
    double *q, *u, *v, *qd, *tip;                 /* records; row 0 of q, v: start */
    int64_t unsettled;
} rrnn_loop_t;

RRNN_EXPORT int64_t rrnn_loop(rrnn_loop_t *run);

static int64_t loop_think(rrnn_loop_t *run, const double *coefficients)
{
    double next[LOOP_STATE];
    double residual = 0.0;
    int64_t k;
    size_t i;
    for (k = 0; k < run->most; ++k) {
        loop_step(run->state, &run->h, coefficients, next, &residual);
        if (residual <= run->tolerance) return k;
        for (i = 0; i < LOOP_STATE; ++i) run->state[i] = next[i];
    }
    if (run->tolerance >= 0.0) {
        loop_step(run->state, &run->h, coefficients, next, &residual);
        if (!(residual <= run->tolerance)) ++run->unsettled;
    }
    return k;
}

static void loop_move(const rrnn_loop_t *run, int64_t row)
{
    const double dt = run->settings[0];
    const int64_t at = row * LOOP_NV;
    const int last = row + 1 == run->rows;
    int64_t i;
    for (i = at; i < at + LOOP_NV; ++i) {
        double a = 0.0;
        if (LOOP_LEVEL == LOOP_ACCELERATION) a = run->u[i] + run->acceleration_noise[i];
        else if (LOOP_LEVEL == LOOP_INCREMENT) run->v[i] = run->u[i] / dt;
        else run->v[i] = run->u[i];
        run->qd[i] = run->v[i] + run->velocity_noise[i];
        if (last) continue;
        run->q[i + LOOP_NV] = run->q[i] + dt * (run->qd[i] + 0.5 * dt * a);
        if (LOOP_LEVEL == LOOP_ACCELERATION) run->v[i + LOOP_NV] = run->v[i] + dt * a;
    }
}

int64_t rrnn_loop(rrnn_loop_t *run)
{
    double coefficients[LOOP_COEFFICIENTS], following[LOOP_MEMORY];
    double resting[LOOP_NV] = {0.0};
    int64_t row, steps = 0;
    size_t i;
    for (row = 0; row < run->rows; ++row) {
        const double *before = row ? run->qd + (row - 1) * LOOP_NV : resting;
        const double *qd = run->v + row * LOOP_NV;
        if (LOOP_LEVEL != LOOP_ACCELERATION) qd = before;
        loop_sense(run->q + row * LOOP_NV, qd, run->memory, run->rd + row * 3,
                   run->rd_dot + row * 3, run->rd_ddot + row * 3, run->settings,
                   run->tip + row * 3, following, coefficients);
        steps += loop_think(run, coefficients);
        loop_output(run->state, &run->h, coefficients, run->u + row * LOOP_NV);
        loop_move(run, row);
        for (i = 0; i < LOOP_MEMORY; ++i) run->memory[i] = following[i];
    }
    return steps;
}
