"""C around the emitted functions: the switch over kinds, and loops over lanes.

A block is ``LANES`` spheres, or sphere pairs, that lie side by side.  The loops
have a fixed count and no branch, so that a compiler puts every emitted formula
into vector instructions where the CPU has them.
"""

from __future__ import annotations

from collections.abc import Sequence

_LANES = "for (int32_t l = 0; l < LANES; l++)"
_POINT = "const double at[3] = {p[l], p[NSP + l], p[2 * NSP + l]};"

_BLOCK = """\
/* Distances of a block of spheres' centres to one solid, with normals. */
static void k_block_{kind}(const double *restrict shape, const double *restrict p,
                           double *restrict d, double *restrict n)
{{
    {lanes} {{
        {point}
        double normal[3];
        k_distance_{kind}(at, shape, d + l, normal);
        n[l] = normal[0];
        n[LANES + l] = normal[1];
        n[2 * LANES + l] = normal[2];
    }}
}}

/* Distances alone. */
static void k_gaps_{kind}(const double *restrict shape, const double *restrict p,
                          double *restrict d)
{{
    {lanes} {{
        {point}
        k_gap_{kind}(at, shape, d + l);
    }}
}}

"""
_HULL = """\
/* A hull is a header and one half-space a facet: the largest distance counts. */
static void k_block_hull(const double *restrict shape, const double *restrict p,
                         double *restrict d, double *restrict n)
{
    for (int32_t l = 0; l < LANES; l++) {
        d[l] = -1e300;
    }
    for (int32_t f = 1; f <= (int32_t)shape[12]; f++) {
        double facet[LANES], normal[3 * LANES];
        k_block_halfspace(shape + 16 * f, p, facet, normal);
        for (int32_t l = 0; l < LANES; l++) {
            for (int32_t a = 0; a < 3; a++) {
                const double now = n[LANES * a + l], next = normal[LANES * a + l];
                n[LANES * a + l] = facet[l] > d[l] ? next : now;
            }
            d[l] = facet[l] > d[l] ? facet[l] : d[l];
        }
    }
}

static void k_gaps_hull(const double *restrict shape, const double *restrict p,
                        double *restrict d)
{
    double n[3 * LANES];
    k_block_hull(shape, p, d, n);
}

/* Distances of a block of spheres' centres to a box along the world's axes. */
static void k_gaps_bounds(const double *restrict bounds, const double *restrict p,
                          double *restrict d)
{
    for (int32_t l = 0; l < LANES; l++) {
        const double at[3] = {p[l], p[NSP + l], p[2 * NSP + l]};
        k_gap_bounds(at, bounds, d + l);
    }
}

"""
_SWITCH = """\
static void k_{name}(int32_t kind, const double *shape, const double *p, double *d{out})
{{
    switch (kind) {{
{cases}    default:
        for (int32_t l = 0; l < LANES; l++) {{
            d[l] = -1e300;
        }}
        break;
    }}
}}

"""
_MOTION = """\
/* Distances of a point to a block of centres, with unit vectors to them. */
static void k_pair_block(const double *restrict from, const double *restrict p,
                         double *restrict d, double *restrict n)
{{
    {lanes} {{
        {point}
        double normal[3];
        k_distance_pair(from, at, d + l, normal);
        n[l] = normal[0];
        n[LANES + l] = normal[1];
        n[2 * LANES + l] = normal[2];
    }}
}}

/* How far a block of centres went, squared. */
static void k_block_squares(const double *restrict before, const double *restrict p,
                            double *restrict square)
{{
    {lanes} {{
        {point}
        const double from[3] = {{before[l], before[NSP + l], before[2 * NSP + l]}};
        k_square(from, at, square + l);
    }}
}}

/* Squared distances of a point to a block of centres. */
static void k_pair_squares(const double *restrict from, const double *restrict p,
                           double *restrict square)
{{
    {lanes} {{
        {point}
        k_square(from, at, square + l);
    }}
}}

/* Right-hand sides of the rows of a block. */
static void k_block_offset(const double *restrict gap, double margin,
                           const double *restrict bound, double *restrict right)
{{
    {lanes} {{
        k_offset(gap + l, &margin, bound + l, right + l);
    }}
}}

/* Velocities J u of a block of centres, and the motion bounds B(u). */
static void k_block_motion(const double *restrict axes, const double *restrict origins,
                           const double *restrict p, const double *restrict reaches,
                           const double *restrict masks, const double *restrict u,
                           double *restrict v, double *restrict bound)
{{
    {lanes} {{
        {point}
        const double reach[NJ] = {{{reach}}};
        const double mask[NJ] = {{{mask}}};
        double velocity[3];
        k_velocity(axes, origins, mask, at, u, velocity);
        k_motion_bound(u, reach, mask, bound + l);
        v[l] = velocity[0];
        v[LANES + l] = velocity[1];
        v[2 * LANES + l] = velocity[2];
    }}
}}

/* Upper bounds of what the pairs of each group come nearer. */
static void k_group_ways(const double *restrict u, double *restrict way)
{{
    const double *restrict reaches = t_group_reach, *restrict masks = t_group_mask;
    for (int32_t l = 0; l < NGP; l++) {{
        const double reach[NJ] = {{{group_reach}}};
        const double mask[NJ] = {{{group_mask}}};
        k_travel(u, reach, mask, way + l);
    }}
}}

"""


def _columns(table: str, joints: int, stride: str) -> str:
    """Entries of one lane, a joint after the other."""
    return ", ".join(f"{table}[{k} * {stride} + l]" for k in range(joints))


def _switch(name: str, kinds: Sequence[str], out: str) -> str:
    extra = ", n" if out else ""
    cases = "".join(
        f"    case {i}: k_{name}_{kind}(shape, p, d{extra}); break;\n"
        for i, kind in enumerate(kinds)
    )
    return _SWITCH.format(name=name, cases=cases, out=out)


def dispatch(kinds: Sequence[str], joints: int) -> str:
    """Loops over lanes: ``k_block``, ``k_gaps``, ``k_pair_block``, motion.

    Args:
        kinds: in the order of the numbers that the runtime uses; hulls of
            half-spaces take the next one.
        joints: of the robot's tree.
    """
    blocks = "".join(
        _BLOCK.format(kind=kind, lanes=_LANES, point=_POINT) for kind in kinds
    )
    every = (*kinds, "hull")
    motion = _MOTION.format(
        lanes=_LANES,
        point=_POINT,
        reach=_columns("reaches", joints, "NSP"),
        mask=_columns("masks", joints, "NSP"),
        group_reach=_columns("reaches", joints, "NGP"),
        group_mask=_columns("masks", joints, "NGP"),
    )
    switches = [_switch("block", every, ", double *n"), _switch("gaps", every, "")]
    return blocks + _HULL + "".join(switches) + motion
