/* A host for model exchange in plain C, FMI 2.0 or 3.0 (-DFMI=2, -DFMI=3): it integrates the unit's
   states under a surface whose speed it raises evenly, by the classical Runge-Kutta scheme, and finds
   events by halving the step.

       exchange_host LIBRARY TOKEN STATES INDICATORS STEP STOP RATE SPEED SHOWN ...
                     [--set REFERENCE=VALUE ...]

   SPEED: value reference of the speed, which is RATE times the time. Prints the values at the SHOWN
   references at the end (34i: a whole number), as C's exact hexadecimal, and how many events there
   were. */
#define _POSIX_C_SOURCE 200809L
#include <dlfcn.h>
#include <math.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#if FMI == 2
#include "fmi2FunctionTypes.h"
#define NAMED(name) fmi2##name
#else
#include "fmi3FunctionTypes.h"
#define NAMED(name) fmi3##name
#endif

enum { MOST = 64, HALVINGS = 60 };
typedef NAMED(ValueReference) Reference;

static void *library, *unit;
static size_t states, indicators;
static double rate;
static Reference speed;

static void *function(const char *name)
{
    char full[64];
    snprintf(full, sizeof full, "fmi%d%s", FMI, name);
    void *found = dlsym(library, full);
    if (found == NULL) {
        fprintf(stderr, "%s is missing\n", full);
        exit(1);
    }
    return found;
}

