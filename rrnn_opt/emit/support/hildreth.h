/* Dual network of a box QP with rows, swept one dual at a time (Hildreth).
 *
 *   minimise 1/2 |u - w|^2   subject to   rows u >= h,   lower <= u <= upper
 *
 * u = w + rows' lambda + z holds throughout, lambda >= 0 being the duals of
 * the rows and z those of the box.  A sweep projects on every row and on the
 * box in turn; cut off, it leaves rows slightly violated.
 */
#ifndef RRNN_HILDRETH_H
#define RRNN_HILDRETH_H

static inline real_t hildreth_dot(int n, const real_t *a, const real_t *b)
{
    real_t sum = 0;
    for (int k = 0; k < n; k++) {
        sum += a[k] * b[k];
    }
    return sum;
}

static inline void hildreth_box(int n, const real_t *lower, const real_t *upper,
                                real_t *z, real_t *u)
{
    for (int k = 0; k < n; k++) {
        const real_t free_value = u[k] - z[k];
        const real_t capped = free_value > upper[k] ? upper[k] : free_value;
        u[k] = capped < lower[k] ? lower[k] : capped;
        z[k] = u[k] - free_value;
    }
}

static inline void hildreth_row(int n, const real_t *row, real_t h, real_t *lambda,
                                real_t *u)
{
    const real_t norm2 = hildreth_dot(n, row, row);
    if (norm2 > (real_t)1e-12) {
        const real_t wanted = *lambda + (h - hildreth_dot(n, row, u)) / norm2;
        const real_t next = wanted > 0 ? wanted : 0;
        const real_t change = next - *lambda;
        for (int k = 0; k < n && change != 0; k++) {
            u[k] += change * row[k];
        }
        *lambda = next;
    }
}

/* rows: m x n, row by row.  On entry u, lambda and z are consistent, e.g.
 * u = w, lambda = 0, z = 0; on return they are the iterate after `sweeps`. */
static inline void hildreth(int n, int m, const real_t *rows, const real_t *h,
                            const real_t *lower, const real_t *upper, int sweeps,
                            real_t *lambda, real_t *z, real_t *u)
{
    for (int sweep = 0; sweep < sweeps; sweep++) {
        for (int i = 0; i < m; i++) {
            hildreth_row(n, rows + i * n, h[i], lambda + i, u);
        }
        hildreth_box(n, lower, upper, z, u);
    }
}

#endif
