/* One of two coupled oscillators, solved exactly for an input that is held or runs straight:
   x'' = -w^2 x + k u, with w^2 = 20 pi^2 and k = 16 pi^2. The least that a unit of a coupled pair can
   be, so that what a step costs is the master's. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "fmi2Functions.h"

#define PI2 9.86960440108935861883
enum { OTHER, X, V, SLOPE, COUNT };

typedef struct {
    double value[COUNT];
    double size, sine, cosine; /* of the last step's size */
} Unit;

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    (void)name, (void)type, (void)resources, (void)functions, (void)visible, (void)logging;
    Unit *unit = calloc(1, sizeof *unit);
    unit->value[X] = strcmp(guid, "first") == 0 ? 1.0 : 0.0;
    return unit;
}

void fmi2FreeInstance(fmi2Component unit)
{
    free(unit);
}

fmi2Status fmi2SetupExperiment(fmi2Component unit, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    (void)unit, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component unit) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component unit) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component unit) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component unit) { return fmi2OK; }

fmi2Status fmi2SetDebugLogging(fmi2Component unit, fmi2Boolean on, size_t count,
                               const fmi2String categories[])
{
    (void)unit, (void)on, (void)count, (void)categories;
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component handle, const fmi2ValueReference references[], size_t count,
                       fmi2Real values[])
{
    const Unit *unit = handle;
    for (size_t i = 0; i < count; i++) {
        values[i] = unit->value[references[i]];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component handle, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    Unit *unit = handle;
    for (size_t i = 0; i < count; i++) {
        unit->value[references[i]] = values[i];
    }
    return fmi2OK;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component handle, const fmi2ValueReference references[],
                                       size_t count, const fmi2Integer orders[],
                                       const fmi2Real values[])
{
    Unit *unit = handle;
    for (size_t i = 0; i < count; i++) {
        if (references[i] != OTHER || orders[i] != 1) {
            return fmi2Error;
        }
        unit->value[SLOPE] = values[i];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component handle, fmi2Real time, fmi2Real size, fmi2Boolean no_way_back)
{
    (void)time, (void)no_way_back;
    Unit *unit = handle;
    const double own = 20.0 * PI2, between = 16.0 * PI2, w = sqrt(own);
    if (size != unit->size) {
        unit->size = size;
        unit->sine = sin(w * size);
        unit->cosine = cos(w * size);
    }
    double *value = unit->value;
    /* about the motion that follows the input */
    double rest = between / own * value[OTHER], drift = between / own * value[SLOPE];
    double x = value[X] - rest, v = value[V] - drift;
    value[X] = rest + drift * size + x * unit->cosine + v / w * unit->sine;
    value[V] = drift + v * unit->cosine - w * x * unit->sine;
    value[OTHER] += value[SLOPE] * size;
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component unit, fmi2FMUstate *state)
{
    if (*state == NULL) {
        *state = malloc(sizeof(Unit));
    }
    *(Unit *)*state = *(Unit *)unit;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component unit, fmi2FMUstate state)
{
    *(Unit *)unit = *(Unit *)state;
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component unit, fmi2FMUstate *state)
{
    (void)unit;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

const char *fmi2GetTypesPlatform(void)
{
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void)
{
    return fmi2Version;
}
