/* A search is made from a request, and freed.
 * Exported names carry the program's prefix (RRNN_EXPORT). */

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
