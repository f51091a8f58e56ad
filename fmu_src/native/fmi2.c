/* FMI 2.0: the functions of the standard around an instance, but those of model exchange. */
#include <string.h>

#include "component.h"
#include "fmi2Functions.h"

/* The logger takes a printf format. */
static void escape(char out[], size_t size, const char *text)
{
    size_t at = 0;
    for (; *text != '\0' && at + 2 < size; text++) {
        if (*text == '%') {
            out[at++] = '%';
        }
        out[at++] = *text;
    }
    out[at] = '\0';
}

static void say(const Component *component, int status, const char *category)
{
    char message[2 * MESSAGE_SIZE];
    escape(message, sizeof message, component->instance.message);
    ((fmi2CallbackLogger)component->log)(component->environment, component->name,
                                         (fmi2Status)status, category, message);
}

static const int RUNNING = STEPPING | AT_EVENT | CONTINUOUS;
static const int READABLE = INITIALISING | RUNNING | TERMINATED | FAILED;
static const int SETTABLE = INSTANTIATED | INITIALISING | RUNNING;

/* --- the unit and its life --- */

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}

/* The reason, which has no % in it, stands in the format: not every host can read what follows. */
static void refuse_instance(const fmi2CallbackFunctions *functions, fmi2String name, const char *why)
{
    if (functions != NULL && functions->logger != NULL) {
        functions->logger(functions->componentEnvironment, name, fmi2Error, "logStatusError", why);
    }
}

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    (void)visible;
    const char *why = NULL;
    if (name == NULL || name[0] == '\0') {
        name = "";
        why = "fmi2Instantiate: the instance has no name";
    } else if (functions == NULL || functions->logger == NULL) {
        return NULL;
    } else if (type != fmi2CoSimulation && (type != fmi2ModelExchange || !HAS_EXCHANGE)) {
        why = HAS_EXCHANGE ? "fmi2Instantiate: this unit is for co-simulation and model exchange"
                           : "fmi2Instantiate: this unit is for co-simulation";
    } else if (guid == NULL || strcmp(guid, UNIT_GUID) != 0) {
        why = "fmi2Instantiate: the GUID is not that of this unit, " UNIT_GUID ": "
              "modelDescription.xml and library are of different builds";
    }
    Component *component = NULL;
    if (why == NULL) {
        component = calloc(1, sizeof *component + strlen(name) + 1);
        why = component == NULL ? "fmi2Instantiate: no memory" : NULL;
    }
    char escaped[2 * MESSAGE_SIZE];
    if (why == NULL && !read_resources(&component->instance, resources, true)) {
        escape(escaped, sizeof escaped, component->instance.message);
        why = escaped;
        free(component);
    }
    if (why != NULL) {
        refuse_instance(functions, name, why);
        return NULL;
    }
    strcpy(component->name, name);
    component->say = say;
    component->log = (void (*)(void))functions->logger;
    component->environment = functions->componentEnvironment;
    component->logs_warnings = logging;
    set_up(&component->instance, type == fmi2ModelExchange, false);
    return component;
}

void fmi2FreeInstance(fmi2Component handle)
{
    free(handle);
}

fmi2Status fmi2SetDebugLogging(fmi2Component handle, fmi2Boolean logging, size_t count,
                               const fmi2String categories[])
{
    return set_logging(handle, __func__, logging, count, categories);
}

fmi2Status fmi2SetupExperiment(fmi2Component handle, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    ENTER(handle, INSTANTIATED)
    return closed(component, set_experiment(&component->instance, start, has_stop, stop,
                                            has_tolerance ? tolerance : 0.0));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component handle)
{
    return change_phase(handle, __func__, INSTANTIATED, INITIALISING);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component handle)
{
    return end_initialisation(handle, __func__);
}

fmi2Status fmi2Terminate(fmi2Component handle)
{
    return change_phase(handle, __func__, RUNNING, TERMINATED);
}

fmi2Status fmi2Reset(fmi2Component handle)
{
    ENTER(handle, ANY_PHASE)
    set_up(&component->instance, component->instance.memory.exchanges, false);
    return fmi2OK;
}

/* --- values --- */

static bool has_room(Component *component, const char *call, size_t count, const void *references,
                     const void *values)
{
    if (count == 0 || (references != NULL && values != NULL)) {
        return true;
    }
    return refuse(&component->instance, "%s: no value references, or no values", call);
}

/* References are unique: some hosts read all variables by fmi2GetReal. */
static Type type_read(fmi2ValueReference reference, Type type)
{
    bool as_it_is = type == REAL_TYPE && reference < VARIABLE_COUNT;
    return as_it_is ? VARIABLES[reference].type : type;
}

/* Are there values of this type at all references, and room for them? */
static bool can_read(Component *component, const char *call, const fmi2ValueReference references[],
                     size_t count, const void *values, Type type)
{
    bool can = has_room(component, call, count, references, values);
    for (size_t i = 0; can && i < count; i++) {
        can = is_known(&component->instance, references[i], type_read(references[i], type));
    }
    return can;
}

