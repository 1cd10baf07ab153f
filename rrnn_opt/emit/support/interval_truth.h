/* Comparisons and choices of intervals; follows interval.h. */
/* [1, 1] where something is certain, [0, 0] where its contrary is, else [0, 1] */
RRNN_INLINE rrnn_i rrnn_i_truth(rrnn_m yes, rrnn_m no)
{
    const rrnn_v one = RRNN_ALL(1.0), zero = RRNN_ALL(0.0);
    const rrnn_i r = {rrnn_select(yes, -one, zero), rrnn_select(no, zero, one)};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_lt(rrnn_i a, rrnn_i b)
{
    return rrnn_i_truth(a.h < -b.n, -a.n >= b.h);
}

RRNN_INLINE rrnn_i rrnn_i_le(rrnn_i a, rrnn_i b)
{
    return rrnn_i_truth(a.h <= -b.n, -a.n > b.h);
}

RRNN_INLINE rrnn_m rrnn_i_apart(rrnn_i a, rrnn_i b)
{
    return (a.h < -b.n) | (-a.n > b.h);
}

RRNN_INLINE rrnn_m rrnn_i_same(rrnn_i a, rrnn_i b)
{
    return (a.h == -b.n) & (-a.n == b.h);
}

RRNN_INLINE rrnn_i rrnn_i_eq(rrnn_i a, rrnn_i b)
{
    return rrnn_i_truth(rrnn_i_same(a, b), rrnn_i_apart(a, b));
}

RRNN_INLINE rrnn_i rrnn_i_ne(rrnn_i a, rrnn_i b)
{
    return rrnn_i_truth(rrnn_i_apart(a, b), rrnn_i_same(a, b));
}

RRNN_INLINE rrnn_m rrnn_i_false(rrnn_i a)
{
    return (a.n == 0.0) & (a.h == 0.0);
}

RRNN_INLINE rrnn_i rrnn_i_not(rrnn_i a)
{
    return rrnn_i_truth(rrnn_i_false(a), ~rrnn_i_zero_in(a));
}

RRNN_INLINE rrnn_i rrnn_i_and(rrnn_i a, rrnn_i b)
{
    const rrnn_m yes = ~(rrnn_i_zero_in(a) | rrnn_i_zero_in(b));
    return rrnn_i_truth(yes, rrnn_i_false(a) | rrnn_i_false(b));
}

RRNN_INLINE rrnn_i rrnn_i_or(rrnn_i a, rrnn_i b)
{
    const rrnn_m yes = ~(rrnn_i_zero_in(a) & rrnn_i_zero_in(b));
    return rrnn_i_truth(yes, rrnn_i_false(a) & rrnn_i_false(b));
}

RRNN_INLINE rrnn_i rrnn_i_if_else_zero(rrnn_i c, rrnn_i a)
{
    const rrnn_v zero = RRNN_ALL(0.0);
    const rrnn_m never = rrnn_i_false(c), always = ~rrnn_i_zero_in(c);
    const rrnn_v n = rrnn_select(never, zero, rrnn_max(a.n, zero));
    const rrnn_v h = rrnn_select(never, zero, rrnn_max(a.h, zero));
    const rrnn_i r = {rrnn_select(always, a.n, n), rrnn_select(always, a.h, h)};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_sign(rrnn_i a)
{
    const rrnn_v one = RRNN_ALL(1.0), zero = RRNN_ALL(0.0);
    const rrnn_v n = rrnn_select(a.n > 0.0, one, zero);
    const rrnn_v h = rrnn_select(a.h > 0.0, one, zero);
    const rrnn_i r = {
        rrnn_select(a.n < 0.0, -one, n), rrnn_select(a.h < 0.0, -one, h)};
    return r;
}
