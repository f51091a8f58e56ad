/* What the functions of FMI 2.0 and of FMI 3.0 share: the component that a host holds, how calls are
   let in and answered, and saved states.

   A call that is refused returns an error and says why in the log, whether or not the host has
   switched logging on; the instance has failed then, until it is reset or given an earlier state. But
   to ask for a value that there is not harms nothing: the standards have an error for it, and the
   instance goes on. */
#ifndef COMPONENT_H
#define COMPONENT_H

#include <stdlib.h>

#include "instance.h"

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

/* Statuses of calls, which both versions number alike. */
#define STATUS_OK 0
#define STATUS_WARNING 1
#define STATUS_ERROR 3

typedef struct Component Component;

struct Component {
    Instance instance;
    void (*say)(const Component *component, int status, const char *category); /* its message */
    void (*log)(void); /* the host's logger, as its version of FMI has it; NULL: none */
    void *environment; /* that the logger is given */
    bool logs_warnings;
    bool returns_early; /* the host lets a step end at an event: FMI 3.0 */
    char name[];        /* that the logger is given: FMI 2.0 */
};

/* The status of a call: of one that was refused, the reason is in the instance's message. */
int closed(Component *component, bool done);
int refused(Component *component, const char *call, const char *why);

/* The status of a call that asks for what there is not: it has changed nothing, and the run goes on
   for who goes on with it. */
int unread(const Component *component);

/* The component, if the call is allowed in its phase; else NULL, and the call has been refused. */
Component *entered(void *handle, const char *call, int phases);

#define ENTER(handle, phases)                                                                      \
    Component *component = entered(handle, __func__, phases);                                      \
    if (component == NULL) {                                                                       \
        return STATUS_ERROR;                                                                       \
    }

/* Tell, once in a run, what the user should know though it is no failure. */
void warn_once(Component *component);

/* Whole functions of the standards, by their names. */

int set_logging(void *handle, const char *call, bool logging, size_t count,
                const char *const categories[]);
int change_phase(void *handle, const char *call, int from, Phase to);
int end_initialisation(void *handle, const char *call);
int get_fmu_state(void *handle, const char *call, void **state);
int set_fmu_state(void *handle, const char *call, const void *state);
int free_fmu_state(void *handle, const char *call, void **state);
int get_saved_size(void *handle, const char *call, const void *state, size_t *size);
int state_to_bytes(void *handle, const char *call, const void *state, void *bytes, size_t size);
int state_from_bytes(void *handle, const char *call, const void *bytes, size_t size, void **state);

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
