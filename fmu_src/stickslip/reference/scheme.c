/* The source study's scheme: stick and slip in turn, slip in blocks of 10 ms.

   What the equations are stands in linearised.py; what its faults and effects are, in
   scheme_options.py. SI units, rad. The structures are those of scheme.py, member by member. */

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

#define PI 3.141592653589793
#define STEPS 99                     /* a block is sampled at 100 instants */
#define INTERVAL 0.01                /* s, of a block */
#define STEP (INTERVAL / STEPS)
#define STICK_STEP (20.0 / 1999.0)   /* s: 2000 samples over 20 s, the study's */
#define ROW_STEPS 11                 /* a row every ninth part of a block, 1.1 ms */
#define LONGEST_SLIP_BLOCKS 100      /* fault F14 */
#define BISECTIONS 50                /* halves 10 ms or 0.1 ms to below the resolution of a double */
#define SMALLEST_SLIDING 1e-9        /* m/s, below which a strip's sliding has no direction */
/* Neighbouring strips that share a direction: twenty directions leave 1e-3 of the spin moment. */
#define TOGETHER 5
/* Terms of the series: |W h^2| < 0.02 even at 9999 N/m, where the ninth is below 1e-30. */
#define TERMS 8

enum { STICK, SLIP };
enum { BROKE_AWAY, STUCK_AGAIN, CUT, OUT_OF_TIME };

typedef struct {
    double mass, inertia, stiffness, normal_force, speed, curvature, mu_s, mu_k, mu_slope;
    double mu_k_speed, static_scatter, force_scatter, moment_scatter, correlation_length, covered;
    double reach, spring_length;
    int64_t updated, strip_wise, seed;
} Rig;

typedef struct {
    int64_t one_spring, white, on_grid, stale, mirrored, cut, lagging;
} Faults;

typedef struct {
    int64_t on;
    double stick_springs, lateral, ageing, hold_time, film, weakening_per_joule, relaxation, run_in;
    double run_in_distance, cubic, damping, damping_rotation, ripple, ripple_rate, ripple_phase;
    double pattern, pattern_wavenumber, pattern_phase, spring_angle, anchor_offset;
} Effects;

typedef struct {
    double q[3], v[3];           /* x, y, phi */
    double before[3];            /* velocities before the last block */
    double alpha[4], load[3];    /* load: force, moment, lateral force */
    double mean[2];              /* of the load, without scatter, on a block slower than the surface */
    double side;                 /* 1 where the surface is faster than the block, else -1 */
    double recent_heat, distance, friction; /* J, m, N along x */
    double attachment[4][2], beta[4];
    const double *shares, *middles;
    int64_t strips;
    double *rows, *phases;       /* as in scheme.py */
    int64_t row_count, row_limit, phase_count, phase_limit;
    const double *normals;       /* random numbers, which `refill` makes more of */
    int64_t drawn, normal_count;
    void (*refill)(void);
} Memory;

typedef struct {
    const Rig *rig;
    const Faults *faults;
    const Effects *effects;
    Memory *m;
} Run;

/* Co, Si, P2, P3 and W Si of a step, see `propagator`. */
typedef struct {
    double co[3][3], si[3][3], p2[3][3], p3[3][3], wsi[3][3];
} Propagator;

static double larger(double a, double b) { return a > b ? a : b; }

/* --- random numbers -------------------------------------------------------------------------- */

static double normal(Memory *m) {
    if (m->drawn == m->normal_count) {
        m->refill();
        m->drawn = 0;
    }
    return m->normals[m->drawn++];
}

/* A number in (0, 1) that belongs to (seed, place, channel): splitmix64. */
static double hash(uint64_t seed, int64_t place, uint64_t channel) {
    uint64_t z = seed * UINT64_C(0x9E3779B97F4A7C15);
    z ^= (uint64_t)(place + 1000000) * UINT64_C(0xD1342543DE82EF95);
    z += channel * UINT64_C(0x2545F4914F6CDD1D);
    for (int i = 0; i < 2; i++) {
        z = (z ^ (z >> 30)) * UINT64_C(0xBF58476D1CE4E5B9);
        z = (z ^ (z >> 27)) * UINT64_C(0x94D049BB133111EB);
        z = z ^ (z >> 31);
    }
    return ((double)(z >> 11) + 0.5) / 9007199254740992.0;
}

