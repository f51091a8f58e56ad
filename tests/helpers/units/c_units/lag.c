// A unit for FMI 2.0: y' = gain * u - rate * y, solved exactly for an input that is held.
#include <math.h>
#include <stdlib.h>
#include "fmi2Functions.h"

enum { U, Y, GAIN, RATE, TAKEN, MODE, COUNT };

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                              fmi2String resources, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean logging) {
    double *unit = calloc(COUNT, sizeof(double));
    unit[GAIN] = 1.0;
    return unit;
}

void fmi2FreeInstance(fmi2Component c) { free(c); }

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean defined, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean ends, fmi2Real stop) {
    // begins with what is declared, as units of one exporter do: what was set before is forgotten
    for (int i = 0; i < COUNT; i++) ((double *)c)[i] = i == GAIN;
    return fmi2OK;
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2ExitInitializationMode(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Terminate(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2Reset(fmi2Component c) { return fmi2OK; }
fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t n, const fmi2String s[]) {
    return fmi2OK;
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, fmi2Real v[]) {
    for (size_t i = 0; i < n; i++) v[i] = ((double *)c)[r[i]];
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference r[], size_t n, const fmi2Real v[]) {
    for (size_t i = 0; i < n; i++) ((double *)c)[r[i]] = v[i];
    return fmi2OK;
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, int v[]) {
    for (size_t i = 0; i < n; i++) v[i] = (int)((double *)c)[r[i]];
    return fmi2OK;
}

fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference r[], size_t n, const int v[]) {
    for (size_t i = 0; i < n; i++) ((double *)c)[r[i]] = v[i];
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size, fmi2Boolean final) {
    double *unit = c;
    double rate = unit[RATE], faded = exp(-rate * size);
    double grown = rate > 0.0 ? (1.0 - faded) / rate : size;
    unit[Y] = faded * unit[Y] + grown * unit[GAIN] * unit[U];
    unit[TAKEN] = unit[U];
    return unit[Y] > 1e6 ? fmi2Error : fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *state) {
    if (*state == NULL) *state = malloc(COUNT * sizeof(double));
    for (int i = 0; i < COUNT; i++) ((double *)*state)[i] = ((double *)c)[i];
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
    for (int i = 0; i < COUNT; i++) ((double *)c)[i] = ((double *)state)[i];
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *state) {
    free(*state);
    *state = NULL;
    return fmi2OK;
}
