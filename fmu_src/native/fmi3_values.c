/* FMI 3.0: values of variables, and what this unit has none of.

   A variable that is an array has the reference of its first element. Behind the references of all
   elements follow those of what FMI 3 alone asks for: the time, and the event indicators. */
#include <stdio.h>
#include <string.h>

#include "component.h"
#include "exchange.h"
#include "fmi3Functions.h"

static const size_t TIME_REFERENCE = VARIABLE_COUNT, FIRST_INDICATOR = VARIABLE_COUNT + 1;

static const int RUNNING = STEPPING | AT_EVENT | CONTINUOUS;
static const int READABLE = INITIALISING | STEPPING | AT_EVENT | CONTINUOUS | TERMINATED | FAILED;
static const int SETTABLE = INSTANTIATED | INITIALISING | STEPPING | AT_EVENT | CONTINUOUS;

/* How many values a reference stands for; 0: it is no variable's, but that of an array's inside. */
static size_t elements_of(fmi3ValueReference reference)
{
    return reference < VARIABLE_COUNT ? VARIABLES[reference].elements : 1;
}

/* Are there as many values as the variables have? */
static bool fits(Component *component, const char *call, const fmi3ValueReference references[],
                 size_t many, const void *values, size_t count)
{
    char *message = component->instance.message;
    if ((many > 0 && references == NULL) || (count > 0 && values == NULL)) {
        snprintf(message, MESSAGE_SIZE, "%s: no value references, or no values", call);
        return false;
    }
    size_t needed = 0;
    for (size_t i = 0; i < many; i++) {
        if (elements_of(references[i]) == 0) {
            snprintf(message, MESSAGE_SIZE, "value reference %u: there is no such variable, it is "
                     "within an array", (unsigned)references[i]);
            return false;
        }
        needed += elements_of(references[i]);
    }
    if (needed != count) {
        snprintf(message, MESSAGE_SIZE, "%s: %zu values, the variables have %zu", call, count,
                 needed);
        return false;
    }
    return true;
}

/* Is it a variable of this type, or, of real numbers, what FMI 3 alone asks for? */
static bool is_there(Instance *instance, size_t reference, Type type)
{
    bool added = reference >= TIME_REFERENCE && reference - TIME_REFERENCE <= INDICATOR_COUNT;
    return (added && type == REAL_TYPE) || is_known(instance, reference, type);
}

/* `fits`, and all of them are of this type. */
static bool can_read(Component *component, const char *call, const fmi3ValueReference references[],
                     size_t many, const void *values, size_t count, Type type)
{
    bool can = fits(component, call, references, many, values, count);
    for (size_t i = 0; can && i < many; i++) {
        can = is_there(&component->instance, references[i], type);
    }
    return can;
}

static bool get_value(Instance *instance, size_t reference, Type type, double *value)
{
    if (reference == TIME_REFERENCE) {
        *value = instance->memory.time;
        return true;
    }
    if (reference >= FIRST_INDICATOR && reference - FIRST_INDICATOR < INDICATOR_COUNT) {
        double indicators[INDICATOR_COUNT + 1]; /* there may be none */
        bool done = look_at_indicators(instance, indicators);
        *value = done ? indicators[reference - FIRST_INDICATOR] : 0.0;
        return done;
    }
    return get_number(instance, reference, type, value);
}

static bool set_real(Instance *instance, size_t reference, double value)
{
    if (reference >= TIME_REFERENCE && reference - TIME_REFERENCE <= INDICATOR_COUNT) {
        strcpy(instance->message, reference == TIME_REFERENCE
                                      ? "time is the independent variable and cannot be set"
                                      : "an event indicator is a local variable and cannot be set");
        return false;
    }
    return set_number(instance, reference, REAL_TYPE, value);
}

static bool set_integer(Instance *instance, size_t reference, double value)
{
    return set_number(instance, reference, INTEGER_TYPE, value);
}

static bool set_boolean(Instance *instance, size_t reference, double value)
{
    return set_number(instance, reference, BOOLEAN_TYPE, value);
}

