/* The dual active-set method where the Hessian is only semidefinite.
 *
 * Proximal points: x_k+1 minimises the cost + RRNN_QP_PROXIMAL / 2 |x - x_k|^2
 * over the same rows.  J belongs to P + RRNN_QP_PROXIMAL I.  At most
 * RRNN_QP_ROUNDS rounds; on linear costs a few are enough.
 */
#define RRNN_QP_ROUNDS 200U

/* As rrnn_qp_solve; `steps` counts the partial steps of all rounds. */
static rrnn_qp_status_t rrnn_qp_solve_proximal(rrnn_qp_t *qp, const real_t J[],
                                               rrnn_qp_answer_t *answer)
{
    rrnn_qp_status_t status = RRNN_QP_SPENT;
    real_t last[RRNN_QP_N];
    real_t q[RRNN_QP_N];
    uint32_t steps = 0U;
    uint32_t round = 0U;
    uint32_t i;
    int moving = 1;
    for (i = 0U; i < RRNN_QP_N; ++i) {
        last[i] = RRNN_C(0.0);
        q[i] = qp->q[i];
    }
    while ((moving != 0) && (round < RRNN_QP_ROUNDS)) {
        moving = 0;
        for (i = 0U; i < RRNN_QP_N; ++i) {
            qp->q[i] = q[i] - (RRNN_QP_PROXIMAL * last[i]);
        }
        status = rrnn_qp_solve(qp, J, answer);
        steps += answer->steps;
        round += 1U;
        for (i = 0U; i < RRNN_QP_N; ++i) {
            const real_t size = RRNN_C(1.0) + RRNN_FABS(answer->x[i]);
            const real_t step = RRNN_FABS(answer->x[i] - last[i]);
            if ((status == RRNN_QP_SOLVED) && (step > (RRNN_QP_STILL * size))) {
                moving = 1;
            }
            last[i] = answer->x[i];
        }
    }
    for (i = 0U; i < RRNN_QP_N; ++i) {
        qp->q[i] = q[i];
    }
    answer->steps = steps;
    return (moving != 0) ? RRNN_QP_SPENT : status;
}
