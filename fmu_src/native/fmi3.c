/* FMI 3.0: the life of an instance, saved states and co-simulation. */
#include <stdio.h>
#include <string.h>

#include "component.h"
#include "exchange.h"
#include "fmi3Functions.h"

static void say(const Component *component, int status, const char *category)
{
    ((fmi3LogMessageCallback)component->log)(component->environment, (fmi3Status)status, category,
                                             component->instance.message);
}

static const int RUNNING = STEPPING | AT_EVENT | CONTINUOUS;

/* --- the unit and its life --- */

const char *fmi3GetVersion(void)
{
    return "3.0";
}

/* What is wrong with how the host asks for an instance; NULL: nothing. */
static const char *wrong_request(fmi3String name, fmi3String token)
{
    if (name == NULL || name[0] == '\0') {
        return "the instance has no name";
    }
    if (token == NULL || strcmp(token, UNIT_GUID) != 0) {
        return "the instantiation token is not that of this unit, " UNIT_GUID ": "
               "modelDescription.xml and library are of different builds";
    }
    return NULL;
}

static Component *made(const char *call, const char *why, fmi3String resources,
                        fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                        bool logging)
{
    Component *component = why == NULL ? calloc(1, sizeof *component) : NULL;
    char message[MESSAGE_SIZE];
    snprintf(message, sizeof message, "%.200s: %.800s", call, why == NULL ? "no memory" : why);
    if (component != NULL && !read_resources(&component->instance, resources, false)) {
        memcpy(message, component->instance.message, sizeof message);
        free(component);
        component = NULL;
    }
    if (component == NULL) {
        if (log != NULL) {
            log(environment, fmi3Error, "logStatusError", message);
        }
        return NULL;
    }
    component->say = say;
    component->log = (void (*)(void))log;
    component->environment = environment;
    component->logs_warnings = logging;
    return component;
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String name, fmi3String token, fmi3String resources,
                                          fmi3Boolean visible, fmi3Boolean logging,
                                          fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log)
{
    (void)visible;
    const char *why = HAS_EXCHANGE ? wrong_request(name, token) : "this unit is for co-simulation";
    Component *component = made(__func__, why, resources, environment, log, logging);
    if (component != NULL) {
        set_up(&component->instance, true, false);
    }
    return component;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String name, fmi3String token, fmi3String resources,
                                         fmi3Boolean visible, fmi3Boolean logging,
                                         fmi3Boolean has_event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference required[], size_t count,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update)
{
    (void)visible, (void)required, (void)update;
    const char *why = wrong_request(name, token);
    if (why == NULL && count > 0) {
        why = "this unit has no intermediate update, and no variable can be required for it";
    }
    Component *component = made(__func__, why, resources, environment, log, logging);
    if (component != NULL) {
        set_up(&component->instance, false, has_event_mode);
        component->returns_early = has_event_mode && early_return;
    }
    return component;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String name, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
    fmi3ClockUpdateCallback update, fmi3LockPreemptionCallback lock,
    fmi3UnlockPreemptionCallback unlock)
{
    (void)name, (void)token, (void)visible, (void)update, (void)lock, (void)unlock;
    const char *why = HAS_EXCHANGE ? "this unit is for co-simulation and model exchange"
                                   : "this unit is for co-simulation";
    return made(__func__, why, resources, environment, log, logging);
}

void fmi3FreeInstance(fmi3Instance handle)
{
    free(handle);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance handle, fmi3Boolean logging, size_t count,
                               const fmi3String categories[])
{
    return set_logging(handle, __func__, logging, count, categories);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance handle, fmi3Boolean has_tolerance,
                                       fmi3Float64 tolerance, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop)
{
    ENTER(handle, INSTANTIATED)
    if (!set_experiment(&component->instance, start, has_stop, stop,
                        has_tolerance ? tolerance : 0.0)) {
        return closed(component, false);
    }
    component->instance.memory.phase = INITIALISING;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance handle)
{
    return end_initialisation(handle, __func__);
}

fmi3Status fmi3Terminate(fmi3Instance handle)
{
    return change_phase(handle, __func__, RUNNING, TERMINATED);
}

fmi3Status fmi3Reset(fmi3Instance handle)
{
    ENTER(handle, ANY_PHASE)
    const Memory *memory = &component->instance.memory;
    set_up(&component->instance, memory->exchanges, memory->has_event_mode);
    return fmi3OK;
}

/* There are no structural parameters, so there is nothing to configure. */

