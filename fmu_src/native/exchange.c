#include "exchange.h"

#include <math.h>
#include <string.h>

/* Is this an instance for model exchange whose model is there, and is the host's array as long as
   what is to be exchanged? */
static bool is_ready(Instance *instance, const void *numbers, size_t count, size_t expected)
{
    if (!instance->memory.exchanges) {
        return refuse(instance, "this instance is for co-simulation");
    }
    if (count != expected || (numbers == NULL && expected != 0)) {
        return refuse(instance, "%zu numbers asked for, there are %zu", count, expected);
    }
    return refresh(instance);
}

bool set_time(Instance *instance, double time)
{
    Memory *memory = &instance->memory;
    if (!isfinite(time)) {
        return refuse(instance, "the time is not a finite number");
    }
    memory->time = time;
    memory->is_outdated = true;
    model_put_time(&memory->model, time - memory->start);
    return true;
}

bool set_states(Instance *instance, const double states[], size_t count)
{
    if (!is_ready(instance, states, count, STATE_COUNT)) {
        return false;
    }
    instance->memory.is_outdated = true;
    model_put_states(&instance->memory.model, states);
    return true;
}

bool get_states(Instance *instance, double states[], size_t count)
{
    if (!is_ready(instance, states, count, STATE_COUNT)) {
        return false;
    }
    model_take_states(&instance->memory.model, states);
    return true;
}

/* Of the sizes that count. A host takes its tolerance times the nominals for the error of one step,
   of which there are some hundred to a slip, and CVODE in the mean over all states, of which most
   are at rest. With the sizes themselves it would be off by twice as much in the end; with less
   than this a slip that creeps takes it thousands of steps. */
static const double PART = 0.1;

bool get_nominals(Instance *instance, double nominals[], size_t count)
{
    if (!is_ready(instance, nominals, count, STATE_COUNT)) {
        return false;
    }
    model_nominals(&instance->memory.model, instance->memory.values, nominals);
    for (size_t i = 0; i < count; i++) {
        nominals[i] *= PART;
    }
    return true;
}

bool get_rates(Instance *instance, double rates[], size_t count)
{
    if (!is_ready(instance, rates, count, STATE_COUNT)) {
        return false;
    }
    model_rates(&instance->memory.model, instance->memory.values, rates);
    return true;
}

bool get_indicators(Instance *instance, double indicators[], size_t count)
{
    if (!is_ready(instance, indicators, count, INDICATOR_COUNT)) {
        return false;
    }
    model_indicators(&instance->memory.model, instance->memory.values, indicators);
    return true;
}

bool update(Instance *instance, Update *told)
{
    Memory *memory = &instance->memory;
    Model *model = &memory->model;
    if (!memory->exchanges) {
        *told = (Update){.has_next = false};
        return refresh(instance);
    }
    double states[2][STATE_COUNT], nominals[STATE_COUNT];
    if (memory->is_retuned && !model_tune(model, memory->values, memory->tolerance,
                                          instance->message)) {
        return false;
    }
    memory->is_retuned = false;
    model_take_states(model, states[0]);
    model_update(model, memory->values);
    model_take_states(model, states[1]);
    model_nominals(model, memory->values, nominals);
    memory->is_outdated = true;
    told->states_changed = memcmp(states[0], states[1], sizeof states[0]) != 0;
    told->nominals_changed = memcmp(memory->nominals, nominals, sizeof nominals) != 0;
    memcpy(memory->nominals, nominals, sizeof nominals);
    told->next = model_next_event(model) + memory->start;
    told->has_next = isfinite(told->next);
    return true;
}

bool complete_step(Instance *instance, bool *event)
{
    Memory *memory = &instance->memory;
    double states[STATE_COUNT];
    model_take_states(&memory->model, states);
    for (int i = 0; i < STATE_COUNT; i++) {
        if (!isfinite(states[i])) {
            return refuse(instance, "a state is not a finite number");
        }
    }
    return model_complete_step(&memory->model, memory->values, event, instance->message);
}

/* Of the sizes that count: near the cube root of the spacing of numbers, best for central differences. */
static const double DIFFERENCE = 1e-5;

/* Place of a variable among the states; -1 if it is none. */
static int state_of(unsigned reference)
{
    for (int i = 0; i < STATE_COUNT; i++) {
        if ((unsigned)STATE_REFERENCES[i] == reference) {
            return i;
        }
    }
    return -1;
}

static bool is_input(unsigned reference)
{
    return reference - FIRST_INPUT < INPUT_COUNT; /* unsigned: those before it are large */
}

/* By how much of the direction a difference goes: so that no known variable goes further than
   `DIFFERENCE` of its size; 0 for a direction of zeros, or of numbers hardly above. */
static double span_of(const Memory *memory, const unsigned knowns[], size_t count,
                      const double seed[])
{
    double nominals[STATE_COUNT], fastest = 0.0;
    model_nominals(&memory->model, memory->values, nominals);
    for (size_t i = 0; i < count; i++) {
        int state = state_of(knowns[i]);
        double size = state >= 0 ? nominals[state] : INPUT_NOMINALS[knowns[i] - FIRST_INPUT];
        fastest = fmax(fastest, fabs(seed[i]) / size);
    }
    double span = fastest == 0.0 ? 0.0 : DIFFERENCE / fastest;
    return isfinite(span) ? span : 0.0; /* of next to nothing */
}

