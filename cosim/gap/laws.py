"""Which law of the catalogue follows a curve that the runs have drawn.

The argument has been decided on; each law of it that an effect offers is fitted to the curve, with
the curve's own covariance, and the one with the least chi^2 + parameters ln(nodes) is taken.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial

import numpy as np
from scipy.optimize import least_squares
from stickslip.effects.effect import Candidate, Effect, Scales

from cosim.gap.data import Campaign
from cosim.gap.weak_form.ladder import Finding
from cosim.gap.weak_form.rig_geometry import extensions
from cosim.gap.weak_form.rows import RunRows
from cosim.gap.weak_form.system import Rung

#: A curve is followed by a law whose chi^2 per node is below this: a chi^2 of nine degrees of
#: freedom exceeds 2.8 of them once in 300 curves. Or whose distance is below this part of the
#: curve's values (root mean square), which smoothed arguments turn by some percent.
FOLLOWED, NEARLY = 2.8, 0.05


@dataclass(frozen=True)
class FreeCurve:
    """A curve with its covariance, in the unit of its law: parts of mu_k or of mu_s, or N."""

    at: np.ndarray
    mean: np.ndarray
    covariance: np.ndarray


@dataclass(frozen=True)
class LawFit:
    """A law of the catalogue beside a curve.

    values : `block.parameter` -> value, fitted and set; at : (q,) of the law at the curve's nodes;
    misfit : chi^2 per node; level : by which the curve lies above the law all along
    off : root mean square distance of the law, in parts of the curve's values
    """

    effect: str
    candidate: Candidate
    values: Mapping[str, float]
    at: np.ndarray
    misfit: float
    price: float
    level: float = 0.0
    off: float = math.inf

    @property
    def law(self) -> tuple[str, str]:
        """Effect and form."""
        return self.effect, self.candidate.form

    @property
    def follows(self) -> bool:
        """Whether the curve may be this law's."""
        return self.misfit < FOLLOWED or self.off < NEARLY


def scales_of(campaign: Campaign, runs: list[RunRows], mu_k: float) -> Scales:
    """What is typical of the campaign, for the laws' first guesses."""
    measured = [run.track.run for run in runs]
    speed = float(np.mean([abs(run.surface_speed) for run in measured]))
    mass = float(np.mean([run.mass for run in measured]))
    duration = float(np.mean([np.ptp(run.track.time) for run in runs]))
    stretched = campaign.rig.spring_length - campaign.rig.spring_natural_length
    weight = float(np.mean([run.weight for run in runs]))
    return Scales(
        speed=speed, distance=speed * duration, heat=mu_k * weight * speed * duration,
        duration=duration, stiffness=float(np.mean([run.stiffness for run in measured])),
        travel=max(float(np.max(np.abs(run.track.place))) for run in runs), mass=mass,
        force=weight, extension=stretched,
        longest=max(abs(run.track.run.surface_speed) * np.ptp(run.track.time) for run in runs),
    )  # fmt: skip


def free_curve(rung: Rung, finding: Finding, unit: float) -> FreeCurve | None:
    """The curve of a finding; None where it is none.

    unit : what a value of 1 is in the law's own unit, N for a force, 1 for a part of a coefficient
    """
    unknown = finding.main.unknown
    if unknown.curve is None:
        return None
    part = rung.part_of(finding.main)
    mean, covariance = rung.posterior[0][part], rung.posterior[1][part, part]
    return FreeCurve(unknown.curve.nodes, unit * mean, unit**2 * covariance)


def laws_of(name: str, curve: FreeCurve, context: Context) -> list[LawFit]:
    """Every law of the finding's argument, the best first."""
    shape = SHAPES.get(name)
    if shape is None:
        return []
    found = []
    for effect in context.campaign.catalogue.effects:
        law = shape(effect, context)
        if law is None or not (effect.offered or effect.id in context.own):
            continue
        for candidate in effect.candidates(context.scales):
            if context.allows(effect, candidate):
                found.append(_fitted(effect, candidate, law, curve, name not in _WITHOUT_LEVEL))
    return sorted(found, key=lambda fit: fit.price)


@dataclass(frozen=True)
class Context:
    """What a law is a law of: the campaign's scales, and the settings of the argument.

    own : effects of the user's own files
    """

    campaign: Campaign
    scales: Scales
    settings: Mapping[str, float]
    own: frozenset[str] = frozenset()

    def allows(self, effect: Effect, candidate: Candidate) -> bool:
        """What the argument's variant has settled is set by it, not by a candidate's settings."""
        return not (candidate.settings and effect.id in ("run_in", "thermal_weakening"))


#: (q,) arguments and parameters -> (q,) values of the law.
_Law = Callable[[np.ndarray, Mapping[str, float]], np.ndarray]


def _terms(effect: Effect) -> dict[str, Callable[..., float]]:
    return {term.__name__: term for term in effect.terms}


def _call(
    term: Callable[..., float], axis: str, at: np.ndarray, values: Mapping[str, float],
    **known: float,
) -> np.ndarray:  # fmt: skip
    """A term of the kernel along its argument."""
    given = _given(term, {**values, **known})
    return np.array([term(**{**given, axis: float(one)}) for one in at])


def _given(term: Callable[..., float], values: Mapping[str, float]) -> dict[str, float]:
    """Those of the values that a term asks for."""
    names = term.__code__.co_varnames[: term.__code__.co_argcount]
    return {name: values[name] for name in names if name in values}


