/* Model exchange, whatever the version of FMI: the host sets time and states, and is told rates and
   events. As in instance.h, each returns false for a call that is refused. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include "instance.h"

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

typedef struct {
    bool states_changed;
    bool nominals_changed;
    bool has_next; /* an event at a time that is known */
    double next;   /* that time, s */
} Update;

/* An event is over: what is new. In co-simulation it was decided in the step that it has ended. */
bool update(Instance *instance, Update *told);
bool set_time(Instance *instance, double time);
bool set_states(Instance *instance, const double states[], size_t count);
bool get_states(Instance *instance, double states[], size_t count);
bool get_nominals(Instance *instance, double nominals[], size_t count);
bool get_rates(Instance *instance, double rates[], size_t count);
bool get_indicators(Instance *instance, double indicators[], size_t count);
/* event: where to say whether the host is to enter event mode. */
bool complete_step(Instance *instance, bool *event);

/* Event indicators for who looks on, also in co-simulation. */
bool look_at_indicators(Instance *instance, double indicators[]);

/* Rate of an output at this moment. Of one that is no state it is made of differences along the
   motion, as below, with the inputs of this moment. */
bool get_output_rate(Instance *instance, size_t reference, int order, double *rate);

/* Derivative of unknown variables along a direction of known ones, states and inputs, between
   events. By central differences over a hundred-thousandth of their sizes: relative to the
   curvature over a size good to some 1e-10, and to 1e-10 of an unknown for rounding. Where a
   slip is slower than that, or a law has a corner, it is what lies on both sides. */
bool directional_derivative(Instance *instance, const unsigned unknowns[], size_t unknown_count,
                            const unsigned knowns[], size_t known_count, const double seed[],
                            double result[]);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
