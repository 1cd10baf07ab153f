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
