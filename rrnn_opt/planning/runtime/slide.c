/* One exploration: slide towards a target, every step proved when taken. */

static double distance_between(const double *a, const double *b)
{
    double difference[NV];
    for (int32_t k = 0; k < NV; k++) {
        difference[k] = a[k] - b[k];
    }
    return norm_of(difference);
}

/* Attraction w of norm at most `length`, and the way left (rad, or the size
 * of the task error).  `arrived`: a tip target is met within its tolerance. */
static double drive(const planner_t *planner, const double *q, const pose_t *pose,
                    const target_t *target, double length, double *w, int *arrived)
{
    *arrived = 0;
    if (target->tip == NULL) {
        k_drive_joint(q, target->q, &length, w);
        return distance_between(target->q, q);
    }
    const tip_goal_t *tip = target->tip;
    const double share = planner->set.ik_share;
    double error[2];
    if (tip->has_rotation) {
        k_drive_pose(pose->axes, pose->origins, pose->tip_position,
                     pose->tip_rotation, tip->position, tip->rotation, tip->half,
                     tip->free, &length, w, error);
    } else {
        k_drive_position(pose->axes, pose->origins, pose->tip_position,
                         tip->position, tip->rotation, tip->half, &length, w,
                         error);
    }
    *arrived = error[0] <= share * tip->tolerance &&
               (!tip->has_rotation || error[1] <= share * tip->chord);
    return error[0] + (tip->has_rotation ? error[1] : 0.0);
}

/* A certified step towards the wish, which is cut at the radius of the near
 * pairs and halved until the proof holds.
 * Returns the number of rows, or -1 when no step above min_step is proved. */
static int32_t certified_step(planner_t *planner, const double *q,
                              const pose_t *pose, double sight, double *w,
                              double *length, double *u)
{
    const settings_t *set = &planner->set;
    double wish = norm_of(w);
    for (int32_t k = 0; k < NV && wish > sight; k++) {
        w[k] *= sight / wish;
    }
    wish = wish > sight ? sight : wish;
    *length = *length > sight ? sight : *length;
    for (;;) {
        const int32_t rows = project(planner, q, pose, w, *length, u);
        if (world_proved(&planner->world, u, sight, set->slack)) {
            return rows;
        }
        wish *= 0.5;
        *length = wish;
        if (wish < set->min_step) {
            return -1;
        }
        for (int32_t k = 0; k < NV; k++) {
            w[k] *= 0.5;
        }
    }
}

static int lands_on(const double *q, const double *u, const double *target)
{
    for (int32_t k = 0; k < NV; k++) {
        const double miss = q[k] + u[k] - target[k];
        if (miss > 1e-12 || miss < -1e-12) {
            return 0;
        }
    }
    return 1;
}

/* q += u, kept inside the limits against rounding. */
static void move(const planner_t *planner, double *q, const double *u)
{
    for (int32_t k = 0; k < NV; k++) {
        const double next = q[k] + u[k];
        const double capped = next > planner->upper[k] ? planner->upper[k] : next;
        q[k] = capped < planner->lower[k] ? planner->lower[k] : capped;
    }
}

/* Slides from `from`; waypoints go to the pool (first, count). */
static slide_end_t slide(planner_t *planner, const double *from,
                         const target_t *target, int32_t *first, int32_t *count)
{
    const settings_t *set = &planner->set;
    double q[NV], w[NV], u[NV];
    double length = set->max_step, mark = 1e300;
    pose_t pose;
    memcpy(q, from, sizeof q);
    *first = planner->pool_count;
    *count = 0;
    world_reset(&planner->world);
    for (int32_t step = 0; step < set->max_slide_steps; step++) {
        int arrived;
        if (step % POLL_STEPS == 0 && cancelled(planner)) {
            return EXHAUSTED;
        }
        pose_at(q, &pose);
        const double left = drive(planner, q, &pose, target, length, w, &arrived);
        if (arrived || left == 0.0) {
            return REACHED;
        }
        if (step % set->stall_window == 0) {
            if (left > set->stall_ratio * mark) {
                return STALLED;
            }
            mark = left;
        }
        double sight = set->max_step;
        if (!world_near_within(&planner->world, &pose, &sight)) {
            return EXHAUSTED;
        }
        const int32_t rows = certified_step(planner, q, &pose, sight, w, &length, u);
        planner->steps++;
        if (rows < 0) {
            return STALLED;
        }
        const int home = target->tip == NULL && lands_on(q, u, target->q);
        world_advance(&planner->world, u);
        move(planner, q, u);
        if (home) {
            memcpy(q, target->q, sizeof q);
        }
        if (!pool_push(planner, q)) {
            return EXHAUSTED;
        }
        (*count)++;
        if (home) {
            return REACHED;
        }
        length *= rows > 0 ? 1.25 : 1.6;
        length = length > set->max_step ? set->max_step : length;
    }
    return EXHAUSTED;
}
