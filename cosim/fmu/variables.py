"""The FMU's parameters with what the parameter models know of each, and its ports."""

from __future__ import annotations

import pprint
import uuid
from typing import Any

from stickslip import Parameters, ports
from stickslip.kernel import layout
from stickslip.quantity import details

Entry = dict[str, Any]

#: Parameters that the FMU shows otherwise than the parameter models do.
GUIDES: dict[str, Entry] = {
    key: {
        "unit": None,
        "nominal": None,
        "min": 0,
        "max": 1,
        "above_min": False,
        "description": f"1: the block can move in {motion}; 0: a guide keeps it from that",
    }
    for key, motion in (("free_y", "y"), ("free_phi", "phi"))
}
SPECIAL: dict[str, Entry] = {
    "rig.inertia": {
        "min": 0,
        "description": "moment of inertia about the vertical; 0: that of a disc, m a^2 / 2",
    },
}
DESCRIBED = ("name", "unit", "nominal", "min", "max", "description", "start")


def parameter_table() -> list[Entry]:
    """Every parameter of the FMU, with unit, bounds and description from the parameter models.

    One entry each: name, unit (None: an integer), nominal, min, max, above_min (whether min itself
    is excluded), description, start.
    """
    return [_entry(name, start) for name, start in Parameters().flat().items()]


def as_ports(table: list[Entry]) -> list[ports.Port]:
    """The parameters as the model description tells them."""
    return [ports.Port(slot="", **{key: entry[key] for key in DESCRIBED}) for entry in table]


def variables_module(table: list[Entry], content: str) -> bytes:
    """Text of the module that tells the slave what it is; ``content``: hash of the build."""
    values = {
        "BUILD": content,
        "GUID": str(uuid.uuid5(uuid.NAMESPACE_URL, f"StickSlip3DOF/{content}")),
        # (name, place in u, start) and (name, place in o, is an integer)
        "INPUTS": [(each.name, getattr(layout, each.slot), each.start) for each in ports.INPUTS],
        "OUTPUTS": [
            (each.name, getattr(layout, each.slot), each.unit is None) for each in ports.OUTPUTS
        ],
        "PARAMETERS": table,
    }
    lines = ['"""What this build of the FMU is, its ports and its parameters."""']
    for name, value in values.items():
        lines.append(f"{name} = {pprint.pformat(value, width=100, sort_dicts=False)}")
    return "\n".join(lines).encode() + b"\n"


def _entry(name: str, start: float) -> Entry:
    group, key = name.split(".")
    entry = {"name": name, "nominal": abs(start) or 1.0, "start": start} | GUIDES.get(key, {})
    if key in GUIDES:
        return entry | {"start": int(start)}
    table: Any = Parameters.model_fields[group].annotation
    field = table.model_fields[key.partition("[")[0]]
    bounds = {
        kind: getattr(bound, kind)
        for bound in field.metadata
        for kind in ("gt", "ge", "le")
        if getattr(bound, kind, None) is not None
    }
    whole = field.annotation is int
    return (
        entry
        | ({"start": int(start), "nominal": None} if whole else {})
        | {
            "unit": None if whole else details(field)["unit"],
            "min": bounds.get("gt", bounds.get("ge")),
            "max": bounds.get("le"),
            "above_min": "gt" in bounds,
            "description": field.description,
        }
        | SPECIAL.get(name, {})
    )
