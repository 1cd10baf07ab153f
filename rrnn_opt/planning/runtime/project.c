/* One step of the dual network: rows of the pairs that it violates, swept. */

/* Rows of the programme, their products, and the duals that solve it. */
typedef struct {
    double rows[ROW_MAX * NV], h[ROW_MAX], lambda[ROW_MAX];
    double product[ROW_MAX * ROW_MAX]; /* rows rows' */
    double inverse[ROW_MAX];           /* of its diagonal; 0: an empty row */
    int32_t count;
} duals_t;

/* Adds a row, with its products with the others. */
static void add_row(duals_t *duals, const near_t *pair, const pose_t *pose,
                    double right)
{
    const int32_t i = duals->count++;
    double *row = duals->rows + NV * i;
    near_row(pair, pose, row);
    duals->h[i] = right;
    duals->lambda[i] = 0.0;
    for (int32_t j = 0; j <= i; j++) {
        const double product = hildreth_dot(NV, row, duals->rows + NV * j);
        duals->product[ROW_MAX * i + j] = duals->product[ROW_MAX * j + i] = product;
    }
    const double norm2 = duals->product[(ROW_MAX + 1) * i];
    duals->inverse[i] = norm2 > LEAST_NORM2 ? 1.0 / norm2 : 0.0;
}

/* Sweeps of the rows alone, carried on the residuals h - rows u. */
static void sweep_rows(duals_t *duals, int32_t sweeps, double least, double *u)
{
    const int32_t count = duals->count, lanes = (count + LANES - 1) / LANES * LANES;
    double residual[ROW_MAX] = {0}, before[ROW_MAX];
    memcpy(before, duals->lambda, sizeof before);
    for (int32_t i = 0; i < count; i++) {
        residual[i] = duals->h[i] - hildreth_dot(NV, duals->rows + NV * i, u);
    }
    for (int32_t sweep = 0; sweep < sweeps; sweep++) {
        double largest = 0.0;
        for (int32_t i = 0; i < count; i++) {
            const double *restrict product = duals->product + ROW_MAX * i;
            const double now = duals->lambda[i];
            const double wanted = now + residual[i] * duals->inverse[i];
            const double next = wanted > 0.0 ? wanted : 0.0, change = next - now;
            if (change == 0.0) {
                continue;
            }
            const double size = change * change * product[i];
            largest = size > largest ? size : largest;
            duals->lambda[i] = next;
            for (int32_t j = 0; j < lanes; j++) {
                residual[j] -= change * product[j];
            }
        }
        if (largest <= least * least) {
            break;
        }
    }
    for (int32_t i = 0; i < count; i++) {
        const double change = duals->lambda[i] - before[i];
        for (int32_t k = 0; k < NV && change != 0.0; k++) {
            u[k] += change * duals->rows[NV * i + k];
        }
    }
}

/* Does the box leave u alone, as it has so far? */
static int box_idle(const double *lower, const double *upper, const double *z,
                    const double *u)
{
    int idle = 1;
    for (int32_t k = 0; k < NV; k++) {
        idle &= z[k] == 0.0 && u[k] >= lower[k] && u[k] <= upper[k];
    }
    return idle;
}

/* Sweeps the duals of the rows and, where it holds u, of the box. */
static void sweep_duals(const settings_t *set, duals_t *duals, const double *lower,
                        const double *upper, double *z, double *u)
{
    double lambda[ROW_MAX], from[NV];
    memcpy(lambda, duals->lambda, sizeof lambda);
    memcpy(from, u, sizeof from);
    sweep_rows(duals, set->sweeps, set->sweep_least, u);
    if (!box_idle(lower, upper, z, u)) {
        memcpy(duals->lambda, lambda, sizeof lambda);
        memcpy(u, from, sizeof from);
        hildreth(NV, duals->count, duals->rows, duals->h, lower, upper, set->sweeps,
                 duals->lambda, z, u);
    }
}

/* Right-hand sides of all rows, at the B(w) just measured. */
static void write_rights(planner_t *planner)
{
    for (int32_t p = 0; p < planner->world.open_count; p++) {
        block_t *block = &planner->world.open[p];
        block->used = 0;
        k_block_offset(block->gap, planner->steering, block->bound, block->right);
    }
}

typedef struct {
    double residual;
    block_t *block;
    int32_t lane;
} violation_t;

/* Puts a block's violated rows among the worst ones, worst first. */
static int32_t rank_violations(block_t *block, const double *residuals,
                               violation_t *worst, int32_t found, int32_t most)
{
    for (int32_t l = 0; l < LANES; l++) {
        const double residual = residuals[l];
        if (!(residual < -1e-9) || (block->used >> l & 1u) != 0 ||
            (found == most && residual >= worst[found - 1].residual)) {
            continue;
        }
        int32_t place = found < most ? found++ : found - 1;
        for (; place > 0 && worst[place - 1].residual > residual; place--) {
            worst[place] = worst[place - 1];
        }
        worst[place] = (violation_t){residual, block, l};
    }
    return found;
}

/* By how much each lane's row is kept, m; negative: violated. */
static void block_residuals(const double *restrict drift, const double *restrict right,
                            double *restrict residual)
{
    for (int32_t l = 0; l < LANES; l++) {
        residual[l] = drift[l] - right[l];
    }
}

/* Adds the rows most violated at the u just measured; returns how many. */
static int32_t add_violated(planner_t *planner, const pose_t *pose,
                            duals_t *duals)
{
    world_t *world = &planner->world;
    violation_t worst[PASS_MAX];
    int32_t found = 0, most = planner->set.rows_per_pass;
    most = most < PASS_MAX ? most : PASS_MAX;
    most = most < ROW_MAX - duals->count ? most : ROW_MAX - duals->count;
    for (int32_t p = 0; p < world->open_count && most > 0; p++) {
        block_t *block = &world->open[p];
        double residual[LANES];
        block_residuals(block->drift, block->right, residual);
        if (least_of(residual) < -1e-9) {
            found = rank_violations(block, residual, worst, found, most);
        }
    }
    for (int32_t i = 0; i < found; i++) {
        const int32_t l = worst[i].lane;
        const near_t pair = pair_of(worst[i].block, l);
        worst[i].block->used |= 1u << l;
        add_row(duals, &pair, pose, worst[i].block->right[l]);
    }
    return found;
}

/* Step of the dual network for the wish w, measured when it is done; returns
 * the number of rows used. */
static int32_t project(planner_t *planner, const double *q, const pose_t *pose,
                       const double *w, double radius, double *u)
{
    duals_t duals;
    duals.count = 0;
    double z[NV] = {0}, lower[NV], upper[NV];
    world_t *world = &planner->world;
    world_measure(world, pose, w);
    write_rights(planner);
    k_box(q, planner->lower, planner->upper, &radius, lower, upper);
    memcpy(u, w, NV * sizeof(double));
    hildreth_box(NV, lower, upper, z, u);
    if (memcmp(u, w, NV * sizeof(double)) != 0) {
        world_measure(world, pose, u);
    }
    for (int32_t pass = 0; pass < planner->set.passes && planner->set.project;
         pass++) {
        if (add_violated(planner, pose, &duals) == 0) {
            break;
        }
        sweep_duals(&planner->set, &duals, lower, upper, z, u);
        world_measure(world, pose, u);
    }
    const double length = norm_of(u);
    for (int32_t k = 0; k < NV && length > radius; k++) {
        u[k] *= radius / length;
    }
    if (length > radius) {
        world_measure(world, pose, u);
    }
    return duals.count;
}
