"""Names, units and descriptions of what a result holds."""

from __future__ import annotations

from stickslip.ports import OUTPUTS

# name -> (unit, long name); the mechanical ones as the model itself describes them
MECHANICAL = {port.name: (port.unit or "1", port.description) for port in OUTPUTS}

THERMAL = {
    "interface_temperature": ("degC", "temperature between block and belt, mean of both faces"),
    "belt_entry_temperature": ("degC", "belt face just before the contact"),
    "belt_exit_temperature": ("degC", "belt face just behind the contact"),
    "ice_face_temperature": ("degC", "face of the ice, mean over the contact"),
    "belt_share": ("1", "share of the friction heat that went into the belt, since the start"),
    "melt_rate": ("kg/s", "melting, mean over the last macro step"),
    "melted_mass": ("kg", "ice that the block has lost since the start"),
    "refrozen_mass": ("kg", "ice on the belt, frozen from melt water"),
    "wiped_ice_mass": ("kg", "ice frozen on the belt and taken off by the wiper since the start"),
    "film_thickness": ("m", "water between block and belt, mean over the contact"),
    "heat_received": ("J", "friction heat that the thermal model took up since the start"),
    "railing_heat": ("J", "heat of the belt's rubbing on its railing that entered the belt"),
    "belt_heat": ("J", "heat stored in the belt above the start"),
    "ice_heat": ("J", "heat stored in the ice above the start"),
    "air_heat": ("J", "heat given to the air since the start"),
    "support_heat": ("J", "heat given to railing and rollers since the start, less what they gave"),
    "meltwater_heat": ("J", "heat in what has melted, above ice of the air's temperature"),
    "latent_heat": ("J", "the latent part of the heat in what has melted"),
    "heat_residual": ("J", "heat received less heat found: the thermal model's error"),
}

COUPLING = {
    "coupling_residual": (
        "J",
        "heat handed over and not taken up, and what the participants' own ledgers are off by",
    ),
}

KNOWN = MECHANICAL | THERMAL | COUPLING

TIME = {"units": "s", "long_name": "time"}

MODE = {"flag_values": [0, 1], "flag_meanings": "stick slip"}


def attributes(name: str, unit: str | None = None) -> dict[str, object]:
    """units and long_name of a variable; an unknown one is named by its own words."""
    known_unit, text = KNOWN.get(name, (unit or "1", name.replace("_", " ").replace(".", " ")))
    attrs: dict[str, object] = {"units": unit or known_unit, "long_name": text}
    return attrs | (MODE if name == "mode" else {})