#define GET(named, asked)                                                                          \
    fmi3Status fmi3Get##named(fmi3Instance handle, const fmi3ValueReference references[],          \
                              size_t many, fmi3##named values[], size_t count)                     \
    {                                                                                              \
        ENTER(handle, READABLE)                                                                    \
        if (!can_read(component, __func__, references, many, values, count, asked)) {              \
            return unread(component);                                                             \
        }                                                                                          \
        bool done = true;                                                                          \
        for (size_t i = 0; done && i < many; i++) {                                                \
            for (size_t k = 0; done && k < elements_of(references[i]); k++) {                      \
                double value = 0.0;                                                                \
                done = get_value(&component->instance, references[i] + k, asked, &value);          \
                *values++ = (fmi3##named)value;                                                    \
            }                                                                                      \
        }                                                                                          \
        return closed(component, done);                                                           \
    }
GET(Float64, REAL_TYPE)
GET(Int32, INTEGER_TYPE)
GET(Boolean, BOOLEAN_TYPE)

#define SET(named, set)                                                                            \
    fmi3Status fmi3Set##named(fmi3Instance handle, const fmi3ValueReference references[],          \
                              size_t many, const fmi3##named values[], size_t count)               \
    {                                                                                              \
        ENTER(handle, SETTABLE)                                                                    \
        bool done = fits(component, __func__, references, many, values, count);                    \
        for (size_t i = 0; done && i < many; i++) {                                                \
            for (size_t k = 0; done && k < elements_of(references[i]); k++) {                      \
                done = set(&component->instance, references[i] + k, *values++);                    \
            }                                                                                      \
        }                                                                                          \
        return closed(component, done);                                                           \
    }
SET(Float64, set_real)
SET(Int32, set_integer)
SET(Boolean, set_boolean)

/* --- types that no variable has --- */

static fmi3Status of_no_variable(fmi3Instance handle, const char *call, size_t many, bool reads)
{
    static const char *const WHY = "all variables are of the types Float64, Int32 and Boolean";
    Component *component = entered(handle, call, reads ? READABLE : SETTABLE);
    if (component == NULL) {
        return fmi3Error;
    }
    if (many > 0 && reads) {
        snprintf(component->instance.message, MESSAGE_SIZE, "%s: %s", call, WHY);
        return unread(component);
    }
    return many == 0 ? fmi3OK : refused(component, call, WHY);
}

#define OF_NO_VARIABLE(type)                                                                       \
    fmi3Status fmi3Get##type(fmi3Instance handle, const fmi3ValueReference references[],           \
                             size_t many, fmi3##type values[], size_t count)                       \
    {                                                                                              \
        (void)references, (void)values, (void)count;                                               \
        return of_no_variable(handle, __func__, many, true);                                       \
    }                                                                                              \
    fmi3Status fmi3Set##type(fmi3Instance handle, const fmi3ValueReference references[],           \
                             size_t many, const fmi3##type values[], size_t count)                 \
    {                                                                                              \
        (void)references, (void)values, (void)count;                                               \
        return of_no_variable(handle, __func__, many, false);                                      \
    }
OF_NO_VARIABLE(Float32)
OF_NO_VARIABLE(Int8)
OF_NO_VARIABLE(UInt8)
OF_NO_VARIABLE(Int16)
OF_NO_VARIABLE(UInt16)
OF_NO_VARIABLE(UInt32)
OF_NO_VARIABLE(Int64)
OF_NO_VARIABLE(UInt64)
OF_NO_VARIABLE(String)

fmi3Status fmi3GetBinary(fmi3Instance handle, const fmi3ValueReference references[], size_t many,
                         size_t sizes[], fmi3Binary values[], size_t count)
{
    (void)references, (void)sizes, (void)values, (void)count;
    return of_no_variable(handle, __func__, many, true);
}

fmi3Status fmi3SetBinary(fmi3Instance handle, const fmi3ValueReference references[], size_t many,
                         const size_t sizes[], const fmi3Binary values[], size_t count)
{
    (void)references, (void)sizes, (void)values, (void)count;
    return of_no_variable(handle, __func__, many, false);
}

/* --- clocks --- */

static fmi3Status of_no_clock(fmi3Instance handle, const char *call, size_t many)
{
    Component *component = entered(handle, call, INSTANTIATED | INITIALISING | RUNNING);
    if (component == NULL) {
        return fmi3Error;
    }
    return many == 0 ? fmi3OK : refused(component, call, "this unit has no clocks");
}

#define CLOCKS fmi3Instance handle, const fmi3ValueReference clocks[], size_t many

fmi3Status fmi3GetClock(CLOCKS, fmi3Clock values[])
{
    (void)clocks, (void)values;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3SetClock(CLOCKS, const fmi3Clock values[])
{
    (void)clocks, (void)values;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3GetIntervalDecimal(CLOCKS, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[])
{
    (void)clocks, (void)intervals, (void)qualifiers;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3GetIntervalFraction(CLOCKS, fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                   fmi3IntervalQualifier qualifiers[])
{
    (void)clocks, (void)counters, (void)resolutions, (void)qualifiers;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3GetShiftDecimal(CLOCKS, fmi3Float64 shifts[])
{
    (void)clocks, (void)shifts;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3GetShiftFraction(CLOCKS, fmi3UInt64 counters[], fmi3UInt64 resolutions[])
{
    (void)clocks, (void)counters, (void)resolutions;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3SetIntervalDecimal(CLOCKS, const fmi3Float64 intervals[])
{
    (void)clocks, (void)intervals;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3SetIntervalFraction(CLOCKS, const fmi3UInt64 counters[],
                                   const fmi3UInt64 resolutions[])
{
    (void)clocks, (void)counters, (void)resolutions;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3SetShiftDecimal(CLOCKS, const fmi3Float64 shifts[])
{
    (void)clocks, (void)shifts;
    return of_no_clock(handle, __func__, many);
}

fmi3Status fmi3SetShiftFraction(CLOCKS, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
{
    (void)clocks, (void)counters, (void)resolutions;
    return of_no_clock(handle, __func__, many);
}

/* --- dependencies: those in modelDescription.xml hold as long as the instance lives --- */

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance handle, fmi3ValueReference reference,
                                               size_t *count)
{
    ENTER(handle, ANY_PHASE)
    (void)reference, (void)count;
    return refused(component, __func__, "see the dependencies in modelDescription.xml");
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance handle, fmi3ValueReference dependent,
                                       size_t dependent_elements[],
                                       fmi3ValueReference independents[],
                                       size_t independent_elements[], fmi3DependencyKind kinds[],
                                       size_t count)
{
    ENTER(handle, ANY_PHASE)
    (void)dependent, (void)dependent_elements, (void)independents, (void)independent_elements;
    (void)kinds, (void)count;
    return refused(component, __func__, "see the dependencies in modelDescription.xml");
}
