"""A model with findings: which numbers of the kernel are fitted over the windows.

The weak form says which findings there are, and nearly how large; shooting fits the few numbers of
their laws, so that what is shown is the model that a unit would run.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from stickslip.effects.effect import FreeParameter, Scales
from stickslip.effects.periodic import MOST_HARMONIC
from stickslip.plugins.load import file_of

from cosim.gap.data import Campaign
from cosim.gap.laws import Context, FreeCurve, LawFit, free_curve, laws_of, scales_of
from cosim.gap.weak_form import rig_unknowns as rig
from cosim.gap.weak_form.camera_faults import SMOOTHING
from cosim.gap.weak_form.constants import ALIKE, CONTACT_DELAY, FAULT_SIZES, HARMONICS
from cosim.gap.weak_form.ladder import BY_SPEED, FALLS, Finding
from cosim.gap.weak_form.system import Rung, System
from cosim.gap.windows.numbers import Number
from cosim.gap.windows.run_model import (
    FORCE_PART,
    HEIGHT,
    LOADING,
    PER_WEIGHT,
    TABLE_PART,
    WITH_STIFFNESS,
    WITH_WEIGHT,
)
from cosim.gap.windows.windows import moves_across

#: Bounds of the contact's own numbers: friction falls over 0.3 to 20 mm/s, and over a small part of
#: the speeds of sliding; a loaded contact creeps at less than a third of the surface's speed.
TRANSITION, FALL_PART, CREEP_PART = (3e-4, 2e-2), 0.15, 0.3
TRANSITION_SPEED = "friction.transition_speed"
ROUNDING = "measurement.quantisation"
#: Longest time by which a contact lets go sooner, s, bristles of 100 um on a surface of 2 mm/s:
#: what follows the loading rate farther is static friction's own law.
LONGEST_DELAY = 0.05

#: Springs are at most so many times as stiff as stated.
STIFFER = (0.2, 5.0)
#: What is fitted of a curve that is the law.
CURVE_NUMBERS = (Number(HEIGHT, 1.0, None, 0.0, 2.0),)
#: A fault is at most so many times as large as is expected of one.
MOST_FAULT = 5.0

#: Parameters of laws of the sliding speed, or of the springs, that say how strong they are.
STRENGTHS = ("coefficient", "root_coefficient", "power", "saturating", "linear", "hyperbolic",
             "stribeck", "logarithmic", "cubic", "quintic")  # fmt: skip


@dataclass(frozen=True)
class Part:
    """What a finding puts into the model.

    curve : its free curve, or None; fits : the catalogue's laws on it, the best first
    numbers, settings : of the kernel; starts : labels -> values from which runs' own numbers start
    shifts : labels -> what the rows' value of a number of the rig has of the law
    """

    finding: Finding
    curve: FreeCurve | None = None
    fits: tuple[LawFit, ...] = ()
    numbers: tuple[Number, ...] = ()
    settings: dict[str, float] = field(default_factory=dict)
    starts: dict[str, float] = field(default_factory=dict)
    shifts: dict[str, float] = field(default_factory=dict)

    @property
    def in_model(self) -> bool:
        """Whether the curve itself is the law of the model."""
        return any(number.key == HEIGHT for number in self.numbers)

    @property
    def in_kernel(self) -> bool:
        """Whether the model has it at all."""
        return bool(self.numbers or self.settings)

    @property
    def effect(self) -> str:
        """Id in the catalogue: of the law, where one of the user's own does better."""
        return self.fits[0].effect if self.fits else self.finding.name

    def rivals(self, campaign: Campaign) -> list[LawFit]:
        """Other laws of this curve, each form of its effect and the best of each other: those
        nearly as probable, by e^3, and those of the user's own files, as a kink of theirs is no
        smooth curve. The best of all where the curve itself is in the model."""
        if not self.fits:
            return []
        best, own = self.fits[0], own_effects(campaign)
        others = {best.law: best}
        for fit in self.fits:
            if fit.price < best.price + 2.0 * ALIKE or fit.effect in own:
                form = fit.candidate.form if fit.effect == best.effect else ""
                others.setdefault((fit.effect, form), fit)
        return list(others.values())[0 if self.in_model else 1 :]


