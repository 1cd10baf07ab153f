/* ${prefix}: rollouts and memory cell. See ${prefix}_plan.h. */
#include "${prefix}_plan.h"

#include "${prefix}_math.h"

${kernels}
static void put(${prefix}_node_t *node, const real_t q[], const real_t u[])
{
    uint32_t i;
    for (i = 0U; i < ${nv}U; ++i) {
        node->q[i] = q[i];
        node->u[i] = u[i];
    }
}

static real_t squares(const real_t values[], uint32_t count)
{
    real_t sum = RRNN_C(0.0);
    uint32_t i;
    for (i = 0U; i < count; ++i) {
        sum += values[i] * values[i];
    }
    return sum;
}

static int accepted(const ${prefix}_node_t *node, const ${prefix}_goal_t *goal)
{
    const real_t extent = squares(node->q, ${nv}U) + squares(node->u, ${nv}U)
        + squares(goal->target, 3U) + squares(goal->obstacles, ${n_obstacles}U);
    return ((extent <= (${PREFIX}_LARGEST * ${PREFIX}_LARGEST))
            && (goal->tolerance >= RRNN_C(0.0)))
        ? 1
        : 0;
}

${prefix}_rollout_t ${prefix}_rollout(${prefix}_node_t *node, const ${prefix}_goal_t *goal)
{
    ${prefix}_rollout_t end = {${PREFIX}_PLAN_REFUSED, 0U, RRNN_C(0.0), RRNN_C(0.0)};
    int rolling = accepted(node, goal);
    ${prefix}_node_t now = *node;
    real_t before = RRNN_C(0.0);
    while (rolling != 0) {
        real_t q[${nv}];
        real_t u[${nv}];
        real_t error;
        real_t clearance;
        roll(now.q, now.u, goal->target, goal->obstacles, q, u, &error, &clearance);
        if (!(clearance >= RRNN_C(0.0))) {
            end.outcome = ${PREFIX}_CONTACT;
            rolling = 0;
        } else {
            *node = now;
            end.error = error;
            end.clearance = clearance;
            if (error <= goal->tolerance) {
                end.outcome = ${PREFIX}_REACHED;
                rolling = 0;
            } else if (end.steps >= goal->max_steps) {
                end.outcome = ${PREFIX}_STEPS_SPENT;
                rolling = 0;
            } else if (((end.steps % ${window}U) == 0U) && (end.steps > 0U)
                       && (error > (before * ${least}))) {
                end.outcome = ${PREFIX}_STALLED;
                rolling = 0;
            } else {
                before = ((end.steps % ${window}U) == 0U) ? error : before;
                put(&now, q, u);
                end.steps += 1U;
            }
        }
    }
    return end;
}

${prefix}_real_t ${prefix}_memory(${prefix}_real_t activity, int contact)
{
    real_t hit;
    real_t miss;
    feed(&activity, &hit, &miss);
    return (contact != 0) ? hit : miss;
}
