/* FMI 2.0: the functions of the standard that need the rates of the states, those of model exchange
   and the derivatives of outputs. */
#include "component.h"
#include "exchange.h"
#include "fmi2Functions.h"

static const int INTEGRATING = AT_EVENT | CONTINUOUS;
static const int INFORMING = INITIALISING | INTEGRATING | TERMINATED;

fmi2Status fmi2EnterEventMode(fmi2Component handle)
{
    return change_phase(handle, __func__, INTEGRATING, AT_EVENT);
}

fmi2Status fmi2NewDiscreteStates(fmi2Component handle, fmi2EventInfo *told)
{
    ENTER(handle, AT_EVENT)
    if (told == NULL) {
        return refused(component, __func__, "nowhere to put what it tells");
    }
    Update news;
    if (!update(&component->instance, &news)) {
        return closed(component, false);
    }
    told->newDiscreteStatesNeeded = fmi2False; /* one update decides all */
    told->terminateSimulation = fmi2False;
    told->nominalsOfContinuousStatesChanged = news.nominals_changed;
    told->valuesOfContinuousStatesChanged = news.states_changed;
    told->nextEventTimeDefined = news.has_next;
    told->nextEventTime = news.has_next ? news.next : 0.0;
    return fmi2OK;
}

fmi2Status fmi2EnterContinuousTimeMode(fmi2Component handle)
{
    return change_phase(handle, __func__, AT_EVENT, CONTINUOUS);
}

fmi2Status fmi2CompletedIntegratorStep(fmi2Component handle, fmi2Boolean no_way_back,
                                       fmi2Boolean *event, fmi2Boolean *terminate)
{
    ENTER(handle, CONTINUOUS)
    (void)no_way_back;
    if (event == NULL || terminate == NULL) {
        return refused(component, __func__, "nowhere to put what it tells");
    }
    *event = *terminate = fmi2False;
    bool wanted = false;
    if (!complete_step(&component->instance, &wanted)) {
        return closed(component, false);
    }
    *event = wanted;
    warn_once(component);
    return fmi2OK;
}

fmi2Status fmi2SetTime(fmi2Component handle, fmi2Real time)
{
    ENTER(handle, INTEGRATING)
    return closed(component, set_time(&component->instance, time));
}

fmi2Status fmi2SetContinuousStates(fmi2Component handle, const fmi2Real states[], size_t count)
{
    ENTER(handle, CONTINUOUS)
    return closed(component, set_states(&component->instance, states, count));
}

fmi2Status fmi2GetDerivatives(fmi2Component handle, fmi2Real rates[], size_t count)
{
    ENTER(handle, INFORMING)
    return closed(component, get_rates(&component->instance, rates, count));
}

fmi2Status fmi2GetEventIndicators(fmi2Component handle, fmi2Real indicators[], size_t count)
{
    ENTER(handle, INFORMING)
    return closed(component, get_indicators(&component->instance, indicators, count));
}

fmi2Status fmi2GetContinuousStates(fmi2Component handle, fmi2Real states[], size_t count)
{
    ENTER(handle, INFORMING)
    return closed(component, get_states(&component->instance, states, count));
}

fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component handle, fmi2Real nominals[],
                                             size_t count)
{
    ENTER(handle, INSTANTIATED | INFORMING)
    return closed(component, get_nominals(&component->instance, nominals, count));
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component handle, const fmi2ValueReference unknown[],
                                        size_t unknowns, const fmi2ValueReference known[],
                                        size_t knowns, const fmi2Real seed[], fmi2Real out[])
{
    ENTER(handle, INFORMING)
    return closed(component, directional_derivative(&component->instance, unknown, unknowns, known,
                                                    knowns, seed, out));
}

/* --- co-simulation: what needs the rates of the states --- */

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component handle, const fmi2ValueReference references[],
                                        size_t count, const fmi2Integer order[], fmi2Real values[])
{
    ENTER(handle, STEPPING | TERMINATED)
    if (component->instance.memory.exchanges) {
        return refused(component, __func__, "this instance is for model exchange");
    }
    if (count > 0 && (references == NULL || order == NULL || values == NULL)) {
        return refused(component, __func__, "no value references, or no values");
    }
    bool done = true;
    for (size_t i = 0; done && i < count; i++) {
        done = get_output_rate(&component->instance, references[i], order[i], &values[i]);
    }
    return closed(component, done);
}
