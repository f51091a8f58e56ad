"""Which effect moves the block across the surface, and the rows along x with it.

Effects are compared by how probable the measured y (and phi) are with each, as courses of the whole
record (`across`): all of them are made of the same x(t), friction level and noise, and the samples
are the same for all. "Nothing across" is a block that keeps its y, or swings freely in it, before a
camera that keeps its place or creeps.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from itertools import product
from typing import Any

import numpy as np
from scipy.interpolate import interp1d
from scipy.special import logsumexp

from cosim.gap.data import Campaign
from cosim.gap.data.campaign_file import Rig
from cosim.gap.weak_form.across import (
    ASKEW,
    CURVATURE,
    DIAGONAL,
    FRAME,
    SHARE,
    SHIFT,
    SPRINGS,
    STATES,
    TURN,
    Course,
    Plane,
    course,
    disc,
    measured,
    moves_across,
)
from cosim.gap.weak_form.camera_faults import COURSES, DRIFT, crept
from cosim.gap.weak_form.constants import (
    ALIKE,
    FAULT_SIZES,
    LEAST_FAR,
    LEAST_GAIN,
    LEAST_SHARE,
    MOST_SHARE,
    PLANE_FOLLOWED,
    PLANE_PART,
    ROUNDS,
    SCALES_ASKED,
    SHARE_STEP,
    SLOWEST_SLIDING,
    START_TURN,
    STARTS_ASKED,
    STILL_NUMBER,
    TURNS_ASKED,
)
from cosim.gap.weak_form.evidence import posterior
from cosim.gap.weak_form.rig_unknowns import Level
from cosim.gap.weak_form.rows import RunRows, rows_of
from cosim.gap.weak_form.track import SmoothTrack

#: Numbers of a run at the end of its own: zeros of y and phi.
ZEROS = 2
LATERAL, TURNING, MISALIGNED, ROTATION = (
    "lateral_friction", "turning_surface", "spring_misalignment", "measurement.rotation",
)  # fmt: skip
#: Unknowns of a camera's zero that creeps across -> its course.
CREEPS = {f"{DRIFT}, {course}": course for course in COURSES}
#: Effect, or nothing -> its forms: the unknowns that they have.
FORMS: dict[str, tuple[tuple[str, ...], ...]] = {
    "": ((), *((creep,) for creep in CREEPS)),
    ROTATION: ((ROTATION,),),
    LATERAL: ((SHARE,),),
    TURNING: ((CURVATURE, SHARE), (CURVATURE, ASKEW, SHARE)),
    MISALIGNED: tuple((*some, *share) for share in ((SHARE,), ())
                      for some in ((TURN,), (FRAME,), (SHIFT,), (TURN, SHIFT), (SHIFT, DIAGONAL))),
}  # fmt: skip
#: What is expected at the largest, as standard deviations: curvature (1/m), turns (rad), shifts (m)
#: and camera angle (rad), creep of its zero (m), of which parts are tried; ln g, g the square of
#: lateral_friction.ratio, about isotropic friction.
SD = {
    CURVATURE: 3.0,
    ASKEW: 0.2,
    TURN: 0.2,
    FRAME: 0.2,
    SHIFT: 0.03,
    DIAGONAL: 0.03,
    ROTATION: 0.2,
    SHARE: 0.5,
}
SD |= dict.fromkeys(CREEPS, FAULT_SIZES["drift"])


@dataclass(frozen=True)
class Fitted:
    """A form with the numbers that y asks for.

    evidence : ln; numbers : unknown -> (value, sd), SHARE as lateral_friction.ratio;
    planes : run -> motion in the plane; gap : rms of what is left of y and phi, and of how far
    each run's own numbers are from what they are beforehand; noise units, standard deviations
    turned : names of the runs in which the camera may be
    """

    form: tuple[str, ...]
    evidence: float
    numbers: Mapping[str, tuple[float, float]]
    planes: Mapping[str, Plane] = field(repr=False)
    gap: float
    turned: frozenset[str]

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

    @property
    def settings(self) -> dict[str, float]:
        """In which runs the camera is turned, where not in all."""
        if self.answer != ROTATION:
            return {}
        turned = self.fits[ROTATION].turned
        names = self.fits[ROTATION].planes
        return {f"in@{name}": float(name in turned) for name in names if turned < set(names)}


#: Of a campaign whose blocks go along x alone.
NOTHING = Planar({}, "", "", {})


def planar_effects(campaign: Campaign, runs: Sequence[RunRows]) -> Planar:
    """The effect that moves the block across, by evidence; runs held out are predicted alone."""
    runs = [run for run in runs if run.track.y is not None and run.track.slips]
    if not any(moves_across(run.track.run) for run in runs):
        return NOTHING
    free = set(campaign.rig.degrees_of_freedom) >= {"y", "phi"}
    level = Level.of(list(runs)).kinetic
    fits, evidence = {}, {}
    every = frozenset(run.track.run.name for run in runs)
    moving = frozenset(run.track.run.name for run in runs if moves_across(run.track.run))
    turns = any(run.track.phi is not None for run in runs)
    for name in FORMS if free else ("", ROTATION):
        among = (every, moving) if name == ROTATION and moving < every else (every,)
        # a diagonal that is off turns the block: without that it would be any swing's name
        tried = [_best_fit(campaign, runs, level, form, turned)
                 for form in FORMS[name] if turns or DIAGONAL not in form
                 for turned in among]  # fmt: skip
        fits[name] = max(tried, key=lambda each: each.evidence)
        evidence[name] = float(logsumexp([each.evidence for each in tried]) - np.log(len(tried)))
    nothing = evidence.pop("")
    if not np.isfinite(nothing):
        return NOTHING
    noise = max(max(fits.values(), key=lambda each: each.evidence).gap, 1.0)
    # what no form explains counts as noise
    evidence = {name: (value - nothing) / noise**2 for name, value in evidence.items()}
    ranked = sorted(evidence, key=lambda name: -evidence[name])
    lateral = evidence.get(LATERAL, -np.inf)
    if evidence[ranked[0]] - lateral < max(LEAST_GAIN, PLANE_FOLLOWED * lateral):
        ranked.insert(0, ranked.pop(ranked.index(LATERAL)))  # it is in the others, with a zero
    best = ranked[0]
    explains = fits[best].misfit < PLANE_PART * fits[""].misfit
    is_swing = "ratio" not in fits[best].numbers and _is_zero(fits[best])
    answer = best if evidence[best] > LEAST_GAIN and explains and not is_swing else ""
    alike = [name for name, one in fits.items()
             if answer == LATERAL and "ratio" in one.numbers and _is_zero(one)]  # fmt: skip
    rivals = [name for name in ranked if name not in (answer, *alike)]
    return Planar(evidence, answer, rivals[0] if evidence[rivals[0]] > 0.0 else "", fits)


def _is_zero(fitted: Fitted) -> bool:
    """Whether a form's numbers may be zero, but for friction across and a surface askew."""
    numbers = [one for name, one in fitted.numbers.items() if name not in ("ratio", ASKEW)]
    return all(abs(value) < STILL_NUMBER * sd for value, sd in numbers)


