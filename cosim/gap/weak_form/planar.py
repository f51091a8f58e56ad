"""Which effect moves the block across the surface, and the rows along x with it.

Effects are compared by how probable the measured y (and phi) are with each, as courses of the whole
record (`across`): all of them are made of the same x(t), friction level and noise, and the samples
are the same for all. "Nothing across" is a block that keeps its y, or swings freely in it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields, replace
from itertools import product

import numpy as np
from scipy.special import logsumexp

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.data.campaign_file import Rig
from cosim.gap.weak_form.across import (
    ASKEW,
    CURVATURE,
    OWN,
    SHARE,
    SHIFT,
    TURN,
    Course,
    Plane,
    course,
    disc,
    measured,
)
from cosim.gap.weak_form.constants import (
    CURVATURE_SD,
    LEAST_GAIN,
    LEAST_SHARE,
    MOST_SHARE,
    PLANE_FOLLOWED,
    PLANE_PART,
    PLANE_PARTS,
    PLANE_ROUNDS,
    ROTATION_SD,
    SETTLED,
    SHARE_SD,
    SHARE_STEP,
    SHIFT_SD,
    SLOWEST_SLIDING,
    START_TURN,
    STARTS_ASKED,
    STILL_NUMBER,
    STILL_PIECE,
    STILL_SIGMAS,
    TURN_SD,
)
from cosim.gap.weak_form.evidence import posterior
from cosim.gap.weak_form.rig_unknowns import Level
from cosim.gap.weak_form.rows import RunRows, rows_of
from cosim.gap.weak_form.track import SmoothTrack

LATERAL, TURNING, MISALIGNED, ROTATION = (
    "lateral_friction", "turning_surface", "spring_misalignment", "measurement.rotation",
)  # fmt: skip
#: Effect, or nothing -> its forms: the unknowns that they have.
FORMS: dict[str, tuple[tuple[str, ...], ...]] = {
    "": ((),),
    ROTATION: ((ROTATION,),),
    LATERAL: ((SHARE,),),
    TURNING: ((CURVATURE, SHARE), (CURVATURE, ASKEW, SHARE)),
    MISALIGNED: (
        (TURN, SHARE),
        (SHIFT, SHARE),
        (TURN, SHIFT, SHARE),
        (TURN,),
        (SHIFT,),
        (TURN, SHIFT),
    ),  # fmt: skip
}
SD = {
    CURVATURE: CURVATURE_SD,
    ASKEW: TURN_SD,
    TURN: TURN_SD,
    SHIFT: SHIFT_SD,
    ROTATION: ROTATION_SD,
}


@dataclass(frozen=True)
class Fitted:
    """A form with the numbers that y asks for.

    evidence : ln; numbers : unknown -> (value, sd), SHARE as lateral_friction.ratio;
    planes : run -> motion in the plane; gap : rms of what is left of y and phi, noise units
    """

    form: tuple[str, ...]
    evidence: float
    numbers: Mapping[str, tuple[float, float]]
    planes: Mapping[str, Plane] = field(repr=False)
    gap: float

    @property
    def misfit(self) -> float:
        """Mean square of what is left, beyond that of noise."""
        return max(self.gap**2 - 1.0, 0.0)


@dataclass(frozen=True)
class Planar:
    """What moves the block across.

    evidence : effect -> ln evidence, less that of nothing across; answer, runner_up : the two most
    probable, "" is nothing, and lateral_friction with a zero beside it no rival of its own;
    numbers : 1/m, rad, m, ratio, (value, sd) of the answer;
    fits : effect or "" -> its best form
    """

    evidence: Mapping[str, float]
    answer: str
    runner_up: str
    fits: Mapping[str, Fitted] = field(repr=False)

    @property
    def numbers(self) -> Mapping[str, tuple[float, float]]:
        return self.fits[self.answer].numbers if self.answer else {}


#: Of a campaign whose blocks go along x alone.
NOTHING = Planar({}, "", "", {})


def planar_effects(campaign: Campaign, runs: Sequence[RunRows]) -> Planar:
    """The effect that moves the block across, by evidence; runs held out are predicted alone."""
    runs = [run for run in runs if run.track.y is not None and run.track.slips]
    if not any(_moves(run.track.run) for run in runs):
        return NOTHING
    free = set(campaign.rig.degrees_of_freedom) >= {"y", "phi"}
    names = list(FORMS) if free else ["", ROTATION]
    level = Level.of(list(runs)).kinetic
    fits, evidence = {}, {}
    for name in names:
        tried = [_fit(campaign, runs, level, form) for form in FORMS[name]]
        fits[name] = max(tried, key=lambda each: each.evidence)
        evidence[name] = float(logsumexp([each.evidence for each in tried]) - np.log(len(tried)))
    nothing = evidence.pop("")
    most = max(fits, key=lambda name: fits[name].evidence)
    noise = max(fits[most].gap, 1.0)  # what no form explains counts as noise
    evidence = {name: (value - nothing) / noise**2 for name, value in evidence.items()}
    ranked = sorted(evidence, key=lambda name: -evidence[name])
    if not np.isfinite(nothing):
        return NOTHING
    lateral = evidence.get(LATERAL, -np.inf)
    if evidence[ranked[0]] - lateral < max(LEAST_GAIN, PLANE_FOLLOWED * lateral):
        ranked.insert(0, ranked.pop(ranked.index(LATERAL)))  # it is in the others, with a zero
    explains = fits[ranked[0]].misfit < PLANE_PART * fits[""].misfit
    answer = ranked[0] if evidence[ranked[0]] > LEAST_GAIN and explains else ""
    rivals = [
        name
        for name in ranked
        if name != answer and not (answer == LATERAL and _is_lateral(fits[name]))
    ]
    return Planar(evidence, answer, rivals[0] if evidence[rivals[0]] > 0.0 else "", fits)


def _is_lateral(fitted: Fitted) -> bool:
    """Whether a form is friction across alone, as its other numbers may be zero."""
    others = [number for name, number in fitted.numbers.items() if name not in ("ratio", ASKEW)]
    return "ratio" in fitted.numbers and all(abs(value) < STILL_NUMBER * sd for value, sd in others)


def rows_in_plane(
    tracks: Sequence[SmoothTrack], campaign: Campaign, planar: Planar
) -> list[RunRows]:
    """Rows along x of all runs, with the effect in them that moves the block across.

    Springs, sliding speed and surface are those of the place in the plane; friction along x is its
    part f U_x / U. A turned camera sees x shortened by cos alpha, and the springs along x are so.
    """
    planes = planar.fits[planar.answer].planes if planar.fits else {}
    rows = []
    for track in tracks:
        plane = planes.get(track.run.name)
        if plane is None or planar.answer == ROTATION:
            rows.append(rows_of(track, campaign.rig))
        else:
            rows.append(rows_of(_in_plane(track, plane, campaign.rig), campaign.rig, plane))
    return rows


@dataclass(frozen=True)
class TrackInPlane(SmoothTrack):
    """A track whose sliding speed is that in the plane, m/s, its sign that along x.

    part : (n,) of friction, the part that acts along x, with its sign
    """

    part: np.ndarray

    @property
    def direction(self) -> np.ndarray:
        return self.part


def _in_plane(track: SmoothTrack, plane: Plane, rig: Rig) -> TrackInPlane:
    """Friction goes with the velocity across scaled by the ratio (`stickslip.kernel.friction`)."""
    along, sliding, spin = plane.sliding(track, rig.contact_radius)
    force, _ = disc(sliding, spin)
    part = force * along / np.maximum(sliding, SLOWEST_SLIDING)
    values = {each.name: getattr(track, each.name) for each in fields(track)}
    return TrackInPlane(**values | {"sliding": np.copysign(sliding, along), "part": part})


def _moves(run: MeasuredRun) -> bool:
    """Whether means of y over short pieces differ by more than noise makes them."""
    y = run.motion["y"][np.isfinite(run.motion["y"])]
    means = y[: y.size // STILL_PIECE * STILL_PIECE].reshape(-1, STILL_PIECE).mean(axis=1)
    free = means.size - 1
    if free < 1:
        return False
    square = free * np.var(means, ddof=1) * STILL_PIECE / run.noise["y"] ** 2
    return bool(square > free + STILL_SIGMAS * np.sqrt(2.0 * free))


@dataclass(frozen=True)
class _Samples:
    """Samples of one run, in units of noise, and what its unknowns do to them.

    rows : (m,) less what is known; shared, own : (m, u) columns
    """

    rows: np.ndarray
    shared: np.ndarray
    own: np.ndarray


def _fit(
    campaign: Campaign, runs: Sequence[RunRows], level: float, form: tuple[str, ...]
) -> Fitted:
    """A form, its courses made anew about what came out until they stay."""
    planes = [replace(measured(run.track), share=float(SHARE in form)) for run in runs]
    values = np.zeros(len(form))
    best: Fitted | None = None
    for number in range(PLANE_ROUNDS):
        solved = _round(campaign, runs, level, form, planes, values)
        if solved is None:
            break
        found, planes, values = solved
        settled = best is not None and abs(found.evidence - best.evidence) < SETTLED
        if number and (best is None or found.evidence > best.evidence):
            best = found
        if settled:
            break
    return best or Fitted(form, -np.inf, {}, {}, np.inf)


def _round(
    campaign: Campaign, runs: Sequence[RunRows], level: float, form: tuple[str, ...],
    planes: list[Plane], before: np.ndarray,
) -> tuple[Fitted, list[Plane], np.ndarray] | None:  # fmt: skip
    """The numbers from courses about the last round's; None where these run away."""
    moving = tuple(name for name in form if name != ROTATION)
    courses = [
        course(run.track, campaign.rig, level * run.weight, moving, plane)
        for run, plane in zip(runs, planes, strict=True)
    ]
    samples = [_samples(campaign, run.track, form, made)
               for run, made in zip(runs, courses, strict=True)]  # fmt: skip
    measured_turn = any(run.track.phi is not None for run in runs)
    turn = START_TURN[int(measured_turn or SHARE not in form)]
    settings = [_setting(form, part, start, turn, campaign.errors.stiffness)
                for part, start in product(PLANE_PARTS, STARTS_ASKED)]  # fmt: skip
    fitted = [part for part, run in zip(samples, runs, strict=True) if not run.track.run.hold_out]
    try:
        evidence, values, sd, prior = _solved(fitted, settings)
        values = _bounded(form, values, before)
        own = [_own(part, values, prior) for part in samples]
    except np.linalg.LinAlgError:
        return None
    planes = [_plane(run.track, form, made, values, starts)
              for run, made, starts in zip(runs, courses, own, strict=True)]  # fmt: skip
    left = [
        part.rows - part.shared @ values - part.own @ starts
        for part, starts in zip(samples, own, strict=True)
    ]
    by_run = {run.track.run.name: plane for run, plane in zip(runs, planes, strict=True)}
    gap = float(np.sqrt(np.mean(np.concatenate(left) ** 2)))
    return Fitted(form, evidence, _numbers(form, values, sd), by_run, gap), planes, values


