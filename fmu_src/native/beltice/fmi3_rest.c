/* FMI 3.0: what every unit has a function for, and this one, which is for co-simulation, does not
   offer. */
#include "component.h"
#include "exchange.h"
#include "fmi3Functions.h"

bool update(Instance *instance, Update *told)
{
    *told = (Update){.has_next = false};
    return refresh(instance);
}

bool look_at_indicators(Instance *instance, double indicators[])
{
    (void)indicators;
    return refuse(instance, "this unit has no event indicators");
}

bool get_output_rate(Instance *instance, size_t reference, int order, double *rate)
{
    (void)reference, (void)order, (void)rate;
    return refuse(instance, "fmi3GetOutputDerivatives: not offered");
}

static fmi3Status of_exchange(fmi3Instance handle, const char *call)
{
    Component *component = entered(handle, call, ANY_PHASE);
    return component == NULL ? fmi3Error
                             : refused(component, call, "this instance is for co-simulation");
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance handle)
{
    return of_exchange(handle, __func__);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance handle, fmi3Boolean no_way_back,
                                       fmi3Boolean *event, fmi3Boolean *terminate)
{
    (void)no_way_back, (void)event, (void)terminate;
    return of_exchange(handle, __func__);
}

fmi3Status fmi3SetTime(fmi3Instance handle, fmi3Float64 time)
{
    (void)time;
    return of_exchange(handle, __func__);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance handle, const fmi3Float64 states[], size_t count)
{
    (void)states, (void)count;
    return of_exchange(handle, __func__);
}

#define NUMBERS(function)                                                                          \
    fmi3Status function(fmi3Instance handle, fmi3Float64 numbers[], size_t count)                  \
    {                                                                                              \
        (void)numbers, (void)count;                                                                \
        return of_exchange(handle, __func__);                                                      \
    }
NUMBERS(fmi3GetContinuousStateDerivatives)
NUMBERS(fmi3GetEventIndicators)
NUMBERS(fmi3GetContinuousStates)
NUMBERS(fmi3GetNominalsOfContinuousStates)

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance handle, size_t *count)
{
    (void)count;
    return of_exchange(handle, __func__);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance handle, size_t *count)
{
    (void)count;
    return of_exchange(handle, __func__);
}

#define DERIVATIVE(function)                                                                       \
    fmi3Status function(fmi3Instance handle, const fmi3ValueReference unknown[], size_t unknowns,  \
                        const fmi3ValueReference known[], size_t knowns, const fmi3Float64 seed[], \
                        size_t seeds, fmi3Float64 out[], size_t outs)                              \
    {                                                                                              \
        ENTER(handle, ANY_PHASE)                                                                   \
        (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)seeds;         \
        (void)out, (void)outs;                                                                     \
        return refused(component, __func__, "not offered");                                       \
    }
DERIVATIVE(fmi3GetDirectionalDerivative)
DERIVATIVE(fmi3GetAdjointDerivative)
