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


_HULL = """\
/* A hull is a header and one half-space a facet: the largest distance counts. */
static void k_distance_hull(const double p[3], const double *shape, double *d,
                            double n[3])
{
    *d = -1e300;
    for (int32_t f = 1; f <= (int32_t)shape[12]; f++) {
        double facet, normal[3];
        k_distance_halfspace(p, shape + 16 * f, &facet, normal);
        if (facet > *d) {
            *d = facet;
            for (int32_t i = 0; i < 3; i++)
                n[i] = normal[i];
        }
    }
}

static void k_gaps_hull(const double *restrict shape,
                        const double *restrict centers, double *restrict out)
{
    for (int32_t i = 0; i < NS; i++) {
        out[i] = -1e300;
    }
    for (int32_t f = 1; f <= (int32_t)shape[12]; f++) {
        const double *restrict facet = shape + 16 * f;
        for (int32_t i = 0; i < NS; i++) {
            const double p[3] = {centers[i], centers[NS + i], centers[2 * NS + i]};
            double d;
            k_gap_halfspace(p, facet, &d);
            out[i] = d > out[i] ? d : out[i];
        }
    }
}

/* Distances of all spheres' centres to a box along the world's axes. */
static void k_gaps_bounds(const double *restrict bounds,
                          const double *restrict centers, double *restrict out)
{
    for (int32_t i = 0; i < NS; i++) {
        const double p[3] = {centers[i], centers[NS + i], centers[2 * NS + i]};
        k_gap_bounds(p, bounds, out + i);
    }
}

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
        kinds: in the order of the numbers that the runtime uses; hulls of
            half-spaces take the next one.
    """
    one = "".join(
        f"    case {i}: k_distance_{kind}(p, shape, d, n); break;\n"
        for i, kind in enumerate(kinds)
    )
    every = "".join(_LOOP.format(index=i, kind=k) for i, k in enumerate(kinds))
    hull = len(kinds)
    one += f"    case {hull}: k_distance_hull(p, shape, d, n); break;\n"
    every += f"    case {hull}: k_gaps_hull(shape, centers, out); break;\n"
    return _HULL + _ONE.format(cases=one) + _ALL.format(cases=every) + _PAIRS
