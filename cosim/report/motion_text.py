"""Stability and regimes of a motion in sentences, from the numbers of a summary.

The words stand in `tables.toml`; here is which of them are said, and of what.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from stickslip.steady_motion.regimes import ASIDE_ANGLE_DEG, ASIDE_LENGTH
from stickslip.steady_motion.stability import GRAZING, GUIDED, UNSTABLE
from stickslip.steady_motion.starts import DISTURBED, OWN

from .quantities import TABLES

#: Starts, the most usual first.
SHORT: dict[str, str] = TABLES["starts"]
#: Multipliers that differ by less than this part are told as one.
ALIKE = 0.02
#: Of a number: a rig whose border is further off than this is well inside.
WELL_INSIDE = 1.0 / 3.0
#: A tenth of a millimetre, which every rig is off by, times this is a centimetre.
MUCH = 100.0
#: Regime -> what the block does in it.
EXPLAINED: dict[str, str] = TABLES["regimes"]
SAID: dict[str, str] = TABLES["motion"]


def stability_sentence(numbers: Mapping[str, Any]) -> str:
    """Whether a rig could make the motion; from the summary's ``stability``."""
    found = numbers["stability"]
    verdict = found["verdict"]
    if verdict == GUIDED:
        return SAID[GUIDED]
    growths = [found["growth"], *found["other_growths"]]
    said = found | {"low": min(growths), "high": max(growths), "what": SAID[found["motion"]]}
    if verdict == GRAZING:
        return SAID[GRAZING].format(**said)
    if verdict == UNSTABLE:
        return SAID[UNSTABLE].format(**said, kept=_kept(found), remedy=_remedy(found))
    # in a cycle, and of other disturbances where they grow otherwise
    alike = said["high"] - said["low"] < ALIKE * said["high"]
    factor = SAID["factor" if alike else "factors"].format(**said)
    told = SAID["fares"].format(**said, fares=SAID[verdict], factor=factor)
    return f"{told} {ramp_sentence(numbers)}".rstrip() + _further(found)


def _kept(found: Mapping[str, Any]) -> str:
    """What growth comes to in a run as long as this one."""
    lasts = found["time_to_grow"] > found["watched"]
    return SAID["kept" if lasts else "not_kept"].format(**found)


def unstable_line(numbers: Mapping[str, Any]) -> str:
    """How fast disturbances of an unstable motion grow, and what would help; for a terminal."""
    found = numbers["stability"]
    remedy = _said_where("remedy_line", found) if _stable_side(found) else ""
    what = SAID[f"{found['motion']}, line"]
    return SAID["line"].format(**found, what=what, kept=_kept(found), remedy=remedy)


def _remedy(found: Mapping[str, Any]) -> str:
    if found["unstable_pretensions"] is None:
        return ""
    return _said_where("remedy", found) if _stable_side(found) else SAID["no_remedy"]


def _said_where(name: str, found: Mapping[str, Any]) -> str:
    """With the pretension that is there, and where the motion is stable."""
    return SAID[name].format(stable=_stable_side(found), here=1e3 * found["pretension"])


def _stable_side(found: Mapping[str, Any]) -> str | None:
    """From which pretension on the motion is stable, or up to which: the border that is nearest."""
    for low, high in found["unstable_pretensions"] or ():
        if low <= found["pretension"] and (high is None or found["pretension"] <= high):
            if high is not None:
                return f"from {_millimetres(high, found)} mm"
            if low > 0.0:
                return f"below {_millimetres(low, found)} mm"
    return None


def _millimetres(border: float, found: Mapping[str, Any]) -> str:
    """Digits as the border is known to."""
    step = 1e3 * found["pretension_resolution"]
    return f"{1e3 * border:.3g}" if step < 0.1 else f"about {step * round(1e3 * border / step):.2g}"


def ramp_sentence(numbers: Mapping[str, Any]) -> str:
    """What the ramp to a stable motion makes of a disturbance, where that is much; else nothing."""
    amplification = numbers["stability"]["amplification"] or 0.0
    return "" if amplification < MUCH else SAID["ramp"].format(amplification)


