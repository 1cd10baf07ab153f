/* Blocks of spheres or sphere pairs that a step could bring into contact. */

static double norm_of(const double *a)
{
    double sum = hildreth_dot(NV, a, a);
    double root;
    k_sqrt(&sum, &root);
    return root;
}

static void pose_at(const double *q, pose_t *pose)
{
    memset(pose->centers + 3 * NSP, 0, LANES * sizeof(double)); /* read by idle lanes */
    k_frames(q, pose->axes, pose->origins, pose->centers, pose->tip_position,
             pose->tip_rotation);
}

/* The pose without the spheres' centres. */
static void tip_pose_at(const double *q, pose_t *pose)
{
    k_tip_frames(q, pose->axes, pose->origins, pose->tip_position, pose->tip_rotation);
}

/* Centre of sphere i; centres lie coordinate by coordinate. */
static void center_of(const pose_t *pose, int32_t i, double *p)
{
    p[0] = pose->centers[i];
    p[1] = pose->centers[NSP + i];
    p[2] = pose->centers[2 * NSP + i];
}

/* A place in the list of open blocks, or NULL when it is full. */
static block_t *block_open(world_t *world, int32_t other, int32_t group,
                           int32_t first)
{
    if (world->open_count >= OPEN_MAX) {
        return NULL;
    }
    block_t *block = &world->open[world->open_count++];
    block->other = other;
    block->group = group;
    block->first = first;
    block->used = 0;
    return block;
}

/* Opens the blocks of spheres near obstacle o; 0 when the list overflows. */
static int world_obstacle(world_t *world, const pose_t *pose, int32_t o,
                          double radius)
{
    const int32_t kind = world->kind[o];
    const double *shape = world->shape + SHAPE * world->first[o];
    double *key = world->key + (size_t)NB * (size_t)o;
    const int known = world->stamp[o] == world->epoch;
    for (int32_t b = 0; b < NB; b++) {
        const int32_t first = LANES * b;
        double spare[LANES];
        if (known && key[b] > world->way[b]) {
            continue;
        }
        block_t *block = block_open(world, o, -1, first);
        if (block == NULL) {
            return 0;
        }
        k_block(kind, shape, pose->centers + first, block->gap, block->n);
        for (int32_t l = 0; l < LANES; l++) {
            block->gap[l] = block->gap[l] - t_radius[first + l] - world->margin;
            spare[l] = block->gap[l] - radius * t_lever[first + l];
        }
        const double least = least_of(spare);
        key[b] = world->way[b] + least;
        world->open_count -= least > 0.0;
    }
    world->stamp[o] = world->epoch;
    return 1;
}

/* Gaps of block c of sphere pairs, and unit vectors from its sphere i to the
 * spheres j, which lie side by side. */
static void pair_gaps(const pose_t *pose, int32_t c, double *gap, double *n)
{
    double center[3];
    center_of(pose, t_pair_i[c], center);
    k_pair_block(center, pose->centers + t_pair_j[c], gap, n);
    for (int32_t l = 0; l < LANES; l++) {
        gap[l] -= t_pair_radius[LANES * c + l];
    }
}

/* Opens block c of sphere pairs if it is near; 0 when the list overflows.
 * Its least distance, greatest radius and greatest lever are looked at first. */
static int world_pairs(world_t *world, const pose_t *pose, int32_t c, double radius)
{
    const int32_t group = t_pair_group[c];
    double center[3], square[LANES], least, distance;
    center_of(pose, t_pair_i[c], center);
    k_pair_squares(center, pose->centers + t_pair_j[c], square);
    for (int32_t l = 0; l < LANES; l++) {
        square[l] += t_pair_idle[LANES * c + l];
    }
    least = least_of(square);
    k_sqrt(&least, &distance);
    const double spare = distance - t_pair_size[c] - radius * t_pair_rate[c];
    world->pair_key[c] = world->group_way[group] + spare;
    if (spare > 0.0) {
        return 1;
    }
    block_t *block = block_open(world, -1, group, c);
    if (block == NULL) {
        return 0;
    }
    pair_gaps(pose, c, block->gap, block->n);
    return 1;
}

/* Adds what the centres went since they were last seen. */
static void world_place(world_t *world, const pose_t *pose)
{
    double square[LANES], greatest[NB], farthest = 0.0;
    for (int32_t b = 0; b < NB && world->placed; b++) {
        k_block_squares(world->seen + LANES * b, pose->centers + LANES * b, square);
        greatest[b] = greatest_of(square);
    }
    for (int32_t b = 0; b < NB && world->placed; b++) {
        double longest;
        k_sqrt(greatest + b, &longest);
        world->way[b] += longest;
        farthest = greater(longest, farthest);
    }
    world->farthest += farthest;
    world->placed = 1;
    memcpy(world->seen, pose->centers, sizeof world->seen);
}
