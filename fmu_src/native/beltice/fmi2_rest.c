/* FMI 2.0: what every unit has a function for, and this one does not offer. */
#include "component.h"
#include "fmi2Functions.h"

fmi2Status fmi2GetDirectionalDerivative(fmi2Component handle, const fmi2ValueReference unknown[],
                                        size_t unknowns, const fmi2ValueReference known[],
                                        size_t knowns, const fmi2Real seed[], fmi2Real out[])
{
    ENTER(handle, ANY_PHASE)
    (void)unknown, (void)unknowns, (void)known, (void)knowns, (void)seed, (void)out;
    return refused(component, __func__, "not offered");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component handle, const fmi2ValueReference references[],
                                        size_t count, const fmi2Integer order[], fmi2Real values[])
{
    ENTER(handle, STEPPING | TERMINATED)
    (void)references, (void)order, (void)values;
    return count == 0 ? fmi2OK : refused(component, __func__, "not offered");
}
