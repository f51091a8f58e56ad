"""What was found, as the answer has it: sentences, laws with the runs' own points, ranking."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import numpy as np
from scipy.optimize import least_squares
from scipy.special import logsumexp, softmax
from scipy.stats import norm

from cosim.gap.data import Campaign
from cosim.gap.extended import ROUNDING, Part
from cosim.gap.judge import NOTHING_MISSING, is_asked_for_ageing
from cosim.gap.quantities import WORDS, digits, percent, quantity, with_digits
from cosim.gap.result import NINETY, Exponent, Gap, Law, Ranked, RigNumber, Score, Where
from cosim.gap.weak_form.added import Added
from cosim.gap.weak_form.constants import ALIKE, LEAST_GAIN
from cosim.gap.weak_form.ladder import Ladder
from cosim.gap.weak_form.rows import BREAK_AWAY, SLIP, STICK
from cosim.gap.weak_form.system import Rung, System
from cosim.gap.weak_form.unknowns import Curve, Unknown
from cosim.gap.windows import Fitted
from cosim.gap.windows.run_model import HEIGHT, LOADING

#: Whether a piece of a finding's setting is a figure.
_FIGURE = re.compile(r"\d").search
_SAYS: dict[str, str] = WORDS["findings"]


def text_of(part: Part) -> str:
    """A finding in words; one of the user's own effects by its id."""
    words = _SAYS.get(part.finding.name, f"{part.finding.name} is missing")
    variant = _variant(part)
    return f"{words}: {part.effect}" + (f" ({variant})" if variant else "")


def _variant(part: Part) -> str:
    """Its setting in words; a figure of it only where the model has no number of its own for it."""
    pieces = part.finding.variant.split(", ")
    return ", ".join(one for one in pieces if not (part.numbers and _FIGURE(one)))


def sentence_of(gap: Gap, parts: Sequence[Part], hints: Sequence[str] = ()) -> str:
    """The answer in a sentence. hints : what the rows ask for and simulated runs do without"""
    if gap.verdict == "none":
        extra = [rung.name for rung in gap.ladder[1:]]
        counted = f"{' and '.join(extra)} {'are' if len(extra) > 1 else 'is'} included"
        beside = f" once {counted}" if extra else ""
        said = f"the regression hints at {', '.join(hints)}, which simulated runs do not confirm"
        more = f"; {said}" if hints else ""
        sooner = gap.extended.values.get(LOADING, 0.0)
        if is_asked_for_ageing(sooner):
            more += (
                f"; it breaks away {1e3 * sooner:.0f} ms sooner than an ideal contact, nearly as "
                "static friction that grows at rest would"
            )
        return f"No effect is missing: the stated model describes the runs{beside}{more}."
    severe = [doubt for doubt in gap.doubts if doubt.severe]
    if severe:
        why = "" if severe[0].check == "search" else " while the data are in doubt"
        return f"Nothing is named{why}. {severe[0].text}"
    # numbers of what does not explain the runs make up for what is missing
    sizes = gap.verdict != "unknown"
    each = [text_of(part) + (_size(part, gap) if sizes else "") for part in parts]
    found = "; ".join([*each[:1], *map(_lower, each[1:])])
    if gap.verdict in ("named", "class", "partial"):
        found += "".join(
            f"; these runs cannot tell {first} from {' or '.join(others)}"
            for first, *others in gap.classes
        )
    if gap.verdict in ("named", "class"):
        return f"{found}."
    if gap.verdict == "partial":
        nuisances = [rung.name for rung in gap.ladder if rung.name in ("contact", "scatter")]
        this = " and ".join(["this", *nuisances])
        explain, share = f"explain{'s' * (not nuisances)}", percent(gap.share)
        takes = f"{explain} {share} of the misfit{' of the fitted runs' * (share == 'all')}"
        return f"{found}; {this} {takes}, and {_what_is_missing(gap, share == 'all')}."
    if parts:
        return f"Something is missing that is not in the catalogue; nearest to it: {_lower(found)}."
    if any(doubt.check == "scatter" for doubt in gap.doubts):
        return f"The stated model does not describe the runs: {_what_is_missing(gap)}."
    if gap.ladder[-1].gap.held_out is None and gap.ladder[-1].gap.fit <= NOTHING_MISSING:
        return "The fitted runs need nothing more, but no run is held out to confirm it."
    return "The model does not describe the runs, and no effect that was tried explains why."


