/* Broad phase: which solids a motion of norm `radius` could reach.
 *
 * Solids 0 .. flat - 1 are always looked at: those without bounds, or all of a
 * small scene.  The others hang on a tree of boxes, eight children a node,
 * children side by side; nodes from `leaf` on hold solids.
 *
 * A key is the way that the robot's spheres may go before a solid or a node
 * can be in reach; it counts while its stamp is that of the last reset.
 * Keys of nodes lie behind those of the solids. */

#define BROAD_STACK 80

typedef struct {
    int32_t at, end;      /* solids of the leaf that is open */
    int32_t stack[BROAD_STACK];
    int32_t top;
} broad_t;

static void broad_begin(const world_t *world, broad_t *walk)
{
    walk->at = 0;
    walk->end = world->flat;
    walk->top = 0;
    if (world->nodes > 0) {
        walk->stack[walk->top++] = 0;
    }
}

static int world_far(const world_t *world, int32_t index)
{
    return world->stamp[index] == world->epoch && world->key[index] > world->way;
}

static void world_key(world_t *world, int32_t index, double least)
{
    world->stamp[index] = world->epoch;
    world->key[index] = world->way + least;
}

/* Least entry, in eight lanes that vectorise. */
static double least_of(const double *values, int32_t count)
{
    double lanes[8], least = 1e300;
    int32_t i = 0;
    for (int32_t k = 0; k < 8; k++) {
        lanes[k] = 1e300;
    }
    for (; i + 8 <= count; i += 8) {
        for (int32_t k = 0; k < 8; k++) {
            lanes[k] = values[i + k] < lanes[k] ? values[i + k] : lanes[k];
        }
    }
    for (; i < count; i++) {
        least = values[i] < least ? values[i] : least;
    }
    for (int32_t k = 0; k < 8; k++) {
        least = lanes[k] < least ? lanes[k] : least;
    }
    return least;
}

/* Least spare of all spheres above a node's box. */
static double broad_spare(const world_t *world, const pose_t *pose, int32_t node,
                          double radius)
{
    double spare[NS];
    k_gaps_bounds(world->node_bounds + 6 * node, pose->centers, spare);
    for (int32_t i = 0; i < NS; i++) {
        spare[i] -= t_radius[i] + world->margin + radius * t_lever[i] - t_idle[i];
    }
    return least_of(spare, NS);
}

/* The next solid that may be in reach, or -1. */
static int32_t broad_next(world_t *world, const pose_t *pose, double radius,
                          broad_t *walk)
{
    while (walk->at == walk->end) {
        if (walk->top == 0) {
            return -1;
        }
        const int32_t node = walk->stack[--walk->top];
        if (world_far(world, world->count + node)) {
            continue;
        }
        const double least = broad_spare(world, pose, node, radius);
        world_key(world, world->count + node, least);
        if (least > 0.0) {
            continue;
        }
        const int32_t first = world->node_first[node];
        const int32_t last = first + world->node_size[node];
        if (node >= world->leaf) {
            walk->at = first;
            walk->end = last;
        }
        for (int32_t child = first; node < world->leaf && child < last; child++) {
            walk->stack[walk->top++] = child;
        }
    }
    return walk->at++;
}
