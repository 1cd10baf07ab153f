/* Counts instructions and stack of peer_step over requests from a file. */
#include "board.h"
#include "peer.h"

#define PAINT 0xA5C3A5C3U
#define WORDS 6000U

real_t request[14];

static uint32_t *stack_now(void)
{
    uint32_t *sp;
    __asm volatile("mov %0, sp" : "=r"(sp));
    return sp;
}

static void paint(void)
{
    volatile uint32_t *const low = stack_now() - WORDS;
    uint32_t k;
    for (k = 0U; k < (WORDS - 32U); ++k) {
        low[k] = PAINT;
    }
}

static uint32_t used(void)
{
    const volatile uint32_t *const low = stack_now() - WORDS;
    uint32_t k = 0U;
    while ((k < (WORDS - 32U)) && (low[k] == PAINT)) {
        ++k;
    }
    return 4U * (WORDS - k);
}

int main(void)
{
    const int in = board_open("requests.bin", "rb");
    const int out = board_open("answers.bin", "wb");
    uint32_t empty;
    uint32_t word[2];
    board_count_begin();
    empty = board_count();
    empty = board_count() - empty;
    peer_setup();
    while (board_read(in, request, sizeof request) != 0) {
        uint32_t begin;
        paint();
        begin = board_count();
        peer_step();
        word[0] = (board_count() - begin) - empty;
        word[1] = used();
        if ((board_write(out, peer_answer(), 7U * sizeof(real_t)) == 0)
            || (board_write(out, word, sizeof word) == 0)) {
            return 1;
        }
    }
    board_close(out);
    board_close(in);
    return 0;
}
