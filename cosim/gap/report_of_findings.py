"""What was found, as the answer has it: sentences, laws with the runs' own points, ranking."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from scipy.optimize import least_squares
from scipy.special import logsumexp

from cosim.gap.data import Campaign
from cosim.gap.extended import Part
from cosim.gap.result import NINETY, Exponent, Gap, Law, Ranked, RigNumber, Score, Where
from cosim.gap.weak_form.ladder import Ladder
from cosim.gap.weak_form.rows import BREAK_AWAY, SLIP, STICK
from cosim.gap.weak_form.system import Rung, System
from cosim.gap.windows import Fitted

_SAYS = {
    "velocity_weakening": "Friction changes with the sliding speed, in proportion to the load",
    "film_drag": "Friction grows with the sliding speed, whatever the load",
    "structural_damping": "A force against the frame grows with the block's own velocity",
    "spring_hardening": "The springs' force is not linear in the place",
    "run_in": "Friction drifts with the distance slid",
    "thermal_weakening": "Friction follows the friction heat of the last seconds",
    "load_dependence": "Friction coefficients depend on the load",
    "static_strengthening": "Static friction grows with the time at rest",
    "surface_pattern": "Friction is periodic in the place on the surface",
    "speed_ripple": "The surface's speed is periodic in time",
    "lateral_friction": "Friction acts across the surface's motion too",
    "turning_surface": "The surface turns about a centre",
    "spring_misalignment": "The springs stand off the axis",
    "measurement.scale": "The camera's scale is off",
    "measurement.clock": "The camera's clock is off",
    "measurement.drift": "The camera drifts",
    "measurement.latency": "The camera reads a frame out while the block moves",
    "measurement.smoothing": "The tracker smooths the motion",
    "measurement.rotation": "The camera is turned",
    "measurement.zero": "The tracker's zero is off by more than stated",
    "other.time": "Friction drifts with the time of the run, whatever was slid",
    "other.hysteresis": "The springs, or guides, give way with hysteresis",
    "other.resonator": "Something on the block swings on a spring of its own",
    "other.release": "Friction changes in the first moments after a break-away",
    "other.springs": "All springs are stiffer, or softer, than stated",
    "other.room": "Friction follows the room's temperature from run to run",
    "other.order": "Friction drifts from run to run, in their order",
    "other.shaking": "A force on the block is periodic in time",
}


def says(name: str) -> str:
    """A finding in words; one of the user's own effects by its id."""
    return _SAYS.get(name, f"{name} is missing")


def text_of(part: Part) -> str:
    """A finding with its size."""
    variant = part.finding.variant
    words = f"{says(part.finding.name)}: {part.effect}"
    return f"{words} ({variant})" if variant else words


def sentence_of(gap: Gap, parts: Sequence[Part]) -> str:
    """The answer in a sentence."""
    if gap.verdict == "none":
        extra = [rung.name for rung in gap.ladder[1:]]
        beside = f" once {' and '.join(extra)} are counted" if extra else ""
        return f"No effect is missing: the stated model describes the runs{beside}."
    found = "; ".join(text_of(part) + _size(part, gap) for part in parts)
    if gap.verdict == "named":
        return f"{found}."
    if gap.verdict == "class":
        return f"{found}; these runs cannot tell {' from '.join(gap.effects)}."
    if gap.verdict == "partial":
        part = f"{100.0 * gap.share:.0f} % of the misfit"
        return f"{found}; this takes {part}, and something else is missing."
    if parts:
        return f"The model lacks something that the catalogue does not hold; nearest: {found}."
    return "The model misses the runs, and nothing that was tried repairs it."


def _size(part: Part, gap: Gap) -> str:
    """The largest value of a curve, with its interval and its power."""
    if part.curve is None:
        return ""
    unknown = part.finding.main.unknown
    assert unknown.curve is not None
    mean, sd = part.curve.mean[-1], float(np.sqrt(part.curve.covariance[-1, -1]))
    at, per = part.curve.at[-1], unit_of(part)
    where = f"at {at:.2g} {unknown.curve.unit}"
    if unknown.curve.unit == "ln s":
        where = f"after {np.exp(at):.2g} s"
    value = f", {mean:.2g} ({mean - NINETY * sd:.2g} to {mean + NINETY * sd:.2g}) "
    value += "N " if per == "N" else f"of {per} "
    power = next((one for one in gap.exponents if one.effect == part.effect), None)
    return value + where + (f", as the power {power.value:.2g} of it" if power else "")


