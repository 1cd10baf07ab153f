/* DAQP, set up once, fed by our emitted data of the programme. */
#include "api.h"
#include "peer.h"

void arm_data(const real_t q[7], const real_t rd[3], const real_t ball[4],
              real_t rows[35], real_t lower[12], real_t upper[12]);

static real_t hessian[49];
static real_t linear[7];
static real_t rows[35];
static real_t lower[12];
static real_t upper[12];
static int sense[12] = {0, 0, 0, 0, 0, 0, 0, 5, 5, 5, 0, 0};
/* newlib's heap, behind all variables: not in the RAM of the table. */
void *_sbrk(int bytes);
void *_sbrk(int bytes)
{
    static char *top = (char *)0x20100000U;
    top += bytes;
    return top - bytes;
}

static DAQPProblem problem;
static DAQPWorkspace work;
static const real_t posture[7] = {0, (real_t)-0.5, 0, (real_t)-2.2, 0, (real_t)1.8, 0};
static const real_t velocity[3] = {0, 0, 0};
static const real_t far[4] = {9, 9, 9, 1};
static real_t answer[7];
static real_t multipliers[12];

void peer_setup(void)
{
    int k;
    for (k = 0; k < 7; ++k) {
        hessian[8 * k] = (real_t)1;
    }
    arm_data(posture, velocity, far, rows, lower, upper);
    problem.n = 7;
    problem.m = 12;
    problem.ms = 7;
    problem.H = hessian;
    problem.f = linear;
    problem.A = rows;
    problem.bupper = upper;
    problem.blower = lower;
    problem.sense = sense;
    (void)setup_daqp(&problem, &work, (real_t *)0);
}

void peer_step(void)
{
    DAQPResult result;
    arm_data(request, &request[7], &request[10], rows, lower, upper);
    result.x = answer;
    result.lam = multipliers;
    (void)daqp_update_ldp(DAQP_UPDATE_M + DAQP_UPDATE_v + DAQP_UPDATE_d + DAQP_UPDATE_sense, &work, &problem);
    daqp_solve(&result, &work);
}

const real_t *peer_answer(void)
{
    return answer;
}