/* Two standard normals that belong to a place (m) on the surface: independent at nodes `length`
   apart, linear between them, of unit variance everywhere. */
void field_scatter(int64_t seed, double place, double length, double *normals) {
    double node = floor(place / length);
    double share = place / length - node;
    normals[0] = normals[1] = 0.0;
    for (int side = 0; side < 2; side++) {
        double weight = side == 1 ? share : 1.0 - share;
        double radius = sqrt(-2.0 * log(hash((uint64_t)seed, (int64_t)node + side, 0)));
        double angle = 2.0 * PI * hash((uint64_t)seed, (int64_t)node + side, 1);
        normals[0] += weight * radius * cos(angle);
        normals[1] += weight * radius * sin(angle);
    }
    double scale = 1.0 / sqrt(share * share + (1.0 - share) * (1.0 - share));
    normals[0] *= scale;
    normals[1] *= scale;
}

static void add_scatter(const Run *run, double place, double load[3]) {
    double normals[2];
    if (run->faults->white) {
        normals[0] = normal(run->m);
        normals[1] = normal(run->m);
    } else {
        field_scatter(run->rig->seed, place, run->rig->correlation_length, normals);
    }
    load[0] += run->rig->force_scatter * normals[0];
    load[1] += run->rig->moment_scatter * normals[1];
}

/* --- effects ---------------------------------------------------------------------------------- */

static double surface_speed(const Run *run, double t) {
    const Effects *e = run->effects;
    if (e->ripple == 0.0) return run->rig->speed;
    double angle = e->ripple_rate * t + e->ripple_phase;
    return run->rig->speed * (1.0 + e->ripple * sin(angle));
}

static double surface_travel(const Run *run, double t) {
    const Effects *e = run->effects;
    double travel = run->rig->speed * t;
    if (e->ripple != 0.0) {
        double start = e->ripple_phase, now = e->ripple_rate * t + e->ripple_phase;
        travel += run->rig->speed * e->ripple / e->ripple_rate * (cos(start) - cos(now));
    }
    return travel;
}

/* Friction of a place on the surface over its mean (surface_pattern). */
static double place_factor(const Effects *e, double place) {
    if (e->pattern == 0.0) return 1.0;
    double angle = e->pattern_wavenumber * place + e->pattern_phase;
    return larger(0.0, 1.0 + e->pattern * cos(angle));
}

/* mu_k over its value at the start: place, recent heat and distance slid. */
static double kinetic_factor(const Run *run, double place) {
    const Effects *e = run->effects;
    double factor = place_factor(e, place);
    factor *= larger(0.0, 1.0 - e->weakening_per_joule * run->m->recent_heat);
    if (e->run_in != 0.0) {
        double drift = 1.0 - exp(-run->m->distance / e->run_in_distance);
        factor *= larger(0.0, 1.0 + e->run_in * drift);
    }
    return factor;
}

/* Load on the contact along -x, N: springs, damping and the block's own inertia. */
static double load_in_stick(const Run *run, double t, double x) {
    const Rig *rig = run->rig;
    const Effects *e = run->effects;
    double angle = e->ripple_rate * t + e->ripple_phase;
    double acceleration = rig->speed * e->ripple * e->ripple_rate * cos(angle);
    double load = 4.0 * (rig->stiffness * x + e->cubic * (x * x * x));
    return load + e->damping * surface_speed(run, t) + rig->mass * acceleration;
}

/* What the contact holds after `hold` (s) of stick, N. */
static double held_in_stick(const Run *run, double t, double hold, double x) {
    const Effects *e = run->effects;
    double mu = run->rig->mu_s * place_factor(e, x - surface_travel(run, t));
    if (e->ageing != 0.0) mu += e->ageing * log10(1.0 + hold / e->hold_time);
    return mu * run->rig->normal_force;
}

