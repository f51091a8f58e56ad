#include "instance.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

/* A host computes its communication points in one way or another and may miss the end of the last
   step by rounding; a gap of more than this part of a step is not rounding. */
static const double GAP = 1e-6;
/* s. A step cannot be interrupted: nobody shall wait for one for more than a minute. */
static const double LONGEST_STEP = 1000.0;

bool refuse(Instance *instance, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(instance->message, sizeof instance->message, format, arguments);
    va_end(arguments);
    return false;
}

static const char *phase_name(Phase phase)
{
    switch (phase) {
    case INSTANTIATED: return "instantiated";
    case INITIALISING: return "initialising";
    case STEPPING: return "stepping";
    case TERMINATED: return "terminated";
    case AT_EVENT: return "in event mode";
    case CONTINUOUS: return "in continuous-time mode";
    default: return "failed";
    }
}

bool read_resources(Instance *instance, const char *resources, bool is_uri)
{
    return model_read(&instance->memory.model, resources, is_uri, instance->message);
}

void set_up(Instance *instance, bool exchanges, bool has_event_mode)
{
    Memory *memory = &instance->memory;
    memset(memory, 0, offsetof(Memory, model));
    memory->phase = INSTANTIATED;
    memory->exchanges = exchanges;
    memory->has_event_mode = has_event_mode;
    memory->is_stale = true;
    memory->stop = INFINITY;
    for (size_t i = 0; i < VARIABLE_COUNT; i++) {
        memory->values[i] = VARIABLES[i].start;
    }
    model_clear(&memory->model, memory->values);
}

bool is_allowed(Instance *instance, const char *call, int phases)
{
    if (instance->memory.phase & phases) {
        return true;
    }
    if (instance->memory.phase == FAILED) {
        return refuse(instance, "%s: the instance has failed before; reset it or set an earlier state",
                      call);
    }
    return refuse(instance, "%s: not allowed while the instance is %s", call,
                  phase_name(instance->memory.phase));
}

bool set_experiment(Instance *instance, double start, bool has_stop, double stop, double tolerance)
{
    Memory *memory = &instance->memory;
    if (memory->has_experiment) {
        return refuse(instance, "the experiment has been set up before");
    }
    if (!isfinite(start)) {
        return refuse(instance, "start time is %g; must be a finite number of seconds", start);
    }
    if (has_stop && !(stop >= start)) {
        return refuse(instance, "stop time is %g s; must not be before the start time, %g s", stop,
                      start);
    }
    if (!(tolerance >= 0.0 && isfinite(tolerance))) {
        return refuse(instance, "tolerance is %g; must be a finite number of at least 0", tolerance);
    }
    memory->has_experiment = true;
    memory->start = memory->time = start;
    memory->stop = has_stop ? stop : INFINITY;
    memory->tolerance = tolerance;
    memory->is_stale = true;
    return true;
}

bool refresh(Instance *instance)
{
    Memory *memory = &instance->memory;
    if (memory->has_stepped || !memory->is_stale) {
        return true;
    }
    if (!model_begin(&memory->model, memory->values, memory->tolerance, instance->message)) {
        return false;
    }
    memory->is_stale = memory->is_retuned = false;
    memory->is_outdated = true;
    if (memory->exchanges) {
        model_hand_over(&memory->model);
    }
    return true;
}

bool begin_run(Instance *instance)
{
    Memory *memory = &instance->memory;
    memory->phase = memory->exchanges || memory->has_event_mode ? AT_EVENT : STEPPING;
    bool done = refresh(instance);
    memory->has_stepped = memory->exchanges; /* from here on all follows from the host's states */
    return done;
}

bool choose_messages(Instance *instance, const char *call, size_t count,
                     const char *const categories[], bool *warnings)
{
    *warnings = count == 0;
    if (count > 0 && categories == NULL) {
        return refuse(instance, "%s: no categories", call);
    }
    for (size_t i = 0; i < count; i++) {
        if (categories[i] == NULL) {
            return refuse(instance, "%s: a category without a name", call);
        }
        bool all = strcmp(categories[i], "logAll") == 0;
        if (all || strcmp(categories[i], "logStatusWarning") == 0) {
            *warnings = true;
        } else if (strcmp(categories[i], "logStatusError") != 0) {
            return refuse(instance, "%s: the categories are logStatusError, logStatusWarning and "
                          "logAll", call);
        }
    }
    return true;
}

/* What follows from states and time: in co-simulation outputs are there since the step. */
static void show(Memory *memory, Causality causality)
{
    if (!memory->is_outdated) {
        return;
    }
    if (memory->exchanges) {
        model_show_moment(&memory->model, memory->values);
    } else if (causality == LOCAL) {
        model_show_locals(&memory->model, memory->values);
    } else {
        return;
    }
    memory->is_outdated = false;
}

