/* The exported functions of the rollouts. */

RRNN_EXPORT rollouts_t *NAME(rollouts_create)(planner_t *base,
                                              const rollout_settings_t *settings)
{
    rollouts_t *r = calloc(1, sizeof *r);
    if (r == NULL) {
        return NULL;
    }
    state_t state = {.u = {0}};
    r->base = base;
    r->set = *settings;
    r->set.contacts = settings->contacts < CONTACT_MAX ? settings->contacts : CONTACT_MAX;
    memcpy(state.q, base->tree[0].nodes[0].q, sizeof state.q);
    if (add_rolled(r, &state, r->set.center, -1, -1) < 0) {
        free(r);
        return NULL;
    }
    return r;
}

RRNN_EXPORT void NAME(rollouts_free)(rollouts_t *r)
{
    if (r != NULL) {
        free(r->nodes);
        free(r);
    }
}

/* Explores until solved, the budget is spent or `slice` seconds are over. */
RRNN_EXPORT int32_t NAME(rollouts_run)(rollouts_t *r, int64_t budget, double slice)
{
    const double begin = seconds();
    planner_t *base = r->base;
    const int64_t most = r->set.law <= SECOND_ORDER || budget < 1 ? budget : 1;
    base->budget = most;
    while (!base->out_of_memory) {
        if (base->random + base->heuristic >= most) {
            return BUDGET;
        }
        if (explore_once(r)) {
            return SOLVED;
        }
        if (seconds() - begin > slice) {
            return PAUSED;
        }
    }
    return NO_MEMORY;
}

/* One step at the state (q, u) towards a target: the next u, for tests. */
RRNN_EXPORT double NAME(rollouts_step)(rollouts_t *r, const double *q, double *u,
                                       const double *target)
{
    pose_t pose;
    state_t state;
    double error;
    memcpy(state.q, q, sizeof state.q);
    memcpy(state.u, u, sizeof state.u);
    pose_at(q, &pose);
    world_reset(&r->base->world);
    r->band_count = 0;
    near_contacts(r, &pose);
    if (r->set.law <= SECOND_ORDER) {
        network_step(r, &pose, target, &state, &error);
    } else {
        scheme_step(r, &pose, target, &state, &error);
    }
    memcpy(u, state.u, sizeof state.u);
    return error;
}

RRNN_EXPORT int32_t NAME(rollouts_count)(const rollouts_t *r)
{
    return r->count;
}

/* Node `index`: posture, and its parent as the result. */
RRNN_EXPORT int32_t NAME(rollouts_node)(const rollouts_t *r, int32_t index, double *q)
{
    memcpy(q, r->nodes[index].state.q, NV * sizeof(double));
    return r->nodes[index].parent;
}

/* Writes the way to node `index` as the path, as line 12 does; 0: no memory. */
RRNN_EXPORT int32_t NAME(rollouts_trace)(rollouts_t *r, int32_t index)
{
    free(r->base->path);
    r->base->path = NULL;
    r->base->path_count = 0;
    return trace_rollouts(r, index);
}
