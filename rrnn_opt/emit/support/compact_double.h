/* Sine and cosine in one call, double precision, for a microcontroller.
 *
 * The bits of sincos_double.h by other instructions: see compact_float.h.  */
#if FLT_EVAL_METHOD != 0
#error "sincos needs FLT_EVAL_METHOD == 0"
#endif

typedef struct {
    double s;
    double c;
} rrnn_sincos_t;

RRNN_UNUSED static inline rrnn_sincos_t rrnn_sincos(double x)
{
    const double big = 6755399441055744.0; /* 1.5 * 2^52: adding it rounds */
    const double least =
        (fabs(x) <= 1073741824.0) ? 2.0222662487959506e-21 : (double)NAN;
    const double kd = ((x * 0.6366197723675814) + big) - big;
    const uint32_t k = (uint32_t)(int32_t)((fabs(x) <= 1073741824.0) ? kd : 0.0);
    const double t = x - (kd * 1.5707963267341256);
    const double w = kd * 6.077100506303966e-11;
    const double r = t - w; /* r + d: the reduced argument */
    const double d = ((t - r) - w) - (kd * least);
    const double z = r * r;
    const double ps = -1.66666666666666324348e-01 + (z
        * (8.33333333332248946124e-03 + (z
        * (-1.98412698298579493134e-04 + (z
        * (2.75573137070700676789e-06 + (z
        * (-2.50507602534068634195e-08 + (z
        * 1.58969099521155010221e-10)))))))));
    const double pc = 4.16666666666666019037e-02 + (z
        * (-1.38888888888741095749e-03 + (z
        * (2.48015872894767294178e-05 + (z
        * (-2.75573143513906633035e-07 + (z
        * (2.08757232129817482790e-09 + (z
        * -1.13596475577881948265e-11)))))))));
    const double sr = r + ((r * (z * ps)) + d);
    const double cr = 1.0 - ((0.5 * z) - (((z * z) * pc) - (r * d)));
    const double turned[4] = {sr, cr, -sr, -cr};
    const rrnn_sincos_t out = {turned[k & 3U], turned[(k + 1U) & 3U]};
    return out;
}

/* Of `count` angles: one loop, so that the constants are loaded once. */
RRNN_UNUSED RRNN_APART static void rrnn_sincos_all(const double x[], uint32_t count,
                                        rrnn_sincos_t out[])
{
    uint32_t i;
    for (i = 0U; i < count; ++i) {
        out[i] = rrnn_sincos(x[i]);
    }
}
