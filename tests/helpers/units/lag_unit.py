"""A small FMI 2.0 unit in C, made where a test needs one: y' = gain * u - rate * y, solved exactly.

Its ports can be given names, units and definitions of units.
"""

from __future__ import annotations

import subprocess
import tempfile
import zipfile
from collections.abc import Mapping
from functools import cache
from pathlib import Path

import fmpy
from c_library import compiler

from cosim.fmu.native import native_folder

SOURCE = r"""
#include <math.h>
#include <stdlib.h>
#include "fmi2Functions.h"

enum { U, Y, GAIN, RATE, TAKEN, MODE, COUNT };
#define VALUES(name, type) \
    fmi2Status fmi2Get##name(fmi2Component c, const fmi2ValueReference r[], size_t n, type v[]) { \
        for (size_t i = 0; i < n; i++) v[i] = (type)((double *)c)[r[i]]; return fmi2OK; } \
    fmi2Status fmi2Set##name(fmi2Component c, const fmi2ValueReference r[], size_t n, \
                             const type v[]) { \
        for (size_t i = 0; i < n; i++) ((double *)c)[r[i]] = (double)v[i]; return fmi2OK; }
VALUES(Real, fmi2Real)
VALUES(Integer, fmi2Integer)
VALUES(Boolean, fmi2Boolean)

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
    free(*state); *state = NULL; return fmi2OK;
}
#define REFUSED(name, ...) fmi2Status fmi2##name(fmi2Component c, __VA_ARGS__) { return fmi2Error; }
#define STRINGS const fmi2ValueReference r[], size_t n
REFUSED(GetString, STRINGS, fmi2String v[])
REFUSED(SetString, STRINGS, const fmi2String v[])
REFUSED(SetRealInputDerivatives, STRINGS, const fmi2Integer o[], const fmi2Real v[])
REFUSED(GetRealOutputDerivatives, STRINGS, const fmi2Integer o[], fmi2Real v[])
REFUSED(GetStatus, const fmi2StatusKind k, fmi2Status *s)
REFUSED(GetRealStatus, const fmi2StatusKind k, fmi2Real *v)
REFUSED(GetIntegerStatus, const fmi2StatusKind k, fmi2Integer *v)
REFUSED(GetBooleanStatus, const fmi2StatusKind k, fmi2Boolean *v)
REFUSED(GetStringStatus, const fmi2StatusKind k, fmi2String *v)
REFUSED(GetDirectionalDerivative, STRINGS, const fmi2ValueReference k[], size_t m,
        const fmi2Real d[], fmi2Real v[])
REFUSED(SerializedFMUstateSize, fmi2FMUstate s, size_t *n)
REFUSED(SerializeFMUstate, fmi2FMUstate s, fmi2Byte b[], size_t n)
REFUSED(DeSerializeFMUstate, const fmi2Byte b[], size_t n, fmi2FMUstate *s)
fmi2Status fmi2CancelStep(fmi2Component c) { return fmi2Error; }
const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }
const char *fmi2GetVersion(void) { return fmi2Version; }
"""
UNITS = {
    "degC": 'K="1" offset="273.15"',
    "K": 'K="1"',
    "m": 'm="1"',
    "mm": 'm="1" factor="0.001"',
    "J": 'kg="1" m="2" s="-2"',
    "kJ": 'kg="1" m="2" s="-2" factor="1000"',
    "W": 'kg="1" m="2" s="-3"',
    "N": 'kg="1" m="1" s="-2"',
}
DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="lag" guid="lag">
  <CoSimulation modelIdentifier="lag" canGetAndSetFMUstate="true"
    canHandleVariableCommunicationStepSize="true"/>
  <UnitDefinitions>{units}</UnitDefinitions>
  <TypeDefinitions><SimpleType name="Mode"><Enumeration><Item name="off" value="0"/>
    <Item name="on" value="1"/></Enumeration></SimpleType></TypeDefinitions>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.01"/>
  <ModelVariables>
    <ScalarVariable name="{u}" valueReference="0" causality="input" variability="continuous">
      <Real start="0"{u_unit}/></ScalarVariable>
    <ScalarVariable name="{y}" valueReference="1" causality="output" variability="continuous"
      initial="exact"><Real start="0"{y_unit}/></ScalarVariable>
    <ScalarVariable name="{gain}" valueReference="2" causality="parameter" variability="fixed">
      <Real start="1"{u_unit}/></ScalarVariable>
    <ScalarVariable name="part.rate" valueReference="3" causality="parameter" variability="fixed">
      <Real start="0" min="0"/></ScalarVariable>
    <ScalarVariable name="taken" valueReference="4" causality="output" variability="continuous"
      initial="calculated"><Real{u_unit}/></ScalarVariable>
    <ScalarVariable name="mode" valueReference="5" causality="parameter" variability="fixed">
      <Enumeration declaredType="Mode" start="0"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure><Outputs><Unknown index="2"/><Unknown index="5"/></Outputs>
    <InitialUnknowns><Unknown index="5"/></InitialUnknowns></ModelStructure>
</fmiModelDescription>
"""


def lag_unit(
    path: Path,
    u_unit: str = "",
    y_unit: str = "",
    *,
    u: str = "u",
    y: str = "y",
    gain: str = "part.gain",
    units: Mapping[str, str] = UNITS,
) -> Path:
    """Write the unit; u, y, gain: names of its variables; u_unit, y_unit: "" for none."""
    used = {unit: units[unit] for unit in (u_unit, y_unit) if unit}
    defined = "".join(f'<Unit name="{n}"><BaseUnit {b}/></Unit>' for n, b in used.items())
    text = DESCRIPTION.format(
        units=defined or '<Unit name="none"/>',
        u=u,
        y=y,
        gain=gain,
        u_unit=f' unit="{u_unit}"' if u_unit else "",
        y_unit=f' unit="{y_unit}"' if y_unit else "",
    )
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", text)
        archive.write(_library(), f"binaries/{fmpy.platform}/lag{fmpy.sharedLibraryExtension}")
    return path


@cache
def _library() -> Path:
    folder = Path(tempfile.mkdtemp(prefix="lag-unit-"))
    (folder / "lag.c").write_text(SOURCE, encoding="utf-8")
    made = folder / f"lag{fmpy.sharedLibraryExtension}"
    headers = native_folder() / "headers"
    command = [*compiler(), "-O1", "-shared", "-fPIC", "-I", str(headers)]
    subprocess.run([*command, "-o", str(made), "lag.c", "-lm"], cwd=folder, check=True)
    return made
