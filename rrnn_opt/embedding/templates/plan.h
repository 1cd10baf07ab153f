/* ${prefix}: rollouts of the network and the memory cell, to plan on board.
 *
 * A node of a search tree is one ${prefix}_node_t, ${node_bytes} bytes; nothing else
 * is kept. Clearances are checked at every step, and at no time between.
 */
#ifndef ${PREFIX}_PLAN_H
#define ${PREFIX}_PLAN_H

#include "${prefix}.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum {
    ${PREFIX}_REACHED = 0,     /* the tip is within the tolerance of the target */
    ${PREFIX}_CONTACT = 1,     /* a clearance became negative; the node stands before */
    ${PREFIX}_STALLED = 2,     /* the error hardly fell in ${window} steps */
    ${PREFIX}_STEPS_SPENT = 3, /* max_steps were made */
    ${PREFIX}_PLAN_REFUSED = 4 /* an argument is not finite or too large; nothing moved */
} ${prefix}_outcome_t;

/* Posture and velocity that a rollout starts from and ends in. */
typedef struct {
    ${prefix}_real_t q[${nv}]; /* [rad or m] */
    ${prefix}_real_t u[${nv}]; /* [rad/s or m/s] */
} ${prefix}_node_t;

typedef struct {
    ${prefix}_real_t target[3]; /* of the tip [m] */
    ${prefix}_real_t obstacles[${n_obstacles}]; /* ${m} spheres: centre, radius [m] */
    ${prefix}_real_t tolerance; /* distance that counts as reached [m] */
    uint32_t max_steps;
} ${prefix}_goal_t;

typedef struct {
    ${prefix}_outcome_t outcome;
    uint32_t steps; /* that were made */
    ${prefix}_real_t error; /* distance of the tip at the node [m] */
    ${prefix}_real_t clearance; /* least of the node [m] */
} ${prefix}_rollout_t;

/* Run the network (17) from a node towards a target. */
${prefix}_rollout_t ${prefix}_rollout(${prefix}_node_t *node, const ${prefix}_goal_t *goal);

/* Activity of the memory cell (14) after an exploration, in [0, 1]; contact: whether
 * it ended in one. Explore at random while a uniform number is below the activity. */
${prefix}_real_t ${prefix}_memory(${prefix}_real_t activity, int contact);

#ifdef __cplusplus
}
#endif

#endif
