/* Sine and cosine in one call, double precision, no library behind it.
 *
 * Reduction: x = k pi/2 + r with k = nearest integer to 2x/pi, pi/2 held in
 * three parts of 33, 33 and 53 bits (Cody and Waite, "Software Manual for the
 * Elementary Functions", 1980), so k*part is exact up to |k| = 2^20.
 * Kernels on |r| <= pi/4: minimax polynomials of fdlibm (Sun Microsystems
 * 1993, freely usable).  No branch, no table; the same bits on every IEEE 754
 * machine when products and sums are not contracted (-ffp-contract=off).
 *
 * Error: at most 2 ulp for |x| <= 50 (tested), absolute error near the spacing
 * of x beyond; NaN for NaN, infinity and |x| > 2^30.  */
#if FLT_EVAL_METHOD != 0
#error "sincos needs FLT_EVAL_METHOD == 0 (on 32-bit x86: -msse2 -mfpmath=sse)"
#endif

typedef struct {
    double s;
    double c;
} rrnn_sincos_t;

RRNN_UNUSED static inline rrnn_sincos_t rrnn_sincos(double x)
{
    const double big = 6755399441055744.0; /* 1.5 * 2^52: adding it rounds */
    const int ok = (x >= -1073741824.0) && (x <= 1073741824.0);
    const double y = ok ? x : (double)NAN;
    const double kd = (y * 0.6366197723675814 + big) - big;
    const int32_t k = ok ? (int32_t)kd : 0;
    const double t = y - kd * 1.5707963267341256;
    const double w = kd * 6.077100506303966e-11;
    const double r = t - w; /* r + d: the reduced argument */
    const double d = ((t - r) - w) - kd * 2.0222662487959506e-21;
    const double z = r * r;
    const double ps = -1.66666666666666324348e-01 + z
        * (8.33333333332248946124e-03 + z
        * (-1.98412698298579493134e-04 + z
        * (2.75573137070700676789e-06 + z
        * (-2.50507602534068634195e-08 + z
        * 1.58969099521155010221e-10))));
    const double pc = 4.16666666666666019037e-02 + z
        * (-1.38888888888741095749e-03 + z
        * (2.48015872894767294178e-05 + z
        * (-2.75573143513906633035e-07 + z
        * (2.08757232129817482790e-09 + z
        * -1.13596475577881948265e-11))));
    const double sr = r + (r * (z * ps) + d);
    const double cr = 1.0 - (0.5 * z - ((z * z) * pc - r * d));
    const double s0 = ((k & 1) != 0) ? cr : sr;
    const double c0 = ((k & 1) != 0) ? sr : cr;
    const rrnn_sincos_t out = {
        ((k & 2) != 0) ? -s0 : s0,
        (((k + 1) & 2) != 0) ? -c0 : c0,
    };
    return out;
}

/* All at once; the loop vectorises. */
RRNN_UNUSED static inline void rrnn_sincos_all(const double x[], uint32_t count,
                                               rrnn_sincos_t out[])
{
    uint32_t i;
    for (i = 0U; i < count; ++i) {
        out[i] = rrnn_sincos(x[i]);
    }
}
