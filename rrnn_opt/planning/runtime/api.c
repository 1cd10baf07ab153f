/* The exported functions; names carry the program's prefix (RRNN_EXPORT). */

typedef struct {
    const double *lower, *upper, *sample_lower, *sample_upper, *start;
    const int32_t *kind;
    const double *shape;
    const double *joint_goals;
    const tip_goal_t *tip_goals;
    const int32_t *first, *node_first, *node_size;
    const double *node_bounds;
    double margin;
    uint64_t seed[2];
    int32_t obstacle_count, joint_goal_count, tip_goal_count;
    int32_t flat, nodes, leaf;
} request_t;

typedef struct {
    double gap;           /* m, promised margin already taken off */
    int32_t sphere;
    int32_t other;        /* obstacle or second sphere */
    int32_t is_self;
    int32_t reserved;
} closest_t;

static void world_open(world_t *world, const request_t *request)
{
    world->count = request->obstacle_count;
    world->kind = request->kind;
    world->first = request->first;
    world->shape = request->shape;
    world->flat = request->flat;
    world->nodes = request->nodes;
    world->leaf = request->leaf;
    world->node_first = request->node_first;
    world->node_size = request->node_size;
    world->node_bounds = request->node_bounds;
}

static int start_search(planner_t *planner, const request_t *request)
{
    if (add_node(planner, 0, request->start, -1, 0, 0) < 0) {
        return 0;
    }
    for (int32_t i = 0; i < request->joint_goal_count; i++) {
        if (add_node(planner, 1, request->joint_goals + NV * i, -1, 0, 0) < 0) {
            return 0;
        }
    }
    return 1;
}

RRNN_EXPORT void NAME(free)(planner_t *planner)
{
    if (planner != NULL) {
        free(planner->world.open);
        free(planner->world.key);
        free(planner->world.node_key);
        free(planner->world.stamp);
        free(planner->tree[0].nodes);
        free(planner->tree[1].nodes);
        free(planner->pool);
        free(planner->heap);
        free(planner->tips);
        free(planner->cells);
        free(planner->path);
        free(planner);
    }
}

RRNN_EXPORT planner_t *NAME(create)(const settings_t *settings, const request_t *request)
{
    planner_t *planner = calloc(1, sizeof *planner);
    if (planner == NULL) {
        return NULL;
    }
    const size_t solids = (size_t)request->obstacle_count;
    const size_t nodes = (size_t)request->nodes;
    const size_t tips = (size_t)request->tip_goal_count + 1;
    planner->set = *settings;
    planner->steering = settings->steering;
    world_open(&planner->world, request);
    planner->world.margin = request->margin;
    planner->world.open = malloc(OPEN_MAX * sizeof(block_t));
    planner->world.key = malloc((solids * NB + 1) * sizeof(double));
    planner->world.node_key = malloc((nodes + 1) * sizeof(double));
    planner->world.stamp = calloc(solids + nodes + 1, sizeof(uint32_t));
    planner->tips = malloc(tips * sizeof(tip_goal_t));
    planner->tip_count = request->tip_goal_count;
    planner->activity = settings->coin >= 0.0 ? settings->coin : 0.0;
    planner->done[0] = planner->done[1] = -1;
    planner->deadline = NEVER;
    memcpy(planner->lower, request->lower, sizeof planner->lower);
    memcpy(planner->upper, request->upper, sizeof planner->upper);
    memcpy(planner->sample_lower, request->sample_lower, sizeof planner->lower);
    memcpy(planner->sample_upper, request->sample_upper, sizeof planner->upper);
    rng_seed(&planner->rng, request->seed);
    if (planner->world.open == NULL || planner->world.key == NULL ||
        planner->world.node_key == NULL || planner->world.stamp == NULL || planner->tips == NULL) {
        NAME(free)(planner);
        return NULL;
    }
    memcpy(planner->tips, request->tip_goals,
           (size_t)request->tip_goal_count * sizeof(tip_goal_t));
    if (!start_search(planner, request)) {
        NAME(free)(planner);
        return NULL;
    }
    return planner;
}

/* Whether Ctrl-C ends the calls below: for the one thread that handles signals. */
RRNN_EXPORT void NAME(interruptible)(planner_t *planner, int32_t yes)
{
    planner->interruptible = yes;
}

