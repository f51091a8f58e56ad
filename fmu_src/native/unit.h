/* What a model is to the FMI functions: a table of variables, and a few calls on plain memory.

   A model's own header, "model.h", defines `Model`: plain numbers without pointers, so that copying
   it is saving the run. Times are in seconds since the start of the experiment. Every call that can
   fail returns false and says why in one line of at most MESSAGE_SIZE characters. */
#ifndef UNIT_H
#define UNIT_H

#include <stdbool.h>
#include <stddef.h>

#include "model.h"
#include "variables.h"

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

enum { MESSAGE_SIZE = 1024 };

typedef enum { INPUT, OUTPUT, PARAMETER, LOCAL } Causality;
typedef enum { REAL_TYPE, INTEGER_TYPE, BOOLEAN_TYPE } Type;

/* A variable stands in `VARIABLES` at the place of its value reference. */
typedef struct {
    const char *name;
    Causality causality;
    Type type;
    bool is_tunable; /* a parameter that may change in the run */
    double start;
    double low, high; /* bounds, both allowed */
    bool above_low;   /* `low` itself is not allowed */
    unsigned elements; /* of the array that begins here, 1: it is none; 0: this is inside of one */
} Variable;

extern const Variable VARIABLES[VARIABLE_COUNT];
extern const double INPUT_NOMINALS[INPUT_COUNT]; /* a size of each input that counts */

/* Read what the model needs from the unit's resources, before anything else; once. Where they are: a
   URI, as FMI 2 has it, or a path, as FMI 3 has it; or NULL. */
bool model_read(Model *model, const char *resources, bool is_uri, char message[]);

/* Empty the memory, but for what was read; `values` are the starts, and may get others. */
void model_clear(Model *model, double values[]);

/* Begin a run from parameters and inputs in `values`; fills in the outputs there.
   tolerance: the host's, which can tighten the model's own and not loosen it; 0: none. */
bool model_begin(Model *model, double values[], double tolerance, char message[]);

/* Say with which rate, per second, an input goes on from its value, during the next step. */
void model_set_rate(Model *model, size_t input, double rate);

/* Go on to the time `end` with the inputs in `values`; fills in the outputs there.
   event: where to say whether an event has ended the step, then or before; NULL: none does.
   After a failure `values` are as they were, and the model is of no further use. */
bool model_step(Model *model, double values[], double end, bool *event, char message[]);

/* What a step has reached: the time, and inputs that have gone on in it, into `values`. */
double model_time(const Model *model);
void model_show_inputs(const Model *model, double values[]);

/* Take over tunable parameters that have changed in `values` in the run. */
bool model_tune(Model *model, double values[], double tolerance, char message[]);

/* Is there anything that the user should know, though it is no failure, and has not been told yet in
   this run? `told` keeps a bit for each of what there may be. Asked after each step until it is not. */
bool model_warns(const Model *model, const double values[], unsigned *told, char message[]);

/* Fills in the local variables of a run that `model_step` leads: its states and their rates. */
void model_show_locals(Model *model, double values[]);

/* --- model exchange: a host integrates the continuous states, all others follow from events --- */

/* Hand a run that `model_begin` has begun over to a host. */
void model_hand_over(Model *model);

void model_put_time(Model *model, double time);
void model_put_states(Model *model, const double states[]);
void model_take_states(const Model *model, double states[]);
void model_nominals(const Model *model, const double values[], double nominals[]);

/* Rates of the states, and event indicators, which are above 0 until their event. */
void model_rates(Model *model, const double values[], double rates[]);
void model_indicators(Model *model, const double values[], double indicators[]);

/* Fills in outputs and local variables of the moment. */
void model_show_moment(Model *model, double values[]);

/* Decide at an event what happens from here on; the states may change. */
void model_update(Model *model, const double values[]);

/* Time of the next event that is known before, or INFINITY. */
double model_next_event(const Model *model);

/* To be told of each step of the host; false where the run cannot go on. event: where to say
   whether the host is to enter event mode. */
bool model_complete_step(Model *model, const double values[], bool *event, char message[]);

/* To be told that the host has set an input, at the time that it has put. */
void model_hear_input(Model *model, bool in_event);

/* Look at an input beside the value that it has, by so much, from here on. */
void model_look_aside(Model *model, size_t input, double by);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