#define GET(function, value, asked)                                                                \
    fmi2Status function(fmi2Component handle, const fmi2ValueReference references[], size_t count, \
                        value values[])                                                            \
    {                                                                                              \
        ENTER(handle, READABLE)                                                                    \
        if (!can_read(component, __func__, references, count, values, asked)) {                    \
            return unread(component);                                                              \
        }                                                                                          \
        bool done = true;                                                                          \
        for (size_t i = 0; done && i < count; i++) {                                               \
            double found = 0.0;                                                                    \
            done = get_number(&component->instance, references[i],                                 \
                              type_read(references[i], asked), &found);                            \
            values[i] = (value)found;                                                              \
        }                                                                                          \
        return closed(component, done);                                                            \
    }
GET(fmi2GetReal, fmi2Real, REAL_TYPE)
GET(fmi2GetInteger, fmi2Integer, INTEGER_TYPE)
GET(fmi2GetBoolean, fmi2Boolean, BOOLEAN_TYPE)

#define SET(function, value, asked)                                                                \
    fmi2Status function(fmi2Component handle, const fmi2ValueReference references[], size_t count, \
                        const value values[])                                                      \
    {                                                                                              \
        ENTER(handle, SETTABLE)                                                                    \
        bool done = has_room(component, __func__, count, references, values);                      \
        for (size_t i = 0; done && i < count; i++) {                                               \
            done = set_number(&component->instance, references[i], asked, values[i]);              \
        }                                                                                          \
        return closed(component, done);                                                            \
    }
SET(fmi2SetReal, fmi2Real, REAL_TYPE)
SET(fmi2SetInteger, fmi2Integer, INTEGER_TYPE)
SET(fmi2SetBoolean, fmi2Boolean, BOOLEAN_TYPE)

/* No variable is a text. */

fmi2Status fmi2GetString(fmi2Component handle, const fmi2ValueReference references[], size_t count,
                         fmi2String values[])
{
    ENTER(handle, READABLE)
    (void)references, (void)values;
    strcpy(component->instance.message, "fmi2GetString: no variable is a text");
    return count == 0 ? fmi2OK : unread(component);
}

fmi2Status fmi2SetString(fmi2Component handle, const fmi2ValueReference references[], size_t count,
                         const fmi2String values[])
{
    ENTER(handle, SETTABLE)
    (void)references, (void)values;
    return count == 0 ? fmi2OK : refused(component, __func__, "no variable is a text");
}

/* --- saved states --- */

fmi2Status fmi2GetFMUstate(fmi2Component handle, fmi2FMUstate *state)
{
    return get_fmu_state(handle, __func__, state);
}

fmi2Status fmi2SetFMUstate(fmi2Component handle, fmi2FMUstate state)
{
    return set_fmu_state(handle, __func__, state);
}

fmi2Status fmi2FreeFMUstate(fmi2Component handle, fmi2FMUstate *state)
{
    return free_fmu_state(handle, __func__, state);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component handle, fmi2FMUstate state, size_t *size)
{
    return get_saved_size(handle, __func__, state, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component handle, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size)
{
    return state_to_bytes(handle, __func__, state, bytes, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component handle, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    return state_from_bytes(handle, __func__, bytes, size, state);
}

/* --- co-simulation --- */

fmi2Status fmi2DoStep(fmi2Component handle, fmi2Real time, fmi2Real size, fmi2Boolean no_way_back)
{
    ENTER(handle, STEPPING)
    (void)no_way_back;
    if (!step(&component->instance, time, size, NULL)) {
        return closed(component, false);
    }
    warn_once(component);
    return fmi2OK;
}

fmi2Status fmi2CancelStep(fmi2Component handle)
{
    ENTER(handle, ANY_PHASE)
    return refused(component, __func__, "no step is under way; they end before they return");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component handle, const fmi2ValueReference references[],
                                       size_t count, const fmi2Integer order[],
                                       const fmi2Real values[])
{
    ENTER(handle, SETTABLE)
    bool done = has_room(component, __func__, count, references, values) &&
                has_room(component, __func__, count, order, values);
    for (size_t i = 0; done && i < count; i++) {
        done = set_rate(&component->instance, references[i], order[i], values[i]);
    }
    return closed(component, done);
}

/* Steps are never pending: what there is to be asked of one is known. */

fmi2Status fmi2GetStatus(fmi2Component handle, const fmi2StatusKind kind, fmi2Status *value)
{
    (void)kind, (void)value;
    return handle == NULL ? fmi2Error : fmi2Discard;
}

fmi2Status fmi2GetRealStatus(fmi2Component handle, const fmi2StatusKind kind, fmi2Real *value)
{
    Component *component = handle;
    if (component == NULL) {
        return fmi2Error;
    }
    if (kind != fmi2LastSuccessfulTime || value == NULL) {
        return fmi2Discard;
    }
    *value = component->instance.memory.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component handle, const fmi2StatusKind kind, fmi2Integer *value)
{
    (void)kind, (void)value;
    return handle == NULL ? fmi2Error : fmi2Discard;
}

fmi2Status fmi2GetBooleanStatus(fmi2Component handle, const fmi2StatusKind kind, fmi2Boolean *value)
{
    if (handle == NULL) {
        return fmi2Error;
    }
    if (kind != fmi2Terminated || value == NULL) {
        return fmi2Discard;
    }
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component handle, const fmi2StatusKind kind, fmi2String *value)
{
    (void)kind, (void)value;
    return handle == NULL ? fmi2Error : fmi2Discard;
}
