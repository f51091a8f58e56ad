"""Two coupled oscillators as native units and as a system (SSP), with their exact motion."""

import zipfile
from pathlib import Path

import numpy as np
from c_units import made

from cosim.coupling import Connection, CoupledSystem, FmuParticipant

NAMES = ("first", "second")
STARTS = {"first": "1.0", "second": "0.0"}
LINKS = (("first.x", "second.other"), ("second.x", "first.other"))
SYSTEM = "oscillators.ssp"

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
    """Write `first.fmu`, `second.fmu` and the system of them; the two units."""
    units = []
    for name, start in STARTS.items():
        unit = made("oscillator", folder, **{"{name}": name, "{start}": start})
        units.append(unit.rename(folder / f"{name}.fmu"))
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
