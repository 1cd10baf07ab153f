/* Run a network to rest by explicit Euler steps.
 *
 * Given before this text: real_t, RRNN_EXPORT, the sizes SETTLE_STATE and
 * SETTLE_PARAMETERS, and the emitted
 *     settle_step(state, parameters, h, next, residual)
 * with residual = the largest component of the network's residual at `state`.
 *
 * Returns the steps made; `residual` tells why it stopped: within the
 * tolerance, not finite or beyond `escape`, or neither (out of steps).
 */
RRNN_EXPORT int64_t rrnn_settle(const real_t *parameters, real_t *state, real_t h,
                                real_t tolerance, real_t escape, int64_t max_steps,
                                real_t *residual);

int64_t rrnn_settle(const real_t *parameters, real_t *state, real_t h,
                    real_t tolerance, real_t escape, int64_t max_steps,
                    real_t *residual)
{
    real_t given[SETTLE_PARAMETERS > 0 ? SETTLE_PARAMETERS : 1];
    real_t now[SETTLE_STATE];
    real_t next[SETTLE_STATE];
    int64_t k = 0;
    size_t i;
    /* copies of its own let the compiler lift what the step does not change */
    for (i = 0; i < SETTLE_PARAMETERS; ++i) given[i] = parameters[i];
    for (i = 0; i < SETTLE_STATE; ++i) now[i] = state[i];
    for (;;) {
        settle_step(now, given, h, next, residual);
        if (*residual <= tolerance || !(*residual <= escape) || k >= max_steps) break;
        for (i = 0; i < SETTLE_STATE; ++i) now[i] = next[i];
        ++k;
    }
    for (i = 0; i < SETTLE_STATE; ++i) state[i] = now[i];
    return k;
}
