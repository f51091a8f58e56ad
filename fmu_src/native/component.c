/* See component.h. */
#include "component.h"

#include <string.h>

static void say(const Component *component, int status, const char *category)
{
    if (component->log != NULL) {
        component->say(component, status, category);
    }
}

int closed(Component *component, bool done)
{
    if (done) {
        return STATUS_OK;
    }
    component->instance.memory.phase = FAILED;
    return unread(component);
}

int refused(Component *component, const char *call, const char *why)
{
    return closed(component, refuse(&component->instance, "%s: %s", call, why));
}

int unread(const Component *component)
{
    say(component, STATUS_ERROR, "logStatusError");
    return STATUS_ERROR;
}

Component *entered(void *handle, const char *call, int phases)
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
            say(component, STATUS_WARNING, "logStatusWarning");
        }
    }
}

/* `ENTER` of a function that is told which call of the standard it is. */
#define ENTER_CALL(phases)                                                                         \
    Component *component = entered(handle, call, phases);                                          \
    if (component == NULL) {                                                                       \
        return STATUS_ERROR;                                                                       \
    }

int set_logging(void *handle, const char *call, bool logging, size_t count,
                const char *const categories[])
{
    ENTER_CALL(ANY_PHASE)
    bool warnings;
    if (!choose_messages(&component->instance, call, count, categories, &warnings)) {
        return closed(component, false);
    }
    component->logs_warnings = logging && warnings;
    return STATUS_OK;
}

int change_phase(void *handle, const char *call, int from, Phase to)
{
    ENTER_CALL(from)
    component->instance.memory.phase = to;
    return STATUS_OK;
}

int end_initialisation(void *handle, const char *call)
{
    ENTER_CALL(INITIALISING)
    return closed(component, begin_run(&component->instance));
}

int get_fmu_state(void *handle, const char *call, void **state)
{
    ENTER_CALL(ANY_PHASE)
    if (state == NULL) {
        return refused(component, call, "nowhere to put the state");
    }
    if (*state == NULL) { /* else it is one that was made before, to be overwritten */
        *state = malloc(sizeof(Memory));
    }
    if (*state == NULL) {
        return refused(component, call, "no memory");
    }
    memcpy(*state, &component->instance.memory, sizeof(Memory));
    return STATUS_OK;
}

int set_fmu_state(void *handle, const char *call, const void *state)
{
    ENTER_CALL(ANY_PHASE)
    if (state == NULL) {
        return refused(component, call, "there is no state");
    }
    return closed(component, put_back(&component->instance, state));
}

int free_fmu_state(void *handle, const char *call, void **state)
{
    ENTER_CALL(ANY_PHASE)
    if (state != NULL) {
        free(*state);
        *state = NULL;
    }
    return STATUS_OK;
}

int get_saved_size(void *handle, const char *call, const void *state, size_t *size)
{
    ENTER_CALL(ANY_PHASE)
    if (state == NULL || size == NULL) {
        return refused(component, call, "there is no state");
    }
    *size = saved_size();
    return STATUS_OK;
}

int state_to_bytes(void *handle, const char *call, const void *state, void *bytes, size_t size)
{
    ENTER_CALL(ANY_PHASE)
    if (state == NULL || bytes == NULL) {
        return refused(component, call, "no state, or nowhere to put it");
    }
    if (size < saved_size()) {
        return refused(component, call, "there are fewer bytes than a saved state takes");
    }
    save(state, bytes);
    return STATUS_OK;
}

int state_from_bytes(void *handle, const char *call, const void *bytes, size_t size, void **state)
{
    ENTER_CALL(ANY_PHASE)
    if (bytes == NULL || state == NULL) {
        return refused(component, call, "no bytes, or nowhere to put the state");
    }
    Memory *memory = malloc(sizeof *memory);
    if (memory == NULL) {
        return refused(component, call, "no memory");
    }
    if (!load(&component->instance, bytes, size, memory)) {
        free(memory);
        return closed(component, false);
    }
    *state = memory; /* what stood there before is not looked at: it need not be a state */
    return STATUS_OK;
}