def unit_of(part: Part) -> str:
    """Of a curve's values: N, or parts of a coefficient."""
    forces = ("film_drag", "structural_damping", "spring_hardening")
    curve = part.finding.main.unknown.curve
    assert curve is not None
    if part.finding.name in forces:
        return "N"
    return "mu_k" if part.finding.name == "velocity_weakening" else curve.per


def law_of(system: System, rung: Rung, part: Part) -> Law | None:
    """A curve with the points that each run says by itself."""
    if part.curve is None:
        return None
    unknown = part.finding.main.unknown
    assert unknown.curve is not None
    best = part.fits[0] if part.fits else None
    points, names = _points(system, rung, part)
    law = None
    if best is not None:
        weight = 1.0 / np.maximum(np.diag(part.curve.covariance), 1e-18)
        level = np.sum(weight * (part.curve.mean - best.at)) / weight.sum()
        law = best.at + level
    return Law(
        part.effect, unknown.curve.quantity, unknown.curve.unit, unit_of(part),
        part.curve.at, part.curve.mean, np.sqrt(np.diag(part.curve.covariance)), points, names,
        best.candidate.form if best is not None and best.follows else "", law,
    )  # fmt: skip


def _points(system: System, rung: Rung, part: Part) -> tuple[np.ndarray, tuple[str, ...]]:
    """What each run by itself says at those nodes of the argument that it tells of.

    The curve plus what is left of the run's rows, projected on the curve there.
    """
    unknown = part.finding.main.unknown
    assert unknown.curve is not None and part.curve is not None
    place = rung.part_of(part.finding.main)
    mean, covariance = rung.posterior[0][place], rung.posterior[1][place, place]
    scale = np.sqrt(part.curve.covariance[-1, -1] / max(covariance[-1, -1], 1e-300))
    points, names = [], []
    for run in system.fitted:
        columns = unknown.columns([run])
        left = rung.left(run)
        square = np.sum(columns**2, axis=0)
        for node in np.flatnonzero(square > 0.02 * square.max(initial=0.0)):
            if square[node] <= 0.0:
                continue
            value = mean[node] + columns[:, node] @ left / square[node]
            sd = 1.0 / np.sqrt(square[node])
            points.append((unknown.curve.nodes[node], scale * value, scale * sd))
            names.append(run.track.run.name)
    return np.array(points).reshape(-1, 3), tuple(names)


#: Findings whose force or coefficient goes by a power of the argument, and the catalogue's.
_POWERS = {"film_drag": 1.0, "structural_damping": 1.0}


def exponents_of(part: Part) -> Iterator[Exponent]:
    """The power a u^n that follows a curve, where it starts at nothing."""
    if part.finding.name not in _POWERS or part.curve is None:
        return
    at, mean = part.curve.at[1:], part.curve.mean[1:]
    covariance = part.curve.covariance[1:, 1:]
    lower = np.linalg.cholesky(covariance + 1e-12 * np.trace(covariance) * np.eye(at.size))

    def rows(p: np.ndarray) -> np.ndarray:
        return np.linalg.solve(lower, p[0] * (at / at[-1]) ** p[1] - mean)

    found = least_squares(rows, [mean[-1], 1.0], x_scale=[abs(mean[-1]) + 1e-12, 1.0])
    inverse = np.linalg.pinv(found.jac.T @ found.jac)
    value, sd = float(found.x[1]), float(np.sqrt(inverse[1, 1]))
    unknown = part.finding.main.unknown
    assert unknown.curve is not None
    yield Exponent(part.effect, unknown.curve.quantity, value, value - NINETY * sd,
                   value + NINETY * sd, _POWERS[part.finding.name])  # fmt: skip