def rows_in_plane(
    tracks: Sequence[SmoothTrack], campaign: Campaign, planar: Planar
) -> list[RunRows]:
    """Rows along x of all runs, with the effect in them that moves the block across.

    Springs, sliding speed and surface are those of the place in the plane; friction along x is its
    part f U_x / U.
    """
    planes = planar.fits[planar.answer].planes if planar.fits else {}
    rows = []
    for track in tracks:
        plane = planes.get(track.run.name)
        inside = track if plane is None else _in_plane(track, plane, campaign.rig)
        rows.append(rows_of(inside, campaign.rig, plane))
    return rows


def _in_plane(track: SmoothTrack, plane: Plane, rig: Rig) -> SmoothTrack:
    """The sliding speed in the plane, its sign that along x, and the part of friction along x.

    Friction goes with the velocity across scaled by the ratio (`stickslip.kernel.friction`).
    """
    along, sliding, spin = plane.sliding(track, rig.contact_radius)
    force, _ = disc(sliding, spin)
    part = force * along / np.maximum(sliding, SLOWEST_SLIDING)
    return replace(track, sliding=np.copysign(sliding, along), part=part)


@dataclass(frozen=True)
class _Samples:
    """Samples of one run, in units of noise, and what its unknowns do to them.

    rows : (m,) less what is known; shared, own : (m, u) columns
    """

    rows: np.ndarray
    shared: np.ndarray
    own: np.ndarray


