/* Sine and cosine in one call, single precision, for a microcontroller.
 *
 * The bits of sincos_float.h by other instructions.  The four signed values
 * stand in a table that the quadrant points into, and an angle out of range
 * makes the last part of pi/2 a NaN: no branch, and no select of two values
 * that a compiler could turn into one.  So the number of instructions does not
 * depend on the angle.  */
#if FLT_EVAL_METHOD != 0
#error "sincos needs FLT_EVAL_METHOD == 0"
#endif

typedef struct {
    float s;
    float c;
} rrnn_sincos_t;

RRNN_UNUSED static inline rrnn_sincos_t rrnn_sincos(float x)
{
    const float big = 12582912.0F; /* 1.5 * 2^23: adding it rounds */
    const float least = (fabsf(x) <= 32768.0F) ? 0x1.0b4612p-34F : (float)NAN;
    const float kd = ((x * 0x1.45f306p-1F) + big) - big;
    const uint32_t k = (uint32_t)(int32_t)((fabsf(x) <= 32768.0F) ? kd : 0.0F);
    const float t = x - (kd * 0x1.921ep+0F);
    const float w = kd * 0x1.b544p-16F;
    const float r = t - w; /* r + d: the reduced argument */
    const float d = ((t - r) - w) - (kd * least);
    const float z = r * r;
    const float ps = -1.6666654611e-1F + (z
        * (8.3321608736e-3F + (z
        * -1.9515295891e-4F)));
    const float pc = 4.166664568298827e-2F + (z
        * (-1.388731625493765e-3F + (z
        * 2.443315711809948e-5F)));
    const float sr = r + ((r * (z * ps)) + d);
    const float cr = 1.0F - ((0.5F * z) - (((z * z) * pc) - (r * d)));
    const float turned[4] = {sr, cr, -sr, -cr};
    const rrnn_sincos_t out = {turned[k & 3U], turned[(k + 1U) & 3U]};
    return out;
}

/* Of `count` angles: one loop, so that the constants are loaded once. */
RRNN_UNUSED RRNN_APART static void rrnn_sincos_all(const float x[], uint32_t count,
                                        rrnn_sincos_t out[])
{
    uint32_t i;
    for (i = 0U; i < count; ++i) {
        out[i] = rrnn_sincos(x[i]);
    }
}
