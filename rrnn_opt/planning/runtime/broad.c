/* Broad phase: which solids a motion of norm `radius` could reach.
 *
 * Solids 0 .. flat - 1 are always looked at: those without bounds, or all of a
 * small scene.  The others hang on a tree of boxes, eight children a node,
 * children side by side; nodes from `leaf` on hold solids.
 *
 * A node's key is the way that the robot's spheres may go before it can be in
 * reach; it counts while its stamp is that of the last reset.  Stamps of nodes
 * lie behind those of the solids. */

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

static int node_far(const world_t *world, int32_t node)
{
    return world->stamp[world->count + node] == world->epoch &&
           world->node_key[node] > world->farthest;
}

static void node_keep(world_t *world, int32_t node, double least)
{
    world->stamp[world->count + node] = world->epoch;
    world->node_key[node] = world->farthest + least;
}

static inline double lesser(double a, double b)
{
    return a < b ? a : b;
}

static inline double greater(double a, double b)
{
    return a > b ? a : b;
}

/* Least entry of a block of eight, half against half. */
static inline double least_of(const double *v)
{
    double half[4];
    for (int32_t l = 0; l < 4; l++) {
        half[l] = lesser(v[l], v[l + 4]);
    }
    return lesser(lesser(half[0], half[2]), lesser(half[1], half[3]));
}

/* Greatest entry of a block of eight. */
static inline double greatest_of(const double *v)
{
    double half[4];
    for (int32_t l = 0; l < 4; l++) {
        half[l] = greater(v[l], v[l + 4]);
    }
    return greater(greater(half[0], half[2]), greater(half[1], half[3]));
}

/* Least spare of all spheres above a node's box. */
static double broad_spare(const world_t *world, const pose_t *pose, int32_t node,
                          double radius)
{
    const double *bounds = world->node_bounds + 6 * node;
    double least = 1e300;
    for (int32_t first = 0; first < NSP; first += LANES) {
        double spare[LANES];
        k_gaps_bounds(bounds, pose->centers + first, spare);
        for (int32_t l = 0; l < LANES; l++) {
            spare[l] -= t_radius[first + l] + world->margin +
                        radius * t_lever[first + l];
        }
        const double found = least_of(spare);
        least = found < least ? found : least;
    }
    return least;
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
        if (node_far(world, node)) {
            continue;
        }
        const double least = broad_spare(world, pose, node, radius);
        node_keep(world, node, least);
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
