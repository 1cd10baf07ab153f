/* Algorithm 1 of the paper. */

/* One rollout; `state` is left where the last proved step ended.  Waypoints go
 * to the pool when `record` is set. */
static outcome_t roll(rollouts_t *r, state_t *state, const double *target,
                      double tolerance, int record)
{
    planner_t *base = r->base;
    const rollout_settings_t *set = &r->set;
    double mark = 1e300, error;
    outcome_t end = {0, 0, 0};
    world_reset(&base->world);
    r->band_count = 0;
    for (int32_t step = 0; step < set->max_steps; step++) {
        pose_t pose;
        state_t next = *state;
        double move_by[NV];
        pose_at(state->q, &pose);
        if (!near_contacts(r, &pose)) {
            end.contact = 1;
            break;
        }
        end.band |= set->law <= SECOND_ORDER
                        ? network_step(r, &pose, target, &next, &error)
                        : scheme_step(r, &pose, target, &next, &error);
        if (error <= tolerance) {
            end.reached = 1;
            break;
        }
        if (step % set->stall_window == 0) {
            if (error > set->stall_ratio * mark) {
                break;
            }
            mark = error;
        }
        for (int32_t k = 0; k < NV; k++) {
            move_by[k] = set->step * next.u[k];
        }
        if (!record) {
            base->steps++;
        }
        if (!world_certify(&base->world, &pose, move_by, set->radius, set->slack)) {
            end.contact = 1;
            break;
        }
        world_advance(&base->world, move_by);
        move(base, next.q, move_by);
        *state = next;
        if (record && !pool_push(base, state->q)) {
            break;
        }
    }
    if (end.contact) {
        memset(state->u, 0, sizeof state->u);
    }
    return end;
}

static int32_t add_rolled(rollouts_t *r, const state_t *state, const double *target,
                          int32_t parent, int32_t tip_goal)
{
    pose_t pose;
    if (!grow(r->base, (void **)&r->nodes, &r->room, r->count + 1, sizeof(rolled_t))) {
        return -1;
    }
    rolled_t *node = &r->nodes[r->count];
    pose_at(state->q, &pose);
    node->state = *state;
    memcpy(node->tip, pose.tip_position, sizeof node->tip);
    memcpy(node->target, target, sizeof node->target);
    node->parent = parent;
    node->tip_goal = tip_goal;
    return r->count++;
}

/* Line 2: a random point of the task space. */
static void draw_task_point(rollouts_t *r, double *point)
{
    rng_t *rng = &r->base->rng;
    if (r->set.by_posture) {
        double q[NV];
        pose_t pose;
        draw_posture(r->base, q);
        pose_at(q, &pose);
        memcpy(point, pose.tip_position, sizeof pose.tip_position);
        return;
    }
    double d[3], norm2;
    do {
        for (int32_t a = 0; a < 3; a++) {
            d[a] = 2.0 * rng_uniform(rng) - 1.0;
        }
        norm2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    } while (norm2 > 1.0);
    for (int32_t a = 0; a < 3; a++) {
        point[a] = r->set.center[a] + r->set.ball * d[a];
    }
}

/* Line 6: the node whose tip is nearest to the point. */
static int32_t nearest_tip(const rollouts_t *r, const double *point)
{
    int32_t best = 0;
    double least = 1e300;
    for (int32_t i = 0; i < r->count; i++) {
        double sum = 0.0;
        for (int32_t a = 0; a < 3; a++) {
            const double way = r->nodes[i].tip[a] - point[a];
            sum += way * way;
        }
        if (sum < least) {
            least = sum;
            best = i;
        }
    }
    return best;
}

static double tolerance_of(const rollouts_t *r, int32_t tip_goal)
{
    return tip_goal < 0 ? r->set.random_tolerance
                        : r->set.share * r->base->tips[tip_goal].tolerance;
}

/* Line 12: rolls every rollout on the way again, and keeps its waypoints. */
static int trace_rollouts(rollouts_t *r, int32_t node)
{
    planner_t *base = r->base;
    int32_t length = 0;
    for (int32_t i = node; r->nodes[i].parent >= 0; i = r->nodes[i].parent) {
        length++;
    }
    base->pool_count = 0;
    if (!pool_push(base, r->nodes[0].state.q)) {
        return 0;
    }
    for (int32_t depth = length; depth > 0; depth--) {
        int32_t at = node;
        for (int32_t i = 1; i < depth; i++) {
            at = r->nodes[at].parent;
        }
        const rolled_t *end = &r->nodes[at];
        state_t state = r->nodes[end->parent].state;
        roll(r, &state, end->target, tolerance_of(r, end->tip_goal), 1);
    }
    const size_t size = (size_t)base->pool_count * NV * sizeof(double);
    base->path = malloc(size);
    if (base->path == NULL || base->out_of_memory) {
        base->out_of_memory = 1;
        return 0;
    }
    memcpy(base->path, base->pool, size);
    base->path_count = base->pool_count;
    return 1;
}

static void feed_cell(rollouts_t *r, const outcome_t *end)
{
    planner_t *base = r->base;
    const int32_t signals[3] = {end->contact, end->band, !end->reached};
    const double stimulus = signals[r->set.feed];
    double next;
    k_memory(&base->activity, &stimulus, &next);
    base->activity = base->set.coin >= 0.0 ? base->set.coin : next;
}

/* Lines 1-20, once; 1 when the goal is reached. */
static int explore_once(rollouts_t *r)
{
    planner_t *base = r->base;
    const int is_random =
        r->set.law <= SECOND_ORDER && base->activity > rng_uniform(&base->rng);
    const int32_t tip_goal = is_random ? -1 : r->turns++ % base->tip_count;
    double target[3];
    if (is_random) {
        draw_task_point(r, target);
    } else {
        memcpy(target, base->tips[tip_goal].position, sizeof target);
    }
    const int32_t from = nearest_tip(r, target);
    if (!open_exploration(base, is_random)) {
        return 0;
    }
    const int64_t before = base->steps;
    state_t state = r->nodes[from].state;
    const outcome_t end = roll(r, &state, target, tolerance_of(r, tip_goal), 0);
    const int32_t node =
        base->steps > before ? add_rolled(r, &state, target, from, tip_goal) : from;
    feed_cell(r, &end);
    return node >= 0 && end.reached && !is_random && trace_rollouts(r, node);
}