/* Distance from a time to the next number, s. */
static double spacing(double time)
{
    return nextafter(fabs(time), DBL_MAX) - fabs(time);
}

static bool is_possible_step(Instance *instance, double time, double size)
{
    double last = instance->memory.time, stop = instance->memory.stop;
    if (!isfinite(time) || !isfinite(size)) {
        return refuse(instance, "step from t = %g of size %g: must be finite numbers", time, size);
    }
    if (size <= 0.0) {
        return refuse(instance, "step size is %g s; must be greater than 0", size);
    }
    if (size > LONGEST_STEP) {
        return refuse(instance, "step size is %g s; must be at most %g s, as a step cannot be "
                      "interrupted: take several", size, LONGEST_STEP);
    }
    if (fabs(time - last) > GAP * size + 4.0 * spacing(last)) {
        return refuse(instance, "step begins at t = %.15g s, the last one ended at t = %.15g s", time,
                      last);
    }
    if (time + size > stop && time + size - stop > GAP * size + 4.0 * spacing(stop)) {
        return refuse(instance, "step to t = %.15g s goes past the stop time that was set up, "
                      "%.15g s", time + size, stop);
    }
    return true;
}

bool step(Instance *instance, double time, double size, bool *event)
{
    Memory *memory = &instance->memory;
    if (!is_possible_step(instance, time, size) || !refresh(instance)) {
        return false;
    }
    if (memory->is_retuned &&
        !model_tune(&memory->model, memory->values, memory->tolerance, instance->message)) {
        return false;
    }
    memory->is_retuned = false;
    double end = time + size - memory->start;
    if (!(end > model_time(&memory->model))) {
        return refuse(instance, "step size is %g s, lost in the rounding of the time, %.15g s, and of "
                      "that since the start", size, memory->time);
    }
    if (!model_step(&memory->model, memory->values, end, event, instance->message)) {
        return false;
    }
    bool early = model_time(&memory->model) < end;
    memory->time = early ? model_time(&memory->model) + memory->start : time + size;
    memory->has_stepped = true;
    memory->is_outdated = true;
    return true;
}

bool is_known(Instance *instance, size_t reference, Type type)
{
    static const char *const NAMES[] = {"a real number", "an integer", "a Boolean"};
    if (reference >= VARIABLE_COUNT) {
        return refuse(instance, "value reference %zu: there is no such variable", reference);
    }
    if (VARIABLES[reference].type != type) {
        return refuse(instance, "%s is %s, not %s", VARIABLES[reference].name,
                      NAMES[VARIABLES[reference].type], NAMES[type]);
    }
    return true;
}

bool get_number(Instance *instance, size_t reference, Type type, double *value)
{
    if (!is_known(instance, reference, type)) {
        return false;
    }
    Causality causality = VARIABLES[reference].causality;
    if (causality == OUTPUT || causality == LOCAL) {
        if (!refresh(instance)) {
            return false;
        }
        show(&instance->memory, causality);
    }
    *value = instance->memory.values[reference];
    return true;
}

static bool is_inside(Instance *instance, const Variable *variable, double value)
{
    if (!isfinite(value)) {
        return refuse(instance, "%s = %g: must be a finite number", variable->name, value);
    }
    if (value < variable->low || value > variable->high ||
        (variable->above_low && value == variable->low)) {
        return refuse(instance, "%s = %g: must lie in %c%g, %g]", variable->name, value,
                      variable->above_low ? '(' : '[', variable->low, variable->high);
    }
    return true;
}

static bool may_be_set(Instance *instance, const Variable *variable)
{
    Phase phase = instance->memory.phase;
    if (variable->causality == OUTPUT || variable->causality == LOCAL) {
        return refuse(instance, "%s is %s and cannot be set", variable->name,
                      variable->causality == OUTPUT ? "an output" : "a local variable");
    }
    if (variable->causality == PARAMETER && !variable->is_tunable && !(phase & BEFORE_THE_RUN)) {
        return refuse(instance, "%s is fixed and cannot be set after initialisation",
                      variable->name);
    }
    if (variable->causality == PARAMETER && phase == CONTINUOUS) {
        return refuse(instance, "%s cannot be set in continuous-time mode: enter event mode",
                      variable->name);
    }
    if (variable->causality == PARAMETER && phase == STEPPING && instance->memory.has_event_mode) {
        return refuse(instance, "%s cannot be set in step mode: enter event mode", variable->name);
    }
    return true;
}

/* An input next to a bound, beyond it, is one that a host varies for a difference, or rounding: it is
   taken for the bound. By up to this part of its nominal. */
