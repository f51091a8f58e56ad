/* FMI 2.0: the functions of the standard around an instance, but those of model exchange.

   A call that is refused returns fmi2Error and says why in the log, whether or not the host has
   switched logging on; the instance has failed then, until it is reset or given an earlier state. But
   to ask for a value that there is not harms nothing: the standard has fmi2Error for it, and the
   instance goes on. */
#include <stdlib.h>
#include <string.h>

#include "fmi2Component.h"

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

static void say(const Component *component, fmi2Status status, const char *category,
                const char *text)
{
    char message[2 * MESSAGE_SIZE];
    if (component->log == NULL) {
        return;
    }
    escape(message, sizeof message, text);
    component->log(component->environment, component->name, status, category, message);
}

fmi2Status closed(Component *component, bool done)
{
    if (done) {
        return fmi2OK;
    }
    component->instance.memory.phase = FAILED;
    say(component, fmi2Error, "logStatusError", component->instance.message);
    return fmi2Error;
}

fmi2Status refused(Component *component, const char *why)
{
    strncpy(component->instance.message, why, MESSAGE_SIZE - 1);
    return closed(component, false);
}

fmi2Status unread(const Component *component)
{
    say(component, fmi2Error, "logStatusError", component->instance.message);
    return fmi2Error;
}

Component *entered(fmi2Component handle, const char *call, int phases)
{
    Component *component = handle;
    if (component == NULL || closed(component, is_allowed(&component->instance, call, phases))) {
        return NULL;
    }
    return component;
}

void warn_once(Component *component)
{
    Memory *memory = &component->instance.memory;
    while (model_warns(&memory->model, memory->values, &memory->warned,
                       component->instance.message)) {
        if (component->logs_warnings) {
            say(component, fmi2Warning, "logStatusWarning", component->instance.message);
        }
    }
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
    component->log = functions->logger;
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
    ENTER(handle, ANY_PHASE)
    bool warnings;
    if (!choose_messages(&component->instance, __func__, count, categories, &warnings)) {
        return closed(component, false);
    }
    component->logs_warnings = logging && warnings;
    return fmi2OK;
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
    ENTER(handle, INSTANTIATED)
    component->instance.memory.phase = INITIALISING;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component handle)
{
    ENTER(handle, INITIALISING)
    return closed(component, begin_run(&component->instance));
}

fmi2Status fmi2Terminate(fmi2Component handle)
{
    ENTER(handle, RUNNING)
    component->instance.memory.phase = TERMINATED;
    return fmi2OK;
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
    strcpy(component->instance.message, call);
    strcat(component->instance.message, ": no value references, or no values");
    return false;
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
    return count == 0 ? fmi2OK : refused(component, "fmi2SetString: no variable is a text");
}

/* --- saved states --- */

fmi2Status fmi2GetFMUstate(fmi2Component handle, fmi2FMUstate *state)
{
    ENTER(handle, ANY_PHASE)
    if (state == NULL) {
        return refused(component, "fmi2GetFMUstate: nowhere to put the state");
    }
    if (*state == NULL) { /* else it is one that was made before, to be overwritten */
        *state = malloc(sizeof(Memory));
    }
    if (*state == NULL) {
        return refused(component, "fmi2GetFMUstate: no memory");
    }
    memcpy(*state, &component->instance.memory, sizeof(Memory));
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component handle, fmi2FMUstate state)
{
    ENTER(handle, ANY_PHASE)
    if (state == NULL) {
        return refused(component, "fmi2SetFMUstate: there is no state");
    }
    return closed(component, put_back(&component->instance, state));
}

fmi2Status fmi2FreeFMUstate(fmi2Component handle, fmi2FMUstate *state)
{
    ENTER(handle, ANY_PHASE)
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component handle, fmi2FMUstate state, size_t *size)
{
    ENTER(handle, ANY_PHASE)
    if (state == NULL || size == NULL) {
        return refused(component, "fmi2SerializedFMUstateSize: there is no state");
    }
    *size = saved_size();
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component handle, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size)
{
    ENTER(handle, ANY_PHASE)
    if (state == NULL || bytes == NULL) {
        return refused(component, "fmi2SerializeFMUstate: no state, or nowhere to put it");
    }
    if (size < saved_size()) {
        return refused(component, "fmi2SerializeFMUstate: there are fewer bytes than "
                                  "fmi2SerializedFMUstateSize asks for");
    }
    save(state, (unsigned char *)bytes);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component handle, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate *state)
{
    ENTER(handle, ANY_PHASE)
    if (bytes == NULL || state == NULL) {
        return refused(component, "fmi2DeSerializeFMUstate: no bytes, or nowhere to put the state");
    }
    Memory *memory = malloc(sizeof *memory);
    if (memory == NULL) {
        return refused(component, "fmi2DeSerializeFMUstate: no memory");
    }
    if (!load(&component->instance, (const unsigned char *)bytes, size, memory)) {
        free(memory);
        return closed(component, false);
    }
    *state = memory; /* what stood there before is not looked at: it need not be a state */
    return fmi2OK;
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
    return refused(component, "fmi2CancelStep: no step is under way; they end before they return");
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
