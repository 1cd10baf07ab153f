/* The search: random attraction, heuristic pairs, and the cell that chooses. */

static int open_exploration(planner_t *planner, int is_random)
{
    const int64_t index = planner->random + planner->heuristic;
    if (index >= planner->budget) {
        return 0;
    }
    if (!grow(planner, (void **)&planner->cells, &planner->cell_room,
              (int32_t)index + 1, sizeof(double))) {
        return 0;
    }
    planner->cells[index] = planner->activity;
    if (is_random) {
        planner->random++;
    } else {
        planner->heuristic++;
    }
    return 1;
}

static void close_exploration(planner_t *planner, slide_end_t end)
{
    const double stimulus = end == REACHED ? 0.0 : 1.0;
    double next;
    k_memory(&planner->activity, &stimulus, &next);
    planner->activity = planner->set.coin >= 0.0 ? planner->set.coin : next;
}

/* One rollout from a node; the new last node goes to *last. */
static slide_end_t explore(planner_t *planner, int side, int32_t from,
                           const target_t *target, int is_random, int32_t *last)
{
    int32_t first, count;
    double q[NV];
    *last = -1;
    if (!open_exploration(planner, is_random)) {
        return EXHAUSTED;
    }
    memcpy(q, planner->tree[side].nodes[from].q, sizeof q);
    const slide_end_t end = slide(planner, q, target, &first, &count);
    *last = planner->out_of_memory ? -1 : add_slide(planner, side, from, first, count);
    close_exploration(planner, end);
    return end;
}

static void meet(planner_t *planner, int side, int32_t here, int32_t there)
{
    planner->done[side] = here;
    planner->done[1 - side] = there;
}

/* Slides a node of one tree to a node of the other. */
static int connect(planner_t *planner, int side, int32_t from, int32_t to)
{
    target_t target = {.tip = NULL};
    int32_t last;
    memcpy(target.q, planner->tree[1 - side].nodes[to].q, sizeof target.q);
    if (explore(planner, side, from, &target, 0, &last) != REACHED || last < 0) {
        return 0;
    }
    meet(planner, side, last, to);
    return 1;
}

static int random_turn(planner_t *planner)
{
    target_t target = {.tip = NULL};
    int32_t last;
    if (planner->random_turns++ % 2 == 0) {
        find_root(planner, NULL);
    }
    draw_attraction(planner, target.q);
    const int side = planner->tree[1].count < planner->tree[0].count &&
                     planner->tree[1].count > 0;
    const int32_t from = nearest(&planner->tree[side], target.q);
    explore(planner, side, from, &target, 1, &last);
    if (!planner->set.connect || last < 0 || planner->tree[1 - side].count == 0) {
        return 0;
    }
    const double *reached = planner->tree[side].nodes[last].q;
    return connect(planner, 1 - side, nearest(&planner->tree[1 - side], reached),
                   last);
}

/* Slides the most promising node of the start tree straight to a tip goal. */
static int tip_turn(planner_t *planner)
{
    tree_t *tree = &planner->tree[0];
    int32_t best = 0, last;
    double least = 1e300;
    for (int32_t i = 0; i < tree->count; i++) {
        const double cost = tree->nodes[i].tip_error * (1.0 + tree->nodes[i].uses);
        if (cost < least) {
            least = cost;
            best = i;
        }
    }
    const int32_t turn = tree->nodes[best].uses++ % planner->tip_count;
    const target_t target = {.tip = planner->tips + turn};
    if (explore(planner, 0, best, &target, 0, &last) != REACHED || last < 0) {
        return 0;
    }
    meet(planner, 0, last, -1);
    return 1;
}

static int heuristic_turn(planner_t *planner)
{
    pair_t pair;
    const int32_t turn = planner->turns++;
    const int wanted = planner->set.drive && turn % 3 == 2;
    if (planner->tip_count > 0 && (wanted || planner->tree[1].count == 0)) {
        return tip_turn(planner);
    }
    if (!heap_pop(planner, &pair)) {
        return random_turn(planner);
    }
    return turn % 2 == 0 ? connect(planner, 1, pair.b, pair.a)
                         : connect(planner, 0, pair.a, pair.b);
}

/* Chooses between a random and a heuristic turn, and takes it.  Late choices are in
 * turn made without the steering margin, which would close narrower passages. */
static int take_turn(planner_t *planner)
{
    const int64_t index = planner->choices++;
    const int close = index >= planner->set.close_after && index % 2 == 1;
    planner->steering = close ? 0.0 : planner->set.steering;
    const int found = rng_uniform(&planner->rng) < planner->activity
                          ? random_turn(planner)
                          : heuristic_turn(planner);
    planner->steering = planner->set.steering;
    return found;
}

/* Explores until a path is found, the budget is spent, or the clock shows `end`
 * (PAUSED: call again; pausing changes nothing of what is found), or until it is
 * cancelled, which does. */
static plan_status_t search(planner_t *planner, int64_t budget, double end)
{
    planner->budget = budget;
    while (!planner->out_of_memory) {
        if (planner->random + planner->heuristic >= budget) {
            return BUDGET;
        }
        if (take_turn(planner) && trace_path(planner)) {
            return SOLVED;
        }
        if (cancelled(planner)) {
            return CANCELLED;
        }
        if (seconds() > end) {
            return PAUSED;
        }
    }
    return NO_MEMORY;
}
