/* Sine and cosine of intervals; follows interval.h. */
/* One ulp-exact evaluation of sine and cosine, |x| <= 1e5, rounding upwards.
 *
 * kd is an integer next to 2 x / pi with |x - kd pi/2| < 0.7856; pi/2 is held
 * in parts of 33, 33 and 53 bits, the first two products are exact.  Taylor
 * polynomials up to r^17 and r^16.  That the answer is within RRNN_SINCOS is
 * proved with balls by validation/studies/sincos_bound.py. */
#define RRNN_SINCOS 0x1p-49
#define RRNN_ANGLE 1e5

RRNN_INLINE void rrnn_v_sincos(rrnn_v x, rrnn_v *sine, rrnn_v *cosine)
{
    const rrnn_v big = RRNN_ALL(6755399441055744.0); /* 1.5 * 2^52 */
    const rrnn_v y = x * 0x1.45f306dc9c883p-1 - 0.5 + big;
    const rrnn_v kd = y - big; /* upwards: the least integer above 2 x/pi - 1/2 */
    const rrnn_v r = ((x - kd * 0x1.921fb544p+0) - kd * 0x1.0b4611a6p-34)
        - kd * 0x1.3198a2e037073p-69;
    const rrnn_v z = r * r;
    const rrnn_v ps = ((((((z * 0x1.952c77030ad4ap-49 - 0x1.ae7f3e733b81fp-41) * z
        + 0x1.6124613a86d09p-33) * z - 0x1.ae64567f544e4p-26) * z
        + 0x1.71de3a556c734p-19) * z - 0x1.a01a01a01a01ap-13) * z
        + 0x1.1111111111111p-7) * z - 0x1.5555555555555p-3;
    const rrnn_v pc = ((((((z * 0x1.ae7f3e733b81fp-45 - 0x1.93974a8c07c9dp-37) * z
        + 0x1.1eed8eff8d898p-29) * z - 0x1.27e4fb7789f5cp-22) * z
        + 0x1.a01a01a01a01ap-16) * z - 0x1.6c16c16c16c17p-10) * z
        + 0x1.5555555555555p-5) * z - 0.5;
    const rrnn_v s = r + r * (z * ps), c = z * pc + 1.0;
    const rrnn_m k = (rrnn_m)y & 3; /* big is a multiple of 4 */
    const rrnn_m odd = (k & 1) == 1;
    const rrnn_v s0 = rrnn_select(odd, c, s), c0 = rrnn_select(odd, s, c);
    *sine = rrnn_select((k & 2) == 2, -s0, s0);
    *cosine = rrnn_select(((k + 1) & 2) == 2, -c0, c0);
}

/* Range of a wave of period one turn between two angles: v, w its values at the
 * ends, low and high those ends in turns, counted from a top of the wave. */
RRNN_INLINE rrnn_v rrnn_crest(rrnn_v v, rrnn_v w, rrnn_v low, rrnn_v high)
{
    const rrnn_v big = RRNN_ALL(6755399441055744.0);
    const rrnn_v slack = RRNN_ALL(1e-9), one = RRNN_ALL(1.0);
    const rrnn_v next = ((low - slack) + big) - big; /* least integer above */
    const rrnn_m top = ~(next > high + slack);
    const rrnn_v most = rrnn_max(v, w) + RRNN_SINCOS;
    return rrnn_select(top | ~(most < 1.0), one, most);
}

RRNN_INLINE rrnn_isc rrnn_i_sincos(rrnn_i a)
{
    const rrnn_v lo = -a.n, turn = RRNN_ALL(0x1.45f306dc9c883p-3);
    const rrnn_v l = lo * turn, h = a.h * turn;
    rrnn_v s0, c0, s1, c1;
    rrnn_v_sincos(lo, &s0, &c0);
    rrnn_v_sincos(a.h, &s1, &c1);
    rrnn_isc r = {
        {rrnn_crest(-s0, -s1, l + 0.25, h + 0.25),
         rrnn_crest(s0, s1, l - 0.25, h - 0.25)},
        {rrnn_crest(-c0, -c1, l - 0.5, h - 0.5), rrnn_crest(c0, c1, l, h)},
    };
    const rrnn_m far = ~((a.n <= RRNN_ANGLE) & (a.h <= RRNN_ANGLE));
    const rrnn_v one = RRNN_ALL(1.0);
    r.s.n = rrnn_select(far, one, r.s.n);
    r.s.h = rrnn_select(far, one, r.s.h);
    r.c.n = rrnn_select(far, one, r.c.n);
    r.c.h = rrnn_select(far, one, r.c.h);
    return r;
}
