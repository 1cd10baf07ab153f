/* Arithmetic on RRNN_LANES doubles at once, to the bit as one by one.
 *
 * Read once for every width, each time with another RRNN_LANES, RRNN_TARGET
 * (what the compiler may use) and prefix of the names.  Vector types of gcc and
 * clang; products and sums are not contracted, and sine and cosine are those of
 * sincos_double.h, operation by operation, so that a lane holds what the scalar
 * code computes.  */
#define RRNN_LANE static inline __attribute__((always_inline, unused)) RRNN_TARGET

typedef double rrnn_v __attribute__((vector_size(8 * RRNN_LANES)));
typedef long long rrnn_m __attribute__((vector_size(8 * RRNN_LANES)));
typedef struct {
    rrnn_v s;
    rrnn_v c;
} rrnn_sc;

#if RRNN_LANES == 8
#define rrnn_all(x) ((rrnn_v){x, x, x, x, x, x, x, x})
#define rrnn_bits(x) ((rrnn_m){x, x, x, x, x, x, x, x})
#elif RRNN_LANES == 4
#define rrnn_all(x) ((rrnn_v){x, x, x, x})
#define rrnn_bits(x) ((rrnn_m){x, x, x, x})
#else
#define rrnn_all(x) ((rrnn_v){x, x})
#define rrnn_bits(x) ((rrnn_m){x, x})
#endif

RRNN_LANE rrnn_v rrnn_load(const double *from)
{
    rrnn_v r;
    memcpy(&r, from, sizeof r);
    return r;
}

RRNN_LANE void rrnn_store(double *to, rrnn_v x)
{
    memcpy(to, &x, sizeof x);
}

RRNN_LANE rrnn_v rrnn_select(rrnn_m m, rrnn_v a, rrnn_v b)
{
    return (rrnn_v)((m & (rrnn_m)a) | (~m & (rrnn_m)b));
}

/* 1.0 where the mask is set, else 0.0. */
RRNN_LANE rrnn_v rrnn_truth(rrnn_m m)
{
    return (rrnn_v)(m & (rrnn_m)rrnn_all(1.0));
}

RRNN_LANE rrnn_v rrnn_fabs(rrnn_v x)
{
    return (rrnn_v)((rrnn_m)x & rrnn_bits(INT64_MAX));
}

RRNN_LANE rrnn_v rrnn_copysign(rrnn_v x, rrnn_v y)
{
    return rrnn_select(rrnn_bits(INT64_MAX), x, y);
}

RRNN_LANE rrnn_v rrnn_neg(rrnn_v x)
{
    return (rrnn_v)((rrnn_m)x ^ rrnn_bits(INT64_MIN));
}

RRNN_LANE rrnn_v rrnn_sign(rrnn_v x)
{
    const rrnn_v zero = rrnn_all(0.0), one = rrnn_all(1.0);
    return rrnn_select(x < zero, -one, rrnn_select(x > zero, one, x));
}

#if RRNN_LANES == 8 && defined(RRNN_X86)
#define RRNN_BY(wide, narrow, each) ((rrnn_v)wide)
#elif RRNN_LANES == 4 && defined(RRNN_X86)
#define RRNN_BY(wide, narrow, each) ((rrnn_v)narrow)
#else
#define RRNN_BY(wide, narrow, each) (each)
#endif

RRNN_LANE rrnn_v rrnn_fmin(rrnn_v a, rrnn_v b)
{
    return RRNN_BY(_mm512_min_pd((__m512d)a, (__m512d)b),
                   _mm256_min_pd((__m256d)a, (__m256d)b), rrnn_select(a < b, a, b));
}

RRNN_LANE rrnn_v rrnn_fmax(rrnn_v a, rrnn_v b)
{
    return RRNN_BY(_mm512_max_pd((__m512d)a, (__m512d)b),
                   _mm256_max_pd((__m256d)a, (__m256d)b), rrnn_select(a > b, a, b));
}