def _best_fit(
    campaign: Campaign, runs: Sequence[RunRows], level: float, form: tuple[str, ...],
    turned: frozenset[str],
) -> Fitted:  # fmt: skip
    """The most probable from springs along x, and of a block that nothing holds from turned ones.

    It keeps swinging by the error of a first guess, so that springs turned by far are found from
    near them alone. What came back from there to next to nothing is a swing, and no turn.
    """
    tried = [_fit(campaign, runs, level, form, turned, {})]
    for name in {TURN, FRAME} & set(form) if SHARE not in form else ():
        far = (_fit(campaign, runs, level, form, turned, {name: turn}) for turn in TURNS_ASKED)
        tried += [each for each in far if abs(each.numbers.get(name, (0.0, 0.0))[0]) > LEAST_FAR]
    return max(tried, key=lambda each: each.evidence)


def _fit(
    campaign: Campaign, runs: Sequence[RunRows], level: float, form: tuple[str, ...],
    turned: frozenset[str], about: Mapping[str, float],
) -> Fitted:  # fmt: skip
    """A form, its courses made anew about what came out until they stay.

    turned : runs in which the camera may be; about : numbers of the form that it sets out from
    """
    start: dict[str, Any] = {"share": float(SHARE in form), **about}
    planes = [replace(measured(run.track), **start) for run in runs]
    values, rounds = np.array([about.get(name, 0.0) for name in form]), []
    nothing = Fitted(form, -np.inf, {}, {}, np.inf, turned)
    for _ in range(ROUNDS):
        try:
            found, values = _round(campaign, runs, level, form, planes, values, turned)
        except np.linalg.LinAlgError:  # the courses run away
            break
        planes = list(found.planes.values())
        rounds.append(found)
        before = max((each.evidence for each in rounds[1:-1]), default=-np.inf)
        if abs(found.evidence - before) < 0.1 * ALIKE:
            break
    return max(rounds[1:], key=lambda each: each.evidence, default=nothing)


def _round(
    campaign: Campaign, runs: Sequence[RunRows], level: float, form: tuple[str, ...],
    planes: Sequence[Plane], before: np.ndarray, turned: frozenset[str],
) -> tuple[Fitted, np.ndarray]:  # fmt: skip
    """The numbers from courses about the last round's."""
    moving = tuple(name for name in form if name not in (ROTATION, *CREEPS))
    courses = [
        course(run.track, campaign.rig, level * run.weight, moving, plane)
        for run, plane in zip(runs, planes, strict=True)
    ]
    samples = [_samples(campaign, run.track, form, made, run.track.run.name in turned)
               for run, made in zip(runs, courses, strict=True)]  # fmt: skip
    turn = START_TURN[any(run.track.phi is not None for run in runs) or SHARE not in form]
    fitted = [part for part, run in zip(samples, runs, strict=True) if not run.track.run.hold_out]
    evidence, values, sd, prior_of = _solved(fitted, form, turn, campaign.errors.stiffness)
    for place, name in enumerate(form):
        if name == SHARE:  # friction across as good as isotropic at most, and no far step
            low, high = before[place] - SHARE_STEP, before[place] + SHARE_STEP
            values[place] = np.clip(values[place], max(low, LEAST_SHARE), min(high, MOST_SHARE))
    found, left = {}, []
    for run, made, part in zip(runs, courses, samples, strict=True):
        rows, prior = part.rows - part.shared @ values, prior_of(part)
        gram, right = part.own.T @ part.own, part.own.T @ rows
        own = posterior(gram, right, float(rows @ rows), np.diag(prior**2)).mean
        left += [rows - part.own @ own, own / prior]
        known = {name: float(v) for name, v in zip(form, values, strict=True) if name in moving}
        starts = {f"own {number}": float(v) for number, v in enumerate(own[:-ZEROS])}
        found[run.track.run.name] = made.plane(run.track, known | starts)
    gap = float(np.sqrt(np.mean(np.concatenate(left) ** 2)))
    return Fitted(form, evidence, _numbers(form, values, sd), found, gap, turned), values