def rounding_of(campaign: Campaign) -> Part | None:
    """Numbers that are written in coarse steps, which are read off the digits; None where none are.

    No number of it is fitted: what rounding adds to the noise is in that of the runs.
    """
    steps = {run.name: run.rounding for run in campaign.runs if run.rounding}
    if not steps:
        return None
    some = len(steps) < sum(run.track is not None for run in campaign.runs)
    settings = {f"in@{name}": 1.0 for name in steps} if some else {}
    coarsest = max(step for of_run in steps.values() for step, _ in of_run.values())
    return Part(Finding(ROUNDING, (), 0.0, settings=settings), settings={ROUNDING: coarsest})


def part_of(
    campaign: Campaign, system: System, rung: Rung, finding: Finding, law: LawFit | None = None
) -> Part:
    """A finding's law and the numbers that are fitted of it; none where no effect stands for it.

    law : of this form; else that which is nearest to the curve, if it follows it
    """
    if finding.numbers:
        return _across(finding)
    if finding.main.unknown.wave is not None:
        return _wave(campaign, rung, finding)
    if finding.name.startswith("measurement."):
        return _fault(campaign, rung, finding)
    if finding.name == "load_dependence":
        weight = scales_of(campaign, system.runs, system.level.kinetic).force
        return _load(rung, finding, weight)
    if finding.name == "other.springs":
        stiffer = 1.0 + float(rung.posterior[0][rung.part_of(finding.main)][0])
        return Part(finding, numbers=(Number("springs.stiffness", stiffer, None, *STIFFER),))
    return _of_curve(campaign, system, rung, finding, law)


def _of_curve(
    campaign: Campaign, system: System, rung: Rung, finding: Finding, law: LawFit | None
) -> Part:
    """The law that follows a curve; the curve itself where none does and the model has it."""
    level, unknown = system.level, finding.main.unknown
    scales = scales_of(campaign, system.runs, level.kinetic)
    units = dict.fromkeys(("film_drag", "structural_damping"), level.kinetic * scales.force)
    units["spring_hardening"] = scales.travel * 4.0 * scales.stiffness
    at_rest = unknown.curve is not None and unknown.curve.per == "mu_k"
    kinetic = started_from(campaign, rung)[f"friction.{rig.MU_K}"]
    of_level = level.kinetic / kinetic if at_rest and kinetic > 0.0 else 1.0
    curve = free_curve(rung, finding, units.get(finding.name, of_level))
    if curve is None:
        return Part(finding)
    known = {**unknown.settings, "mu_s": level.static}
    fits = laws_of(finding.name, curve, Context(campaign, scales, known, own_effects(campaign)))
    if not fits:
        return Part(finding, curve)
    if law is not None:
        fits.sort(key=lambda fit: fit.law != law.law)
    best = fits[0]
    if not (law or best.follows) and (points := _points(campaign, finding, curve, scales)):
        return Part(finding, curve, tuple(fits), CURVE_NUMBERS, points)
    numbers, settings = _of_law(finding, best, scales)
    shifts = {}
    if finding.name == "static_strengthening":  # the rows' mu_s is that of the shortest hold
        shifts[f"friction.{rig.MU_S}"] = level.static * best.level
    return Part(finding, curve, tuple(fits), tuple(numbers), settings, shifts=shifts)


def _of_law(finding: Finding, fit: LawFit, scales: Scales) -> tuple[list[Number], dict[str, float]]:
    """Numbers of a law, from where the curve puts them, and what else the model then has."""
    known, settings = finding.main.unknown.settings, dict(fit.candidate.settings)
    numbers = [_number(free, fit.values.get(free.key, free.start))
               for free in fit.candidate.free_parameters]  # fmt: skip
    if finding.name in BY_SPEED:
        settings |= _of_load(finding, numbers, scales.force)
    if known.get("per_stiffness"):
        settings |= _scaled(WITH_STIFFNESS, numbers, scales.stiffness)
    if (share := known.get("static")) is not None:
        kind = "relative" if known["in_proportion"] else "absolute"
        start = 1.0 if kind == "relative" else share
        numbers.append(Number(f"{fit.effect}.static_{kind}", start, None, 0.0, 2.0))
    if finding.name == "thermal_weakening":
        memory = Number(f"{fit.effect}.relaxation_time", known["memory"], None, 0.05, 1e3, log=True)
        numbers = [*(n for n in numbers if n.key != memory.key), memory]
        settings[f"{fit.effect}.diffusion"] = known["diffusion"]
        if known["per_weight"]:
            settings[f"{PER_WEIGHT}.{fit.effect}.per_joule"] = scales.force
    return numbers, settings


