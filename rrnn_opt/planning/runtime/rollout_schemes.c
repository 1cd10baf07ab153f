/* One step of the comparison schemes: dual sweeps of a small programme. */

#define SCHEME_ROWS (3 * CONTACT_MAX)

typedef struct {
    double task[3 * NV], right[3];          /* equalities, row by row */
    double rows[SCHEME_ROWS * NV], h[SCHEME_ROWS]; /* rows u >= h */
    double lower[NV], upper[NV];
    int32_t count;
} programme_t;

/* Dual step of an equality row: as hildreth_row, its multiplier has no sign. */
static void equality_row(const double *row, double right, double *u)
{
    const double norm2 = hildreth_dot(NV, row, row);
    const double change =
        norm2 > 1e-12 ? (right - hildreth_dot(NV, row, u)) / norm2 : 0.0;
    for (int32_t k = 0; k < NV; k++) {
        u[k] += change * row[k];
    }
}

/* Smallest u of the programme, after `sweeps` sweeps; inside the box. */
static void solve_programme(const programme_t *p, int32_t sweeps, double *u)
{
    double lambda[SCHEME_ROWS] = {0}, z[NV] = {0};
    memset(u, 0, NV * sizeof(double));
    for (int32_t sweep = 0; sweep < sweeps; sweep++) {
        for (int32_t a = 0; a < 3; a++) {
            equality_row(p->task + NV * a, p->right[a], u);
        }
        for (int32_t i = 0; i < p->count; i++) {
            hildreth_row(NV, p->rows + NV * i, p->h[i], lambda + i, u);
        }
        hildreth_box(NV, p->lower, p->upper, z, u);
    }
}

/* The record of a contact, made with what it allowed when it came near. */
static const band_t *band_of(rollouts_t *r, const near_t *pair, const double *approach)
{
    for (int32_t b = 0; b < r->band_count; b++) {
        if (r->bands[b].sphere == pair->sphere && r->bands[b].other == pair->other) {
            r->bands[b].seen = 1;
            return &r->bands[b];
        }
    }
    if (r->band_count == BAND_MAX) {
        return NULL;
    }
    band_t *band = &r->bands[r->band_count++];
    *band = (band_t){pair->sphere, pair->other, 1, {0.0, 0.0, 0.0}};
    for (int32_t a = 0; a < 3; a++) {
        band->allowed[a] = approach[a] > 0.0 ? approach[a] : 0.0;
    }
    return band;
}

/* Forgets contacts that have left. */
static void drop_bands(rollouts_t *r)
{
    int32_t kept = 0;
    for (int32_t b = 0; b < r->band_count; b++) {
        if (r->bands[b].seen) {
            r->bands[kept] = r->bands[b];
            r->bands[kept++].seen = 0;
        }
    }
    r->band_count = kept;
}

/* The contacts nearest within `safe`, at most `contacts`; returns how many. */
static int32_t nearest_contacts(rollouts_t *r, near_t **list)
{
    const int32_t most = r->set.contacts;
    int32_t found = 0;
    for (int32_t p = 0; p < r->near_count; p++) {
        near_t *pair = &r->near[p];
        if (pair->group >= 0 || pair->gap > r->set.safe ||
            (found == most && pair->gap >= list[found - 1]->gap)) {
            continue;
        }
        int32_t place = found < most ? found++ : found - 1;
        for (; place > 0 && list[place - 1]->gap > pair->gap; place--) {
            list[place] = list[place - 1];
        }
        list[place] = pair;
    }
    return found;
}

/* Three sign rows of a contact: no component goes towards the obstacle faster
 * than the band allows.  `drift`: NULL at velocity level. */
static void contact_rows(rollouts_t *r, const near_t *pair, const pose_t *pose,
                         const state_t *state, const double *drift, programme_t *p)
{
    double center[3], approach[3], share, slope, closing = 0.0;
    double *rows = p->rows + NV * p->count, sign[3];
    center_of(pose, pair->sphere, center);
    for (int32_t a = 0; a < 3; a++) {
        double axis[3] = {0};
        sign[a] = (pair->n[a] > 0.0) - (pair->n[a] < 0.0);
        axis[a] = sign[a];
        k_row(pose->axes, pose->origins, t_mask + NJ * pair->sphere, center, axis,
              rows + NV * a);
        approach[a] = -hildreth_dot(NV, rows + NV * a, state->u);
        closing -= sign[a] * pair->n[a] * approach[a];
    }
    const band_t *band = band_of(r, pair, approach);
    k_band(&pair->gap, &r->set.inner, &r->set.safe, &share, &slope);
    for (int32_t a = 0; a < 3; a++) {
        const double allowed = band == NULL ? 0.0 : band->allowed[a];
        double h = -share * allowed;
        if (drift != NULL) {
            h = -sign[a] * drift[NS * a + pair->sphere] - slope * closing * allowed +
                r->set.kappa_o * (approach[a] - share * allowed);
        }
        p->h[p->count++] = h;
    }
}

/* Velocity after one step of a comparison scheme. */
static int32_t scheme_step(rollouts_t *r, const pose_t *pose, const double *target,
                           state_t *state, double *error)
{
    const rollout_settings_t *set = &r->set;
    const int accelerate = set->law == ACCELERATION_SCHEME;
    double tip_drift[3], drift[3 * NS], u[NV];
    near_t *list[CONTACT_MAX];
    programme_t p = {.count = 0};
    const int32_t found = nearest_contacts(r, list);
    k_attraction(pose->tip_position, target, &set->gain, &set->speed, p.right, error);
    k_tip_rows(pose->axes, pose->origins, pose->tip_position, p.task);
    if (accelerate) {
        k_drift(state->q, state->u, tip_drift, drift);
        k_acceleration_limits(state->q, state->u, p.lower, p.upper);
        for (int32_t a = 0; a < 3; a++) {
            const double now = hildreth_dot(NV, p.task + NV * a, state->u);
            p.right[a] = set->rate * (p.right[a] - now) - tip_drift[a];
        }
    } else {
        k_limits(state->q, p.lower, p.upper);
    }
    for (int32_t i = 0; i < found; i++) {
        contact_rows(r, list[i], pose, state, accelerate ? drift : NULL, &p);
    }
    drop_bands(r);
    solve_programme(&p, set->sweeps, u);
    for (int32_t k = 0; k < NV; k++) {
        state->u[k] = accelerate ? state->u[k] + set->step * u[k] : u[k];
    }
    return found > 0;
}