static double weakened(const Rig *rig, double sliding) {
    return larger(rig->mu_k - rig->mu_slope * (sliding - rig->mu_k_speed), 0.0);
}

/* Friction of every strip against its own sliding velocity (lateral_friction). The strips lie along
   y, so a lateral force has no arm. The surface under a strip moves with v (1 - Y/R, x/R): with a
   curvature it carries the block sideways. */
static void planar_load(
    const Run *run, double factor, double t, const double q[3], const double v[3], double load[3]
) {
    const Rig *rig = run->rig;
    double kappa = run->effects->lateral, speed = surface_speed(run, t);
    double across = kappa * (speed * rig->curvature * q[0] - v[1]);
    double centre = speed * (1.0 - rig->curvature * q[1]) - v[0];
    double spin = kappa * (v[2] - speed * rig->curvature);
    load[0] = load[1] = load[2] = 0.0;
    for (int64_t j = TOGETHER / 2; j < run->m->strips; j += TOGETHER) {
        double share = 0.0;
        for (int64_t i = j - TOGETHER / 2; i <= j + TOGETHER / 2; i++) share += run->m->shares[i];
        double y = run->m->middles[j];
        double along = centre + spin * y;
        double sliding = larger(sqrt(along * along + across * across), SMALLEST_SLIDING);
        double force = factor * weakened(rig, sliding) * share * rig->normal_force / sliding;
        load[0] += force * along;
        load[1] -= kappa * force * along * y;
        load[2] += kappa * force * across;
    }
}

/* Friction (force, moment, lateral force) under the effects. */
static void friction_load(
    const Run *run, double t, const double q[3], const double v[3], double load[3]
) {
    Memory *m = run->m;
    double factor = kinetic_factor(run, q[0] - surface_travel(run, t));
    if (run->effects->lateral > 0.0) {
        planar_load(run, factor, t, q, v, load);
    } else {
        load[0] = m->side * factor * m->mean[0];
        load[1] = m->side * factor * m->mean[1];
        load[2] = 0.0;
    }
    load[0] += run->effects->film * (surface_speed(run, t) - v[0]);
    m->friction = load[0];
}

/* What the cubic term of the springs and the damping put on the block. */
static void add_spring_and_damping_load(
    const Run *run, const double q[3], const double v[3], double load[3]
) {
    const Effects *e = run->effects;
    load[0] -= e->damping * v[0];
    load[2] -= e->damping * v[1];
    load[1] -= e->damping_rotation * v[2];
    if (e->cubic == 0.0) return;
    for (int i = 0; i < 4; i++) {
        const double *at = run->m->attachment[i];
        double c = cos(run->m->alpha[i]), d = sin(run->m->alpha[i]);
        double arm = d * at[0] - c * at[1];
        double extension = c * q[0] + d * q[1] + arm * q[2];
        double pull = e->cubic * (extension * extension * extension);
        load[0] -= pull * c;
        load[1] -= pull * arm;
        load[2] -= pull * d;
    }
}

/* Carry the lumped thermal state and the distance over a step `h` (s). */
static void remember(const Run *run, double t, const double v[3], double h) {
    Memory *m = run->m;
    double sliding = fabs(surface_speed(run, t) - v[0]);
    double heat = fabs(m->friction) * sliding;
    m->recent_heat += h * (heat - m->recent_heat / run->effects->relaxation);
    m->distance += h * sliding;
}

/* --- friction of the strips -------------------------------------------------------------------- */

/* Force and moment without scatter. A strip at y slides at v (1 - y/R) - (x' - y phi'); friction on
   every strip is along +x, the study's assumption. */
