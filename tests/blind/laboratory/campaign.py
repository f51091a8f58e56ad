"""A campaign: what is hidden is drawn, given its size and run, until it shows."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from . import fresh_kinds, fresh_laws, held_back, out_of_catalogue
from .apparatus import JUMP, Record
from .cold_room import draw_room, room_camera, room_tracker
from .laws import LAWS, Law, Reference
from .plans import RIGS, Plan, draw_plan
from .recording import FAULTS, FRESH_FAULTS, Fault, Tracker, draw_tracker
from .simulation import SAMPLE, SLIP, STEP, at_rest_on_belt, simulate
from .size import Size, measure

KINDS = out_of_catalogue.KINDS | held_back.KINDS | fresh_kinds.KINDS
PLANAR = {"lateral_friction", "turning_surface", "spring_misalignment", "measurement.rotation"}
GUIDED = {"guide_friction", "slack_springs", "measurement.latency"}  # x alone, a wide field
DAMPING = {"film_drag", "structural_damping", "guide_friction"}  # would still fast runs
TRIES = 40  # campaigns drawn at most until one shows what it hides
SEARCH = 6  # strengths tried at most for a size
LARGEST = 4  # over the largest size asked for, beyond which a campaign is drawn anew
COARSE = 2  # a search's steps over a record's own
FINEST = 2e-5  # m, noise of the best tracker


@dataclass(frozen=True)
class Order:
    """What a campaign is to be."""

    contact: str
    effects: tuple[str, ...] = ()
    fault: str | None = None
    kind: str | None = None  # out of the catalogue
    scatter: float = 0.0
    sizes: tuple[float, float] = (5.0, 25.0)  # noise units, of each hidden thing by itself
    exponents: dict[str, float] = field(default_factory=dict)  # of the effect's strength, wrong
    alike: tuple[str, ...] = ()  # what the runs, of one speed and mass, cannot tell apart
    some_runs: bool = False  # the fault is in some of the runs only
    creeping: float | None = None  # of the Iwan contact, 0 to 1; drawn if left out

    @property
    def in_room(self) -> bool:
        """Whether rig, camera and laws are those that go with the Iwan contact."""
        return self.contact == "iwan"


@dataclass(frozen=True)
class Hidden:
    """One hidden thing with its strength found."""

    name: str
    shape: str
    text: str
    strength: float
    apply: Callable[[Record, float], None]
    law: Law | None = None


@dataclass(frozen=True)
class Campaign:
    order: Order
    plan: Plan
    hidden: tuple[Hidden, ...]
    sizes: tuple[Size, ...]
    fault: tuple[Fault, float] | None
    tracker: Tracker
    records: tuple[Record, ...]
    motions: tuple[NDArray, ...]
    rng: np.random.Generator  # of the recording
    fault_runs: tuple[int, ...] = ()  # places of the runs that the fault is in


def own_step(p: Record) -> float:
    """The step of a record's integrator, s: shorter for the one of first order."""
    return STEP / 2 if p["contact"] == JUMP else STEP


def with_hidden(plain: Record, hidden: Sequence[Hidden]) -> Record:
    p = plain.copy()
    for each in hidden:
        each.apply(p, each.strength)
    return p


def move(plan: Plan, records: Sequence[Record], coarse: int = 1) -> list[NDArray]:
    """Rows of every run."""
    return [
        simulate(p, at_rest_on_belt(p, *run.start), plan.duration, step=own_step(p) * coarse)
        for run, p in zip(plan.runs, records, strict=True)
    ]


def draw_hidden(order: Order, rng: np.random.Generator, reference: Reference) -> list[Hidden]:
    """Laws and kinds of an order, at the strengths to begin with."""
    found = []
    fresh = fresh_laws.ALIKE if order.alike else fresh_laws.LAWS
    for name in order.effects:
        law = (fresh if order.in_room else LAWS)[name](rng, reference)
        if order.exponents:
            shape = law.shape.split(", per ")[0]
            law = replace(law, shape=shape, exponents=order.exponents)

        def apply(p: Record, strength: float, law: Law = law) -> None:
            law.apply(p, strength, reference)

        found.append(Hidden(name, law.shape, law.text, law.start, apply, law))
    if order.kind:
        kind, seed = KINDS[order.kind], int(rng.integers(2**32))

        def disturb(p: Record, strength: float) -> None:  # each run the same numbers
            kind(p, strength, np.random.default_rng(seed), reference)

        text = " ".join((kind.__doc__ or "").split())
        found.append(Hidden(order.kind, order.kind, text, 0.3, disturb))
    return found


