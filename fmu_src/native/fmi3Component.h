/* What the functions of FMI 3.0 share: the component, and how calls are let in and answered.

   The names differ from those of FMI 2.0, as one library has both. */
#ifndef FMI3_COMPONENT_H
#define FMI3_COMPONENT_H

#include "fmi3Functions.h"
#include "instance.h"

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

typedef struct {
    Instance instance;
    fmi3LogMessageCallback log;
    fmi3InstanceEnvironment environment;
    bool logs_warnings;
    bool returns_early; /* the host lets a step end at an event */
} Component3;

/* The status of a call: of one that was refused, the reason is in the instance's message. */
fmi3Status closed3(Component3 *component, bool done);
fmi3Status unread3(const Component3 *component);
fmi3Status refused3(Component3 *component, const char *call, const char *why);

/* The component, if the call is allowed in its phase; else NULL, and the call has been refused. */
Component3 *entered3(fmi3Instance handle, const char *call, int phases);

/* Tell, once in a run, what the user should know though it is no failure. */
void warn_once3(Component3 *component);

#define ENTER(handle, phases)                                                                      \
    Component3 *component = entered3(handle, __func__, phases);                                    \
    if (component == NULL) {                                                                       \
        return fmi3Error;                                                                          \
    }

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
