/* The method itself; it follows active_rows.h. */
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