def _what_is_missing(gap: Gap, is_all: bool = False) -> str:
    """Beside what is named. is_all : whether nothing is left to explain in the fitted runs"""
    if any(doubt.check == "scatter" for doubt in gap.doubts):
        return "something differs between the runs by more than friction is stated to scatter"
    if is_all and gap.ladder[-1].gap.held_out is not None:
        return "in the runs that were held out something is missing"
    return "something else is missing"


def _lower(text: str) -> str:
    """Text within a sentence."""
    return text[:1].lower() + text[1:]


def _size(part: Part, gap: Gap) -> str:
    """Its first number in the model, as in the page's table; of a curve without, its largest value.

    And its power, where the runs exclude that of the catalogue's law.
    """
    axis = _axis_of(part)
    power = next((one for one in gap.exponents if one.effect == part.effect), None)
    if (part.numbers and not part.in_model) or part.curve is None or axis is None:
        size = _first_number(part, gap)
        return size + (_power(power) if power and not power.holds else "")
    most = int(np.argmax(np.abs(part.curve.mean)))
    height = gap.extended.values.get(HEIGHT, 1.0)
    sd = height * float(np.sqrt(part.curve.covariance[most, most]))
    mean = height * part.curve.mean[most]
    at, per = part.curve.at[most], _unit_of(part.finding.name, axis)
    where = f"after {np.exp(at):.2g} s" if axis.unit == "ln s" else f"at {at:.2g} {axis.unit}"
    shown, low, high = with_digits(mean, mean - NINETY * sd, mean + NINETY * sd)
    value = f", {shown} ({low} to {high}) " + ("N " if per == "N" else f"of {per} ")
    return value + where


def _power(one: Exponent) -> str:
    value, low, high = with_digits(one.value, one.low, one.high)
    return f", force as the {one.quantity} to the power {value} ({low} to {high})"


def _first_number(part: Part, gap: Gap) -> str:
    """The first that the runs determine, with its 90 % interval."""
    parameters, intervals, _ = _numbers_of(part, gap.extended)
    for key in (number.key for number in part.numbers if number.key in intervals):
        number = quantity(key, parameters[key], intervals[key], "", gap.campaign.catalogue)
        text = number.text.removeprefix(f"{part.effect}.")
        if (speed := part.settings.get(f"{key}_speed")) and number.unit == "N":  # of a power law
            text = f"{text.removeprefix('power = ')} at {speed:.3g} m/s"
        return f", {text}"
    if part.finding.name == ROUNDING:
        step = quantity(ROUNDING, part.settings[ROUNDING], None)
        return f", {step.value} {step.unit}"
    return ""


def _axis_of(part: Part) -> Curve | None:
    """Of its curve; what moves the block across has numbers alone, and no rows along x."""
    return part.finding.main.unknown.curve if part.curve is not None else None


def _unit_of(name: str, axis: Curve) -> str:
    """Of a curve's values: N, or parts of a coefficient."""
    if name in ("film_drag", "structural_damping", "spring_hardening"):
        return "N"
    return "mu_k" if name == "velocity_weakening" else axis.per


def law_of(system: System, rung: Rung, part: Part, height: float) -> Law | None:
    """A curve with the points that each run says by itself. height : of one that is the law"""
    curve, axis = part.curve, _axis_of(part)
    if curve is None or axis is None:
        return None
    height = height if part.in_model else 1.0
    variance = height**2 * np.diag(curve.covariance)
    form, law = "", None
    if part.fits:
        best, weight = part.fits[0], 1.0 / np.maximum(variance, 1e-18)
        form = best.candidate.form if best.follows else ""
        law = best.at + np.sum(weight * (curve.mean - best.at)) / weight.sum()
    points, names = _points(system, rung, part.finding.main, axis, variance[-1])
    return Law(
        part.effect, axis.quantity, axis.unit, _unit_of(part.finding.name, axis), curve.at,
        height * curve.mean, np.sqrt(variance), points, names, form, law, part.in_model,
    )  # fmt: skip


