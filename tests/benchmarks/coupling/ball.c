/* The least that a co-simulation unit can be: a ball that bounces, by Euler steps of 1 ms, as in the
   Reference FMUs. What a call costs in a host is measured with it. */
#include <stdlib.h>

#include "fmi2FunctionTypes.h"

typedef struct {
    double height, speed;
} Ball;

fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean logging)
{
    (void)name, (void)type, (void)guid, (void)resources;
    (void)functions, (void)visible, (void)logging;
    Ball *ball = calloc(1, sizeof *ball);
    ball->height = 1.0;
    return ball;
}

void fmi2FreeInstance(fmi2Component ball)
{
    free(ball);
}

fmi2Status fmi2SetupExperiment(fmi2Component ball, fmi2Boolean has_tolerance, fmi2Real tolerance,
                               fmi2Real start, fmi2Boolean has_stop, fmi2Real stop)
{
    (void)ball, (void)has_tolerance, (void)tolerance, (void)start, (void)has_stop, (void)stop;
    return fmi2OK;
}

#define NOTHING(function)                                                                          \
    fmi2Status function(fmi2Component ball)                                                        \
    {                                                                                              \
        (void)ball;                                                                                \
        return fmi2OK;                                                                             \
    }
NOTHING(fmi2EnterInitializationMode)
NOTHING(fmi2ExitInitializationMode)
NOTHING(fmi2Terminate)

fmi2Status fmi2GetReal(fmi2Component handle, const fmi2ValueReference references[], size_t count,
                       fmi2Real values[])
{
    const double *numbers = handle;
    for (size_t i = 0; i < count; i++) {
        values[i] = numbers[references[i] % 2];
    }
    return fmi2OK;
}

fmi2Status fmi2SetReal(fmi2Component handle, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[])
{
    double *numbers = handle;
    for (size_t i = 0; i < count; i++) {
        numbers[references[i] % 2] = values[i];
    }
    return fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component handle, fmi2Real time, fmi2Real size, fmi2Boolean no_way_back)
{
    (void)time, (void)no_way_back;
    Ball *ball = handle;
    for (int left = (int)(size / 1e-3 + 0.5); left > 0; left--) {
        ball->speed -= 9.81e-3;
        ball->height += 1e-3 * ball->speed;
        if (ball->height < 0.0) {
            ball->height = 0.0;
            ball->speed *= -0.7;
        }
    }
    return fmi2OK;
}

fmi2Status fmi2GetFMUstate(fmi2Component handle, fmi2FMUstate *state)
{
    *state = malloc(sizeof(Ball));
    *(Ball *)*state = *(Ball *)handle;
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component handle, fmi2FMUstate state)
{
    *(Ball *)handle = *(Ball *)state;
    return fmi2OK;
}

fmi2Status fmi2FreeFMUstate(fmi2Component handle, fmi2FMUstate *state)
{
    (void)handle;
    free(*state);
    *state = NULL;
    return fmi2OK;
}

/* What else fmpy looks for, and does not call. */
#define MISSING(function)                                                                          \
    fmi2Status function(void)                                                                      \
    {                                                                                              \
        return fmi2Error;                                                                          \
    }
MISSING(fmi2GetTypesPlatform)
MISSING(fmi2GetVersion)
MISSING(fmi2SetDebugLogging)
MISSING(fmi2Reset)
MISSING(fmi2GetInteger)
MISSING(fmi2GetBoolean)
MISSING(fmi2GetString)
MISSING(fmi2SetInteger)
MISSING(fmi2SetBoolean)
MISSING(fmi2SetString)
MISSING(fmi2SerializedFMUstateSize)
MISSING(fmi2SerializeFMUstate)
MISSING(fmi2DeSerializeFMUstate)
MISSING(fmi2GetDirectionalDerivative)
MISSING(fmi2SetRealInputDerivatives)
MISSING(fmi2GetRealOutputDerivatives)
MISSING(fmi2CancelStep)
MISSING(fmi2GetStatus)
MISSING(fmi2GetRealStatus)
MISSING(fmi2GetIntegerStatus)
MISSING(fmi2GetBooleanStatus)
MISSING(fmi2GetStringStatus)
