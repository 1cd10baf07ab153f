/* What every measured code offers; real_t is REAL. Only peer_step is counted. */
#ifndef PEER_H
#define PEER_H

#include <stdint.h>

typedef REAL real_t;

/* Joint angles (7), tip velocity (3), centre and radius of the ball (4). */
extern real_t request[14];

void peer_setup(void);
void peer_step(void);
const real_t *peer_answer(void); /* joint velocities (7) */

#endif