fmi3Status fmi3EnterConfigurationMode(fmi3Instance handle)
{
    ENTER(handle, ANY_PHASE)
    return refused(component, __func__, "this unit has no structural parameters");
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance handle)
{
    ENTER(handle, ANY_PHASE)
    return refused(component, __func__, "this unit has no structural parameters");
}

/* --- saved states --- */

fmi3Status fmi3GetFMUState(fmi3Instance handle, fmi3FMUState *state)
{
    return get_fmu_state(handle, __func__, state);
}

fmi3Status fmi3SetFMUState(fmi3Instance handle, fmi3FMUState state)
{
    return set_fmu_state(handle, __func__, state);
}

fmi3Status fmi3FreeFMUState(fmi3Instance handle, fmi3FMUState *state)
{
    return free_fmu_state(handle, __func__, state);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance handle, fmi3FMUState state, size_t *size)
{
    return get_saved_size(handle, __func__, state, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance handle, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size)
{
    return state_to_bytes(handle, __func__, state, bytes, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance handle, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState *state)
{
    return state_from_bytes(handle, __func__, bytes, size, state);
}

/* --- events --- */

fmi3Status fmi3EnterEventMode(fmi3Instance handle)
{
    ENTER(handle, STEPPING | CONTINUOUS)
    Memory *memory = &component->instance.memory;
    if (!memory->exchanges && !memory->has_event_mode) {
        return refused(component, __func__, "this instance was made without event mode");
    }
    memory->phase = AT_EVENT;
    return fmi3OK;
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance handle)
{
    ENTER(handle, INITIALISING | AT_EVENT)
    return fmi3OK; /* nothing that can be read follows from a discrete state that is to come */
}

fmi3Status fmi3UpdateDiscreteStates(fmi3Instance handle, fmi3Boolean *again,
                                    fmi3Boolean *terminate, fmi3Boolean *nominals_changed,
                                    fmi3Boolean *states_changed, fmi3Boolean *has_next,
                                    fmi3Float64 *next)
{
    ENTER(handle, AT_EVENT)
    if (again == NULL || terminate == NULL || nominals_changed == NULL || states_changed == NULL ||
        has_next == NULL || next == NULL) {
        return refused(component, __func__, "nowhere to put what it tells");
    }
    Update news;
    if (!update(&component->instance, &news)) {
        return closed(component, false);
    }
    *again = *terminate = fmi3False; /* one update decides all */
    *nominals_changed = news.nominals_changed;
    *states_changed = news.states_changed;
    *has_next = news.has_next;
    *next = news.has_next ? news.next : 0.0;
    return fmi3OK;
}

/* --- co-simulation --- */

fmi3Status fmi3EnterStepMode(fmi3Instance handle)
{
    ENTER(handle, AT_EVENT)
    if (component->instance.memory.exchanges) {
        return refused(component, __func__, "this instance is for model exchange");
    }
    component->instance.memory.phase = STEPPING;
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance handle, fmi3Float64 time, fmi3Float64 size,
                      fmi3Boolean no_way_back, fmi3Boolean *event, fmi3Boolean *terminate,
                      fmi3Boolean *early, fmi3Float64 *reached)
{
    ENTER(handle, STEPPING)
    (void)no_way_back;
    if (event == NULL || terminate == NULL || early == NULL || reached == NULL) {
        return refused(component, __func__, "nowhere to put what it tells");
    }
    const Memory *memory = &component->instance.memory;
    *event = *terminate = *early = fmi3False;
    bool done = step(&component->instance, time, size, component->returns_early ? event : NULL);
    *reached = memory->time;
    if (!done) {
        return closed(component, false);
    }
    *early = *event && *reached < time + size;
    warn_once(component);
    return fmi3OK;
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance handle, const fmi3ValueReference references[],
                                    size_t many, const fmi3Int32 orders[], fmi3Float64 values[],
                                    size_t count)
{
    ENTER(handle, STEPPING | AT_EVENT | TERMINATED)
    if (component->instance.memory.exchanges) {
        return refused(component, __func__, "this instance is for model exchange");
    }
    if (count != many || (many > 0 && (references == NULL || orders == NULL || values == NULL))) {
        return refused(component, __func__, "one reference, order and value for each derivative");
    }
    bool done = true;
    for (size_t i = 0; done && i < many; i++) {
        done = get_output_rate(&component->instance, references[i], orders[i], &values[i]);
    }
    return closed(component, done);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance handle, fmi3ValueReference clock,
                                      fmi3Float64 time)
{
    ENTER(handle, ANY_PHASE)
    (void)clock, (void)time;
    return refused(component, __func__, "this unit has no clocks");
}