def ranking_of(
    ladder: Ladder, parts: Sequence[Part], extended: Fitted, after: Score
) -> tuple[Ranked, ...]:
    """Every effect in the place of what was found first, or on the rig's own unknowns."""
    if parts:
        along = [part for part in parts if part.finding.added]
        first = (along or list(parts))[0]
        evidence = {first.finding.name: first.finding.gain}
        evidence |= {name: first.finding.gain + more for name, more in first.finding.others.items()}
    else:
        rung = ladder.system.rung().evidence  # of the rows that the offers are of
        evidence = {name: offer[0] - rung for name, offer in ladder.first_offers.items()}
    total = logsumexp(list(evidence.values()) or [0.0])
    named = {part.finding.name: part for part in parts}
    return tuple(
        _ranked(name, value, float(np.exp(value - total)), named.get(name), extended, after)
        for name, value in sorted(evidence.items(), key=lambda pair: -pair[1])
    )


def _ranked(
    name: str, evidence: float, probability: float, part: Part | None, extended: Fitted,
    after: Score,
) -> Ranked:  # fmt: skip
    if part is None:
        return Ranked(name, "", evidence, probability)
    keys = {number.key for number in part.numbers if number.scope == "campaign"}
    parameters = {key: value for key, value in extended.values.items() if key in keys}
    intervals, undetermined = intervals_of(extended, parameters)
    form = part.fits[0].candidate.form if part.fits else part.finding.variant
    return Ranked(part.effect, form, evidence, probability, after, parameters, intervals,
                  undetermined)  # fmt: skip


def intervals_of(
    fitted: Fitted, parameters: Mapping[str, float]
) -> tuple[dict[str, tuple[float, float]], tuple[str, ...]]:
    """90 % intervals, and what the data do not determine: at a bound, or known to no better than
    its own size."""
    intervals, undetermined = {}, []
    for key, value in parameters.items():
        sd = fitted.sd.get(key, float("inf"))
        if key in fitted.at_bound or not np.isfinite(sd) or NINETY * sd > abs(value):
            undetermined.append(key)
        else:
            intervals[key] = (value - NINETY * sd, value + NINETY * sd)
    return intervals, tuple(undetermined)


def rig_numbers(campaign: Campaign, fitted: Fitted) -> tuple[RigNumber, ...]:
    """Springs and zeros, as stated and as the runs have them."""
    found = []
    for label, value in fitted.values.items():
        key, _, owner = label.partition("@")
        sd = fitted.sd.get(label, float("inf"))
        if key == "offset.stiffness":
            error = campaign.errors.stiffness
            found.append(RigNumber(f"stiffness, {owner}", "1", 0.0, error, value, sd))
        elif key == "offset.x" and owner:
            run = next((r for r in campaign.runs if r.name == owner), None)
            if run is not None:
                stated = campaign.zero_sd(run, "x")
                found.append(RigNumber(f"zero of x, {owner}", "m", 0.0, stated, value, sd))
    return tuple(found)


_REGIMES = {SLIP: "slip", STICK: "stick", BREAK_AWAY: "break-away"}


def where_of(campaign: Campaign, ladder: Ladder, plain: Fitted) -> Where:
    """Where the user's model misses most: kind of rows, and runs by their windows' gap."""
    rung = ladder.system.rung(contact=False, scatter=False)
    kinds = np.concatenate([run.kinds for run in ladder.system.fitted])
    squares = {kind: float(np.mean(rung.residuals[kinds == kind] ** 2)) for kind in _REGIMES
               if np.any(kinds == kind)}  # fmt: skip
    worst = max(squares, key=lambda kind: squares[kind])
    runs = sorted(plain.runs, key=lambda run: -run.gap)
    names = tuple(run.name for run in runs[:3])
    text = (
        f"the user's model misses x by {runs[0].gap:.2g} noise units in {runs[0].name}; of the "
        f"balance of forces most in {_REGIMES[worst]}"
    )
    return Where("x", _REGIMES[worst], names, text)


__all__ = [
    "exponents_of", "intervals_of", "law_of", "ranking_of", "rig_numbers", "says",
    "sentence_of", "text_of", "where_of",
]  # fmt: skip
