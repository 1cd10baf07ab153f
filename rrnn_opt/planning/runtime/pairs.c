/* Single pairs: rows, bounds of self pairs, and the list for callers. */

static near_t pair_of(const block_t *block, int32_t l)
{
    const int32_t at = block->first, own = block->group < 0;
    near_t pair = {own ? at + l : t_pair_j[at] + l, own ? block->other : t_pair_i[at],
                   block->group, block->gap[l],
                   {block->n[l], block->n[LANES + l], block->n[2 * LANES + l]}};
    return pair;
}

/* Row n' J of a pair. */
static void near_row(const near_t *pair, const pose_t *pose, double *row)
{
    const int32_t i = pair->sphere, g = pair->group;
    double center[3], other[NV];
    center_of(pose, i, center);
    if (g < 0) {
        k_row(pose->axes, pose->origins, t_mask + NJ * i, center, pair->n, row);
        return;
    }
    k_row(pose->axes, pose->origins, t_group_j + NJ * g, center, pair->n, row);
    center_of(pose, pair->other, center);
    k_row(pose->axes, pose->origins, t_group_i + NJ * g, center, pair->n, other);
    for (int32_t k = 0; k < NV; k++) {
        row[k] -= other[k];
    }
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

/* n' J u and B(u) of a block of self pairs; where the gap is more than twice
 * what |u| can close, the bound of the ways stands for both. */
static void pairs_measure(block_t *block, const pose_t *pose, const double *u)
{
    const double length = norm_of(u);
    for (int32_t l = 0; l < LANES; l++) {
        const double way = t_pair_lever[LANES * block->first + l] * length;
        block->drift[l] = -way;
        block->bound[l] = 0.0;
        if (block->gap[l] > 2.0 * way) {
            continue;
        }
        const near_t pair = pair_of(block, l);
        double row[NV];
        near_row(&pair, pose, row);
        block->drift[l] = hildreth_dot(NV, row, u);
        block->bound[l] = near_bound(&pair, u);
    }
}

/* Could a motion of norm `radius` close this pair's gap? */
static int lane_near(const block_t *block, int32_t l, double radius)
{
    const double lever = block->group < 0 ? t_lever[block->first + l]
                                          : t_pair_lever[LANES * block->first + l];
    return block->gap[l] - radius * lever <= 0.0;
}

/* The open pairs that are near, one by one; at most `most`. */
static int32_t near_list(const world_t *world, double radius, near_t *list, int32_t most)
{
    int32_t count = 0;
    for (int32_t p = 0; p < world->open_count; p++) {
        for (int32_t l = 0; l < LANES && count < most; l++) {
            if (lane_near(&world->open[p], l, radius)) {
                list[count++] = pair_of(&world->open[p], l);
            }
        }
    }
    return count;
}