static void mean_load(const Run *run, const double v[3]) {
    const Rig *rig = run->rig;
    Memory *m = run->m;
    m->mean[0] = m->mean[1] = 0.0;
    for (int64_t j = 0; j < m->strips; j++) {
        double y = m->middles[j];
        double surface = rig->speed * (1.0 - rig->curvature * y);
        double mu = weakened(rig, fabs(surface - v[0] + y * v[2]));
        double force = mu * m->shares[j] * rig->normal_force;
        m->mean[0] += force;
        m->mean[1] -= force * y;
    }
}

/* The same, at the price of one strip where all of them slide alike: a rim speed of less than 1e-12
   of the sliding speed moves no digit of the force that matters here. */
static void even_load(const Run *run, const double v[3]) {
    const Rig *rig = run->rig;
    Memory *m = run->m;
    double sliding = fabs(rig->speed - v[0]);
    double rim = fabs(v[2]) * m->middles[m->strips - 1];
    if (rig->curvature != 0.0 || rim > 1e-12 * sliding) {
        mean_load(run, v);
        return;
    }
    m->mean[0] = weakened(rig, sliding) * rig->covered * rig->normal_force;
    m->mean[1] = 0.0;
}

static void friction_and_springs(
    const Run *run, double t, const double q[3], const double v[3], double load[3]
) {
    if (run->effects->on) {
        friction_load(run, t, q, v, load);
        add_spring_and_damping_load(run, q, v, load);
    } else {
        load[0] = run->m->side * run->m->mean[0];
        load[1] = run->m->side * run->m->mean[1];
        load[2] = 0.0;
    }
    if (run->rig->force_scatter > 0.0) add_scatter(run, run->rig->speed * t - q[0], load);
}

/* --- springs, and the exact step under a load that is linear in time --------------------------- */

/* Spring angles alpha = arctan(rise / length), rise = reach [sin(beta + phi) - sin beta]. A spring
   that comes from the +x side is the mirror image, which the study leaves out. */
static void turn_springs(const Run *run) {
    Memory *m = run->m;
    const Effects *e = run->effects;
    for (int i = 0; i < 4; i++) {
        double rise = run->rig->reach * (sin(m->beta[i] + m->q[2]) - sin(m->beta[i]));
        m->alpha[i] = atan2(rise, run->rig->spring_length);
        bool right = m->attachment[i][0] > 0.0;
        if (run->faults->mirrored && right) m->alpha[i] = -m->alpha[i];
        if (e->on) {
            double lean = atan2(e->anchor_offset, run->rig->spring_length);
            m->alpha[i] += e->spring_angle + (right ? lean : -lean);
        }
    }
}

/* W = M^-1 K under the present spring angles. */
static void stiffness_over_mass(const Run *run, double w[3][3]) {
    const Memory *m = run->m;
    memset(w, 0, 9 * sizeof(double));
    for (int i = 0; i < 4; i++) {
        double c = cos(m->alpha[i]), d = sin(m->alpha[i]);
        double g[3] = {c, d, d * m->attachment[i][0] - c * m->attachment[i][1]};
        for (int row = 0; row < 3; row++)
            for (int column = 0; column < 3; column++) w[row][column] += g[row] * g[column];
    }
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 3; column++) {
            w[row][column] *= run->rig->stiffness / run->rig->mass;
            if (row == 2) w[row][column] *= run->rig->mass / run->rig->inertia;
        }
}

static void multiply(double a[3][3], double b[3][3], double product[3][3]) {
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            double sum = 0.0;
            for (int n = 0; n < 3; n++) sum += a[i][n] * b[n][j];
            product[i][j] = sum;
        }
}

/* With W = M^-1 K and load accelerations a0, a1 at the ends of a step h

       q1  =    Co q0 + Si q0' + P2 a0 + P3 (a1 - a0)
       q1' = -W Si q0 + Co q0' + Si a0 + (P2/h) (a1 - a0)

   Co = sum (-W h^2)^n/(2n)!, Si = h sum (-W h^2)^n/(2n+1)!, P2 and P3 = h^2 sum (-W h^2)^n/(2n+2)!
   and /(2n+3)!: the blocks of the matrix exponential with a first-order hold. */
