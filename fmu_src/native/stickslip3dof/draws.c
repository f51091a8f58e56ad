/* The Mersenne Twister MT19937 of Matsumoto and Nishimura (ACM Trans. Model. Comput. Simul. 8,
   1998), seeded and read as CPython does, so that a seed means the same rig in every form of the
   unit. */
#include "draws.h"

#include <math.h>
#include <stdint.h>

#include "model.h"

enum { WORDS = 624, SHIFT = 397 };

typedef struct {
    uint32_t words[WORDS];
    int next;
    double deviate; /* the second of a pair of normal deviates, drawn with the first */
    int has_deviate;
} Twister;

static void seed_words(uint32_t words[], uint32_t seed)
{
    words[0] = seed;
    for (uint32_t i = 1; i < WORDS; i++) {
        words[i] = 1812433253u * (words[i - 1] ^ (words[i - 1] >> 30)) + i;
    }
}

/* `init_by_array` with a key of one word, which is how Python seeds with a whole number. */
static void seed_twister(Twister *twister, uint32_t key)
{
    uint32_t *words = twister->words;
    uint32_t i = 1;
    seed_words(words, 19650218u);
    for (int k = 0; k < WORDS; k++) {
        words[i] = (words[i] ^ ((words[i - 1] ^ (words[i - 1] >> 30)) * 1664525u)) + key;
        if (++i >= WORDS) {
            words[0] = words[WORDS - 1];
            i = 1;
        }
    }
    for (int k = 0; k < WORDS - 1; k++) {
        words[i] = (words[i] ^ ((words[i - 1] ^ (words[i - 1] >> 30)) * 1566083941u)) - i;
        if (++i >= WORDS) {
            words[0] = words[WORDS - 1];
            i = 1;
        }
    }
    words[0] = 0x80000000u;
    twister->next = WORDS;
    twister->has_deviate = 0;
}

static void twist(uint32_t words[])
{
    for (int i = 0; i < WORDS; i++) {
        uint32_t y = (words[i] & 0x80000000u) | (words[(i + 1) % WORDS] & 0x7fffffffu);
        words[i] = words[(i + SHIFT) % WORDS] ^ (y >> 1) ^ (y & 1u ? 0x9908b0dfu : 0u);
    }
}

static uint32_t next_word(Twister *twister)
{
    if (twister->next >= WORDS) {
        twist(twister->words);
        twister->next = 0;
    }
    uint32_t y = twister->words[twister->next++];
    y ^= y >> 11;
    y ^= (y << 7) & 0x9d2c5680u;
    y ^= (y << 15) & 0xefc60000u;
    return y ^ (y >> 18);
}

/* Uniform in [0, 1), of 53 bits. */
static double uniform(Twister *twister)
{
    uint32_t high = next_word(twister) >> 5, low = next_word(twister) >> 6;
    return (high * 67108864.0 + low) * (1.0 / 9007199254740992.0);
}

/* Standard normal deviates in pairs, after Box and Muller. */
static double normal(Twister *twister)
{
    if (twister->has_deviate) {
        twister->has_deviate = 0;
        return twister->deviate;
    }
    double angle = uniform(twister) * 6.283185307179586;
    double radius = sqrt(-2.0 * log(1.0 - uniform(twister)));
    twister->deviate = sin(angle) * radius;
    twister->has_deviate = 1;
    return cos(angle) * radius;
}

void draw(double d[], const double v[])
{
    Twister twister;
    for (int i = 0; i < D_SIZE; i++) {
        if (i == 0 || DRAW_SEED[i] != DRAW_SEED[i - 1]) {
            seed_twister(&twister, (uint32_t)v[DRAW_SEED[i]]);
        }
        d[i] = DRAW_UNIFORM[i] ? uniform(&twister) : normal(&twister);
    }
}
