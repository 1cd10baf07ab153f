/* Growing arrays: waypoints, nodes, pairs, the record of the memory cell. */

/* Makes room for `wanted` items of `size` bytes; 0 when memory is out. */
static int grow(planner_t *planner, void **items, int32_t *room, int32_t wanted,
                size_t size)
{
    if (wanted <= *room) {
        return 1;
    }
    const int32_t next = wanted < 512 ? 1024 : 2 * wanted;
    void *moved = realloc(*items, (size_t)next * size);
    if (moved == NULL) {
        planner->out_of_memory = 1;
        return 0;
    }
    *items = moved;
    *room = next;
    return 1;
}

static int pool_push(planner_t *planner, const double *q)
{
    if (!grow(planner, (void **)&planner->pool, &planner->pool_room,
              planner->pool_count + 1, NV * sizeof(double))) {
        return 0;
    }
    memcpy(planner->pool + (size_t)NV * (size_t)planner->pool_count, q,
           NV * sizeof(double));
    planner->pool_count++;
    return 1;
}

static const double *pool_at(const planner_t *planner, int32_t index)
{
    return planner->pool + (size_t)NV * (size_t)index;
}

/* Binary heap of untried pairs of nodes, nearest first. */
static int heap_push(planner_t *planner, double distance, int32_t a, int32_t b)
{
    if (!grow(planner, (void **)&planner->heap, &planner->heap_room,
              planner->heap_count + 1, sizeof(pair_t))) {
        return 0;
    }
    pair_t *heap = planner->heap;
    int32_t child = planner->heap_count++;
    while (child > 0 && heap[(child - 1) / 2].distance > distance) {
        heap[child] = heap[(child - 1) / 2];
        child = (child - 1) / 2;
    }
    heap[child] = (pair_t){distance, a, b};
    return 1;
}

static int heap_pop(planner_t *planner, pair_t *out)
{
    if (planner->heap_count == 0) {
        return 0;
    }
    pair_t *heap = planner->heap;
    const int32_t count = --planner->heap_count;
    const pair_t last = heap[count];
    int32_t hole = 0;
    *out = heap[0];
    for (;;) {
        int32_t child = 2 * hole + 1;
        if (child >= count) {
            break;
        }
        if (child + 1 < count && heap[child + 1].distance < heap[child].distance) {
            child++;
        }
        if (heap[child].distance >= last.distance) {
            break;
        }
        heap[hole] = heap[child];
        hole = child;
    }
    heap[hole] = last;
    return 1;
}
