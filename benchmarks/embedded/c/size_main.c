/* The least that uses peer_step: its image is what is weighed. */
#include "peer.h"

real_t request[14];

int main(void)
{
    peer_setup();
    for (;;) {
        peer_step();
    }
}
