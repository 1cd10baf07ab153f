/* Interval arithmetic over lanes of doubles, rounded outwards.
 *
 * An interval [a, b] is held as (n, h) = (-a, b), and all arithmetic runs with
 * the machine rounding UPWARDS: rounding -a up is rounding a down, so both ends
 * move outwards and the mode is set once for a whole kernel (S. M. Rump,
 * "INTLAB", 1999; F. Goualard, "Gaol", 2005).  Needs -frounding-math, or the
 * compiler would fold (-x)*y into -(x*y).
 *
 * No end is ever NaN unless another one is infinite: with upward rounding n
 * and h overflow to +infinity only.  Emitted code adds every n + h >= 0 that
 * arithmetic makes to an accumulator, which is therefore infinite or NaN as
 * soon as any intermediate interval is not bounded; such lanes prove nothing.
 * Division by an interval with zero in it, the square root of one that reaches
 * below zero, and angles beyond 1e5 rad (sine and cosine: [-1, 1]) are unbounded
 * or trivially bounded in this sense.  */
#include <fenv.h>
#include <string.h>
#if defined(__AVX__)
#include <immintrin.h>
#endif

#if defined(__AVX512F__)
#define RRNN_LANES 8
#else
#define RRNN_LANES 4
#endif
#define RRNN_INLINE static inline __attribute__((always_inline, unused))

typedef double rrnn_v __attribute__((vector_size(8 * RRNN_LANES)));
typedef long long rrnn_m __attribute__((vector_size(8 * RRNN_LANES)));
typedef struct {
    rrnn_v n;
    rrnn_v h;
} rrnn_i;
typedef struct {
    rrnn_i s;
    rrnn_i c;
} rrnn_isc;

#define RRNN_ALL(x) ((x) + (rrnn_v){0})
#define RRNN_INFTY RRNN_ALL((double)INFINITY)

RRNN_INLINE rrnn_v rrnn_select(rrnn_m m, rrnn_v a, rrnn_v b)
{
    return (rrnn_v)((m & (rrnn_m)a) | (~m & (rrnn_m)b));
}

RRNN_INLINE rrnn_v rrnn_max(rrnn_v a, rrnn_v b)
{
#if defined(__AVX512F__)
    return (rrnn_v)_mm512_max_pd((__m512d)a, (__m512d)b);
#elif defined(__AVX__)
    return (rrnn_v)_mm256_max_pd((__m256d)a, (__m256d)b);
#else
    return rrnn_select(a > b, a, b);
#endif
}

RRNN_INLINE rrnn_v rrnn_min(rrnn_v a, rrnn_v b)
{
    return -rrnn_max(-a, -b);
}

RRNN_INLINE rrnn_i rrnn_i_point(double x)
{
    const rrnn_i r = {RRNN_ALL(-x), RRNN_ALL(x)};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_load(const double *lo, const double *hi)
{
    rrnn_v a, b;
    memcpy(&a, lo, sizeof a);
    memcpy(&b, hi, sizeof b);
    const rrnn_i r = {-a, b};
    return r;
}

RRNN_INLINE void rrnn_i_store(double *lo, double *hi, rrnn_i x)
{
    const rrnn_v a = -x.n;
    memcpy(lo, &a, sizeof a);
    memcpy(hi, &x.h, sizeof x.h);
}

RRNN_INLINE rrnn_i rrnn_i_neg(rrnn_i a)
{
    const rrnn_i r = {a.h, a.n};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_add(rrnn_i a, rrnn_i b)
{
    const rrnn_i r = {a.n + b.n, a.h + b.h};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_sub(rrnn_i a, rrnn_i b)
{
    const rrnn_i r = {a.n + b.h, a.h + b.n};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_twice(rrnn_i a)
{
    return rrnn_i_add(a, a);
}

RRNN_INLINE rrnn_i rrnn_i_mul(rrnn_i a, rrnn_i b)
{
    const rrnn_v an = -a.n, ah = -a.h; /* the lower end; minus the upper one */
    const rrnn_i r = {
        rrnn_max(rrnn_max(an * b.n, a.n * b.h), rrnn_max(a.h * b.n, ah * b.h)),
        rrnn_max(rrnn_max(a.n * b.n, an * b.h), rrnn_max(ah * b.n, a.h * b.h)),
    };
    return r;
}

/* Least absolute value of an interval. */
RRNN_INLINE rrnn_v rrnn_i_least(rrnn_i a)
{
    return rrnn_max(rrnn_max(-a.n, -a.h), RRNN_ALL(0.0));
}

RRNN_INLINE rrnn_i rrnn_i_sq(rrnn_i a)
{
    const rrnn_v least = rrnn_i_least(a), most = rrnn_max(a.n, a.h);
    const rrnn_i r = {(-least) * least, most * most};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_fabs(rrnn_i a)
{
    const rrnn_i r = {-rrnn_i_least(a), rrnn_max(a.n, a.h)};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_unless(rrnn_m bad, rrnn_i a)
{
    const rrnn_i r = {
        rrnn_select(bad, RRNN_INFTY, a.n), rrnn_select(bad, RRNN_INFTY, a.h)};
    return r;
}

RRNN_INLINE rrnn_m rrnn_i_zero_in(rrnn_i a)
{
    return ~((a.n < 0.0) | (a.h < 0.0));
}

RRNN_INLINE rrnn_i rrnn_i_inv(rrnn_i a)
{
    const rrnn_v one = RRNN_ALL(-1.0);
    const rrnn_i r = {one / a.h, one / a.n};
    return rrnn_i_unless(rrnn_i_zero_in(a), r);
}

RRNN_INLINE rrnn_i rrnn_i_div(rrnn_i a, rrnn_i b)
{
    const rrnn_v an = -a.n, ah = -a.h;
    const rrnn_i r = {
        rrnn_max(rrnn_max(an / b.n, a.n / b.h), rrnn_max(a.h / b.n, ah / b.h)),
        rrnn_max(rrnn_max(a.n / b.n, an / b.h), rrnn_max(ah / b.n, a.h / b.h)),
    };
    return rrnn_i_unless(rrnn_i_zero_in(b), r);
}

RRNN_INLINE rrnn_i rrnn_i_sqrt(rrnn_i a)
{
    rrnn_v low = -a.n, high = a.h;
    int k;
    for (k = 0; k < RRNN_LANES; ++k) {
        low[k] = sqrt(low[k]);
        high[k] = sqrt(high[k]);
    }
    /* (-s) (1 - 2^-52), rounded up, is no less than minus the true root */
    const rrnn_i r = {(-low) * (1.0 - 0x1p-52), high};
    return rrnn_i_unless(~(a.n <= 0.0), r);
}

RRNN_INLINE rrnn_i rrnn_i_fmin(rrnn_i a, rrnn_i b)
{
    const rrnn_i r = {rrnn_max(a.n, b.n), rrnn_min(a.h, b.h)};
    return r;
}

RRNN_INLINE rrnn_i rrnn_i_fmax(rrnn_i a, rrnn_i b)
{
    const rrnn_i r = {rrnn_min(a.n, b.n), rrnn_max(a.h, b.h)};
    return r;
}

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
