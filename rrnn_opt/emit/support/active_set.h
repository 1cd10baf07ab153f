/* Dual active-set method for a small strictly convex quadratic programme.
 *
 *   minimise 1/2 x'Px + q'x   subject to   A x = b,  G x <= h,  lb <= x <= ub
 *
 * It starts at the free minimum and takes up the most violated row until none
 * is left, dropping rows whose multiplier turns negative; every partial step
 * raises the dual objective.  Fixed sizes, no allocation, at most
 * RRNN_QP_STEPS partial steps.
 *
 * Before this text: RRNN_QP_N unknowns (> 0), RRNN_QP_P equality rows,
 * RRNN_QP_M inequality rows.
 *
 * Source: D. Goldfarb, A. Idnani, "A numerically stable dual method for
 * solving strictly convex quadratic programs", Mathematical Programming 27,
 * 1983; the factors J and R are updated by Givens rotations as there.
 */
/* Rows: lower bounds, upper bounds, equalities, inequalities. */
#define RRNN_QP_UPPER (RRNN_QP_N)
#define RRNN_QP_EQUAL (2U * RRNN_QP_N)
#define RRNN_QP_ROWS (RRNN_QP_EQUAL + RRNN_QP_P)
#define RRNN_QP_ALL (RRNN_QP_ROWS + RRNN_QP_M)
#define RRNN_QP_STEPS (4U * (RRNN_QP_ALL + RRNN_QP_N))
#define RRNN_QP_ROOM(count) (((count) > 0U) ? (count) : 1U)

typedef enum {
    RRNN_QP_SOLVED = 0,
    RRNN_QP_INFEASIBLE = 1, /* rows contradict each other */
    RRNN_QP_SPENT = 2       /* RRNN_QP_STEPS were not enough */
} rrnn_qp_status_t;

/* The data; matrices column-major; infinite bounds are none. */
typedef struct {
    real_t q[RRNN_QP_N];
    real_t A[RRNN_QP_ROOM(RRNN_QP_P * RRNN_QP_N)];
    real_t b[RRNN_QP_ROOM(RRNN_QP_P)];
    real_t G[RRNN_QP_ROOM(RRNN_QP_M * RRNN_QP_N)];
    real_t h[RRNN_QP_ROOM(RRNN_QP_M)];
    real_t lb[RRNN_QP_N];
    real_t ub[RRNN_QP_N];
} rrnn_qp_t;

/* The answer: stationary where Px + q = A'lam - G'mu + (bounds). */
typedef struct {
    real_t x[RRNN_QP_N];
    real_t lam[RRNN_QP_ROOM(RRNN_QP_P)];
    real_t mu[RRNN_QP_ROOM(RRNN_QP_M)];
    real_t box[RRNN_QP_N]; /* positive at an active upper bound */
    uint32_t steps;        /* partial steps that were taken */
} rrnn_qp_answer_t;

/* J J' = P^-1; J = [J1 J2] with R = J1'N upper triangular, N the active
 * normals in the order of `active`, and J2'N = 0. */
typedef struct {
    real_t J[RRNN_QP_N * RRNN_QP_N]; /* row-major, as R */
    real_t R[RRNN_QP_N * RRNN_QP_N];
    real_t x[RRNN_QP_N];
    real_t d[RRNN_QP_N];             /* J' normal */
    real_t z[RRNN_QP_N];             /* primal direction */
    real_t r[RRNN_QP_N];             /* dual direction, negated */
    real_t y[RRNN_QP_N];             /* multipliers of the active rows */
    uint32_t active[RRNN_QP_N];
    uint8_t held[RRNN_QP_ALL];       /* 1: in `active`, or not needed */
    uint32_t count;
} rrnn_qp_work_t;

static real_t rrnn_qp_dot(const real_t a[], const real_t b[])
{
    real_t sum = RRNN_C(0.0);
    uint32_t i;
    for (i = 0U; i < RRNN_QP_N; ++i) {
        sum += a[i] * b[i];
    }
    return sum;
}

/* Row k as normal'x >= right; returns right. */
static real_t rrnn_qp_normal(const rrnn_qp_t *qp, uint32_t k, real_t normal[])
{
    real_t right;
    uint32_t i;
    for (i = 0U; i < RRNN_QP_N; ++i) {
        normal[i] = RRNN_C(0.0);
    }
    if (k < RRNN_QP_UPPER) {
        normal[k] = RRNN_C(1.0);
        right = qp->lb[k];
    } else if (k < RRNN_QP_EQUAL) {
        normal[k - RRNN_QP_UPPER] = -RRNN_C(1.0);
        right = -qp->ub[k - RRNN_QP_UPPER];
    } else if (k < RRNN_QP_ROWS) {
        for (i = 0U; i < RRNN_QP_N; ++i) {
            normal[i] = qp->A[(k - RRNN_QP_EQUAL) + (RRNN_QP_P * i)];
        }
        right = qp->b[k - RRNN_QP_EQUAL];
    } else {
        for (i = 0U; i < RRNN_QP_N; ++i) {
            normal[i] = -qp->G[(k - RRNN_QP_ROWS) + (RRNN_QP_M * i)];
        }
        right = -qp->h[k - RRNN_QP_ROWS];
    }
    return right;
}

