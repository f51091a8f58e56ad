"""Two coupled oscillators as native units and as a system (SSP), with their exact motion."""

from __future__ import annotations

import subprocess
import zipfile
from pathlib import Path

import fmpy
import numpy as np
from c_library import compiler

from cosim.coupling import Connection, CoupledSystem, FmuParticipant
from cosim.fmu.native import native_folder

NAMES = ("first", "second")
STARTS = {"first": 1.0, "second": 0.0}
LINKS = (("first.x", "second.other"), ("second.x", "first.other"))
SYSTEM = "oscillators.ssp"

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="{name}" guid="{name}">
  <CoSimulation modelIdentifier="oscillator" canGetAndSetFMUstate="true"
    canHandleVariableCommunicationStepSize="true" canInterpolateInputs="true"/>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.01"/>
  <ModelVariables>
    <ScalarVariable name="other" valueReference="0" causality="input" variability="continuous">
      <Real start="0"/></ScalarVariable>
    <ScalarVariable name="x" valueReference="1" causality="output" variability="continuous"
      initial="exact"><Real start="{start}"/></ScalarVariable>
  </ModelVariables>
  <ModelStructure><Outputs><Unknown index="2"/></Outputs></ModelStructure>
</fmiModelDescription>
"""
STRUCTURE = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="oscillators" version="1.0"
    xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
    xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="oscillators">
    <ssd:Elements>{components}</ssd:Elements>
    <ssd:Connections>{connections}</ssd:Connections>
  </ssd:System>
  <ssd:DefaultExperiment startTime="0" stopTime="1"/>
</ssd:SystemStructureDescription>
"""
COMPONENT = """
      <ssd:Component name="{name}" type="application/x-fmu-sharedlibrary"
          source="resources/{name}.fmu">
        <ssd:Connectors>
          <ssd:Connector name="other" kind="input"><ssc:Real/></ssd:Connector>
          <ssd:Connector name="x" kind="output"><ssc:Real/></ssd:Connector>
        </ssd:Connectors>
      </ssd:Component>"""


def build(folder: Path) -> list[Path]:
    """Compile the unit, write `first.fmu`, `second.fmu` and the system of them; the two units."""
    library = folder / f"oscillator{fmpy.sharedLibraryExtension}"
    command = [*compiler(), "-O2", "-shared", "-fPIC", "-I", str(native_folder() / "headers")]
    source = Path(__file__).with_name("oscillator.c")
    subprocess.run([*command, str(source), "-o", str(library), "-lm"], check=True)
    units = [folder / f"{name}.fmu" for name in NAMES]
    for unit in units:
        text = DESCRIPTION.format(name=unit.stem, start=STARTS[unit.stem])
        with zipfile.ZipFile(unit, "w") as archive:
            archive.writestr("modelDescription.xml", text)
            archive.write(library, f"binaries/{fmpy.platform}/{library.name}")
    links = [(*source.split("."), *sink.split(".")) for source, sink in LINKS]
    text = STRUCTURE.format(
        components="".join(COMPONENT.format(name=name) for name in NAMES),
        connections="".join(
            f'<ssd:Connection startElement="{a}" startConnector="{x}" endElement="{b}"'
            f' endConnector="{u}"/>'
            for a, x, b, u in links
        ),
    )
    with zipfile.ZipFile(folder / SYSTEM, "w") as archive:
        archive.writestr("SystemStructure.ssd", text)
        for unit in units:
            archive.write(unit, f"resources/{unit.name}")
    return units


def coupled(units: list[Path]) -> CoupledSystem:
    """Both as a system of this product's master."""
    return CoupledSystem(
        [FmuParticipant(unit, unit.stem) for unit in units],
        [Connection(source, sink) for source, sink in LINKS],
    )


def largest_error(time, first, second) -> float:
    """Of x of both, against the exact motion (cos 2 pi t +- cos 6 pi t) / 2."""
    slow, fast = np.cos(2 * np.pi * np.asarray(time)), np.cos(6 * np.pi * np.asarray(time))
    off = [np.abs(first - (slow + fast) / 2), np.abs(second - (slow - fast) / 2)]
    return float(np.max(off))
