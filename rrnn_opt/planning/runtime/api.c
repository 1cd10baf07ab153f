/* What a search is asked; exported names carry the program's prefix. */

typedef struct {
    double gap;           /* m, promised margin already taken off */
    int32_t sphere;
    int32_t other;        /* obstacle or second sphere */
    int32_t is_self;
    int32_t reserved;
} closest_t;

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