def _further(found: Mapping[str, Any]) -> str:
    """Where else it would not be stable."""
    told = [
        _millimetres(low, found)
        + (" mm on" if high is None else f" to {_millimetres(high, found)} mm")
        for low, high in found["unstable_pretensions"] or []
    ]
    where = ", nor of ".join(told)
    return SAID["further"].format(where=where, here=1e3 * found["pretension"]) if told else ""


def regime_sentence(numbers: Mapping[str, Any]) -> str:
    """Which regime the run is in, how many starts lead to it, and what exists beside it."""
    found, groups, others = (numbers[key] for key in ("regimes", "same_regime", "other_regimes"))
    starts = [start for start in SHORT if start in groups]
    alike, count = [start for start in starts if groups[start] == OWN], len(starts)
    line = f"This run {described(found[OWN])}"
    if not starts:
        return line + SAID["not_tried"]
    part = "all" if len(alike) == count else f"{len(alike)} of"
    line += SAID["leads" if alike else "leads_not"].format(part=part, count=count)
    if others:
        beside = ";".join(_beside(found[first], first, groups) for first in others)
        line += SAID["others" if len(others) > 1 else "another"].format(beside)
    if open_ended := [SHORT[start] for start in starts if groups[start] is None]:
        first, rest = _listed(open_ended)[:1], _listed(open_ended)[1:]
        line += SAID["open_ended"].format(first.upper() + rest)
    return line if numbers["all_starts_followed"] else line + SAID["not_followed"]


def _beside(regime: Mapping[str, Any], first: str, groups: Mapping[str, str | None]) -> str:
    """A regime with the most usual start that leads to it."""
    starts = [start for start in SHORT if groups.get(start) == first]
    more = f" (as from {len(starts) - 1} more)" if len(starts) > 1 else ""
    return f" {SHORT[starts[0]]}{more} it {described(regime)}"


def border_sentence(numbers: Mapping[str, Any]) -> str:
    """How little of its numbers would have to differ for the rig to do something else."""
    borders = numbers["nearest_borders"]
    if borders is None:
        return SAID["no_borders"]
    near = [one for one in borders if one["margin"] is not None and one["margin"] < WELL_INSIDE]
    who = "It" if numbers["same_regime"].get(DISTURBED, OWN) == OWN else "Disturbed, it"
    if not near:
        return SAID["inside"].format(who)
    told = []
    for does in dict.fromkeys(_beyond(one) for one in near):
        with_these = [_side(one) for one in near if _beyond(one) == does]
        told.append(f"it {does} with {_listed(with_these, 'or')}")
    return f"{who} is near a border: {'; '.join(told)}."


def _beyond(border: Mapping[str, Any]) -> str:
    where = ", aside of its line or turned" if border["aside"] else ""
    return EXPLAINED.get(border["beyond"], "cannot be followed") + where


def _side(border: Mapping[str, Any]) -> str:
    """On which side of which value: "surface.speed above 0.157 m/s (0.15 here)"."""
    side = "above" if border["border"] > border["value"] else "below"
    unit = "" if border["unit"] == "1" else f" {border['unit']}"
    return f"{border['key']} {side} {border['border']:.3g}{unit} ({border['value']:.3g} here)"


def described(regime: Mapping[str, Any]) -> str:
    """What the block does in a regime: "sticks and slips at 1.73 Hz"."""
    line = EXPLAINED[regime["name"]]
    if regime["frequency"]:
        line += f" at {regime['frequency']:.4g} Hz"
    aside, turned = regime["max_y"], regime["max_rotation_deg"]
    bent = [f"up to {1e3 * aside:.2g} mm aside of its line"] * (aside >= ASIDE_LENGTH)
    bent += [f"turned by up to {turned:.2g}°"] * (turned >= ASIDE_ANGLE_DEG)
    return ", ".join([line, " and ".join(bent)]) if bent else line


def _listed(words: list[str], last: str = "and") -> str:
    return f" {last} ".join(filter(None, [", ".join(words[:-1]), *words[-1:]]))