def as_points(campaign: Campaign, system: System, part: Part) -> Part:
    """The same with its curve in place of the law; itself where the model has no such table."""
    if part.curve is None:
        return part
    scales = scales_of(campaign, system.runs, system.level.kinetic)
    points = _points(campaign, part.finding, part.curve, scales)
    return replace(part, numbers=CURVE_NUMBERS, settings=points, shifts={}) if points else part


def _points(
    campaign: Campaign, finding: Finding, curve: FreeCurve, scales: Scales
) -> dict[str, float]:
    """A curve that no law follows, as the springs' force curve or as the table of friction.

    Of 2 n - 1 points that a force curve may have; {} where the model has no such table.
    """
    at, value = curve.at[[0, *range(2, curve.at.size)]], curve.mean[[0, *range(2, curve.at.size)]]
    if finding.name == "spring_hardening" and finding.main.unknown.settings["per_stiffness"]:
        more = value / (4.0 * scales.stiffness)
        # along x two springs are stretched by what the others lose: odd about their tension
        stretch = np.concatenate([-at[:0:-1], at])
        part = scales.extension + stretch + np.concatenate([-more[:0:-1], more])
        points = zip(scales.extension + stretch, np.maximum.accumulate(part), strict=True)
        names = ("springs.force_curve_extension", FORCE_PART)
    elif finding.name == FALLS and campaign.friction_table is None:
        points = zip(at, np.maximum(1.0 + value - value[0], 0.0), strict=True)
        names = ("friction.table_speed", TABLE_PART)
    else:
        return {}
    return {
        f"{name}[{number}]": float(one)
        for number, pair in enumerate(points, 1)
        for name, one in zip(names, pair, strict=True)
    }


def _of_load(finding: Finding, numbers: Sequence[Number], force: float) -> dict[str, float]:
    """A film is of the contact, a law of mu_k of the load; other findings are scaled."""
    curve = finding.main.unknown.curve
    of_weight = curve is not None and curve.per == "mu_k"
    if of_weight == (finding.name == FALLS):
        return {}
    return _scaled(WITH_WEIGHT if of_weight else PER_WEIGHT, numbers, force)


def _scaled(how: str, numbers: Sequence[Number], typical: float) -> dict[str, float]:
    """A law's strengths, which are what they say at a typical weight or stiffness."""
    strengths = [n.key for n in numbers if n.key.rpartition(".")[2] in STRENGTHS]
    return {f"{how}.{key}": typical for key in strengths}


def own_effects(campaign: Campaign) -> frozenset[str]:
    """Ids of the effects of the user's own files."""
    return frozenset(effect.id for effect in campaign.catalogue.effects if file_of(effect))


def _number(free: FreeParameter, value: float) -> Number:
    """A free parameter of a law, from where the curve puts it."""
    inside = min(max(value, free.low), free.high)
    if free.log:
        inside = max(inside, 1e-12)
    elif free.low <= 0.0 <= free.high and inside == 0.0:
        inside = 0.1 * free.start  # at 0 the motion does not feel what else the law has
    scope = "run" if free.per_run else "campaign"
    return Number(free.key, inside, None, free.low, free.high, scope, free.log)  # type: ignore[arg-type]


#: What moves the block across, as y has it -> the model's number, its unit, and its bound either
#: way: 1/m, degrees, m, rad.
_ACROSS = {
    "curvature": ("turning_surface.curvature", 1.0, 20.0),
    "turn": ("spring_misalignment.angle_deg", 180.0 / math.pi, 60.0),
    "frame": ("spring_misalignment.frame_angle_deg", 180.0 / math.pi, 60.0),
    "shift": ("spring_misalignment.lateral_offset", 1.0, 1.0),
    "diagonal": ("spring_misalignment.diagonal_offset", 1.0, 1.0),
    "rotation": ("measurement.rotation", 1.0, 0.5),
}


