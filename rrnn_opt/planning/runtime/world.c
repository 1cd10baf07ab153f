/* Which pairs are near, and the proof that a step is free. */

static void pose_at(const double *q, pose_t *pose)
{
    k_frames(q, pose->axes, pose->origins, pose->centers, pose->tip_position,
             pose->tip_rotation);
}

static void world_reset(world_t *world)
{
    for (int32_t i = 0; i < NS; i++) {
        world->least[i] = -1.0;
        world->way[i] = 0.0;
    }
    for (size_t i = 0; i < (size_t)NS * (size_t)world->count; i++) {
        world->key[i] = -1.0;
    }
    for (int32_t i = 0; i < NP; i++) {
        world->pair_key[i] = -1.0;
    }
}

/* A place in the list of near pairs, or NULL when it is full. */
static near_t *world_add(world_t *world, int32_t sphere, int32_t other,
                         int32_t group, double gap, const double *n)
{
    if (world->near_count >= NEAR_MAX) {
        return NULL;
    }
    near_t *pair = &world->near[world->near_count++];
    pair->sphere = sphere;
    pair->other = other;
    pair->group = group;
    pair->gap = gap;
    pair->has_row = 0;
    memcpy(pair->n, n, 3 * sizeof(double));
    return pair;
}

static int world_obstacles(world_t *world, const pose_t *pose, int32_t i,
                           double radius)
{
    const double horizon = radius * t_lever[i];
    double least = 1e300;
    double *key = world->key + (size_t)i * (size_t)world->count;
    for (int32_t o = 0; o < world->count; o++) {
        if (key[o] <= world->way[i]) {
            double d, n[3];
            k_distance(world->kind[o], pose->centers + 3 * i,
                       world->shape + SHAPE * o, &d, n);
            const double gap = d - t_radius[i] - world->margin;
            key[o] = gap > horizon ? world->way[i] + gap - horizon : world->way[i];
            if (gap <= horizon && !world_add(world, i, o, -1, gap, n)) {
                return 0;
            }
        }
        least = key[o] < least ? key[o] : least;
    }
    world->least[i] = least;
    return 1;
}

static int world_pairs(world_t *world, const pose_t *pose, double radius)
{
    for (int32_t p = 0; p < NP; p++) {
        const int32_t i = t_pair_i[p], j = t_pair_j[p];
        const double way = world->way[i] + world->way[j];
        if (world->pair_key[p] > way) {
            continue;
        }
        double d, n[3];
        const double horizon = radius * t_pair_lever[p];
        k_distance_pair(pose->centers + 3 * i, pose->centers + 3 * j, &d, n);
        const double gap = d - t_radius[i] - t_radius[j];
        world->pair_key[p] = gap > horizon ? way + gap - horizon : way;
        if (gap <= horizon &&
            !world_add(world, j, i, t_pair_group[p], gap, n)) {
            return 0;
        }
    }
    return 1;
}

/* Lists every pair whose gap a motion of norm `radius` could close.
 * Returns 0 when the list overflows: then nothing is proved. */
static int world_near(world_t *world, const pose_t *pose, double radius)
{
    world->near_count = 0;
    for (int32_t i = 0; i < NS; i++) {
        if (t_moves[i] && world->least[i] <= world->way[i] &&
            !world_obstacles(world, pose, i, radius)) {
            return 0;
        }
    }
    return world_pairs(world, pose, radius);
}

/* Does a pair break its promised clearance?  Stops at the first that does. */
static int world_hit(const world_t *world, const pose_t *pose)
{
    double d, n[3];
    for (int32_t i = 0; i < NS; i++) {
        const double *center = pose->centers + 3 * i;
        for (int32_t o = 0; t_moves[i] && o < world->count; o++) {
            k_distance(world->kind[o], center, world->shape + SHAPE * o, &d, n);
            if (d - t_radius[i] - world->margin < 0.0) {
                return 1;
            }
        }
    }
    for (int32_t p = 0; p < NP; p++) {
        const int32_t i = t_pair_i[p], j = t_pair_j[p];
        k_distance_pair(pose->centers + 3 * i, pose->centers + 3 * j, &d, n);
        if (d - t_radius[i] - t_radius[j] < 0.0) {
            return 1;
        }
    }
    return 0;
}

/* Motion bound B of a pair for the increment u. */
static double near_bound(const near_t *pair, const double *u)
{
    double moved, other;
    const int32_t i = pair->sphere, g = pair->group;
    if (g < 0) {
        k_motion_bound(u, t_reach + NJ * i, t_mask + NJ * i, &moved);
        return moved;
    }
    k_motion_bound(u, t_reach + NJ * i, t_group_j + NJ * g, &moved);
    k_motion_bound(u, t_reach + NJ * pair->other, t_group_i + NJ * g, &other);
    return moved + other;
}

/* Row n' J of a pair, written when it is first asked for. */
static const double *near_row(near_t *pair, const pose_t *pose)
{
    const int32_t i = pair->sphere, g = pair->group;
    const double *center = pose->centers + 3 * i;
    if (pair->has_row) {
        return pair->row;
    }
    pair->has_row = 1;
    if (g < 0) {
        k_row(pose->axes, pose->origins, t_mask + NJ * i, center, pair->n,
              pair->row);
        return pair->row;
    }
    double other[NV];
    k_row(pose->axes, pose->origins, t_group_j + NJ * g, center, pair->n, pair->row);
    k_row(pose->axes, pose->origins, t_group_i + NJ * g,
          pose->centers + 3 * pair->other, pair->n, other);
    for (int32_t k = 0; k < NV; k++) {
        pair->row[k] -= other[k];
    }
    return pair->row;
}

/* Upper bound of what a motion takes from a pair's gap, from the ways of the
 * spheres. */
static double near_way(const near_t *pair, const double *way)
{
    return way[pair->sphere] + (pair->group < 0 ? 0.0 : way[pair->other]);
}

/* Proof that q + s u, 0 <= s <= 1, is free: one inequality a pair that the
 * ways of its spheres could close.  Pairs that are not near are out of reach
 * of |u| <= radius. */
static int world_certify(world_t *world, const pose_t *pose, const double *u,
                         double radius, double slack)
{
    double way[NS + 1];
    if (hildreth_dot(NV, u, u) > radius * radius * (1.0 + 1e-12)) {
        return 0;
    }
    k_travel(u, way);
    for (int32_t p = 0; p < world->near_count; p++) {
        near_t *pair = &world->near[p];
        if (pair->gap - near_way(pair, way) >= slack) {
            continue;
        }
        const double drift = hildreth_dot(NV, near_row(pair, pose), u);
        if (!(pair->gap + drift - 0.5 * near_bound(pair, u) >= slack)) {
            return 0;
        }
    }
    return 1;
}

/* Adds the way of a step u to every sphere. */
static void world_advance(world_t *world, const double *u)
{
    double way[NS + 1];
    k_travel(u, way);
    for (int32_t i = 0; i < NS; i++) {
        world->way[i] += way[i];
    }
}