def _setting(
    form: tuple[str, ...], part: float, start: float, turn: float, stiffness: float
) -> tuple[np.ndarray, np.ndarray]:
    """Standard deviations of what the runs share, and of springs, starts and zeros of a run.

    start : m off the axis, and as much in the time of a swing; turn : rad, likewise
    """
    shared = [SHARE_SD if name == SHARE else part * SD[name] for name in form]
    starts = [2.0 * stiffness, start, 10.0 * start, turn, 10.0 * turn]
    return np.array(shared), np.array([*starts, 1.0, 1.0])


def _samples(
    campaign: Campaign, track: SmoothTrack, form: tuple[str, ...], made: Course
) -> _Samples:
    """Measured y, and phi where the tracker has it, against a course."""
    rows, shared, own = [], [], []
    for axis, channel in enumerate(("y", "phi")):
        if channel not in track.run.motion.channels:
            continue
        noise = track.run.noise[channel]
        seen = np.isfinite(track.run.motion[channel])
        read = _reader(track, track.run.motion.time[seen])
        columns = read(made.columns[:, axis]) / noise
        turned = read(-track.place * (axis == 0)) / noise
        moving = iter(columns)
        shared.append(np.array([turned if name == ROTATION else next(moving) for name in form])
                      .reshape(len(form), turned.size).T)  # fmt: skip
        zeros = np.zeros((2, turned.size))
        zeros[axis] = campaign.zero_sd(track.run, channel) / noise
        own.append(np.vstack([*columns[-len(OWN) :], zeros]).T)
        rows.append((track.run.motion[channel][seen] - read(made.offset[axis])) / noise)
    return _Samples(np.concatenate(rows), np.concatenate(shared), np.concatenate(own))