void propagator(double w[3][3], double h, Propagator *out) {
    double power[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, scaled[3][3], next[3][3];
    double factor = 1.0; /* 1/(2n)! */
    memset(out, 0, sizeof(*out));
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) scaled[i][j] = w[i][j] * (-h * h);
    for (int n = 0; n < TERMS; n++) {
        double even = 2.0 * n, odd = factor / (even + 1.0), then = odd / (even + 2.0);
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 3; j++) {
                out->co[i][j] += power[i][j] * factor;
                out->si[i][j] += power[i][j] * (odd * h);
                out->p2[i][j] += power[i][j] * (then * h * h);
                out->p3[i][j] += power[i][j] * (then * h * h / (even + 3.0));
            }
        factor = then;
        multiply(power, scaled, next);
        memcpy(power, next, sizeof(power));
    }
    multiply(w, out->si, out->wsi);
}

void step(
    const Propagator *p, double h, const double q[3], const double v[3], const double a0[3],
    const double a1[3], double q1[3], double v1[3]
) {
    for (int i = 0; i < 3; i++) {
        double place = 0.0, speed = 0.0;
        for (int j = 0; j < 3; j++) {
            double ramp = a1[j] - a0[j];
            place += p->co[i][j] * q[j] + p->si[i][j] * v[j] + p->p2[i][j] * a0[j]
                + p->p3[i][j] * ramp;
            speed += p->co[i][j] * v[j] - p->wsi[i][j] * q[j] + p->si[i][j] * a0[j]
                + p->p2[i][j] / h * ramp;
        }
        q1[i] = place;
        v1[i] = speed;
    }
}

static void accelerate(const Rig *rig, const double load[3], double a[3]) {
    a[0] = load[0] / rig->mass;
    a[1] = load[2] / rig->mass;
    a[2] = load[1] / rig->inertia;
}

/* --- rows and phases --------------------------------------------------------------------------- */

static void record(Memory *m, double t, int mode) {
    if (m->row_count >= m->row_limit) return;
    double *row = m->rows + 10 * m->row_count++;
    row[0] = t;
    memcpy(row + 1, m->q, sizeof(m->q));
    memcpy(row + 4, m->v, sizeof(m->v));
    memcpy(row + 7, m->load, 2 * sizeof(double));
    row[9] = mode;
}

static void end_phase(Memory *m, double begin, double end, int mode, int how, double jump) {
    double phase[5] = {begin, end, mode, how, jump};
    memcpy(m->phases + 5 * m->phase_count++, phase, sizeof(phase));
}

/* --- stick ------------------------------------------------------------------------------------- */

/* Place of a block that the surface has carried since `begin`, m. */
static double carried(const Run *run, double x0, double begin, double t) {
    if (run->effects->ripple == 0.0) return x0 + run->rig->speed * (t - begin);
    return x0 + surface_travel(run, t) - surface_travel(run, begin);
}

typedef struct {
    double share; /* of the springs that counts */
    double extra; /* of what the contact holds, over its mean, N */
    double x0, begin;
} Stick;

static bool lets_go(const Run *run, const Stick *s, double t) {
    double x = carried(run, s->x0, s->begin, t);
    double held = held_in_stick(run, t, t - s->begin, x) + s->extra;
    return s->share * load_in_stick(run, t, x) >= held;
}

/* When the load in stick reaches what the contact holds. */
static double break_away(const Run *run, const Stick *s, double until) {
    double before = s->begin, late = s->begin;
    int64_t i = 0;
    for (;; i++) {
        late = s->begin + i * STICK_STEP;
        if (lets_go(run, s, late)) break;
        if (late >= until) return until;
        before = late;
    }
    if (run->faults->on_grid || i == 0) return before;
    for (int n = 0; n < BISECTIONS; n++) {
        double middle = 0.5 * (before + late);
        if (lets_go(run, s, middle)) late = middle;
        else before = middle;
    }
    return late;
}

