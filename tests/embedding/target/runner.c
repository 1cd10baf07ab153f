/* Runs a controller over requests from a file and leaves its answers in another:
 * the same text on the host and on a board. */
#include <string.h>

#include "board.h"
#include CONTROLLER_HEADER

#define JOIN(a, b) a##b
#define NAMED(a, b) JOIN(a, b)
#define LOWER(name) NAMED(CONTROLLER, name)
#define UPPER(name) NAMED(CONTROLLER_UPPER, name)

typedef LOWER(_real_t) number_t;

typedef struct {
    number_t state[UPPER(_N_STATE)];
    number_t step_size;
    number_t tolerance;
    LOWER(_in_t) in;
    uint32_t fresh; /* 1: begin with state; 0: go on from the last request */
    uint32_t unused;
} request_t;

typedef struct {
    number_t state[UPPER(_N_STATE)];
    number_t output[UPPER(_N_OUTPUT)];
    number_t said[4]; /* residual, merit, its change; the monitor's merit */
    uint32_t word[8]; /* init, step and monitor: status; verdict, iterations,
                         the monitor's verdict, ticks, instructions of step */
} answer_t;

static request_t request;
static LOWER(_state_t) state;

static void answer(answer_t *said, uint32_t empty)
{
    LOWER(_out_t) out;
    LOWER(_monitor_t) seen;
    uint32_t begin;
    (void)memset(said, 0, sizeof *said);
    (void)memset(&out, 0, sizeof out);
    (void)memset(&seen, 0, sizeof seen);
    if (request.fresh != 0U) {
        LOWER(_param_t) param;
        param.step_size = request.step_size;
        param.tolerance = request.tolerance;
        said->word[0] = (uint32_t)LOWER(_init)(&state, &param);
        (void)memcpy(&state, request.state, sizeof request.state);
    }
    said->word[2] = (uint32_t)LOWER(_monitor)(&state, &request.in, &seen);
    begin = board_count();
    said->word[1] = (uint32_t)LOWER(_step)(&state, &request.in, &out);
    said->word[7] = (board_count() - begin) - empty;
    said->word[3] = out.verdict;
    said->word[4] = out.iterations;
    said->word[5] = seen.verdict;
    said->word[6] = state.tick;
    said->said[0] = out.residual;
    said->said[1] = out.merit;
    said->said[2] = out.merit_change;
    said->said[3] = seen.merit;
    (void)memcpy(said->state, &state, sizeof said->state);
    (void)memcpy(said->output, &out, sizeof said->output);
}

int main(void)
{
    const int in = board_open("requests.bin", "rb");
    const int out = board_open("answers.bin", "wb");
    answer_t said;
    uint32_t begin;
    uint32_t empty;
    if ((in < 0) || (out < 0)) {
        return 2;
    }
    board_count_begin();
    begin = board_count();
    empty = board_count() - begin;
    board_number(LOWER(_selftest)());
    while (board_read(in, &request, sizeof request) != 0) {
        answer(&said, empty);
        if (board_write(out, &said, sizeof said) == 0) {
            return 2;
        }
    }
    board_close(out);
    board_close(in);
    return 0;
}