def _samples(
    campaign: Campaign, track: SmoothTrack, form: tuple[str, ...], made: Course, is_turned: bool
) -> _Samples:
    """Measured y, and phi where the tracker has it, against a course."""
    rows, shared, own = [], [], []
    for axis, channel in enumerate(("y", "phi")):
        if channel not in track.run.motion.channels:
            continue
        noise, values = track.run.noise[channel], track.run.motion[channel]
        seen = np.isfinite(values)
        times = np.clip(track.run.motion.time[seen], *track.time[[0, -1]])
        # columns of what the form has, of a run's own, and the course without either
        every = np.vstack([made.columns[:, axis], made.offset[axis]])
        *columns, offset = interp1d(track.time, every)(times) / noise
        moving = iter(columns)  # what the form has first, then what is the run's own
        zeros = np.zeros((ZEROS, times.size))
        zeros[axis] = campaign.zero_sd(track.run, channel) / noise
        camera = (axis == 0) * _of_camera(track, form, is_turned, times) / noise
        shared.append(np.reshape([seen_so if name in (ROTATION, *CREEPS) else next(moving)
                                  for name, seen_so in zip(form, camera, strict=True)],
                                 (len(form), times.size)).T)  # fmt: skip
        own.append(np.vstack([*moving, zeros]).T)
        rows.append(values[seen] / noise - offset)
    return _Samples(np.concatenate(rows), np.concatenate(shared), np.concatenate(own))


def _of_camera(
    track: SmoothTrack, form: tuple[str, ...], is_turned: bool, times: np.ndarray
) -> np.ndarray:
    """(unknowns, times) m of y by what a camera does of a form; 0 for what moves the block."""
    seen = np.zeros((len(form), times.size))
    for row, name in zip(seen, form, strict=True):
        if name == ROTATION and is_turned:
            row[:] = -np.interp(times, track.time, track.place)
        elif name in CREEPS:
            row[:] = crept(CREEPS[name], track.time, times)
    return seen


def _solved(
    samples: Sequence[_Samples], form: tuple[str, ...], turn: float, stiffness: float
) -> tuple[float, np.ndarray, np.ndarray, Callable[[_Samples], np.ndarray]]:
    """ln evidence over settings; at the best: mean, sd of what is shared, and a run's own priors.

    turn : how far a block may be turned where it is put down, rad, and as much in a tenth of a
    second; stiffness : stated error of the springs. Where a record goes on after a hole the block
    may be anywhere.
    """
    count = samples[0].shared.shape[1]
    ends = np.cumsum([count, *(part.own.shape[1] for part in samples)])
    gram, right, square = np.zeros((ends[-1], ends[-1])), np.zeros(ends[-1]), 0.0
    for part, first, last in zip(samples, ends[:-1], ends[1:], strict=True):
        at = np.r_[0:count, first:last]
        columns = np.hstack([part.shared, part.own])
        gram[np.ix_(at, at)] += columns.T @ columns
        right[at] += columns.T @ part.rows
        square += float(part.rows @ part.rows)

    def prior_of(start: float, part: _Samples) -> np.ndarray:
        springs, anywhere = [2.0 * stiffness] * SPRINGS, (STARTS_ASKED[-1], START_TURN[-1])
        states = [[y, 10.0 * y, phi, 10.0 * phi] for y, phi in ((start, turn), anywhere)]
        further = (part.own.shape[1] - SPRINGS - ZEROS) // STATES - 1
        return np.array([*springs, *states[0], *states[1] * further, *[1.0] * ZEROS])

    found = []
    for scale, start in product(SCALES_ASKED[1:], STARTS_ASKED):
        shared = [SD[name] * (1.0 if name == SHARE else scale) for name in form]
        prior = np.concatenate([shared, *(prior_of(start, part) for part in samples)])
        found.append((posterior(gram, right, square, np.diag(prior**2)), start))
    evidence = float(logsumexp([one.log_evidence for one, _ in found]) - np.log(len(found)))
    best, start = max(found, key=lambda pair: pair[0].log_evidence)
    sd = np.sqrt(np.diag(best.covariance)[:count])
    return evidence, best.mean[:count], sd, partial(prior_of, start)


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