/* Turns columns j and k of J, and rows j and k of R from column `from` on, so
 * that (a, b) becomes (length, 0); returns the length. */
static real_t rrnn_qp_turn(rrnn_qp_work_t *w, uint32_t j, uint32_t k, uint32_t from,
                           real_t a, real_t b)
{
    const real_t length = RRNN_SQRT((a * a) + (b * b));
    if (length > RRNN_C(0.0)) {
        const real_t c = a / length;
        const real_t s = b / length;
        uint32_t i;
        for (i = 0U; i < RRNN_QP_N; ++i) {
            real_t *const row = &w->J[i * RRNN_QP_N];
            const real_t first = row[j];
            const real_t second = row[k];
            row[j] = (c * first) + (s * second);
            row[k] = (c * second) - (s * first);
        }
        for (i = from; i < w->count; ++i) {
            const real_t first = w->R[(j * RRNN_QP_N) + i];
            const real_t second = w->R[(k * RRNN_QP_N) + i];
            w->R[(j * RRNN_QP_N) + i] = (c * first) + (s * second);
            w->R[(k * RRNN_QP_N) + i] = (c * second) - (s * first);
        }
    }
    return length;
}

/* Puts row k, whose d is at hand, behind the active ones. */
static void rrnn_qp_add(rrnn_qp_work_t *w, uint32_t k, real_t multiplier)
{
    uint32_t j;
    uint32_t i;
    for (j = RRNN_QP_N - 1U; j > w->count; --j) {
        if (w->d[j] != RRNN_C(0.0)) {
            w->d[j - 1U] = rrnn_qp_turn(w, j - 1U, j, w->count, w->d[j - 1U], w->d[j]);
        }
    }
    for (i = 0U; i <= w->count; ++i) {
        w->R[(i * RRNN_QP_N) + w->count] = w->d[i];
    }
    w->active[w->count] = k;
    w->y[w->count] = multiplier;
    w->held[k] = 1U;
    w->count += 1U;
}

/* Takes out the active row at `place`. */
static void rrnn_qp_drop(rrnn_qp_work_t *w, uint32_t place)
{
    uint32_t j;
    uint32_t i;
    w->held[w->active[place]] = 0U;
    w->count -= 1U;
    for (j = place; j < w->count; ++j) {
        w->active[j] = w->active[j + 1U];
        w->y[j] = w->y[j + 1U];
        for (i = 0U; i <= (j + 1U); ++i) {
            w->R[(i * RRNN_QP_N) + j] = w->R[(i * RRNN_QP_N) + j + 1U];
        }
    }
    for (j = place; j < w->count; ++j) {
        const real_t a = w->R[(j * RRNN_QP_N) + j];
        const real_t b = w->R[((j + 1U) * RRNN_QP_N) + j];
        if (b != RRNN_C(0.0)) {
            (void)rrnn_qp_turn(w, j, j + 1U, j, a, b);
            w->R[((j + 1U) * RRNN_QP_N) + j] = RRNN_C(0.0);
        }
    }
}

/* Directions d, z, r of a normal; returns normal'z, or 0 when the normal lies
 * in the span of the active ones. */
static real_t rrnn_qp_directions(rrnn_qp_work_t *w, const real_t normal[])
{
    real_t whole = RRNN_C(0.0);
    real_t rest = RRNN_C(0.0);
    uint32_t i;
    uint32_t j;
    for (j = 0U; j < RRNN_QP_N; ++j) {
        w->d[j] = RRNN_C(0.0);
        w->z[j] = RRNN_C(0.0);
    }
    for (i = 0U; i < RRNN_QP_N; ++i) {
        for (j = 0U; j < RRNN_QP_N; ++j) {
            w->d[j] += w->J[(i * RRNN_QP_N) + j] * normal[i];
        }
    }
    for (j = 0U; j < RRNN_QP_N; ++j) {
        whole += w->d[j] * w->d[j];
        rest += (j < w->count) ? RRNN_C(0.0) : (w->d[j] * w->d[j]);
    }
    for (i = 0U; i < RRNN_QP_N; ++i) {
        for (j = w->count; j < RRNN_QP_N; ++j) {
            w->z[i] += w->J[(i * RRNN_QP_N) + j] * w->d[j];
        }
    }
    for (i = w->count; i > 0U; --i) {
        real_t sum = w->d[i - 1U];
        for (j = i; j < w->count; ++j) {
            sum -= w->R[((i - 1U) * RRNN_QP_N) + j] * w->r[j];
        }
        w->r[i - 1U] = sum / w->R[((i - 1U) * RRNN_QP_N) + (i - 1U)];
    }
    return (rest > (RRNN_QP_DEPENDENT * whole)) ? rest : RRNN_C(0.0);
}

