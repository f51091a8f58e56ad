/* FMI 3.0, model exchange: the functions of the standard around an instance. */
#include "component.h"
#include "exchange.h"
#include "fmi3Functions.h"

static const int INFORMING = INITIALISING | AT_EVENT | CONTINUOUS | TERMINATED;

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance handle)
{
    ENTER(handle, AT_EVENT)
    if (!component->instance.memory.exchanges) {
        return refused(component, __func__, "this instance is for co-simulation");
    }
    component->instance.memory.phase = CONTINUOUS;
    return fmi3OK;
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance handle, fmi3Boolean no_way_back,
                                       fmi3Boolean *event, fmi3Boolean *terminate)
{
    ENTER(handle, CONTINUOUS)
    (void)no_way_back;
    if (event == NULL || terminate == NULL) {
        return refused(component, __func__, "nowhere to put what it tells");
    }
    *event = *terminate = fmi3False;
    bool wanted = false;
    if (!complete_step(&component->instance, &wanted)) {
        return closed(component, false);
    }
    *event = wanted;
    warn_once(component);
    return fmi3OK;
}

fmi3Status fmi3SetTime(fmi3Instance handle, fmi3Float64 time)
{
    ENTER(handle, CONTINUOUS)
    return closed(component, set_time(&component->instance, time));
}

fmi3Status fmi3SetContinuousStates(fmi3Instance handle, const fmi3Float64 states[], size_t count)
{
    ENTER(handle, CONTINUOUS)
    return closed(component, set_states(&component->instance, states, count));
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance handle, fmi3Float64 rates[], size_t count)
{
    ENTER(handle, INFORMING)
    return closed(component, get_rates(&component->instance, rates, count));
}

fmi3Status fmi3GetEventIndicators(fmi3Instance handle, fmi3Float64 indicators[], size_t count)
{
    ENTER(handle, INFORMING)
    return closed(component, get_indicators(&component->instance, indicators, count));
}

fmi3Status fmi3GetContinuousStates(fmi3Instance handle, fmi3Float64 states[], size_t count)
{
    ENTER(handle, INFORMING)
    return closed(component, get_states(&component->instance, states, count));
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance handle, fmi3Float64 nominals[],
                                             size_t count)
{
    ENTER(handle, INSTANTIATED | INFORMING)
    return closed(component, get_nominals(&component->instance, nominals, count));
}

/* How many there are of something that only model exchange has. */
static fmi3Status count_of(fmi3Instance handle, const char *call, size_t there, size_t *count)
{
    Component *component = entered(handle, call, INSTANTIATED | INFORMING);
    if (component == NULL) {
        return fmi3Error;
    }
    if (!component->instance.memory.exchanges) {
        return refused(component, call, "this instance is for co-simulation");
    }
    if (count == NULL) {
        return refused(component, call, "nowhere to put the number");
    }
    *count = there;
    return fmi3OK;
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance handle, size_t *count)
{
    return count_of(handle, __func__, INDICATOR_COUNT, count);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance handle, size_t *count)
{
    return count_of(handle, __func__, STATE_COUNT, count);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance handle, const fmi3ValueReference unknown[],
                                        size_t unknowns, const fmi3ValueReference known[],
                                        size_t knowns, const fmi3Float64 seed[], size_t seeds,
                                        fmi3Float64 out[], size_t outs)
{
    ENTER(handle, INFORMING)
    if (seeds != knowns || outs != unknowns) {
        return refused(component, __func__, "one number for each known and unknown variable");
    }
    return closed(component, directional_derivative(&component->instance, unknown, unknowns, known,
                                                     knowns, seed, out));
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance handle, const fmi3ValueReference unknown[],
                                    size_t unknowns, const fmi3ValueReference known[],
                                    size_t knowns, const fmi3Float64 seed[], size_t seeds,
                                    fmi3Float64 out[], size_t outs)
{
    ENTER(handle, INFORMING)
    (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)seeds, (void)out;
    (void)outs;
    return refused(component, __func__, "not offered; fmi3GetDirectionalDerivative is");
}