def plain_records(plan: Plan) -> list[Record]:
    return [run.plain for run in plan.runs]


def sized(
    plan: Plan,
    hidden: Sequence[Hidden],
    j: int,
    tracker: Tracker,
    motions: Sequence[NDArray],
    coarse: int = 1,
) -> Size:
    """Size of the j-th hidden thing in the motions of a plan, beside the others."""
    rest = [each for i, each in enumerate(hidden) if i != j]
    without = [with_hidden(p, rest) for p in plain_records(plan)]
    axes = 2 if tracker.with_y else 1
    return measure(without, motions, tracker.noise, axes, own_step(without[0]) * coarse)


def find_strength(
    plan: Plan, hidden: list[Hidden], j: int, tracker: Tracker, target: float
) -> Hidden:
    """The j-th hidden thing at the strength that has about the target's size, if it can.

    Sought on four runs (all speeds, two masses), on all where masses matter; a strength that stills
    one of them is too much.
    """
    each = hidden[j]
    most = each.law.most if each.law else 2.0
    if each.law and not each.law.sized:
        return each
    some = plan if each.name == "load_dependence" else replace(plan, runs=plan.runs[:4])
    strength, tried = min(each.strength, most), []
    for _ in range(SEARCH):
        others = [replace(h, strength=strength) if i == j else h for i, h in enumerate(hidden)]
        records = [with_hidden(p, others) for p in plain_records(some)]
        motions = move(some, records, COARSE)
        if not lively(some, motions, tracker.noise, 1):
            most, strength = 0.6 * strength, 0.4 * strength
            continue
        size = sized(some, others, j, tracker, motions, COARSE).size
        tried.append((abs(np.log(max(size, 1e-6) / target)), strength))
        if tried[-1][0] < 0.25 or (strength == most and size < target):
            break
        change = float(np.clip((target / max(size, 1e-6)) ** 0.9, 0.1, 8))
        strength = float(np.clip(strength * change, 1e-4, most))
    return replace(each, strength=min(tried)[1] if tried else strength)


def find_amount(
    plan: Plan, motions: Sequence[NDArray], order: Order, tracker: Tracker, target: float, rng
) -> tuple[Fault, float]:
    """A fault of the camera, with an amount of about the target's size where that is sought."""
    ways, (low, high), sought = (FRESH_FAULTS if order.in_room else FAULTS)[str(order.fault)]
    what = ways[int(rng.integers(len(ways)))]
    amount = float(np.exp(rng.uniform(np.log(low), np.log(high))))
    some, coarse = (4, COARSE) if order.in_room else (len(motions), 1)
    few = replace(plan, runs=plan.runs[:some])
    for _ in range(SEARCH if sought else 0):
        size = fault_size(few, motions[:some], (what, amount), tracker, coarse).size
        if abs(np.log(size / target)) < 0.2:
            break
        amount = float(np.clip(amount * np.clip((target / size) ** 0.8, 0.2, 5), low, high))
    return what, amount * (float(rng.choice((-1, 1))) if what.__name__ in SIGNED else 1.0)


SIGNED = {"scale", "clock", "rotation", "creep", "sagging"}


def fault_size(
    plan: Plan, motions, fault: tuple[Fault, float], tracker: Tracker, coarse: int = 1
) -> Size:
    axes = 2 if tracker.with_y else 1
    plains = plain_records(plan)
    return measure(plains, motions, tracker.noise, axes, own_step(plains[0]) * coarse, fault)