/* Carry the block with the surface until the springs break it away; returns the time. */
static double stick(const Run *run, double begin, double until) {
    const Rig *rig = run->rig;
    Memory *m = run->m;
    double share = run->faults->one_spring ? 0.25 : 1.0, end;
    if (run->effects->stick_springs > 0.0) share = 0.25 * run->effects->stick_springs;
    double springs = 4.0 * share * rig->stiffness, extra = 0.0, x0 = m->q[0];
    if (rig->static_scatter > 0.0) extra = rig->static_scatter * normal(m);
    if (run->effects->on) {
        Stick s = {share, extra * rig->normal_force, x0, begin};
        end = break_away(run, &s, until);
        m->recent_heat *= exp((begin - end) / run->effects->relaxation);
    } else {
        double limit = (rig->mu_s + extra) * rig->normal_force;
        double threshold = springs > 0.0 ? limit / springs : INFINITY;
        double stay = larger((threshold - x0) / rig->speed, 0.0);
        if (run->faults->on_grid && stay < INFINITY) /* the last sample before the limit */
            stay = larger(ceil(stay / STICK_STEP) - 1.0, 0.0) * STICK_STEP;
        end = begin + stay < until ? begin + stay : until;
    }
    m->v[0] = m->v[1] = m->v[2] = m->load[1] = 0.0;
    int64_t samples = (int64_t)((end - begin) / STICK_STEP);
    for (int64_t i = 0; i < samples + 2; i++) {
        double t = begin + i * STICK_STEP < end ? begin + i * STICK_STEP : end;
        m->q[0] = carried(run, x0, begin, t);
        m->v[0] = surface_speed(run, t);
        m->load[0] = springs * m->q[0];
        record(m, t, STICK);
    }
    end_phase(m, begin, end, STICK, end < until ? BROKE_AWAY : OUT_OF_TIME, 0.0);
    if (run->faults->stale) memcpy(m->v, m->before, sizeof(m->v));
    return end;
}

/* --- slip -------------------------------------------------------------------------------------- */

/* Advance to where x' meets the surface's speed within a step; the share of it. */
static double reach(const Run *run, double t, double w[3][3], const double a0[3], const double a1[3])
{
    Memory *m = run->m;
    double speed = surface_speed(run, t);
    if (m->side * (m->v[0] - speed) >= 0.0) {
        /* friction would drag the block past the surface's speed: it stays with it */
        m->q[0] += speed * STEP;
        m->v[0] = speed;
        m->v[1] = m->v[2] = 0.0;
        return 1.0;
    }
    Propagator p;
    double early = 0.0, late = 1.0, q1[3], v1[3], a[3];
    for (int n = 0; n < BISECTIONS; n++) {
        double middle = 0.5 * (early + late);
        propagator(w, middle * STEP, &p);
        for (int i = 0; i < 3; i++) a[i] = a0[i] + middle * (a1[i] - a0[i]);
        step(&p, middle * STEP, m->q, m->v, a0, a, q1, v1);
        if (m->side * (v1[0] - surface_speed(run, t + middle * STEP)) >= 0.0) late = middle;
        else early = middle;
    }
    memcpy(m->q, q1, sizeof(q1));
    memcpy(m->v, v1, sizeof(v1));
    return late;
}

/* One block of slip under constant spring angles; the time, and whether it re-stuck. Unless it goes
   `to_the_end`, the block stops where the surface's speed is reached. */
