/* xoroshiro128+ (Blackman and Vigna, 2018): 128 bits of state, the same
 * stream with every compiler. */
#ifndef RRNN_RNG_H
#define RRNN_RNG_H

#include <stdint.h>

typedef struct {
    uint64_t s[2];
} rng_t;

static inline void rng_seed(rng_t *rng, const uint64_t seed[2])
{
    rng->s[0] = seed[0];
    rng->s[1] = (seed[0] | seed[1]) != 0 ? seed[1] : 1;
}

static inline uint64_t rng_rotate(uint64_t x, int k)
{
    return (x << k) | (x >> (64 - k));
}

static inline uint64_t rng_next(rng_t *rng)
{
    const uint64_t a = rng->s[0];
    const uint64_t b = rng->s[1] ^ a;
    const uint64_t result = a + rng->s[1];
    rng->s[0] = rng_rotate(a, 24) ^ b ^ (b << 16);
    rng->s[1] = rng_rotate(b, 37);
    return result;
}

/* Uniform in [0, 1). */
static inline double rng_uniform(rng_t *rng)
{
    return (double)(rng_next(rng) >> 11) * (1.0 / 9007199254740992.0);
}

#endif
