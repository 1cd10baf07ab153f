/* The least program around ${prefix}: what it weighs is what the controller costs. */
#include "${prefix}.h"

extern ${prefix}_in_t sensed;
extern ${prefix}_out_t wanted;
extern ${prefix}_state_t state;
${prefix}_in_t sensed;
${prefix}_out_t wanted;
${prefix}_state_t state;

int main(void)
{
    const ${prefix}_param_t param = {${step_size}, ${tolerance}};
    ${prefix}_status_t status = ${prefix}_init(&state, &param);
    while (status == ${PREFIX}_OK) {
        status = ${prefix}_step(&state, &sensed, &wanted);
    }
    return 1;
}
