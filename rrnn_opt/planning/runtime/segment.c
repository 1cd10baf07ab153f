/* Proof that a straight segment of joint space is free, by bisection. */

#define SEGMENT_DEPTH 16

/* 1: the piece around `middle` with half `h` is proved; 0: open; -1: hit. */
static int piece_verdict(planner_t *planner, const double *middle, const double *h)
{
    world_t *world = &planner->world;
    const double slack = planner->set.slack;
    const double radius = norm_of(h);
    pose_t pose;
    pose_at(middle, &pose);
    world_reset(world);
    if (!world_near(world, &pose, radius)) {
        return 0;
    }
    int proved = 1;
    world_measure(world, &pose, h);
    for (int32_t p = 0; p < world->open_count; p++) {
        const block_t *block = &world->open[p];
        for (int32_t l = 0; l < LANES; l++) {
            const double drift = block->drift[l];
            const double loss = drift < 0.0 ? -drift : drift;
            if (block->gap[l] < slack) {
                return -1;
            }
            proved &= block->gap[l] - loss - 0.5 * block->bound[l] >= slack;
        }
    }
    return proved;
}

/* Every piece in turn, coarse to fine; a segment that is not decided at the
 * last depth counts as not free. */
static int pieces_free(planner_t *planner, const double *from, const double *to)
{
    double starts[SEGMENT_DEPTH + 2], ends[SEGMENT_DEPTH + 2];
    int32_t depths[SEGMENT_DEPTH + 2];
    int32_t top = 1;
    starts[0] = 0.0;
    ends[0] = 1.0;
    depths[0] = 0;
    while (top > 0) {
        double middle[NV], h[NV];
        top--;
        const double a = starts[top], b = ends[top];
        const int32_t depth = depths[top];
        for (int32_t k = 0; k < NV; k++) {
            const double way = to[k] - from[k];
            middle[k] = from[k] + 0.5 * (a + b) * way;
            h[k] = 0.5 * (b - a) * way;
        }
        const int verdict = piece_verdict(planner, middle, h);
        if (verdict < 0 || (verdict == 0 && depth >= SEGMENT_DEPTH) ||
            cancelled(planner)) {
            return 0;
        }
        if (verdict == 0) {
            starts[top] = 0.5 * (a + b);
            ends[top] = b;
            depths[top++] = depth + 1;
            starts[top] = a;
            ends[top] = 0.5 * (a + b);
            depths[top++] = depth + 1;
        }
    }
    return 1;
}

/* Is the segment free, with `clearance` beyond the margin to obstacles? */
static int segment_free(planner_t *planner, const double *from, const double *to,
                        double clearance)
{
    const double margin = planner->world.margin;
    planner->world.margin = margin + clearance;
    const int verdict = pieces_free(planner, from, to);
    planner->world.margin = margin;
    return verdict;
}