def _points(
    system: System, rung: Rung, main: Added, axis: Curve, variance: float
) -> tuple[np.ndarray, tuple[str, ...]]:
    """What each run by itself says at those nodes of the argument that it tells of.

    The curve plus what is left of the run's rows, projected on the curve there. variance : of the
    law at its last node
    """
    place = rung.part_of(main)
    mean, covariance = rung.posterior[0][place], rung.posterior[1][place, place]
    scale = np.sqrt(variance / max(covariance[-1, -1], 1e-300))
    points, names = [], []
    for run in system.fitted:
        columns, left = main.unknown.columns([run]), rung.left(run)
        square = np.sum(columns**2, axis=0)
        for node in np.flatnonzero(square > 0.02 * square.max(initial=0.0)):
            value = mean[node] + columns[:, node] @ left / square[node]
            points.append((axis.nodes[node], scale * value, scale / np.sqrt(square[node])))
            names.append(run.track.run.name)
    return np.array(points).reshape(-1, 3), tuple(names)


#: Findings whose force or coefficient goes by a power of the argument, and the catalogue's.
_POWERS = {"film_drag": 1.0, "structural_damping": 1.0}


def exponents_of(
    part: Part, rung: Rung, unknowns: Mapping[str, Sequence[Unknown]]
) -> Iterator[Exponent]:
    """The power a u^n that follows a curve, where it starts at nothing.

    Over all forms of the curve, as probable as the rows have each: how smooth it is, and over what,
    is not known. rung : with the finding; unknowns : the forms of every argument
    """
    axis = _axis_of(part)
    if part.finding.name not in _POWERS or part.curve is None or axis is None:
        return
    main = part.finding.main
    rest = rung.system.rung([one for one in rung.added if one is not main])
    forms = [form for unknown in unknowns[main.unknown.name] for form in rest.forms(unknown)]
    weights = softmax([evidence for evidence, _ in forms])
    likely = [(weight, added) for weight, (_, added) in zip(weights, forms, strict=True)
              if weight > 1e-3]  # fmt: skip
    powers = [_power_of(rest.with_more([added]), added) for _, added in likely]
    each = norm.ppf((np.arange(99) + 0.5) / 99.0)
    at = np.concatenate([value + sd * each for value, sd in powers])
    order = np.argsort(at)
    shares = np.cumsum(np.repeat([weight for weight, _ in likely], each.size)[order])
    value, low, high = np.interp([0.5, 0.05, 0.95], shares / shares[-1], at[order]).tolist()
    yield Exponent(part.effect, axis.quantity, value, low, high, _POWERS[part.finding.name])


def _power_of(rung: Rung, added: Added) -> tuple[float, float]:
    """n of a u^n beside one form of a curve, and its standard deviation."""
    curve, place = added.unknown.curve, rung.part_of(added)
    assert curve is not None  # of a force over a speed
    at, mean = curve.nodes[1:], rung.posterior[0][place][1:]
    covariance = rung.posterior[1][place, place][1:, 1:]
    lower = np.linalg.cholesky(covariance + 1e-12 * np.trace(covariance) * np.eye(at.size))

    def rows(p: np.ndarray) -> np.ndarray:
        return np.linalg.solve(lower, p[0] * (at / at[-1]) ** p[1] - mean)

    found = least_squares(rows, [mean[-1], 1.0], x_scale=[abs(mean[-1]) + 1e-12, 1.0])
    inverse = np.linalg.pinv(found.jac.T @ found.jac)
    return float(found.x[1]), float(np.sqrt(inverse[1, 1]))


