/* Which blocks are near, and the proof that a step is free. */

static void world_reset(world_t *world)
{
    world->farthest = 0.0;
    world->placed = 0;
    world->epoch++;
    world->shortened = 0;
    memset(world->way, 0, sizeof world->way);
    memset(world->group_way, 0, sizeof world->group_way);
    for (int32_t c = 0; c < NQ; c++) {
        world->pair_key[c] = -1.0;
    }
}

/* Opens every block with a pair whose gap a motion of norm `radius` could
 * close.  Returns 0 when the list overflows: then nothing is proved. */
static int world_near(world_t *world, const pose_t *pose, double radius)
{
    broad_t walk;
    int32_t o;
    world->open_count = 0;
    world_place(world, pose);
    broad_begin(world, &walk);
    while ((o = broad_next(world, pose, radius, &walk)) >= 0) {
        if (!world_obstacle(world, pose, o, radius)) {
            return 0;
        }
    }
    for (int32_t g = 0; g < NG; g++) {
        const double way = world->group_way[g];
        for (int32_t c = t_group_first[g]; c < t_group_first[g + 1]; c++) {
            if (world->pair_key[c] <= way && !world_pairs(world, pose, c, radius)) {
                return 0;
            }
        }
    }
    return 1;
}

/* As world_near, with the radius halved until the list holds all blocks. */
static int world_near_within(world_t *world, const pose_t *pose, double *radius)
{
    if (world->shortened) {
        world_reset(world);
    }
    while (!world_near(world, pose, *radius)) {
        *radius *= 0.5;
        world_reset(world);
        world->shortened = 1;  /* keys hold for this radius only */
        if (*radius < RADIUS_LEAST) {
            return 0;
        }
    }
    return 1;
}

/* Does a pair break its promised clearance?  Stops at the first that does. */
static int world_hit(world_t *world, const pose_t *pose)
{
    double gap[LANES], n[3 * LANES];
    broad_t walk;
    int32_t o;
    world_reset(world);
    broad_begin(world, &walk);
    while ((o = broad_next(world, pose, 0.0, &walk)) >= 0) {
        const double *shape = world->shape + SHAPE * world->first[o];
        for (int32_t first = 0; first < NSP; first += LANES) {
            k_gaps(world->kind[o], shape, pose->centers + first, gap);
            for (int32_t l = 0; l < LANES; l++) {
                gap[l] = gap[l] - t_radius[first + l] - world->margin;
            }
            if (least_of(gap) < 0.0) {
                return 1;
            }
        }
    }
    for (int32_t c = 0; c < NQ; c++) {
        pair_gaps(pose, c, gap, n);
        if (least_of(gap) < 0.0) {
            return 1;
        }
    }
    return 0;
}

/* J u and B(u) of block b's spheres, worked out when they are first asked for. */
static const double *block_motion(world_t *world, const pose_t *pose, int32_t b,
                                  const double *u)
{
    double *motion = world->motion + 4 * LANES * b;
    if (world->moved[b] != world->measure) {
        const int32_t first = LANES * b;
        world->moved[b] = world->measure;
        k_block_motion(pose->axes, pose->origins, pose->centers + first,
                       t_lane_reach + first, t_lane_mask + first, u, motion,
                       motion + 3 * LANES);
    }
    return motion;
}

/* n' J u of the lanes of a block, from the velocities J u. */
static void block_drift(const double *restrict n, const double *restrict v,
                        double *restrict drift)
{
    for (int32_t l = 0; l < LANES; l++) {
        drift[l] = n[l] * v[l] + n[LANES + l] * v[LANES + l] +
                   n[2 * LANES + l] * v[2 * LANES + l];
    }
}

/* Writes n' J u and B(u) of every open pair. */
static void world_measure(world_t *world, const pose_t *pose, const double *u)
{
    world->measure++;
    for (int32_t p = 0; p < world->open_count; p++) {
        block_t *block = &world->open[p];
        if (block->group >= 0) {
            pairs_measure(block, pose, u);
            continue;
        }
        const double *v = block_motion(world, pose, block->first / LANES, u);
        block_drift(block->n, v, block->drift);
        memcpy(block->bound, v + 3 * LANES, sizeof block->bound);
    }
}

/* Proof that q + s u, 0 <= s <= 1, is free: one inequality a pair, all of
 * which `world_measure` has written for this u.  Pairs that are not open are
 * out of reach of |u| <= radius. */
static int world_proved(const world_t *world, const double *u, double radius,
                        double slack)
{
    if (!(hildreth_dot(NV, u, u) <= radius * radius * (1.0 + 1e-12))) {
        return 0;
    }
    for (int32_t p = 0; p < world->open_count; p++) {
        const block_t *block = &world->open[p];
        double kept[LANES];
        for (int32_t l = 0; l < LANES; l++) {
            kept[l] = block->gap[l] + block->drift[l] - 0.5 * block->bound[l];
        }
        if (!(least_of(kept) >= slack)) {
            return 0;
        }
    }
    return 1;
}

static int world_certify(world_t *world, const pose_t *pose, const double *u,
                         double radius, double slack)
{
    world_measure(world, pose, u);
    return world_proved(world, u, radius, slack);
}

/* Adds what the step u may have brought the pairs of each group nearer. */
static void world_advance(world_t *world, const double *u)
{
    double way[NGP + 1];
    k_group_ways(u, way);
    for (int32_t g = 0; g < NGP; g++) {
        world->group_way[g] += way[g];
    }
}
