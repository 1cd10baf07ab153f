
/* J with J J' = P^-1, row by row. */
static const real_t inverse_factor[${n_factor}] = {${factor}};

/* The exact answer, in place of the network's; output and state follow it. */
static ${prefix}_status_t fall_back(const ${prefix}_in_t *in, real_t next[], real_t output[],
                                    uint32_t *iterations)
{
    ${prefix}_status_t status = ${PREFIX}_OK;
    rrnn_qp_status_t answered;
    rrnn_qp_t qp;
    rrnn_qp_answer_t answer;
    uint32_t i;
    ${programme_call};
    answered = rrnn_qp_${solve};
    *iterations = answer.steps;
    if (answered == RRNN_QP_SOLVED) {
        for (i = 0U; i < RRNN_QP_N; ++i) {
            output[i] = answer.x[i];
        }
${restart}    } else if (answered == RRNN_QP_INFEASIBLE) {
        status = ${PREFIX}_INFEASIBLE;
    } else {
        status = ${PREFIX}_NO_ANSWER;
    }
    return status;
}
