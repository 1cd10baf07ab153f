/* OSQP's generated solver, fed by our emitted data of the programme. */
#include "osqp.h"
#include "peer.h"
#include "workspace.h"

void arm_data(const real_t q[7], const real_t rd[3], const real_t ball[4],
              real_t values[VALUES], real_t lower[12], real_t upper[12]);

void peer_setup(void)
{
}

void peer_step(void)
{
    static real_t values[VALUES];
    static real_t lower[12];
    static real_t upper[12];
    arm_data(request, &request[7], &request[10], values, lower, upper);
    (void)osqp_update_data_mat(&solver, (OSQPFloat *)0, (OSQPInt *)0, 0, values,
                               (OSQPInt *)0, VALUES);
    (void)osqp_update_data_vec(&solver, (OSQPFloat *)0, lower, upper);
    (void)osqp_solve(&solver);
}

const real_t *peer_answer(void)
{
    return solver.solution->x;
}
