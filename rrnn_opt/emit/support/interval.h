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
