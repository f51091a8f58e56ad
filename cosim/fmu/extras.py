"""What every unit has beside its model: licences, an icon and, for FMI 3, the terminals it has.

A terminal groups what is connected together; two of the same kind fit each other member by member
(FMI 3.0, section 2.4.9).
"""

from collections.abc import Iterable, Mapping
from importlib.metadata import distribution
from importlib.resources import files
from typing import Any

from cosim.fmu.description import xml_of
from cosim.fmu.libraries import FMI2, FMI3
from cosim.fmu.variables import DECLARED, Variable

LICENSES = "documentation/licenses"
#: Kind of terminal -> what it is, and member -> variables that it may be, of which a unit has one.
TERMINALS: Mapping[str, Any] = DECLARED["terminals"]


def extras(
    variables: Iterable[Variable] = (), fmi: int = FMI2, others: Iterable[str] = ()
) -> dict[str, bytes]:
    """Path in the unit -> content. others: distributions whose code travels in it, too."""
    found = {f"{LICENSES}/license.txt": _license("stickslip")}
    for name in others:
        found[f"{LICENSES}/{name}.txt"] = _license(name)
    if fmi == FMI3:
        found["terminalsAndIcons/terminalsAndIcons.xml"] = terminals([*variables])
        found["terminalsAndIcons/icon.png"] = _icon("png")
        found["terminalsAndIcons/icon.svg"] = _icon("svg")
    else:
        found["model.png"] = _icon("png")
    return found


def _license(name: str) -> bytes:
    text = distribution(name).read_text("licenses/LICENSE")
    if not text:
        raise ValueError(f"the licence of {name} is not installed with it: licenses/LICENSE")
    return text.encode("utf-8")


def _icon(kind: str) -> bytes:
    return (files("cosim.fmu.description") / f"icon.{kind}").read_bytes()


def terminals(variables: Iterable[Variable]) -> bytes:
    """terminalsAndIcons.xml: those of `TERMINALS` of which a unit has every member."""
    known = {variable.name for variable in variables}
    found = {}
    for kind, told in TERMINALS.items():
        has = {
            member: next((name for name in names if name in known), None)
            for member, names in told["members"].items()
        }
        if None not in has.values():
            found[kind] = told["says"], has
    return xml_of("terminals.xml.j2", terminals=found)
