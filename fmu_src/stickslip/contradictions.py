"""Parameters that cannot stand side by side. Pure Python: it travels inside the FMU."""

from __future__ import annotations

from collections.abc import Mapping

ONE = "give one of the two"
#: What of ``friction`` a law of speed and state takes the place of, and why.
NOT_BESIDE_STATE_LAW = {
    "stick_creep": "whose contact creeps by its own law",
    "transition_speed": "whose contact has no mu_s to fall from",
}


def contradiction(values: Mapping[str, float]) -> str:
    """What two of the parameters (names as of `Parameters.flat`) contradict in; "" if nothing."""
    return _beside_state_law(values) or _beside_bristles(values)


def _beside_state_law(values: Mapping[str, float]) -> str:
    if values["rate_and_state.direct"] == 0.0 and values["rate_and_state.evolution"] == 0.0:
        return ""
    for name, why in NOT_BESIDE_STATE_LAW.items():
        value = values[f"friction.{name}"]
        if value != 0.0:
            return f"friction.{name} = {value:g} m/s beside rate_and_state, {why}; {ONE}"
    return ""


def _beside_bristles(values: Mapping[str, float]) -> str:
    distance = values["friction.presliding_distance"]
    said = f"friction.presliding_distance = {distance:g} m"
    if distance == 0.0:
        return ""
    if values["friction.transition_speed"] == 0.0:
        return (
            f"{said} with friction.transition_speed = 0: bristles give way over a sliding speed; "
            "allowed is a transition_speed above 0 m/s"
        )
    if values["friction.stick_creep"] != 0.0:
        return f"{said} beside friction.stick_creep, another law of the same shear; {ONE}"
    if values["stick_stiffness.ratio"] != 1.0:
        return f"{said} beside stick_stiffness, which judges a rigid stick; {ONE}"
    return ""