#define RRNN_EACH(name, f)                                                   \
    RRNN_LANE rrnn_v name(rrnn_v x)                                          \
    {                                                                        \
        for (int l = 0; l < RRNN_LANES; l++) {                               \
            x[l] = f(x[l]);                                                  \
        }                                                                    \
        return x;                                                            \
    }
RRNN_EACH(rrnn_sqrt_each, sqrt)
RRNN_EACH(rrnn_floor_each, floor)
RRNN_EACH(rrnn_ceil_each, ceil)

RRNN_LANE rrnn_v rrnn_sqrt(rrnn_v x)
{
    return RRNN_BY(_mm512_sqrt_pd((__m512d)x), _mm256_sqrt_pd((__m256d)x),
                   rrnn_sqrt_each(x));
}

RRNN_LANE rrnn_v rrnn_floor(rrnn_v x)
{
    return RRNN_BY(_mm512_floor_pd((__m512d)x), _mm256_floor_pd((__m256d)x),
                   rrnn_floor_each(x));
}

RRNN_LANE rrnn_v rrnn_ceil(rrnn_v x)
{
    return RRNN_BY(_mm512_ceil_pd((__m512d)x), _mm256_ceil_pd((__m256d)x),
                   rrnn_ceil_each(x));
}

/* See sincos_double.h; the last bits of 2x/pi + big count the quarter turns. */
RRNN_LANE rrnn_sc rrnn_sincos(rrnn_v x)
{
    const rrnn_v big = rrnn_all(6755399441055744.0), one = rrnn_all(1.0);
    const rrnn_m ok = rrnn_fabs(x) <= rrnn_all(1073741824.0);
    const rrnn_v y = rrnn_select(ok, x, rrnn_all((double)NAN));
    const rrnn_v turned = y * rrnn_all(0.6366197723675814) + big;
    const rrnn_v kd = turned - big;
    const rrnn_m k = (rrnn_m)turned;
    const rrnn_v t = y - kd * rrnn_all(1.5707963267341256);
    const rrnn_v w = kd * rrnn_all(6.077100506303966e-11);
    const rrnn_v r = t - w;
    const rrnn_v d = ((t - r) - w) - kd * rrnn_all(2.0222662487959506e-21);
    const rrnn_v z = r * r;
    const rrnn_v ps = rrnn_all(-1.66666666666666324348e-01) + z
        * (rrnn_all(8.33333333332248946124e-03) + z
        * (rrnn_all(-1.98412698298579493134e-04) + z
        * (rrnn_all(2.75573137070700676789e-06) + z
        * (rrnn_all(-2.50507602534068634195e-08) + z
        * rrnn_all(1.58969099521155010221e-10)))));
    const rrnn_v pc = rrnn_all(4.16666666666666019037e-02) + z
        * (rrnn_all(-1.38888888888741095749e-03) + z
        * (rrnn_all(2.48015872894767294178e-05) + z
        * (rrnn_all(-2.75573143513906633035e-07) + z
        * (rrnn_all(2.08757232129817482790e-09) + z
        * rrnn_all(-1.13596475577881948265e-11)))));
    const rrnn_v sr = r + (r * (z * ps) + d);
    const rrnn_v cr = one - (rrnn_all(0.5) * z - ((z * z) * pc - r * d));
    const rrnn_m odd = (k & rrnn_bits(1)) == rrnn_bits(1);
    const rrnn_v s0 = rrnn_select(odd, cr, sr), c0 = rrnn_select(odd, sr, cr);
    const rrnn_sc out = {
        (rrnn_v)((rrnn_m)s0 ^ ((k & rrnn_bits(2)) << 62)),
        (rrnn_v)((rrnn_m)c0 ^ (((k + rrnn_bits(1)) & rrnn_bits(2)) << 62)),
    };
    return out;
}
#undef RRNN_BY
#undef RRNN_EACH
#undef RRNN_LANE