def _reader(track: SmoothTrack, times: np.ndarray) -> Callable[[np.ndarray], np.ndarray]:
    """Values (..., n) on the grid to those at times (m,), s: (..., m)."""
    at = np.clip((times - track.time[0]) / track.interval, 0.0, track.time.size - 1.0)
    low = np.minimum(at.astype(int), track.time.size - 2)
    part = at - low
    return lambda values: values[..., low] * (1.0 - part) + values[..., low + 1] * part


def _solved(
    samples: Sequence[_Samples], settings: Sequence[tuple[np.ndarray, np.ndarray]]
) -> tuple[float, np.ndarray, np.ndarray, np.ndarray]:
    """ln evidence over settings; mean and sd of what is shared, and own priors, at the best."""
    count, own = samples[0].shared.shape[1], samples[0].own.shape[1]
    size = count + own * len(samples)
    gram, right, square = np.zeros((size, size)), np.zeros(size), 0.0
    for number, part in enumerate(samples):
        at = np.r_[0:count, count + own * number : count + own * (number + 1)]
        columns = np.hstack([part.shared, part.own])
        gram[np.ix_(at, at)] += columns.T @ columns
        right[at] += columns.T @ part.rows
        square += float(part.rows @ part.rows)
    found = [
        posterior(gram, right, square,
                  np.diag(np.concatenate([shared, *[each] * len(samples)]) ** 2))
        for shared, each in settings
    ]  # fmt: skip
    values = [each.log_evidence for each in found]
    best = int(np.argmax(values))
    evidence = float(logsumexp(values) - np.log(len(values)))
    deviations = np.sqrt(np.diag(found[best].covariance)[:count])
    return evidence, found[best].mean[:count], deviations, settings[best][1]


