/* Goal postures: roots of the second tree, found by the network's own drive. */

static void draw_posture(planner_t *planner, double *q)
{
    for (int32_t k = 0; k < NV; k++) {
        const double low = planner->sample_lower[k], high = planner->sample_upper[k];
        q[k] = low + (high - low) * rng_uniform(&planner->rng);
    }
}

/* A posture for the random attraction: every coordinate is u^edge / 2 of its
 * range away from either end, u uniform. */
static void draw_attraction(planner_t *planner, double *q)
{
    for (int32_t k = 0; k < NV; k++) {
        const double low = planner->sample_lower[k], high = planner->sample_upper[k];
        const double twice = 2.0 * rng_uniform(&planner->rng);
        const double u = twice < 1.0 ? twice : twice - 1.0;
        double way = 0.5 * (high - low);
        for (int32_t power = 0; power < planner->set.edge; power++) {
            way *= u;
        }
        q[k] = twice < 1.0 ? low + way : high - way;
    }
}

/* The goal with its region, if it has one, shrunk to a random point of it. */
static tip_goal_t draw_point(planner_t *planner, const tip_goal_t *tip)
{
    tip_goal_t point = *tip;
    for (int32_t k = 0; k < 3; k++) {
        if (tip->half[k] > 0.0) {
            const double shift = (2.0 * rng_uniform(&planner->rng) - 1.0) * tip->half[k];
            for (int32_t i = 0; i < 3; i++) {
                point.position[i] += shift * tip->rotation[3 * k + i];
            }
            point.half[k] = 0.0;
        }
    }
    return point;
}

/* Follows the drive to a tip goal without obstacles; 1 when it arrives. */
static int inverse_kinematics(const planner_t *planner, const tip_goal_t *tip,
                              double *q)
{
    const target_t target = {.tip = tip};
    const double radius = planner->set.ik_step;
    pose_t pose;
    double w[NV], lower[NV], upper[NV], u[NV];
    for (int32_t step = 0; step < planner->set.ik_steps; step++) {
        int arrived;
        double z[NV] = {0};
        tip_pose_at(q, &pose);
        drive(planner, q, &pose, &target, radius, w, &arrived);
        if (arrived) {
            return 1;
        }
        k_box(q, planner->lower, planner->upper, &radius, lower, upper);
        memcpy(u, w, sizeof u);
        hildreth_box(NV, lower, upper, z, u);
        move(planner, q, u);
    }
    return 0;
}

/* Is the posture free, with every promised margin and the slack?  Most that are
 * not are found by their first collision, before all pairs within reach are. */
static int is_free(planner_t *planner, const double *q)
{
    pose_t pose;
    const double none[NV] = {0};
    pose_at(q, &pose);
    if (world_hit(&planner->world, &pose)) {
        return 0;
    }
    double radius = planner->set.max_step;
    world_reset(&planner->world);
    if (!world_near_within(&planner->world, &pose, &radius)) {
        return 0;
    }
    return world_certify(&planner->world, &pose, none, radius, planner->set.slack);
}

/* One more goal posture, from `seed` (NULL: a random posture). */
static int find_root(planner_t *planner, const double *seed)
{
    double q[NV];
    if (planner->tip_count == 0 || planner->roots >= planner->set.max_roots) {
        return 0;
    }
    const int32_t turn = planner->ik_failures + planner->roots;
    tip_goal_t tip = planner->tips[turn % planner->tip_count];
    if (seed != NULL) {
        memcpy(q, seed, sizeof q);
    } else {
        draw_posture(planner, q);
        tip = draw_point(planner, &tip);
    }
    if (!inverse_kinematics(planner, &tip, q) || !is_free(planner, q)) {
        planner->ik_failures++;
        return 0;
    }
    planner->roots++;
    return add_node(planner, 1, q, -1, 0, 0) >= 0;
}

/* The first goal posture: from the start, then within ik_tries draws.  PAUSED when
 * the clock shows `end`: call again; pausing changes nothing of what is found. */
static plan_status_t first_root(planner_t *planner, double end)
{
    while (planner->tree[1].count == 0) {
        if (planner->root_tries > planner->set.ik_tries) {
            return NO_POSTURE;
        }
        find_root(planner, planner->root_tries++ == 0 ? planner->tree[0].nodes[0].q
                                                      : NULL);
        if (planner->out_of_memory) {
            return NO_MEMORY;
        }
        if (cancelled(planner)) {
            return CANCELLED;
        }
        if (seconds() > end) {
            return PAUSED;
        }
    }
    return SOLVED;
}
