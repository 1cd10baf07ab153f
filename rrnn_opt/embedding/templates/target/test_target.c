/* Bare-metal test of ${prefix}: the reference cases, the exact solver, instructions.
 *
 * See board.c for the machine; exit status 0 when all holds. */
#include "${prefix}.h"
#include "${prefix}_cases.h"
#include "board.h"

typedef struct {
    uint32_t least;
    uint32_t most;
} range_t;

static void widen(range_t *range, uint32_t count)
{
    range->least = (count < range->least) ? count : range->least;
    range->most = (count > range->most) ? count : range->most;
}

static void say(const char *what, uint32_t number)
{
    board_text(what);
    board_number(number);
}

/* One call from the start of a case; its instructions are added to the range. */
static ${prefix}_status_t call(const ${prefix}_case_t *want, ${prefix}_real_t tolerance,
                               ${prefix}_state_t *now, ${prefix}_out_t *said, range_t *range)
{
    const ${prefix}_param_t param = {${step_size}, tolerance};
    const uint32_t first = board_count();
    const uint32_t begin = board_count();
    ${prefix}_status_t status;
    ${prefix}_state_t state;
    ${prefix}_out_t out;
    uint32_t count;
    uint32_t i;
    (void)${prefix}_init(&state, &param);
    for (i = 0U; i < ${n_state}U; ++i) {
        ${state_ref}[i] = want->state[i];
    }
    count = board_count();
    status = ${prefix}_step(&state, &want->in, &out);
    count = (board_count() - count) - (begin - first);
    if (status == ${PREFIX}_OK) {
        widen(range, count);
        *now = state;
        *said = out;
    }
    return status;
}

/* Numbers of the network's step that are not those of the case. */
static uint32_t differences(const ${prefix}_case_t *want, range_t *range)
{
    ${prefix}_state_t state;
    ${prefix}_out_t out;
    uint32_t wrong = 0U;
    uint32_t i;
    if (call(want, ${never}, &state, &out, range) != ${PREFIX}_OK) {
        return 1U;
    }
    for (i = 0U; i < ${n_state}U; ++i) {
        wrong += (${state_ref}[i] == want->next[i]) ? 0U : 1U;
    }
    for (i = 0U; i < ${n_output}U; ++i) {
        wrong += (${output_ref}[i] == want->output[i]) ? 0U : 1U;
    }
    return wrong;
}

int main(void)
{
    range_t network = {0xFFFFFFFFU, 0U};
    range_t exact = {0xFFFFFFFFU, 0U};
    uint32_t wrong = 0U;
    uint32_t most = 0U;
    uint32_t k;
    board_count_begin();
    for (k = 0U; k < ${PREFIX}_CASES; ++k) {
        ${prefix}_state_t state;
        ${prefix}_out_t out;
        wrong += differences(&${prefix}_cases[k], &network);
        if (call(&${prefix}_cases[k], ${zero}, &state, &out, &exact) == ${PREFIX}_OK) {
            most = (out.iterations > most) ? out.iterations : most;
        }
    }
    say("wrong numbers: ", wrong);
    say("\nself-test: ", ${prefix}_selftest());
    say("\ninstructions of the network's step: ", network.least);
    say(" to ", network.most);
    say("\ninstructions with the exact solver: ", exact.least);
    say(" to ", exact.most);
    say("\npartial steps of the exact solver: ", most);
    board_text("\n");
    return ((wrong + ${prefix}_selftest()) == 0U) ? 0 : 1;
}