def ranking_of(
    ladder: Ladder, parts: Sequence[Part], extended: Fitted, after: Score
) -> tuple[Ranked, ...]:
    """Every effect in the place of what was found first, or on the rig's own unknowns."""
    if parts:
        first = next((part.finding for part in parts if part.finding.added), parts[0].finding)
        evidence = {first.name: first.gain}
        evidence |= {name: first.gain + more for name, more in first.others.items()}
    else:
        rung = ladder.system.rung().evidence  # of the rows that the offers are of
        evidence = {name: offer[0] - rung for name, offer in ladder.first_offers.items()}
        # with nothing named, that nothing is missing is among what may be: beforehand by as much as
        # a finding is asked for, and by more where the simulated runs do without it
        top = max(evidence.values(), default=0.0)
        evidence["nothing"] = LEAST_GAIN if top < LEAST_GAIN else top + ALIKE
    total = logsumexp(list(evidence.values()) or [0.0])
    evidence.pop("nothing", None)
    named = {part.finding.name: part for part in parts}
    ranking = []
    for name, value in sorted(evidence.items(), key=lambda pair: -pair[1]):
        part, probability = named.get(name), float(np.exp(value - total))
        if part is None:
            ranking.append(Ranked(name, "", value, probability))
        else:
            form = part.fits[0].candidate.form if part.fits else _variant(part)
            numbers = _numbers_of(part, extended)
            ranking.append(Ranked(part.effect, form, value, probability, after, *numbers))
    return tuple(ranking)


def _numbers_of(
    part: Part, fitted: Fitted
) -> tuple[dict[str, float], dict[str, tuple[float, float]], tuple[str, ...]]:
    """Its numbers, 90 % intervals, and what the data do not determine: at a bound, or known to no
    better than its own size."""
    keys = {number.key for number in part.numbers if number.scope == "campaign"}
    parameters = {key: value for key, value in fitted.values.items() if key in keys}
    intervals = {}
    for key, value in parameters.items():
        half = NINETY * fitted.sd.get(key, float("inf"))
        if key not in fitted.at_bound and half <= abs(value) and np.isfinite(half):
            intervals[key] = (value - half, value + half)
    return parameters, intervals, tuple(key for key in parameters if key not in intervals)


def rig_numbers(campaign: Campaign, fitted: Fitted) -> tuple[RigNumber, ...]:
    """Springs and zeros, as stated and as the runs have them."""
    found, runs = [], {run.name: run for run in campaign.runs}
    for label, value in fitted.values.items():
        key, _, owner = label.partition("@")
        if key == "offset.stiffness":
            setup = int(owner.removeprefix("setup ")) + 1
            name = f"springs stiffer than stated, set-up {setup}"
            unit, error = "1", campaign.errors.stiffness
        elif key == "offset.x" and owner in runs:
            name, unit, error = f"zero of x, {owner}", "m", campaign.zero_sd(runs[owner])
        else:
            continue
        sd = fitted.sd.get(label, float("inf"))
        at_bound = label in fitted.at_bound
        found.append(RigNumber(name, unit, 0.0, error, value, sd, at_bound))
    return tuple(found)


_REGIMES = {SLIP: "slip", STICK: "stick", BREAK_AWAY: "break-away"}


def where_of(campaign: Campaign, ladder: Ladder, plain: Fitted) -> Where:
    """Where the user's model misses most: kind of rows, and runs by their windows' gap."""
    rung = ladder.system.rung(contact=False, scatter=False)
    kinds = np.concatenate([run.kinds for run in ladder.system.fitted])
    squares = {kind: float(np.mean(rung.residuals[kinds == kind] ** 2)) for kind in _REGIMES
               if np.any(kinds == kind)}  # fmt: skip
    regime = _REGIMES[max(squares, key=lambda kind: squares[kind])]
    runs = sorted(plain.runs, key=lambda run: -run.gap)[:3]
    most = f"{runs[0].name}, {digits(runs[0].gap)} noise units"
    text = f"{most}; the balance of forces is off most in {regime}"
    return Where("x", regime, tuple(run.name for run in runs), text)