def _over_speed(effect: Effect, context: Context) -> _Law | None:
    factor = _terms(effect).get("dry_factor")
    if factor is None or effect.axis != "sliding speed":
        return None
    return lambda at, values: _call(factor, "speed", at, values)


def _film(effect: Effect, context: Context) -> _Law | None:
    terms = _terms(effect)
    film, drag = terms.get("film_friction"), terms.get("contact_drag")
    if film is None and drag is None:
        return None
    weight = context.scales.force

    def law(at: np.ndarray, values: Mapping[str, float]) -> np.ndarray:
        force = np.zeros(at.size)
        if film is not None:
            force += weight * _call(film, "speed", at, values, normal_force=weight)
        if drag is not None:
            force += at * drag(**_given(drag, values))
        return force

    return law


def _damping(effect: Effect, context: Context) -> _Law | None:
    if effect.id != "structural_damping":
        return None

    def law(at: np.ndarray, values: Mapping[str, float]) -> np.ndarray:
        dry = values["dry_force"] * at / np.hypot(at, values["dry_speed"])
        return np.asarray(values["coefficient"] * at + values["quadratic"] * at**2 + dry)

    return law


def _hardening(effect: Effect, context: Context) -> _Law | None:
    term = _terms(effect).get("spring_force")
    if term is None:
        return None

    def law(at: np.ndarray, values: Mapping[str, float]) -> np.ndarray:
        pulled = np.zeros(at.size)
        right = np.cos(np.deg2rad(context.campaign.rig.attachment_angles_deg)) >= 0.0
        for stretched, side in zip(extensions(context.campaign.rig, at), right, strict=True):
            force = _call(term, "extension", stretched, values)
            pulled += -force if side else force
        return pulled

    return law


def _over(quantity: str, effect: Effect, context: Context) -> _Law | None:
    term = _terms(effect).get("kinetic_factor")
    if term is None or quantity not in term.__code__.co_varnames:
        return None
    known = dict.fromkeys({"diffusion", "fast_heat", "slow_heat"} - {quantity}, 0.0)
    return lambda at, values: _call(term, quantity, at, values, **known)


def _hold(effect: Effect, context: Context) -> _Law | None:
    term = _terms(effect).get("static_growth")
    if term is None:
        return None
    static = context.settings["mu_s"]
    return lambda at, values: _call(term, "hold", np.exp(at), values) / static


SHAPES: dict[str, Callable[[Effect, Context], _Law | None]] = {
    "velocity_weakening": _over_speed,
    "film_drag": _film,
    "structural_damping": _damping,
    "spring_hardening": _hardening,
    "run_in": partial(_over, "slid"),
    "thermal_weakening": partial(_over, "recent_heat"),
    "static_strengthening": _hold,
}
#: Laws beside which no coefficient is free that would take up a constant.
_WITHOUT_LEVEL = ("structural_damping", "spring_hardening")


def _fitted(
    effect: Effect, candidate: Candidate, law: _Law, curve: FreeCurve, level: bool
) -> LawFit:
    """Least squares of a law, and a constant where a coefficient is free, to the curve."""
    free = [each for each in candidate.free_parameters if not each.per_run]
    prefix = f"{effect.id}."
    defaults = {name: field.default for name, field in effect.table.model_fields.items()}
    set_values = {key.removeprefix(prefix): value for key, value in candidate.settings.items()}
    lower = np.linalg.cholesky(curve.covariance + 1e-10 * np.diag(np.diag(curve.covariance))
                               + 1e-18 * np.eye(curve.at.size))  # fmt: skip

    def values(scaled: np.ndarray) -> dict[str, float]:
        own = {each.key.removeprefix(prefix): each.value(each.inside(s))
               for each, s in zip(free, scaled, strict=True)}  # fmt: skip
        return {**defaults, **set_values, **own}

    constant = np.linalg.solve(lower, np.ones(curve.at.size)) if level else np.zeros(curve.at.size)

    def beside(scaled: np.ndarray) -> tuple[np.ndarray, float]:
        """What the law leaves of the curve, and the best constant beside it, without a search."""
        rows = np.linalg.solve(lower, law(curve.at, values(scaled)) - curve.mean)
        above = -float(constant @ rows) / max(float(constant @ constant), 1e-300)
        return rows + above * constant, above

    def residuals(scaled: np.ndarray) -> np.ndarray:
        return np.asarray(np.nan_to_num(beside(scaled)[0], nan=1e6, posinf=1e6, neginf=-1e6))

    low = np.array([each.scaled(each.low) for each in free])
    high = np.array([each.scaled(each.high) for each in free])
    start = np.clip([each.scaled(each.start) for each in free], low, high)
    solved = least_squares(residuals, start, bounds=(low - 1e-12, high + 1e-12))
    own = {each.key.removeprefix(prefix) for each in free} | set(set_values)
    chosen = {f"{prefix}{name}": value for name, value in values(solved.x).items() if name in own}
    chi, above, at = float(2.0 * solved.cost), beside(solved.x)[1], law(curve.at, values(solved.x))
    left, size = (float(np.linalg.norm(one)) for one in (at + above - curve.mean, curve.mean))
    return LawFit(
        effect.id, candidate, chosen, at, chi / curve.at.size,
        chi + len(free) * float(np.log(curve.at.size)), above, left / (size or 1.0),
    )  # fmt: skip