def _across(finding: Finding) -> Part:
    """What moves the block across: its numbers as y has them; friction across as it is or not."""
    numbers = []
    settings = {f"{finding.name}_{name}": value for name, value in finding.settings.items()}
    for name, (value, _) in finding.numbers.items():
        if what := _ACROSS.get(name.rpartition(".")[2]):
            key, unit, most = what
            numbers.append(Number(key, unit * value, None, -most, most))
        elif name == "ratio":
            settings["lateral_friction.ratio"] = 1.0
    return Part(finding, numbers=tuple(numbers), settings=settings)


def _fault(campaign: Campaign, rung: Rung, finding: Finding) -> Part:
    """A camera's fault: its size, one for all runs in which it is; a zero is each run's own."""
    unknown, key = finding.main.unknown, finding.name
    if key == "measurement.zero":  # in place of what is stated of it
        sd = FAULT_SIZES["zero"]
        zero = Number("offset.x", 0.0, sd, -MOST_FAULT * sd, MOST_FAULT * sd, "run")
        return Part(finding, numbers=(zero,))
    size = float(rung.posterior[0][rung.part_of(finding.main)][0])
    most = MOST_FAULT * FAULT_SIZES[key.partition(".")[2]]
    least = -most
    if key == SMOOTHING:  # the rows have a part of the filter's variance
        size = unknown.settings["width"] * math.sqrt(max(size, 0.0))
        least, most = 0.0, MOST_FAULT * unknown.settings["width"]
    settings = {f"{key}_{name}": value for name, value in unknown.settings.items()}
    numbers = [Number(key, size, None, least, most)]
    if key == "measurement.drift" and moves_across(campaign):
        numbers.append(Number(f"{key}_y", 0.0, None, least, most))
    return Part(finding, numbers=tuple(numbers), settings=settings)


def _load(rung: Rung, finding: Finding, weight: float) -> Part:
    """A power of the normal force, from the trend over its logarithm."""
    unknown = finding.main.unknown
    slope = float(rung.posterior[0][rung.part_of(finding.main)][0]) / unknown.settings["span"]
    number = Number("load_dependence.exponent", -slope, None, -2.0, 2.0)
    settings = {"load_dependence.reference_force": weight}
    return Part(finding, numbers=(number,), settings=settings)


def _wave(campaign: Campaign, rung: Rung, finding: Finding) -> Part:
    """Amplitude, period and phases of a wave, with the harmonics that the model has."""
    wave = finding.main.unknown.wave
    sizes = rung.posterior[0][rung.part_of(finding.main)]
    first = complex(sizes[0], -sizes[HARMONICS])
    name, length = finding.name, 1.0 / wave.wavenumber
    amplitude = abs(first)
    # the model's pattern is a cosine of x less the surface's travel, its ripple a sine of the time
    pattern = name == "surface_pattern"
    if name == "other.shaking":
        return Part(finding)
    numbers = [
        Number(f"{name}.amplitude", amplitude, None, 0.0, 1.0),
        Number(f"{name}.phase_deg", 0.0, None, -360.0, 360.0, "run"),
    ]
    settings: dict[str, float] = {}
    starts: dict[str, float] = {}
    if pattern:
        numbers.append(Number(f"{name}.wavelength", length, None, 0.9 * length, 1.1 * length))
        # a set-point that is off by a percent gets ahead by whole waves in a run
        numbers.append(set_point(campaign))
        starts |= {f"offset.speed@{run}": part for run, part in wave.faster.items()}
    turn = math.degrees(np.angle(first))
    for run in campaign.runs:  # also those of too few samples for rows
        angle = turn - math.degrees(wave.phases.get(run.name, 0.0))
        phase = -angle if pattern else angle + 90.0
        starts[f"{name}.phase_deg@{run.name}"] = (phase + 180.0) % 360.0 - 180.0
        if name == "speed_ripple":
            pace = 1.0 + wave.faster.get(run.name, 0.0)
            pace *= abs(run.surface_speed) if wave.kind.unit == "m" else 1.0
            settings[f"{name}.frequency@{run.name}"] = wave.wavenumber * pace
    for order, which in enumerate(("second", "third", "fourth"), 2):
        size = complex(sizes[order - 1], -sizes[HARMONICS + order - 1])
        # b of cos(n a + b), or sin(n a + b), a the angle of the first
        ahead = math.degrees(np.angle(size)) - order * turn
        phase = -ahead if pattern else ahead - 90.0 * (order - 1)
        settings[f"{name}.{which}_amplitude"] = min(abs(size) / amplitude, float(MOST_HARMONIC))
        settings[f"{name}.{which}_phase_deg"] = (phase + 180.0) % 360.0 - 180.0
    return Part(finding, None, (), tuple(numbers), settings, starts)


