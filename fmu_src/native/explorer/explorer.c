/* The kernel for a page in a browser: one run, in memory that the page reads and writes.

   As WebAssembly this is a module that imports nothing. Texts are ASCII and end with a zero. */
#include <math.h>
#include <string.h>

#include "draws.h"
#include "kernel.h"
#include "words.h"

#define CALLED(name) __attribute__((export_name(#name)))

/* Of one call of `record`; the page asks for as many rows as it has time for. */
enum { MOST_ROWS = 1024, MOST_EVENTS = 4096, TEXT = 1024 };

/* What a run comes to, as `regime_of` of the Python package names it; a page has the same order. */
enum { ENDS_EARLY, STICKS, STICKS_AND_SLIPS, SLIDES, CREEPS };

/* A contact that is said to stick, but slides at this part of the surface's speed, creeps. */
static const double FULL_SPEED = 0.9;

static double v[V_SIZE]; /* values of the parameters */
static double p[P_SIZE], u[U_SIZE], z[Z_SIZE], w[W_SIZE];
static double e[E_FIRST + E_WIDTH * MOST_EVENTS];
static double times[MOST_ROWS], o[O_SIZE * MOST_ROWS];
static char text[TEXT];

CALLED(values) double *explorer_values(void) { return v; }
CALLED(inputs) double *explorer_inputs(void) { return u; }
CALLED(times) double *explorer_times(void) { return times; }
CALLED(outputs) double *explorer_outputs(void) { return o; }
CALLED(most_rows) int explorer_most_rows(void) { return MOST_ROWS; }

/* Number of events since the last call, and E_WIDTH numbers of each. */
CALLED(events) double *explorer_events(void) { return e + E_FIRST; }
CALLED(take_events) int explorer_take_events(void)
{
    int count = (int)e[E_COUNT];
    e[E_COUNT] = 0.0;
    return count < MOST_EVENTS ? count : MOST_EVENTS;
}

/* Begin a run from `values` and `inputs` at the time 0. What contradicts in them, or "". */
CALLED(begin) const char *explorer_begin(void)
{
    double d[D_SIZE];
    text[0] = '\0';
    if (find_contradiction(v, text, TEXT)) {
        return text;
    }
    draw(d, v);
    stickslip_pack(v, d, p);
    memset(z, 0, sizeof z);
    memset(w, 0, sizeof w);
    memset(e, 0, sizeof e);
    e[E_CAPACITY] = MOST_EVENTS;
    stickslip_initialise(p, z, 0.0);
    return text;
}

/* Go on to the first so many `times`, a row of `outputs` at each; the number of rows that came. */
CALLED(record) int explorer_record(int count)
{
    return (int)stickslip_record(p, u, z, w, e, times, o, 0, count, true);
}

/* Why fewer rows came, and the time that was reached. */
CALLED(why_not) const char *explorer_why_not(void) { return WHY_NOT[(int)z[Z_STATUS]]; }
CALLED(reached) double explorer_reached(void) { return z[SHOWN + TIME]; }

/* Places of the block's attachments and of the springs' anchors, x and y of four each, m: as they
   are drawn by chance. */
CALLED(attachments) const double *explorer_attachments(void) { return p + P_ATTACH; }
CALLED(anchors) const double *explorer_anchors(void) { return p + P_ANCHOR; }

/* Friction over normal force of a contact that slides along x at a speed above 0, m/s, with its
   memory as at the start of a run; of the parameters of the last `begin`. */
CALLED(coefficient) double explorer_coefficient(double speed)
{
    double scratch[W_SIZE];
    memset(scratch, 0, sizeof scratch);
    stickslip_friction_in_slip(p, u, scratch, speed, 0.0, 0.0);
    return -scratch[W_FRICTION] / p[P_NORMAL_FORCE];
}

/* Of the events those after a time, s, alone: an internal step goes beyond where it is looked at. */
static void forget_events(double until)
{
    int count = explorer_take_events();
    for (int i = 0; i < count; i++) {
        const double *event = e + E_FIRST + E_WIDTH * i;
        if (event[0] > until) {
            memmove(e + E_FIRST + E_WIDTH * (int)e[E_COUNT], event, E_WIDTH * sizeof *event);
            e[E_COUNT] += 1.0;
        }
    }
}

/* Seconds in slip between two rows of `outputs`, at the times `begin` and `end`. */
static double time_in_slip(double begin, double end)
{
    double since = begin, mode = o[O_MODE], sum = 0.0;
    int count = explorer_take_events();
    for (int i = 0; i < count; i++) {
        const double *event = e + E_FIRST + E_WIDTH * i;
        if (event[0] > begin && event[0] < end) {
            sum += mode * (event[0] - since);
            since = event[0];
            mode = event[1];
        }
    }
    return sum + mode * (end - since);
}

/* The regime between two times, s, of a run from `values` and `inputs`. */
CALLED(regime) int explorer_regime(double begin, double end)
{
    const double *late = o + O_SIZE;
    times[0] = begin;
    times[1] = end;
    if (explorer_begin()[0] != '\0' || explorer_record(1) < 1) {
        return ENDS_EARLY;
    }
    forget_events(begin);
    if (stickslip_record(p, u, z, w, e, times, o, 1, 1, true) < 1) {
        return ENDS_EARLY;
    }
    double share = time_in_slip(begin, end) / (end - begin);
    if (share > 0.0) {
        return share < 1.0 ? STICKS_AND_SLIPS : SLIDES;
    }
    double speed = fabs(late[O_SURFACE_SPEED]);
    double slid = (late[O_DISTANCE] - o[O_DISTANCE]) / (end - begin);
    return speed > 0.0 && slid > FULL_SPEED * speed ? CREEPS : STICKS;
}
