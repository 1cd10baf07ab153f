/* Which pairs are near, and the proof that a step is free. */

static void pose_at(const double *q, pose_t *pose)
{
    k_frames(q, pose->axes, pose->origins, pose->centers, pose->tip_position,
             pose->tip_rotation);
}

/* Centre of sphere i; centres lie coordinate by coordinate. */
static void center_of(const pose_t *pose, int32_t i, double *p)
{
    p[0] = pose->centers[i];
    p[1] = pose->centers[NS + i];
    p[2] = pose->centers[2 * NS + i];
}

static void world_reset(world_t *world)
{
    world->way = 0.0;
    world->epoch++;
    world->shortened = 0;
    for (int32_t g = 0; g < NG; g++) {
        world->group_key[g] = -1.0;
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

/* Adds the spheres near obstacle o; 0 when the list overflows. */
static int world_obstacle(world_t *world, const pose_t *pose, int32_t o,
                          double radius)
{
    const int32_t kind = world->kind[o];
    const double *shape = world->shape + SHAPE * world->first[o];
    double distance[NS], spare[NS];
    k_gaps(kind, shape, pose->centers, distance);
    for (int32_t i = 0; i < NS; i++) {
        distance[i] = distance[i] - t_radius[i] - world->margin;
        spare[i] = distance[i] - radius * t_lever[i] + t_idle[i];
    }
    const double least = least_of(spare, NS);
    for (int32_t i = 0; i < NS && least <= 0.0; i++) {
        double p[3], n[3], d;
        if (spare[i] > 0.0) {
            continue;
        }
        center_of(pose, i, p);
        k_distance(kind, p, shape, &d, n);
        if (!world_add(world, i, o, -1, distance[i], n)) {
            return 0;
        }
    }
    world_key(world, o, least);
    return 1;
}

/* Adds the near pairs of group g; 0 when the list overflows. */
static int world_group(world_t *world, const pose_t *pose, int32_t g, double radius)
{
    const int32_t first = t_group_first[g], count = t_group_first[g + 1] - first;
    double distance[NP + 1], spare[NP + 1];
    spare[0] = 1e300;
    k_pair_gaps(g, pose->centers, distance);
    for (int32_t p = 0; p < count; p++) {
        distance[p] = distance[p] - t_pair_radius[first + p];
        spare[p] = distance[p] - radius * t_pair_lever[first + p];
    }
    const double least = least_of(spare, count);
    for (int32_t p = 0; p < count && least <= 0.0; p++) {
        double a[3], b[3], d, n[3];
        if (spare[p] > 0.0) {
            continue;
        }
        const int32_t i = t_pair_i[first + p], j = t_pair_j[first + p];
        center_of(pose, i, a);
        center_of(pose, j, b);
        k_distance_pair(a, b, &d, n);
        if (!world_add(world, j, i, g, distance[p], n)) {
            return 0;
        }
    }
    world->group_key[g] = 2.0 * world->way + least;
    return 1;
}

/* Lists every pair whose gap a motion of norm `radius` could close.
 * Returns 0 when the list overflows: then nothing is proved. */
static int world_near(world_t *world, const pose_t *pose, double radius)
{
    broad_t walk;
    int32_t o;
    world->near_count = 0;
    broad_begin(world, &walk);
    while ((o = broad_next(world, pose, radius, &walk)) >= 0) {
        if (!world_far(world, o) && !world_obstacle(world, pose, o, radius)) {
            return 0;
        }
    }
    for (int32_t g = 0; g < NG; g++) {
        if (world->group_key[g] <= 2.0 * world->way &&
            !world_group(world, pose, g, radius)) {
            return 0;
        }
    }
    return 1;
}

/* As world_near, with the radius halved until the list holds all pairs. */
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
    double gap[NS + NP];
    broad_t walk;
    int32_t o;
    world_reset(world);
    broad_begin(world, &walk);
    while ((o = broad_next(world, pose, 0.0, &walk)) >= 0) {
        k_gaps(world->kind[o], world->shape + SHAPE * world->first[o], pose->centers,
               gap);
        for (int32_t i = 0; i < NS; i++) {
            gap[i] = gap[i] - t_radius[i] - world->margin + t_idle[i];
        }
        if (least_of(gap, NS) < 0.0) {
            return 1;
        }
    }
    for (int32_t g = 0; g < NG; g++) {
        const int32_t first = t_group_first[g], count = t_group_first[g + 1] - first;
        k_pair_gaps(g, pose->centers, gap);
        for (int32_t p = 0; p < count; p++) {
            gap[p] = gap[p] - t_pair_radius[first + p];
        }
        if (least_of(gap, count) < 0.0) {
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
    double center[3];
    if (pair->has_row) {
        return pair->row;
    }
    pair->has_row = 1;
    center_of(pose, i, center);
    if (g < 0) {
        k_row(pose->axes, pose->origins, t_mask + NJ * i, center, pair->n,
              pair->row);
        return pair->row;
    }
    double other[NV];
    k_row(pose->axes, pose->origins, t_group_j + NJ * g, center, pair->n, pair->row);
    center_of(pose, pair->other, center);
    k_row(pose->axes, pose->origins, t_group_i + NJ * g, center, pair->n, other);
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
    double way[NS];
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

/* Adds the longest way of a sphere in the step u. */
static void world_advance(world_t *world, const double *u)
{
    double way[NS], longest = 0.0;
    k_travel(u, way);
    for (int32_t i = 0; i < NS; i++) {
        longest = way[i] > longest ? way[i] : longest;
    }
    world->way += longest;
}
