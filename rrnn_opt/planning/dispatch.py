"""C switches from the kind of an obstacle to its emitted distance functions."""

from __future__ import annotations

from collections.abc import Sequence

_ONE = """\
static void k_distance(int32_t kind, const double p[3], const double shape[16],
                       double *d, double n[3])
{{
    switch (kind) {{
{cases}    default: *d = -1e300; n[0] = n[1] = n[2] = 0.0; break;
    }}
}}
"""
_ALL = """\
/* Distances of all spheres' centres to one obstacle; the loops vectorise. */
static void k_gaps(int32_t kind, const double *restrict shape,
                   const double *restrict centers, double *restrict out)
{{
    switch (kind) {{
{cases}    default:
        for (int32_t i = 0; i < NS; i++) {{
            out[i] = -1e300;
        }}
        break;
    }}
}}
"""
_LOOP = """\
    case {index}:
        for (int32_t i = 0; i < NS; i++) {{
            const double p[3] = {{centers[i], centers[NS + i], centers[2 * NS + i]}};
            k_gap_{kind}(p, shape, out + i);
        }}
        break;
"""


_PAIRS = """\
/* Distances of the centres of group g's sphere pairs; inner loops vectorise. */
static void k_pair_gaps(int32_t g, const double *restrict centers,
                        double *restrict out)
{
    for (int32_t k = t_group_block[g]; k < t_group_block[g + 1]; k++) {
        const int32_t first = t_block_pair[k];
        const int32_t count = t_block_pair[k + 1] - first;
        const int32_t i = t_pair_i[first], j = t_pair_j[first];
        const double a[3] = {centers[i], centers[NS + i], centers[2 * NS + i]};
        double *restrict to = out + (first - t_group_first[g]);
        for (int32_t c = 0; c < count; c++) {
            const double b[3] = {centers[j + c], centers[NS + j + c],
                                 centers[2 * NS + j + c]};
            k_gap_pair(a, b, to + c);
        }
    }
}
"""


def dispatch(kinds: Sequence[str]) -> str:
    """``k_distance`` (one point, with normal), ``k_gaps`` and ``k_pair_gaps``.

    Args:
        kinds: in the order of the numbers that the runtime uses.
    """
    one = "".join(
        f"    case {i}: k_distance_{kind}(p, shape, d, n); break;\n"
        for i, kind in enumerate(kinds)
    )
    every = "".join(_LOOP.format(index=i, kind=k) for i, k in enumerate(kinds))
    return _ONE.format(cases=one) + _ALL.format(cases=every) + _PAIRS