def contact_numbers(campaign: Campaign, fastest: float) -> list[Number]:
    """How the contact lets go: the fall to mu_k, creep under load, loss under fast loading.

    fastest : sliding speed of the campaign, m/s
    """
    slowest = min(abs(run.surface_speed) for run in campaign.runs)
    top = min(TRANSITION[1], max(FALL_PART * fastest, 2.0 * TRANSITION[0]))
    return [
        Number(TRANSITION_SPEED, min(4e-3, 0.5 * top), None, TRANSITION[0], top, log=True),
        # below 1 friction falls infinitely fast at rest: no contact does, and steps would crawl
        Number("friction.transition_exponent", 1.3, 0.5, 1.0, 3.0),
        Number("friction.stick_creep", 0.03 * slowest, None, 0.0, CREEP_PART * slowest),
        Number(LOADING, 0.0, CONTACT_DELAY, -LONGEST_DELAY, LONGEST_DELAY),
    ]


def scatter_numbers(campaign: Campaign, scatter: float) -> list[Number]:
    """What differs from run to run: friction, and the surface's speed from its set-point.

    scatter : standard deviation of friction, relative. Over three cycles 1 % of the speed adds up
    to a tenth of a cycle's stick, far more than the noise; held-out runs have errors of their own,
    which no fitted run can tell.
    """
    friction = Number("offset.friction", 0.0, scatter, -4.0 * scatter, 4.0 * scatter, "run")
    return [friction, set_point(campaign)]


def set_point(campaign: Campaign) -> Number:
    """By which part each run's surface is faster than stated."""
    sd = campaign.errors.surface_speed
    return Number("offset.speed", 0.0, sd, -3.0 * sd, 3.0 * sd, "run")


def started_from(campaign: Campaign, rows: Rung) -> dict[str, float]:
    """label -> value of the rig's numbers, as the rows have them: where a fit sets out."""
    own = [run.track.run for run in rows.system.fitted]
    starts: dict[str, float] = {}

    def of_runs(key: str, values: np.ndarray) -> None:
        labels = (f"{key}@{run.name}" for run in own)
        starts.update(zip(labels, values.tolist(), strict=True))

    for each in rows.base:
        name, values = each.unknown.name, rows.posterior[0][rows.part_of(each)]
        if name == rig.MU_K or (name == rig.MU_S and any(run.events for run in rows.system.fitted)):
            starts[f"friction.{name}"] = float(values[0])
        elif name == rig.MU_S:  # no break-away is seen: a model with other springs may show them
            excess = rows.system.level.static / rows.system.level.kinetic
            starts["friction.mu_s"] = excess * starts["friction.mu_k"]
        elif name == rig.SPRINGS:
            factor = math.log1p(max(float(values[0]), -0.5))
            setups = {
                campaign.setup_of(run) for run in own if rig.setup_of(run) == each.unknown.variant
            }
            starts |= {f"offset.stiffness@setup {setup}": factor for setup in setups}
        elif name == rig.ZERO_NAME:
            of_runs("offset.x", values * [campaign.zero_sd(run) for run in own])
        elif name == rig.SPEED:
            of_runs("offset.speed", values)
        elif name == rig.SCATTER and each.unknown.variant == "both":
            of_runs("offset.friction", values)
        elif name == rig.CONTACT and each.unknown.variant == "loading":
            starts[LOADING] = -float(values[0])
    return starts