/* All variables a span along the direction from here. */
static void look_aside(Memory *memory, const unsigned knowns[], size_t count, const double seed[],
                       double span)
{
    double states[STATE_COUNT];
    model_take_states(&memory->model, states);
    for (size_t i = 0; i < count; i++) {
        int state = state_of(knowns[i]);
        if (state >= 0) {
            states[state] += span * seed[i];
        } else {
            model_look_aside(&memory->model, knowns[i] - FIRST_INPUT, span * seed[i]);
        }
    }
    model_put_states(&memory->model, states);
    model_show_moment(&memory->model, memory->values);
}

bool directional_derivative(Instance *instance, const unsigned unknowns[], size_t unknown_count,
                            const unsigned knowns[], size_t known_count, const double seed[],
                            double result[])
{
    if (!is_ready(instance, NULL, 0, 0)) {
        return false;
    }
    if ((unknown_count > 0 && (unknowns == NULL || result == NULL)) ||
        (known_count > 0 && (knowns == NULL || seed == NULL))) {
        return refuse(instance, "directional derivatives: no value references, or no numbers");
    }
    for (size_t i = 0; i < known_count; i++) {
        if (state_of(knowns[i]) < 0 && !is_input(knowns[i])) {
            return refuse(instance, "directional derivatives are with respect to states and inputs");
        }
        if (!isfinite(seed[i])) {
            return refuse(instance, "the direction along %s is %g; must be a finite number",
                          VARIABLES[knowns[i]].name, seed[i]);
        }
    }
    for (size_t i = 0; i < unknown_count; i++) {
        if (unknowns[i] >= VARIABLE_COUNT || (VARIABLES[unknowns[i]].causality != OUTPUT &&
                                              VARIABLES[unknowns[i]].causality != LOCAL)) {
            return refuse(instance, "directional derivatives are of outputs, states and their rates");
        }
    }
    double span = span_of(&instance->memory, knowns, known_count, seed);
    Memory ahead = instance->memory, behind = instance->memory;
    look_aside(&ahead, knowns, known_count, seed, span);
    look_aside(&behind, knowns, known_count, seed, -span);
    for (size_t i = 0; i < unknown_count; i++) {
        double change = ahead.values[unknowns[i]] - behind.values[unknowns[i]];
        result[i] = span == 0.0 ? 0.0 : change / (2.0 * span);
    }
    return true;
}

/* A copy of the memory as model exchange has it, for who looks on. */
static Memory handed_over(const Memory *memory)
{
    Memory copy = *memory;
    if (!copy.exchanges) {
        model_show_inputs(&copy.model, copy.values);
        model_hand_over(&copy.model);
    }
    return copy;
}

bool look_at_indicators(Instance *instance, double indicators[])
{
    if (!refresh(instance)) {
        return false;
    }
    Memory aside = handed_over(&instance->memory);
    model_indicators(&aside.model, aside.values, indicators);
    return true;
}

/* An output a time along the motion from here, with the inputs of this moment. */
static double ahead(const Memory *memory, const double rates[], double span, size_t reference)
{
    Memory aside = *memory;
    double states[STATE_COUNT];
    model_take_states(&aside.model, states);
    for (int i = 0; i < STATE_COUNT; i++) {
        states[i] += span * rates[i];
    }
    model_put_states(&aside.model, states);
    model_put_time(&aside.model, model_time(&aside.model) + span);
    model_show_moment(&aside.model, aside.values);
    return aside.values[reference];
}

/* Rate of an output that is no state, by central differences along the motion. */
static double rate_along_motion(const Memory *memory, size_t reference)
{
    Memory here = handed_over(memory);
    double rates[STATE_COUNT], nominals[STATE_COUNT], fastest = 0.0;
    model_rates(&here.model, here.values, rates);
    model_nominals(&here.model, here.values, nominals);
    for (int i = 0; i < STATE_COUNT; i++) {
        fastest = fmax(fastest, fabs(rates[i]) / nominals[i]);
    }
    double span = fastest == 0.0 ? DIFFERENCE : DIFFERENCE / fastest;
    double change = ahead(&here, rates, span, reference) - ahead(&here, rates, -span, reference);
    return change / (2.0 * span);
}

/* Value reference of the rate of a state. */
static size_t rate_of(int state)
{
    size_t local = 0;
    while (LOCAL_SLOTS[local] != state + STATE_COUNT) {
        local++;
    }
    return FIRST_LOCAL + local;
}

bool get_output_rate(Instance *instance, size_t reference, int order, double *rate)
{
    if (reference >= VARIABLE_COUNT || VARIABLES[reference].causality != OUTPUT ||
        VARIABLES[reference].type != REAL_TYPE) {
        return refuse(instance, "output derivatives are of outputs that are real numbers");
    }
    if (order != 1) {
        return refuse(instance, "output derivatives are of order 1");
    }
    int state = state_of((unsigned)reference);
    if (state >= 0) {
        return get_number(instance, rate_of(state), REAL_TYPE, rate);
    }
    if (!refresh(instance)) {
        return false;
    }
    *rate = rate_along_motion(&instance->memory, reference);
    return true;
}