static void rrnn_qp_move(rrnn_qp_work_t *w, real_t primal, real_t dual)
{
    uint32_t i;
    for (i = 0U; i < RRNN_QP_N; ++i) {
        w->x[i] += primal * w->z[i];
    }
    for (i = 0U; i < w->count; ++i) {
        w->y[i] -= dual * w->r[i];
    }
}

/* Takes up the equality rows; one that follows from the others is left out. */
static rrnn_qp_status_t rrnn_qp_equalities(rrnn_qp_work_t *w, const rrnn_qp_t *qp)
{
    rrnn_qp_status_t status = RRNN_QP_SOLVED;
    real_t normal[RRNN_QP_N];
    uint32_t k;
    for (k = RRNN_QP_EQUAL; k < RRNN_QP_ROWS; ++k) {
        const real_t right = rrnn_qp_normal(qp, k, normal);
        const real_t lack = right - rrnn_qp_dot(normal, w->x);
        const real_t slope = rrnn_qp_directions(w, normal);
        if (slope > RRNN_C(0.0)) {
            rrnn_qp_move(w, lack / slope, lack / slope);
            rrnn_qp_add(w, k, lack / slope);
        } else {
            const real_t size = RRNN_C(1.0) + RRNN_FABS(right);
            w->held[k] = 1U;
            if (!(RRNN_FABS(lack) <= (RRNN_QP_REDUNDANT * size))) {
                status = RRNN_QP_INFEASIBLE;
            }
        }
    }
    return status;
}

/* The row that is violated most; RRNN_QP_ALL when none is. */
static uint32_t rrnn_qp_worst(const rrnn_qp_work_t *w, const rrnn_qp_t *qp)
{
    real_t normal[RRNN_QP_N];
    real_t most = RRNN_C(0.0);
    uint32_t found = RRNN_QP_ALL;
    uint32_t k;
    for (k = 0U; k < RRNN_QP_ALL; ++k) {
        if (w->held[k] == 0U) {
            const real_t right = rrnn_qp_normal(qp, k, normal);
            const real_t lack = right - rrnn_qp_dot(normal, w->x);
            const real_t size = RRNN_C(1.0) + RRNN_FABS(right);
            if ((lack > most) && (lack > (RRNN_QP_FEASIBLE * size))) {
                most = lack;
                found = k;
            }
        }
    }
    return found;
}

/* The active inequality whose multiplier is the first to reach zero along r,
 * and the length of that step; RRNN_QP_N when none does. */
static uint32_t rrnn_qp_first(const rrnn_qp_work_t *w, real_t *length)
{
    uint32_t found = RRNN_QP_N;
    uint32_t i;
    *length = RRNN_C(0.0);
    for (i = 0U; i < w->count; ++i) {
        const uint32_t k = w->active[i];
        const int may_leave = ((k < RRNN_QP_EQUAL) || (k >= RRNN_QP_ROWS)) ? 1 : 0;
        if ((may_leave != 0) && (w->r[i] > RRNN_C(0.0))) {
            const real_t ratio = w->y[i] / w->r[i];
            if ((found == RRNN_QP_N) || (ratio < *length)) {
                *length = (ratio > RRNN_C(0.0)) ? ratio : RRNN_C(0.0);
                found = i;
            }
        }
    }
    return found;
}

/* Takes up inequality k by partial steps, dropping what stands in the way. */
static rrnn_qp_status_t rrnn_qp_take(rrnn_qp_work_t *w, const rrnn_qp_t *qp, uint32_t k,
                                     uint32_t *steps)
{
    rrnn_qp_status_t status = RRNN_QP_SPENT;
    real_t normal[RRNN_QP_N];
    const real_t right = rrnn_qp_normal(qp, k, normal);
    real_t multiplier = RRNN_C(0.0);
    while ((status == RRNN_QP_SPENT) && (*steps < RRNN_QP_STEPS)) {
        const real_t slope = rrnn_qp_directions(w, normal);
        const real_t lack = right - rrnn_qp_dot(normal, w->x);
        real_t partial;
        const uint32_t place = rrnn_qp_first(w, &partial);
        const int full = (slope > RRNN_C(0.0)) ? 1 : 0;
        const real_t whole = (full != 0) ? (lack / slope) : RRNN_C(0.0);
        *steps += 1U;
        if ((full != 0) && ((place == RRNN_QP_N) || (whole <= partial))) {
            rrnn_qp_move(w, whole, whole);
            rrnn_qp_add(w, k, multiplier + whole);
            status = RRNN_QP_SOLVED;
        } else if (place == RRNN_QP_N) {
            status = RRNN_QP_INFEASIBLE;
        } else {
            rrnn_qp_move(w, (full != 0) ? partial : RRNN_C(0.0), partial);
            multiplier += partial;
            rrnn_qp_drop(w, place);
        }
    }
    return status;
}

