/* Shorten a path by sliding between two of its points; every new piece is a
 * slide, so that it is proved like the path it replaces. */

/* The point `s` rad along a path; *segment is the index of its segment. */
static void point_along(const double *path, int32_t count, double s, double *q,
                        int32_t *segment)
{
    int32_t i = 0;
    double length = distance_between(path, path + NV);
    while (i < count - 2 && s > length) {
        s -= length;
        i++;
        length = distance_between(path + NV * i, path + NV * (i + 1));
    }
    const double share = length > 0.0 ? s / length : 0.0;
    const double part = share > 1.0 ? 1.0 : share;
    for (int32_t k = 0; k < NV; k++) {
        const double from = path[NV * i + k], to = path[NV * (i + 1) + k];
        q[k] = from + part * (to - from);
    }
    *segment = i;
}

static double path_length(const double *path, int32_t count)
{
    double total = 0.0;
    for (int32_t i = 0; i + 1 < count; i++) {
        total += distance_between(path + NV * i, path + NV * (i + 1));
    }
    return total;
}

/* Replaces the part between points a (on segment i) and the slide's end (on
 * segment j) by the slide; returns the new count, or 0 when memory is out. */
static int32_t splice(planner_t *planner, int32_t count, int32_t i, const double *a,
                      int32_t j, int32_t first, int32_t added)
{
    const int32_t tail = count - j - 1;
    const int32_t total = i + 2 + added + tail;
    double *joined = malloc((size_t)total * NV * sizeof(double));
    if (joined == NULL) {
        planner->out_of_memory = 1;
        return 0;
    }
    const size_t row = NV * sizeof(double);
    memcpy(joined, planner->path, (size_t)(i + 1) * row);
    memcpy(joined + NV * (i + 1), a, row);
    memcpy(joined + NV * (i + 2), pool_at(planner, first), (size_t)added * row);
    memcpy(joined + NV * (i + 2 + added), planner->path + NV * (j + 1),
           (size_t)tail * row);
    free(planner->path);
    planner->path = joined;
    return total;
}

/* Tries `attempts` random slides along planner->path. */
static void shorten(planner_t *planner, int32_t attempts)
{
    double total = path_length(planner->path, planner->path_count);
    for (int32_t n = 0; n < attempts && planner->path_count > 1 &&
                        !cancelled(planner); n++) {
        const double x = total * rng_uniform(&planner->rng);
        const double y = total * rng_uniform(&planner->rng);
        const double from = x < y ? x : y, to = x < y ? y : x;
        const int32_t mark = planner->pool_count;
        target_t target = {.tip = NULL};
        double a[NV];
        int32_t i, j, first, added;
        point_along(planner->path, planner->path_count, from, a, &i);
        point_along(planner->path, planner->path_count, to, target.q, &j);
        const int reached = slide(planner, a, &target, &first, &added) == REACHED;
        if (reached && added > 0) {
            const double *way = pool_at(planner, first);
            const double length = distance_between(a, way) + path_length(way, added);
            const double old = to - from;
            if (length < old - 1e-3) {
                planner->path_count =
                    splice(planner, planner->path_count, i, a, j, first, added);
                total = path_length(planner->path, planner->path_count);
            }
        }
        planner->pool_count = mark;
    }
}