def lively(plan: Plan, motions: Sequence[NDArray], noise: float, wanted: int = 2) -> bool:
    """Whether all runs swing most of the time, in the rig's reach; `wanted` ones stick and slip."""
    sticks = 0
    for run, rows in zip(plan.runs, motions, strict=True):
        if not np.isfinite(rows).all() or np.abs(rows[:, 0]).max() > 0.6 * plan.spring_length:
            return False
        if np.abs(rows[:, 1]).max() > 0.03 or np.abs(rows[:, 2]).max() > 0.5:
            return False
        window = round(1.5 / SAMPLE)
        parts = rows[: len(rows) // window * window, 0].reshape(-1, window)
        if np.mean(np.ptp(parts, axis=1) > 8 * noise) < 0.6:
            return False
        held = np.mean(rows[:, SLIP] < max(2e-3, 0.03 * float(run.plain["belt_speed"])))
        sticks += int(0.02 < held < 0.97 and not run.hold_out)
    return sticks >= wanted


def seen_over_scatter(order: Order, plan: Plan, hidden: Sequence[Hidden]) -> bool:
    """A law that shows between runs alone differs there by more than three times the scatter."""
    if "load_dependence" not in order.effects or not order.scatter:
        return True
    masses = np.array([p["mass"] for p in plain_records(plan)])
    strength = next(h.strength for h in hidden if h.name == "load_dependence")
    return bool(strength * np.std(np.log(masses)) > 3 * order.scatter)


def attempt(order: Order, rng: np.random.Generator) -> tuple[Campaign, bool]:
    """One campaign, and whether it shows what it hides."""
    names = {*order.effects, order.fault, order.kind}
    rig = (
        "planar"
        if names & PLANAR
        else str(rng.choice(RIGS, p=(0.6, 0.0, 0.4) if order.in_room else (0.45, 0.2, 0.35)))
    )
    if names & GUIDED or order.alike:
        rig = "guided"
    aside = True if "lateral_friction" in names else None
    if "turning_surface" in names:
        aside = False
    loads = "load_dependence" in names or "mass" in order.exponents
    wanted = {"scatter": order.scatter, "loads": loads, "aside": aside}
    wanted["slow"] = bool(names & DAMPING)
    if order.in_room:
        single = bool(order.alike)
        plan = draw_room(rng, rig, **wanted, single=single, creeping=order.creeping)
        tracker = room_tracker(rng, rig == "planar")
    else:
        plan = draw_plan(rng, rig, order.contact, **wanted)
        tracker = draw_tracker(rng, rig == "planar", rig == "bench")
    hidden = draw_hidden(order, rng, plan.reference)
    target = float(np.exp(rng.uniform(np.log(order.sizes[0] * 1.3), np.log(order.sizes[1]))))
    for j in range(len(hidden)):
        hidden[j] = find_strength(plan, hidden, j, tracker, target)
    records = [with_hidden(p, hidden) for p in plain_records(plan)]
    motions = move(plan, records)
    if not lively(plan, motions, tracker.noise):
        return Campaign(order, plan, tuple(hidden), (), None, tracker, (), (), rng), False
    sizes = [sized(plan, hidden, j, tracker, motions) for j in range(len(hidden))]
    fault = None
    bad_runs = tuple(range(len(plan.runs)))
    if order.fault:
        if order.some_runs:
            number = int(rng.integers(2, max(3, len(bad_runs) - 2)))
            bad_runs = tuple(sorted(int(j) for j in rng.permutation(len(bad_runs))[:number]))
        bad = replace(plan, runs=tuple(plan.runs[j] for j in bad_runs))
        seen = [motions[j] for j in bad_runs]
        fault = find_amount(bad, seen, order, tracker, target, rng)
        sizes.append(fault_size(bad, seen, fault, tracker))
    if order.in_room:
        sizes, tracker = room_camera(sizes, tracker, order.sizes)
    else:
        sizes, tracker = better_camera(order, sizes, tracker)
    sought = all(h.law is None or h.law.sized for h in hidden)
    largest = (1 if order.in_room and sought else LARGEST) * order.sizes[1]
    fits = all(order.sizes[0] <= s.size <= largest for s in sizes)
    shows = fits and seen_over_scatter(order, plan, hidden)
    made = Campaign(
        order,
        plan,
        tuple(hidden),
        tuple(sizes),
        fault,
        tracker,
        tuple(records),
        tuple(motions),
        rng,
        bad_runs if order.fault else (),
    )
    return made, shows


def better_camera(order: Order, sizes: list[Size], tracker: Tracker) -> tuple[list[Size], Tracker]:
    """A camera with less noise, down to FINEST, where what is hidden is too small for this one."""
    least = min((s.size for s in sizes), default=np.inf)
    if least >= order.sizes[0]:
        return sizes, tracker
    noise = max(FINEST, 0.95 * tracker.noise * least / order.sizes[0])
    noise = float(f"{min(noise, tracker.noise):.2g}")
    gain = tracker.noise / noise
    sizes = [Size(s.size * gain, s.raw * gain, s.samples) for s in sizes]
    return sizes, replace(tracker, noise=noise)


def make_campaign(order: Order, seed: Sequence[int]) -> Campaign:
    """The campaign of an order and a seed, the same every time.

    Raises
    ------
    RuntimeError
        in TRIES draws none showed what it hides
    """
    for number in range(TRIES):
        made, shows = attempt(order, np.random.default_rng([*seed, number]))
        if shows:
            return made
    raise RuntimeError(f"{order}: no campaign of {TRIES} shows it; seed {list(seed)}")
