/* What the functions of FMI 2.0 share: the component, and how calls are let in and answered. */
#ifndef FMI2_COMPONENT_H
#define FMI2_COMPONENT_H

#include "fmi2Functions.h"
#include "instance.h"

/* For this library alone: see instance.h. */
#if defined(__GNUC__)
#pragma GCC visibility push(hidden)
#endif

typedef struct {
    Instance instance;
    fmi2CallbackLogger log;
    fmi2ComponentEnvironment environment;
    bool logs_warnings;
    char name[];
} Component;

/* The status of a call: of one that was refused, the reason is in the instance's message. */
fmi2Status closed(Component *component, bool done);
fmi2Status refused(Component *component, const char *why);

/* The status of a call that asks for what there is not: it has changed nothing, and the run goes on
   for who goes on with it. */
fmi2Status unread(const Component *component);

/* The component, if the call is allowed in its phase; else NULL, and the call has been refused. */
Component *entered(fmi2Component handle, const char *call, int phases);

/* Tell, once in a run, what the user should know though it is no failure. */
void warn_once(Component *component);

#define ENTER(handle, phases)                                                                      \
    Component *component = entered(handle, __func__, phases);                                      \
    if (component == NULL) {                                                                       \
        return fmi2Error;                                                                          \
    }

#if defined(__GNUC__)
#pragma GCC visibility pop
#endif

#endif