static const double SLACK = HAS_EXCHANGE ? 0.02 : 1e-6;

static double clipped(const Variable *variable, size_t reference, double value)
{
    if (variable->causality == INPUT) {
        double slack = SLACK * INPUT_NOMINALS[reference - FIRST_INPUT];
        bool below = value < variable->low && value >= variable->low - slack;
        bool above = value > variable->high && value <= variable->high + slack;
        return below ? variable->low : above ? variable->high : value;
    }
    return value;
}

bool set_number(Instance *instance, size_t reference, Type type, double value)
{
    Memory *memory = &instance->memory;
    if (!is_known(instance, reference, type)) {
        return false;
    }
    const Variable *variable = &VARIABLES[reference];
    value = clipped(variable, reference, value);
    if (!may_be_set(instance, variable) || !is_inside(instance, variable, value)) {
        return false;
    }
    if (memory->values[reference] != value) {
        bool leads = BEGINS_WITH_INPUTS || memory->phase != STEPPING;
        memory->is_stale = memory->is_stale || leads || variable->causality != INPUT;
        memory->is_outdated = true;
        memory->is_retuned = memory->is_retuned || variable->causality == PARAMETER;
    }
    memory->values[reference] = value;
#if HAS_EXCHANGE
    if (memory->exchanges && variable->causality == INPUT) {
        model_hear_input(&memory->model, memory->phase == AT_EVENT);
    }
#endif
    return true;
}

bool put_back(Instance *instance, const Memory *memory)
{
    if (memory->exchanges != instance->memory.exchanges) {
        return refuse(instance, "the state is of an instance for %s",
                      memory->exchanges ? "model exchange" : "co-simulation");
    }
    if (memory->has_event_mode != instance->memory.has_event_mode) {
        return refuse(instance, "the state is of an instance %s event mode",
                      memory->has_event_mode ? "with" : "without");
    }
    instance->memory = *memory;
    return true;
}

size_t saved_size(void)
{
    return SAVED_HEADER + sizeof(Memory);
}

bool set_rate(Instance *instance, size_t reference, int order, double rate)
{
    if (!is_known(instance, reference, REAL_TYPE)) {
        return false;
    }
    if (VARIABLES[reference].causality != INPUT) {
        return refuse(instance, "%s is no input, and takes no derivative", VARIABLES[reference].name);
    }
    if (instance->memory.exchanges) {
        return refuse(instance, "%s takes no derivative in model exchange, where it is set at each time",
                      VARIABLES[reference].name);
    }
    if (!TAKES_RATES) {
        return refuse(instance, "%s is held over a step, and takes no derivative",
                      VARIABLES[reference].name);
    }
    if (order != 1) {
        return refuse(instance, "%s: derivative of order %d; what can be used is that of order 1",
                      VARIABLES[reference].name, order);
    }
    if (!isfinite(rate)) {
        return refuse(instance, "%s: its derivative is %g; must be a finite number",
                      VARIABLES[reference].name, rate);
    }
    model_set_rate(&instance->memory.model, reference - FIRST_INPUT, rate);
    return true;
}

/* A number that any damage to the bytes changes: FNV-1a of 64 bits. */
static uint64_t checksum(const unsigned char bytes[], size_t size)
{
    uint64_t sum = 14695981039346656037u;
    for (size_t i = 0; i < size; i++) {
        sum = (sum ^ bytes[i]) * 1099511628211u;
    }
    return sum;
}

/* What the bytes of a state begin with: another build, another machine, or other bytes behind it
   have another. */
static void write_header(unsigned char header[], const unsigned char memory[])
{
    memset(header, 0, SAVED_HEADER);
    const double one = 1.0;
    memcpy(header, UNIT_GUID, sizeof UNIT_GUID);
    memcpy(header + 40, &one, sizeof one); /* how this machine lays out a number */
    const uint64_t facts[2] = {sizeof(Memory), checksum(memory, sizeof(Memory))};
    memcpy(header + 48, facts, sizeof facts);
}

void save(const Memory *memory, unsigned char bytes[])
{
    memcpy(bytes + SAVED_HEADER, memory, sizeof *memory);
    write_header(bytes, bytes + SAVED_HEADER);
}

bool load(Instance *instance, const unsigned char bytes[], size_t size, Memory *memory)
{
    unsigned char expected[SAVED_HEADER];
    bool is_ours = size == saved_size();
    if (is_ours) {
        write_header(expected, bytes + SAVED_HEADER);
        is_ours = memcmp(bytes, expected, SAVED_HEADER) == 0;
    }
    if (!is_ours) {
        return refuse(instance, "the state is damaged, or was taken from another build of this unit");
    }
    memcpy(memory, bytes + SAVED_HEADER, sizeof *memory);
    return true;
}
