/* The two trees of reached postures. */

#define PARTNERS 4        /* pairs remembered for a new node */

static double tip_error_at(const planner_t *planner, const double *q)
{
    if (planner->tip_count == 0) {
        return 0.0;
    }
    pose_t pose;
    target_t target = {.tip = planner->tips};
    double w[NV];
    int arrived;
    tip_pose_at(q, &pose);
    return drive(planner, q, &pose, &target, planner->set.max_step, w, &arrived);
}

static int32_t nearest(const tree_t *tree, const double *q)
{
    int32_t best = -1;
    double least = 1e300;
    for (int32_t i = 0; i < tree->count; i++) {
        double sum = 0.0;
        for (int32_t k = 0; k < NV; k++) {
            const double difference = tree->nodes[i].q[k] - q[k];
            sum += difference * difference;
        }
        if (sum < least) {
            least = sum;
            best = i;
        }
    }
    return best;
}

/* Remembers the nearest partners of a new node in the other tree. */
static int remember_pairs(planner_t *planner, int side, int32_t node)
{
    const tree_t *other = &planner->tree[1 - side];
    const double *q = planner->tree[side].nodes[node].q;
    pair_t best[PARTNERS];
    int32_t count = 0;
    for (int32_t i = 0; i < other->count; i++) {
        const double distance = distance_between(q, other->nodes[i].q);
        if (count == PARTNERS && distance >= best[count - 1].distance) {
            continue;
        }
        int32_t place = count < PARTNERS ? count++ : PARTNERS - 1;
        while (place > 0 && best[place - 1].distance > distance) {
            best[place] = best[place - 1];
            place--;
        }
        best[place] = (pair_t){distance, side == 0 ? node : i, side == 0 ? i : node};
    }
    for (int32_t i = 0; i < count; i++) {
        if (!heap_push(planner, best[i].distance, best[i].a, best[i].b)) {
            return 0;
        }
    }
    return 1;
}

/* Adds a node; returns its index, or -1 when memory is out. */
static int32_t add_node(planner_t *planner, int side, const double *q,
                        int32_t parent, int32_t first, int32_t count)
{
    tree_t *tree = &planner->tree[side];
    if (!grow(planner, (void **)&tree->nodes, &tree->room, tree->count + 1,
              sizeof(node_t))) {
        return -1;
    }
    node_t *node = &tree->nodes[tree->count];
    memcpy(node->q, q, sizeof node->q);
    node->parent = parent;
    node->first = first;
    node->count = count;
    node->uses = 0;
    node->tip_error = side == 0 ? tip_error_at(planner, q) : 0.0;
    tree->count++;
    return remember_pairs(planner, side, tree->count - 1) ? tree->count - 1 : -1;
}

/* Adds a slide as a chain of nodes `node_gap` apart; returns the last node
 * (`from` when the slide did not move), or -1 when memory is out. */
static int32_t add_slide(planner_t *planner, int side, int32_t from, int32_t first,
                         int32_t count)
{
    int32_t parent = from, begin = first;
    double way = 0.0;
    double last[NV];
    memcpy(last, planner->tree[side].nodes[from].q, sizeof last);
    for (int32_t i = first; i < first + count; i++) {
        const double *q = pool_at(planner, i);
        way += distance_between(q, last);
        memcpy(last, q, sizeof last);
        if (way >= planner->set.node_gap || i == first + count - 1) {
            parent = add_node(planner, side, last, parent, begin, i + 1 - begin);
            if (parent < 0) {
                return -1;
            }
            begin = i + 1;
            way = 0.0;
        }
    }
    return parent;
}

static int path_push(planner_t *planner, const double *q)
{
    double *end = planner->path + (size_t)NV * (size_t)planner->path_count;
    memcpy(end, q, NV * sizeof(double));
    planner->path_count++;
    return 1;
}

/* Number of waypoints from the root of a tree to a node. */
static int32_t way_length(const tree_t *tree, int32_t node)
{
    int32_t total = 1;
    for (; node >= 0 && tree->nodes[node].parent >= 0;
         node = tree->nodes[node].parent) {
        total += tree->nodes[node].count;
    }
    return total;
}

/* Appends the way node -> root, the node itself included. */
static void append_back(planner_t *planner, const tree_t *tree, int32_t node)
{
    path_push(planner, tree->nodes[node].q);
    while (tree->nodes[node].parent >= 0) {
        const node_t *at = &tree->nodes[node];
        for (int32_t i = at->count - 2; i >= 0; i--) {
            path_push(planner, pool_at(planner, at->first + i));
        }
        path_push(planner, tree->nodes[at->parent].q);
        node = at->parent;
    }
}

/* Writes start -> done[0], then done[1] -> root of the goal tree. */
static int trace_path(planner_t *planner)
{
    const int32_t a = planner->done[0], b = planner->done[1];
    const int32_t head = way_length(&planner->tree[0], a);
    const int32_t tail = b >= 0 ? way_length(&planner->tree[1], b) : 0;
    planner->path = malloc((size_t)(head + tail) * NV * sizeof(double));
    if (planner->path == NULL) {
        planner->out_of_memory = 1;
        return 0;
    }
    append_back(planner, &planner->tree[0], a);
    for (int32_t i = 0, j = head - 1; i < j; i++, j--) {
        double swap[NV];
        double *x = planner->path + NV * i, *y = planner->path + NV * j;
        memcpy(swap, x, sizeof swap);
        memcpy(x, y, sizeof swap);
        memcpy(y, swap, sizeof swap);
    }
    if (b >= 0) {
        append_back(planner, &planner->tree[1], b);
    }
    return 1;
}