/* Goal postures first, then the search; cancelled when `limit` seconds are over. */
RRNN_EXPORT int32_t NAME(run)(planner_t *planner, int64_t budget, double slice,
                              double limit)
{
    const double begin = seconds(), end = begin + slice;
    watch_t watch;
    planner->cancelled = 0;
    planner->deadline = begin + limit;
    watch_begin(&watch, planner);
    plan_status_t status = first_root(planner, end);
    if (status == SOLVED) {
        status = search(planner, budget, end);
    }
    watch_end(&watch);
    planner->deadline = NEVER;
    return (int32_t)status;
}

RRNN_EXPORT int32_t NAME(segment_free)(planner_t *planner, const double *from,
                                  const double *to, double clearance)
{
    watch_t watch;
    planner->cancelled = 0;
    watch_begin(&watch, planner);
    const int32_t verdict = segment_free(planner, from, to, clearance);
    watch_end(&watch);
    return verdict;
}

/* Which of the postures keep every promised clearance? */
RRNN_EXPORT void NAME(postures_free)(planner_t *planner, const double *q,
                                     int32_t count, uint8_t *out)
{
    for (int32_t i = 0; i < count; i++) {
        pose_t pose;
        pose_at(q + NV * i, &pose);
        out[i] = (uint8_t)!world_hit(&planner->world, &pose);
    }
}

/* The pair with the least gap among those within `radius` rad of motion. */
RRNN_EXPORT int32_t NAME(closest)(planner_t *planner, const double *q, double radius,
                             closest_t *out)
{
    pose_t pose;
    pose_at(q, &pose);
    world_reset(&planner->world);
    const int32_t complete = world_near_within(&planner->world, &pose, &radius);
    *out = (closest_t){1e300, -1, -1, 0, 0};
    for (int32_t p = 0; p < planner->world.open_count; p++) {
        const block_t *block = &planner->world.open[p];
        for (int32_t l = 0; l < LANES; l++) {
            if (block->gap[l] < out->gap && lane_near(block, l, radius)) {
                const near_t pair = pair_of(block, l);
                *out = (closest_t){pair.gap, pair.sphere, pair.other,
                                   pair.group >= 0, 0};
            }
        }
    }
    return complete;
}

/* One projected step at q for the wish w; returns the number of near pairs. */
RRNN_EXPORT int32_t NAME(step)(planner_t *planner, const double *q, const double *w,
                               double *u, near_t *list)
{
    const double radius = planner->set.max_step;
    pose_t pose;
    pose_at(q, &pose);
    world_reset(&planner->world);
    if (!world_near(&planner->world, &pose, radius)) {
        return -1;
    }
    project(planner, q, &pose, w, radius, u);
    return near_list(&planner->world, radius, list, NEAR_MAX);
}

/* Motion bound B of a pair for the increment u. */
RRNN_EXPORT double NAME(bound)(const near_t *pair, const double *u)
{
    return near_bound(pair, u);
}

/* Takes a proved path and shortens it by `attempts` slides. */
RRNN_EXPORT int32_t NAME(shorten)(planner_t *planner, const double *path,
                                  int32_t count, int32_t attempts)
{
    double *copy = malloc((size_t)count * NV * sizeof(double));
    if (copy == NULL) {
        return 0;
    }
    memcpy(copy, path, (size_t)count * NV * sizeof(double));
    free(planner->path);
    planner->path = copy;
    planner->path_count = count;
    watch_t watch;
    planner->cancelled = 0;
    watch_begin(&watch, planner);
    shorten(planner, attempts);
    watch_end(&watch);
    return !planner->out_of_memory;
}

RRNN_EXPORT const double *NAME(path)(const planner_t *planner, int32_t *count)
{
    *count = planner->path_count;
    return planner->path;
}

RRNN_EXPORT const double *NAME(cells)(const planner_t *planner)
{
    return planner->cells;
}

/* random, heuristic, nodes of both trees, steps, goal postures, failures. */
RRNN_EXPORT void NAME(counts)(const planner_t *planner, int64_t *out)
{
    out[0] = planner->random;
    out[1] = planner->heuristic;
    out[2] = planner->tree[0].count + planner->tree[1].count;
    out[3] = planner->steps;
    out[4] = planner->roots;
    out[5] = planner->ik_failures;
}

/* Node q of a tree and its parent, for pictures; returns the node count. */
RRNN_EXPORT int32_t NAME(node)(const planner_t *planner, int32_t side, int32_t index,
                          double *q, int32_t *parent)
{
    const tree_t *tree = &planner->tree[side];
    if (index >= 0 && index < tree->count) {
        memcpy(q, tree->nodes[index].q, NV * sizeof(double));
        *parent = tree->nodes[index].parent;
    }
    return tree->count;
}