/* One correction of what rounding left of the active rows: R'v = lack, x += J1 v. */
static void rrnn_qp_correct(rrnn_qp_work_t *w, const rrnn_qp_t *qp)
{
    real_t normal[RRNN_QP_N];
    uint32_t i;
    uint32_t j;
    for (i = 0U; i < w->count; ++i) {
        real_t sum = rrnn_qp_normal(qp, w->active[i], normal);
        sum -= rrnn_qp_dot(normal, w->x);
        for (j = 0U; j < i; ++j) {
            sum -= w->R[(j * RRNN_QP_N) + i] * w->d[j];
        }
        w->d[i] = sum / w->R[(i * RRNN_QP_N) + i];
    }
    for (i = 0U; i < RRNN_QP_N; ++i) {
        for (j = 0U; j < w->count; ++j) {
            w->x[i] += w->J[(i * RRNN_QP_N) + j] * w->d[j];
        }
    }
}

/* The point, kept inside its bounds to the last bit, and the multipliers. */
static void rrnn_qp_report(const rrnn_qp_work_t *w, const rrnn_qp_t *qp,
                           rrnn_qp_answer_t *answer)
{
    uint32_t i;
    for (i = 0U; i < RRNN_QP_ROOM(RRNN_QP_P); ++i) {
        answer->lam[i] = RRNN_C(0.0);
    }
    for (i = 0U; i < RRNN_QP_ROOM(RRNN_QP_M); ++i) {
        answer->mu[i] = RRNN_C(0.0);
    }
    for (i = 0U; i < RRNN_QP_N; ++i) {
        const real_t capped = (w->x[i] > qp->ub[i]) ? qp->ub[i] : w->x[i];
        answer->x[i] = (capped < qp->lb[i]) ? qp->lb[i] : capped;
        answer->box[i] = RRNN_C(0.0);
    }
    for (i = 0U; i < w->count; ++i) {
        const uint32_t k = w->active[i];
        if (k < RRNN_QP_UPPER) {
            answer->box[k] = -w->y[i];
        } else if (k < RRNN_QP_EQUAL) {
            answer->box[k - RRNN_QP_UPPER] = w->y[i];
        } else if (k < RRNN_QP_ROWS) {
            answer->lam[k - RRNN_QP_EQUAL] = w->y[i];
        } else {
            answer->mu[k - RRNN_QP_ROWS] = w->y[i];
        }
    }
}

/* Solve; J: row-major with J J' = P^-1, for instance the identity for P = I.
 * The data must be finite, bounds and h apart. The answer is written in every
 * case and worth something only when the status is RRNN_QP_SOLVED. */
static rrnn_qp_status_t rrnn_qp_solve(const rrnn_qp_t *qp, const real_t J[],
                                      rrnn_qp_answer_t *answer)
{
    rrnn_qp_work_t w = {0};
    rrnn_qp_status_t status;
    uint32_t worst;
    uint32_t i;
    uint32_t j;
    for (i = 0U; i < (RRNN_QP_N * RRNN_QP_N); ++i) {
        w.J[i] = J[i];
    }
    for (j = 0U; j < RRNN_QP_N; ++j) { /* x = -J J'q */
        real_t sum = RRNN_C(0.0);
        for (i = 0U; i < RRNN_QP_N; ++i) {
            sum += J[(i * RRNN_QP_N) + j] * qp->q[i];
        }
        for (i = 0U; i < RRNN_QP_N; ++i) {
            w.x[i] -= J[(i * RRNN_QP_N) + j] * sum;
        }
    }
    answer->steps = 0U;
    status = rrnn_qp_equalities(&w, qp);
    worst = (status == RRNN_QP_SOLVED) ? rrnn_qp_worst(&w, qp) : RRNN_QP_ALL;
    while (worst < RRNN_QP_ALL) {
        status = rrnn_qp_take(&w, qp, worst, &answer->steps);
        worst = (status == RRNN_QP_SOLVED) ? rrnn_qp_worst(&w, qp) : RRNN_QP_ALL;
    }
    if (status == RRNN_QP_SOLVED) {
        rrnn_qp_correct(&w, qp);
    }
    rrnn_qp_report(&w, qp, answer);
    return status;
}