def _bounded(form: tuple[str, ...], shared: np.ndarray, before: np.ndarray) -> np.ndarray:
    """With friction across as good as isotropic at most, and no far step from the last round's."""
    for place, name in enumerate(form):
        if name == SHARE:
            low = max(before[place] - SHARE_STEP, LEAST_SHARE)
            shared[place] = np.clip(shared[place], low, min(before[place] + SHARE_STEP, MOST_SHARE))
    return shared


def _own(part: _Samples, shared: np.ndarray, sd: np.ndarray) -> np.ndarray:
    """Starts and zeros of a run where the shared numbers are known."""
    rows = part.rows - part.shared @ shared
    return posterior(part.own.T @ part.own, part.own.T @ rows, float(rows @ rows),
                     np.diag(sd**2)).mean  # fmt: skip


def _plane(
    track: SmoothTrack, form: tuple[str, ...], made: Course, shared: np.ndarray, own: np.ndarray
) -> Plane:
    values = {name: float(v) for name, v in zip(form, shared, strict=True) if name != ROTATION}
    starts = dict(zip(OWN, own, strict=False))
    return made.plane(track, values | {f"own {name}": float(v) for name, v in starts.items()})


def _numbers(
    form: tuple[str, ...], shared: np.ndarray, sd: np.ndarray
) -> dict[str, tuple[float, float]]:
    """ln g as the ratio sqrt(g)."""
    numbers = {}
    for name, value, deviation in zip(form, shared, sd, strict=True):
        if name == SHARE:
            ratio = min(float(np.exp(0.5 * value)), 1.0)  # above: mu_k is larger than assumed
            numbers["ratio"] = (ratio, 0.5 * ratio * float(deviation))
        else:
            numbers[name] = (float(value), float(deviation))
    return numbers
