/* Sine and cosine in one call, single precision, no library behind it.
 *
 * As the double version; pi/2 in parts of 16, 16 and 24 bits, so k*part is
 * exact up to |k| = 2^8; kernels: minimax polynomials of Cephes (S. L. Moshier,
 * 1989).
 *
 * Error: at most 2 ulp for |x| <= 50 (tested), absolute error near the spacing
 * of x beyond; NaN for NaN, infinity and |x| > 2^15.  */
#if FLT_EVAL_METHOD != 0
#error "sincos needs FLT_EVAL_METHOD == 0 (on 32-bit x86: -msse2 -mfpmath=sse)"
#endif

typedef struct {
    float s;
    float c;
} rrnn_sincos_t;

RRNN_UNUSED static inline rrnn_sincos_t rrnn_sincos(float x)
{
    const float big = 12582912.0F; /* 1.5 * 2^23: adding it rounds */
    const int ok = (x >= -32768.0F) && (x <= 32768.0F);
    const float y = ok ? x : (float)NAN;
    const float kd = (y * 0x1.45f306p-1F + big) - big;
    const int32_t k = ok ? (int32_t)kd : 0;
    const float t = y - kd * 0x1.921ep+0F;
    const float w = kd * 0x1.b544p-16F;
    const float r = t - w; /* r + d: the reduced argument */
    const float d = ((t - r) - w) - kd * 0x1.0b4612p-34F;
    const float z = r * r;
    const float ps = -1.6666654611e-1F + z
        * (8.3321608736e-3F + z
        * -1.9515295891e-4F);
    const float pc = 4.166664568298827e-2F + z
        * (-1.388731625493765e-3F + z
        * 2.443315711809948e-5F);
    const float sr = r + (r * (z * ps) + d);
    const float cr = 1.0F - (0.5F * z - ((z * z) * pc - r * d));
    const float s0 = ((k & 1) != 0) ? cr : sr;
    const float c0 = ((k & 1) != 0) ? sr : cr;
    const rrnn_sincos_t out = {
        ((k & 2) != 0) ? -s0 : s0,
        (((k + 1) & 2) != 0) ? -c0 : c0,
    };
    return out;
}

/* All at once; the loop vectorises. */
RRNN_UNUSED static inline void rrnn_sincos_all(const float x[], uint32_t count,
                                               rrnn_sincos_t out[])
{
    uint32_t i;
    for (i = 0U; i < count; ++i) {
        out[i] = rrnn_sincos(x[i]);
    }
}
