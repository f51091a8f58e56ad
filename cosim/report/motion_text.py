"""Stability and regimes of a motion in sentences, from the numbers of a summary."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from stickslip.steady_motion.regimes import ASIDE_ANGLE_DEG, ASIDE_LENGTH
from stickslip.steady_motion.stability import GRAZING, GUIDED, NEUTRAL, UNSTABLE
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


def stability_sentence(numbers: Mapping[str, Any]) -> str:
    """Whether a rig could make the motion; from the summary's ``stability``."""
    found = numbers["stability"]
    if found["verdict"] == GUIDED:
        return "The rig allows motion along x alone: there is nothing to be unstable."
    if found["verdict"] == GRAZING:
        return grazing_sentence(found)
    what = "The motion along the line" if found["motion"] == "along the line" else "This motion"
    if found["verdict"] == UNSTABLE:
        return (
            f"{what} is unstable: a small disturbance to the side or in rotation grows tenfold in "
            f"{found['time_to_grow']:.3g} s{_kept(found)}.{_remedy(found)}"
        )
    fares = "neither grow nor die out" if found["verdict"] == NEUTRAL else "die out"
    told = (
        f"{what} is {found['verdict']}: small disturbances to the side and in rotation "
        f"{fares}, by the factor {_factor(found)} in {found['cycle']:.3g} s. "
    )
    return (told + ramp_sentence(numbers)).rstrip() + _further(found)


def _factor(found: Mapping[str, Any]) -> str:
    """Growth in a cycle, and of other disturbances where they grow otherwise."""
    low, high = min(_growths(found)), max(_growths(found))
    if high - low < ALIKE * high:
        return f"{found['growth']:.3g}"
    return f"{low:.2g} to {high:.2g}, as they are smaller or larger,"


def grazing_sentence(found: Mapping[str, Any]) -> str:
    """That multipliers of several sizes of disturbance disagree."""
    low, high = min(_growths(found)), max(_growths(found))
    return (
        "Whether small disturbances to the side and in rotation grow cannot be judged: the motion "
        f"grazes, so that it depends on how small they are (by the factor {low:.3g} or {high:.3g} "
        f"in {found['cycle']:.3g} s)."
    )


def _growths(found: Mapping[str, Any]) -> list[float]:
    return [found["growth"], *found["other_growths"]]


def _kept(found: Mapping[str, Any]) -> str:
    """What growth comes to in a run as long as this one."""
    if found["time_to_grow"] <= found["watched"]:
        return ", so that no rig keeps to it"
    return f", in a run that lasts {found['watched']:.3g} s at constant speed"


def unstable_line(numbers: Mapping[str, Any]) -> str:
    """How fast disturbances of an unstable motion grow, and what would help; for a terminal."""
    found = numbers["stability"]
    motion = "the line" if found["motion"] == "along the line" else "this motion"
    stable, now = _stable_side(found), f"now {1e3 * found['pretension']:.3g}"
    remedy = f"; stable {stable} of pretension ({now})" if stable else ""
    time = f"{found['time_to_grow']:.3g} s"
    return f"disturbances of {motion} grow tenfold in {time}{_kept(found)}{remedy}"


def _remedy(found: Mapping[str, Any]) -> str:
    if found["unstable_pretensions"] is None:
        return ""
    if not (stable := _stable_side(found)):
        return " No pretension that was tried makes it stable."
    here = f"here it is {1e3 * found['pretension']:.3g} mm"
    what = "of pretension, by which the springs are stretched as installed"
    return f" It is stable {stable} {what}; {here}."


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
    if amplification < MUCH:
        return ""
    return (
        f"In the speed ramp before it a disturbance grows up to {amplification:.2g} "
        "times: a rig that is not as drawn may have swerved by then, and stay there."
    )


def _further(found: Mapping[str, Any]) -> str:
    """Where else it would not be stable."""
    told = []
    for low, high in found["unstable_pretensions"] or []:
        upwards = " mm on" if high is None else f" to {_millimetres(high, found)} mm"
        told.append(_millimetres(low, found) + upwards)
    if not told:
        return ""
    here = f"here it is {1e3 * found['pretension']:.3g} mm"
    return f" It is not with a pretension of {', nor of '.join(told)}; {here}."


def regime_sentence(numbers: Mapping[str, Any]) -> str:
    """Which regime the run is in, how many starts lead to it, and what exists beside it."""
    found, groups = numbers["regimes"], numbers["same_regime"]
    starts = [start for start in SHORT if start in groups]
    alike = [start for start in starts if groups[start] == OWN]
    line = f"This run {described(found[OWN])}"
    if not starts:
        return f"{line}. Other starts take too many steps, and were not tried."
    if alike:
        part = "all" if len(alike) == len(starts) else f"{len(alike)} of"
        line += f", as does the rig from {part} {len(starts)} other starts."
    else:
        line += f", to which none of {len(starts)} other starts leads."
    if others := numbers["other_regimes"]:
        line += (
            f" {'Other regimes exist' if len(others) > 1 else 'Another regime exists'} beside it:"
        )
        line += ";".join(_beside(found[first], first, groups) for first in others) + "."
    open_ended = [SHORT[start] for start in starts if groups[start] is None]
    if open_ended:
        first, rest = _listed(open_ended)[:1], _listed(open_ended)[1:]
        line += f" {first.upper()}{rest} it has come to none in the time looked at."
    if not numbers["all_starts_followed"]:
        line += " Further starts take too many steps, and were not tried."
    return line


def _beside(regime: Mapping[str, Any], first: str, groups: Mapping[str, str | None]) -> str:
    """A regime with the most usual start that leads to it."""
    starts = [start for start in SHORT if groups.get(start) == first]
    more = f" (as from {len(starts) - 1} more)" if len(starts) > 1 else ""
    return f" {SHORT[starts[0]]}{more} it {described(regime)}"


def border_sentence(numbers: Mapping[str, Any]) -> str:
    """How little of its numbers would have to differ for the rig to do something else."""
    borders = numbers["nearest_borders"]
    if borders is None:
        return "How near its borders are takes too many steps, and was not looked for."
    near = [one for one in borders if one["margin"] is not None and one["margin"] < WELL_INSIDE]
    who = "It" if numbers["same_regime"].get(DISTURBED, OWN) == OWN else "Disturbed, it"
    if not near:
        return (
            f"{who} is well inside: changed alone by a third, none of speed, speed ramp, damping, "
            "pretension and mu_s/mu_k makes another regime of it."
        )
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
