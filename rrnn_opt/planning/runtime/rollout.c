/* Rollouts of the printed network in time: data, limits (10), sets (12), (17). */

#define CONTACT_MAX 16
#define BAND_MAX 128

typedef enum {
    FIRST_ORDER = 0,
    SECOND_ORDER = 1,
    VELOCITY_SCHEME = 2,
    ACCELERATION_SCHEME = 3
} law_t;

typedef struct {
    double epsilon;       /* s */
    double step;          /* s */
    double safe;          /* m, clearance at which contacts count */
    double share;         /* of the goal's tolerance */
    double random_tolerance; /* m */
    double stall_ratio;
    double radius;        /* rad, largest norm of a step */
    double slack;         /* m */
    double gain, speed, rate, kappa_o, inner; /* of the comparison schemes */
    double center[3];     /* m, ball of the task-space draw */
    double ball;          /* m, its radius */
    int32_t law;
    int32_t by_index;     /* reading of (12) */
    int32_t by_posture;   /* region of the random points */
    int32_t feed;         /* 0: contact, 1: band, 2: failure */
    int32_t stall_window; /* steps */
    int32_t max_steps;
    int32_t sweeps;
    int32_t contacts;
} rollout_settings_t;

/* Approach that the sign rows allowed when a contact came near. */
typedef struct {
    int32_t sphere, other, seen;
    double allowed[3];    /* m/s */
} band_t;

typedef struct {
    double q[NV], u[NV];  /* rad, rad/s */
} state_t;

typedef struct {
    state_t state;
    double tip[3], target[3];
    int32_t parent, tip_goal; /* -1: a random target */
} rolled_t;

typedef struct {
    int32_t reached, contact, band;
} outcome_t;

typedef struct {
    planner_t *base;      /* world, generator, counts and path */
    rollout_settings_t set;
    rolled_t *nodes;
    int32_t count, room;
    band_t bands[BAND_MAX];
    int32_t band_count;
    near_t near[NEAR_MAX];
    int32_t near_count;
    int32_t turns;
} rollouts_t;

/* Pairs near enough for a step or for a contact row; 0: too many.  The margin
 * is widened so that obstacles within `safe` are listed, and given back. */
static int near_contacts(rollouts_t *r, const pose_t *pose)
{
    world_t *world = &r->base->world;
    world->margin += r->set.safe;
    const int complete = world_near(world, pose, r->set.radius);
    world->margin -= r->set.safe;
    r->near_count = near_list(world, r->set.radius, r->near, NEAR_MAX);
    for (int32_t p = 0; p < world->open_count; p++) {
        block_t *block = &world->open[p];
        for (int32_t l = 0; l < LANES && block->group < 0; l++) {
            block->gap[l] += r->set.safe;
        }
    }
    for (int32_t p = 0; p < r->near_count; p++) {
        r->near[p].gap += r->near[p].group < 0 ? r->set.safe : 0.0;
    }
    return complete && r->near_count < NEAR_MAX;
}

/* Cuts the box by the sign sets (12) of every obstacle within `safe`; returns
 * whether there is one. */
static int32_t sign_sets(rollouts_t *r, const pose_t *pose, double *lower,
                         double *upper)
{
    int32_t found = 0;
    for (int32_t p = 0; p < r->near_count; p++) {
        const near_t *pair = &r->near[p];
        const double *moves = t_turns + NV * pair->sphere;
        double escape[NV] = {0}, first[NV] = {0}, least[NV], most[NV];
        if (pair->group >= 0 || pair->gap > r->set.safe) {
            continue;
        }
        if (r->set.by_index) {
            for (int32_t k = 0; k < NV && k < 3; k++) {
                escape[k] = pair->n[k];
                first[k] = 1.0;
            }
            moves = first;
        } else {
            near_row(pair, pose, escape);
        }
        k_sign_set(escape, moves, lower, upper, least, most);
        memcpy(lower, least, sizeof least);
        memcpy(upper, most, sizeof most);
        found = 1;
    }
    return found;
}

/* Velocity after one step of (17), or of its reduced law (18). */
static int32_t network_step(rollouts_t *r, const pose_t *pose, const double *target,
                            state_t *state, double *error)
{
    const rollout_settings_t *set = &r->set;
    double lower[NV], upper[NV], pull[NV], drive_to[NV], next[NV];
    k_limits(state->q, lower, upper);
    const int32_t band = sign_sets(r, pose, lower, upper);
    k_pull(pose->axes, pose->origins, pose->tip_position, target, &set->epsilon, pull,
           error);
    k_clamp(pull, lower, upper, drive_to);
    if (set->law == FIRST_ORDER) {
        memcpy(state->u, drive_to, sizeof drive_to);
    } else {
        k_relax(state->u, drive_to, &set->epsilon, &set->step, next);
        memcpy(state->u, next, sizeof next);
    }
    return band;
}
