/* ${prefix}: reference vectors; values of the model's operations in ${real}. */
#ifndef ${PREFIX}_${NAME}_H
#define ${PREFIX}_${NAME}_H

#include "${prefix}.h"

#define ${PREFIX}_${NAME} ${cases}U

typedef struct {
    ${prefix}_real_t state[${n_state}];
    ${prefix}_in_t in;
    ${prefix}_real_t next[${n_state}];
    ${prefix}_real_t output[${n_output}];
    ${prefix}_real_t merit;
} ${prefix}_${kind}_t;

static const ${prefix}_${kind}_t ${prefix}_${name}[${PREFIX}_${NAME}] = {
${vectors}
};

#endif
