/* An instance of the unit, whatever the version of FMI: what it remembers, in which phase it is,
   and what it refuses. */
#ifndef INSTANCE_H
#define INSTANCE_H

#include "unit.h"

/* For this library alone, however it is compiled: a name that another library of the process has
   too, as the C library of Linux has `step`, would be bound to that one. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

typedef enum {
    INSTANTIATED = 1,
    INITIALISING = 2,
    STEPPING = 4,
    TERMINATED = 8,
    FAILED = 16, /* until a reset, or until a state from before is set */
    AT_EVENT = 32,
    CONTINUOUS = 64 /* of model exchange */
} Phase;

enum { ANY_PHASE = 127, BEFORE_THE_RUN = INSTANTIATED | INITIALISING };

/* Everything that a run remembers, plain numbers without pointers: copying it is saving the run. */
typedef struct {
    Phase phase;
    bool exchanges;      /* model exchange; else co-simulation */
    bool has_event_mode; /* co-simulation whose host takes part in events */
    bool has_experiment; /* start time and tolerance have been set */
    bool has_stepped;    /* before the first step all follows from parameters and inputs */
    bool is_stale;       /* the model is to be begun again, from other parameters or inputs */
    bool is_retuned;     /* tunable parameters have changed since the last step */
    bool is_outdated;    /* what follows from states and time is not yet in `values` */
    unsigned warned; /* what the user has been told of, see model_warns */
    double start; /* time at which the experiment begins, s */
    double stop;  /* time past which no step may go, s; infinite: any */
    double time;  /* of the last communication point, s */
    double tolerance;
    double values[VARIABLE_COUNT];
    double nominals[STATE_COUNT + 1]; /* that a host of model exchange was told of last */
    Model model;
} Memory;

typedef struct {
    Memory memory;
    char message[MESSAGE_SIZE]; /* why the last call was refused */
} Instance;

/* A saved state as bytes: `SAVED_HEADER` bytes that tell what they belong to, then the memory. */
enum { SAVED_HEADER = 64 };

/* Each of these returns false for a call that is refused, with the reason in `message`. */

bool refuse(Instance *instance, const char *format, ...); /* as printf; false */
bool read_resources(Instance *instance, const char *resources, bool is_uri); /* first of all, once */
void set_up(Instance *instance, bool exchanges, bool has_event_mode);
bool is_allowed(Instance *instance, const char *call, int phases);
bool set_experiment(Instance *instance, double start, bool has_stop, double stop, double tolerance);
bool begin_run(Instance *instance); /* end of the initialisation */

/* event: where to say whether the step has ended in an event, at its end or before; NULL: it takes
   events as they come. */
bool step(Instance *instance, double time, double size, bool *event);

/* Of the categories of messages, those that errors do not belong to: whether the host wants them. */
bool choose_messages(Instance *instance, const char *call, size_t count,
                     const char *const categories[], bool *warnings);

/* Whether there is such a variable, of this type. */
bool is_known(Instance *instance, size_t reference, Type type);
bool get_number(Instance *instance, size_t reference, Type type, double *value);
bool set_number(Instance *instance, size_t reference, Type type, double value);

bool set_rate(Instance *instance, size_t reference, int order, double rate);

/* A state that was saved before, of an instance of the same interface. */
bool put_back(Instance *instance, const Memory *memory);

/* Outputs follow from parameters and inputs as long as no step has been made: call before any is
   read. */
bool refresh(Instance *instance);

size_t saved_size(void);
void save(const Memory *memory, unsigned char bytes[]);
bool load(Instance *instance, const unsigned char bytes[], size_t size, Memory *memory);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