/* Call a function of the unit by its name; any status but OK ends the host. */
#define CALL(name, ...)                                                                            \
    do {                                                                                           \
        NAMED(name##TYPE) *called;                                                                 \
        *(void **)&called = function(#name);                                                       \
        if (called(unit, ##__VA_ARGS__) != 0) {                                                    \
            fprintf(stderr, "%s has failed\n", #name);                                             \
            exit(1);                                                                               \
        }                                                                                          \
    } while (0)

static void set_real(Reference reference, double value)
{
#if FMI == 2
    CALL(SetReal, &reference, 1, &value);
#else
    CALL(SetFloat64, &reference, 1, &value, 1);
#endif
}

static double get_real(Reference reference)
{
    double value;
#if FMI == 2
    CALL(GetReal, &reference, 1, &value);
#else
    CALL(GetFloat64, &reference, 1, &value, 1);
#endif
    return value;
}

/* Of a reference as text, with an i behind it where it is a whole number. */
static double value_of(const char *text)
{
    Reference reference = (Reference)strtoul(text, NULL, 10);
#if FMI == 3
    if (strchr(text, 'i') != NULL) {
        fmi3Int32 whole;
        CALL(GetInt32, &reference, 1, &whole, 1);
        return whole;
    }
#endif
    return get_real(reference);
}

static void put(double time, const double x[])
{
    CALL(SetTime, time);
    set_real(speed, rate * time);
    CALL(SetContinuousStates, x, states);
}

static void slopes(double time, const double x[], double dx[])
{
    put(time, x);
#if FMI == 2
    CALL(GetDerivatives, dx, states);
#else
    CALL(GetContinuousStateDerivatives, dx, states);
#endif
}

/* From x at a time over h, into `end`. */
static void integrate(double time, const double x[], double h, double end[])
{
    static const double PARTS[4] = {0.0, 0.5, 0.5, 1.0}, WEIGHTS[4] = {1.0, 2.0, 2.0, 1.0};
    double k[MOST] = {0.0}, sum[MOST] = {0.0}, at[MOST];
    for (int stage = 0; stage < 4; stage++) {
        for (size_t i = 0; i < states; i++) {
            at[i] = x[i] + PARTS[stage] * h * k[i];
        }
        slopes(time + PARTS[stage] * h, at, k);
        for (size_t i = 0; i < states; i++) {
            sum[i] += WEIGHTS[stage] * k[i];
        }
    }
    for (size_t i = 0; i < states; i++) {
        end[i] = x[i] + h / 6.0 * sum[i];
    }
    put(time + h, end);
}

/* Whether an indicator that was above 0 is not any more. */
static bool has_event(const double before[])
{
    double now[MOST];
    CALL(GetEventIndicators, now, indicators);
    for (size_t i = 0; i < indicators; i++) {
        if (before[i] > 0.0 && now[i] <= 0.0) {
            return true;
        }
    }
    return false;
}

static void update(double x[], double z[])
{
#if FMI == 2
    fmi2EventInfo told;
    CALL(NewDiscreteStates, &told);
#else
    bool told[5];
    double next;
    CALL(UpdateDiscreteStates, &told[0], &told[1], &told[2], &told[3], &told[4], &next);
#endif
    CALL(EnterContinuousTimeMode);
    CALL(GetContinuousStates, x, states);
    CALL(GetEventIndicators, z, indicators);
}

#if FMI == 2
static void say(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                fmi2String category, fmi2String text, ...)
{
    (void)environment, (void)name, (void)category;
    fprintf(stderr, "status %d: %s\n", status, text);
}

static void begin(const char *token)
{
    static fmi2CallbackFunctions callbacks = {say, calloc, free, NULL, NULL};
    fmi2InstantiateTYPE *make;
    *(void **)&make = function("Instantiate");
    unit = make("block", fmi2ModelExchange, token, "", &callbacks, fmi2False, fmi2False);
}

static void initialise(void)
{
    CALL(SetupExperiment, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    CALL(EnterInitializationMode);
    CALL(ExitInitializationMode);
}
#else
static void say(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                fmi3String text)
{
    (void)environment, (void)category;
    fprintf(stderr, "status %d: %s\n", status, text);
}

static void begin(const char *token)
{
    fmi3InstantiateModelExchangeTYPE *make;
    *(void **)&make = function("InstantiateModelExchange");
    unit = make("block", token, "", false, false, NULL, say);
}

static void initialise(void)
{
    CALL(EnterInitializationMode, false, 0.0, 0.0, false, 0.0);
    CALL(ExitInitializationMode);
}
#endif

int main(int count, char **given)
{
    library = dlopen(given[1], RTLD_NOW | RTLD_LOCAL);
    if (library == NULL) {
        fprintf(stderr, "%s\n", dlerror());
        return 1;
    }
    states = strtoul(given[3], NULL, 10), indicators = strtoul(given[4], NULL, 10);
    double h = atof(given[5]), stop = atof(given[6]), x[MOST], end[MOST], z[MOST];
    rate = atof(given[7]), speed = (Reference)strtoul(given[8], NULL, 10);
    begin(given[2]);
    if (unit == NULL) {
        return 1;
    }
    int last = 9;
    while (last < count && strcmp(given[last], "--set") != 0) {
        last++;
    }
    for (int i = last + 1; i < count; i++) {
        set_real((Reference)strtoul(given[i], NULL, 10), atof(strchr(given[i], '=') + 1));
    }
    set_real(speed, 0.0);
    initialise();
    update(x, z);
    long events = 0;
    double time = 0.0;
    for (long n = 0; n < lround(stop / h);) {
        double goal = (double)(n + 1) * h, size = goal - time;
        integrate(time, x, size, end);
        bool found = has_event(z);
        if (found) { /* the earliest end of the step at which there is one */
            double low = 0.0;
            for (int i = 0; i < HALVINGS && size - low > 1e-13; i++) {
                double middle = 0.5 * (low + size);
                integrate(time, x, middle, end);
                *(has_event(z) ? &size : &low) = middle;
            }
            integrate(time, x, size, end);
        }
        bool whole = time + size >= goal - 1e-14;
        time = whole ? goal : time + size;
        n += whole;
        memcpy(x, end, states * sizeof *x);
#if FMI == 2
        fmi2Boolean wanted, over;
        CALL(CompletedIntegratorStep, fmi2True, &wanted, &over);
#else
        fmi3Boolean wanted, over;
        CALL(CompletedIntegratorStep, true, &wanted, &over);
#endif
        if (found || wanted) {
            events++;
            CALL(EnterEventMode);
            update(x, z);
        } else {
            CALL(GetEventIndicators, z, indicators);
        }
    }
    for (int i = 9; i < last; i++) {
        printf("%a\n", value_of(given[i]));
    }
    printf("%ld\n", events);
    CALL(Terminate);
    NAMED(FreeInstanceTYPE) *release;
    *(void **)&release = function("FreeInstance");
    release(unit);
    dlclose(library);
    return 0;
}