static double block(const Run *run, double begin, double until, bool to_the_end, bool *reached) {
    const Rig *rig = run->rig;
    Memory *m = run->m;
    const bool on = run->effects->on, follows = rig->strip_wise && !run->faults->lagging;
    /* only a load that depends on the state needs a look ahead to where it is taken */
    const bool ahead = on || !run->faults->white || follows;
    double w[3][3], q1[3] = {0}, v1[3] = {0}, load1[3], a0[3], a1[3], t = begin;
    Propagator p;
    stiffness_over_mass(run, w);
    propagator(w, STEP, &p);
    *reached = false;
    if (rig->strip_wise) mean_load(run, m->v);
    friction_and_springs(run, t, m->q, m->v, m->load);
    for (int i = 0; i < STEPS; i++) {
        accelerate(rig, m->load, a0);
        if (ahead) step(&p, STEP, m->q, m->v, a0, a0, q1, v1);
        if (follows) even_load(run, v1);
        friction_and_springs(run, t + STEP, q1, v1, load1);
        accelerate(rig, load1, a1);
        step(&p, STEP, m->q, m->v, a0, a1, q1, v1);
        double speed = on ? surface_speed(run, t + STEP) : rig->speed;
        if (!to_the_end && m->side * (v1[0] - speed) >= 0.0) {
            double share = reach(run, t, w, a0, a1);
            for (int n = 0; n < 3; n++) m->load[n] += share * (load1[n] - m->load[n]);
            t += share * STEP;
            record(m, t, SLIP);
            *reached = true;
            return t;
        }
        memcpy(m->q, q1, sizeof(q1));
        memcpy(m->v, v1, sizeof(v1));
        memcpy(m->load, load1, sizeof(load1));
        t = begin + (i + 1) * STEP;
        if (on) remember(run, t, v1, STEP);
        if ((i + 1) % ROW_STEPS == 0) record(m, t, SLIP);
        if (t >= until) return t;
    }
    return begin + INTERVAL;
}

/* Can friction keep the block on the surface, along x? */
static bool holds(const Run *run, double t) {
    double load = load_in_stick(run, t, run->m->q[0]);
    return fabs(load) <= held_in_stick(run, t, 0.0, run->m->q[0]);
}

/* Slide in blocks until the surface's speed is reached; returns the time. */
static double slip(const Run *run, double begin, double until) {
    const Faults *faults = run->faults;
    Memory *m = run->m;
    double t = begin;
    int how = CUT;
    memcpy(m->before, m->v, sizeof(m->v));
    m->side = 1.0;
    for (int blocks = 1;; blocks++) {
        bool reached;
        if (run->rig->updated && !faults->stale) turn_springs(run);
        t = block(run, t, until, faults->on_grid, &reached);
        if (faults->on_grid) {
            reached = m->v[0] >= surface_speed(run, t);
        } else if (reached && !holds(run, t)) {
            reached = false; /* the block slides through */
            m->side = -m->side;
        }
        if (reached) {
            how = STUCK_AGAIN;
            break;
        }
        if (run->rig->updated && faults->stale) turn_springs(run);
        /* not reached by the block that ends a slip: its own beginning is what stays */
        memcpy(m->before, m->v, sizeof(m->v));
        if (faults->cut && blocks == LONGEST_SLIP_BLOCKS) break;
        if (t >= until) {
            how = OUT_OF_TIME;
            break;
        }
    }
    end_phase(m, begin, t, SLIP, how, surface_speed(run, t) - m->v[0]);
    return t;
}

/* --- runs -------------------------------------------------------------------------------------- */

/* Stick and slip `cycles` times or until `duration` (s). */
void run(
    const Rig *rig, const Faults *faults, const Effects *effects, Memory *m, int64_t cycles,
    double duration
) {
    const Run all = {rig, faults, effects, m};
    double t = 0.0;
    m->before[0] = rig->speed;
    for (int64_t i = 0; i < cycles; i++) {
        t = stick(&all, t, duration);
        if (t < duration) t = slip(&all, t, duration);
        if (t >= duration || m->phase_count + 2 > m->phase_limit) break;
    }
}

/* Slip alone for `duration` (s), never stopped by the surface's speed. */
void slide(
    const Rig *rig, const Faults *faults, const Effects *effects, Memory *m, double duration
) {
    const Run all = {rig, faults, effects, m};
    double t = 0.0;
    bool reached;
    record(m, t, SLIP);
    while (t < duration) {
        if (rig->updated) turn_springs(&all);
        t = block(&all, t, duration, true, &reached);
    }
    end_phase(m, 0.0, t, SLIP, OUT_OF_TIME, 0.0);
}
