"""A hidden campaign: a plan, what is hidden in it, how large it is, how it was recorded."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, dataclass, replace

import numpy as np

from .effect_size import Known, Size, effect_size
from .effects import EFFECTS
from .ingredients import Ingredient
from .layouts import Plan, draw_plan
from .motion import COARSE, FINE, Motion, move, needs_plane
from .out_of_catalogue import OUT_OF_CATALOGUE
from .plug_ins import PLUG_INS
from .simulator.hidden import State
from .tracker import Tracker, draw_tracker

KINDS = ("effects", "none", "unknown", "two", "single_speed")
SIZES = (6.0, 30.0)  # noise units between which a size is drawn, unless told
SEARCH = 7  # motions spent on the strength that has the size asked for
BEST_NOISE = 1e-4  # m, of the best tracker
NEAR = 0.05  # logarithm of a size that need not be met more closely
KNOWN = 0.03  # relative standard deviation of a coefficient that is stated
STICKS = 5e-4  # m/s of sliding below which a block counts as held
# pairs that no campaign of this kind can tell from one another or from one of them alone
BLURRED = (
    {"film_drag", "structural_damping"},
    {"film_drag", "velocity_weakening"},
    {"lateral_friction", "turning_surface"},
    {"thermal_weakening", "run_in"},
    {"thermal_weakening", "velocity_weakening"},
)


@dataclass(frozen=True)
class Campaign:
    """Everything about one campaign, the hidden part too."""

    seed: int
    kind: str
    plan: Plan
    ingredients: tuple[Ingredient, ...]
    strengths: tuple[float, ...]
    tracker: Tracker
    motions: list[Motion]
    size: Size
    alone: tuple[float, ...]  # size of each ingredient by itself, noise units
    known: Known  # friction coefficients that the experimenter states

    @property
    def stick_shares(self) -> list[float]:
        """Part of the time that the block was held, by run."""
        return [float((each.rows[:, 7] < STICKS).mean()) for each in self.motions]


def pick_pair(rng: np.random.Generator) -> list[str]:
    """Two effects that can both be seen."""
    names = [name for name in EFFECTS if name != "stick_stiffness"]
    while True:
        pair = [str(name) for name in rng.choice(names, 2, replace=False)]
        if set(pair) not in BLURRED:
            return pair


def pick(kind: str, rng: np.random.Generator, ids: Sequence[str]) -> list[Ingredient]:
    """Ingredients of a kind of campaign; ids says which, where they are given."""
    if kind == "none":
        return []
    names = list(ids)
    if not names and kind == "two":
        names = pick_pair(rng)
    elif not names:
        pool = {
            "effects": list(EFFECTS),
            "unknown": list(OUT_OF_CATALOGUE),
            "single_speed": ["film_drag", "structural_damping"],
        }[kind]
        names = [str(rng.choice(pool))]
    return [(EFFECTS | OUT_OF_CATALOGUE | PLUG_INS)[name](rng) for name in names]


def pick_plan(kind: str, rng: np.random.Generator, ingredients: Sequence[Ingredient]) -> Plan:
    """A plan in which the ingredients have a chance to be seen."""
    names = {each.id for each in ingredients}
    plan = str(rng.choice(("example", "slow", "drawn", "both_ways"), p=(0.4, 0.2, 0.3, 0.1)))
    if kind == "single_speed":
        plan = "single"
    elif "asymmetric_friction" in names:
        plan = "both_ways"
    elif names & {"static_strengthening", "play"} and rng.random() < 0.5:
        plan = "slow"
    line = not any(each.plane for each in ingredients) and rng.random() < 0.15
    drawn = draw_plan(plan, rng, line)
    if kind == "none" and not line and rng.random() < 0.2:
        aside = State(y=float(rng.uniform(-0.006, 0.006)))
        runs = tuple(
            replace(run, start=run.start._replace(y=aside.y * rng.uniform(0.3, 1)))
            for run in drawn.runs
        )
        return replace(drawn, runs=runs)
    return drawn


def state_friction(plan: Plan, rng: np.random.Generator, stated: bool) -> Known:
    """Coefficients measured by themselves, with their standard deviations; none if not stated."""
    p = plan.runs[0].hidden
    if not stated:
        return {}
    return {
        name: (round(value * (1 + KNOWN * float(rng.normal())), 4), round(KNOWN * value, 4))
        for name, value in (("mu_s", p.mu_s), ("mu_k", p.mu_k))
    }


def size_at(plan: Plan, ingredients, strengths, tracker: Tracker, steps, known: Known):
    """Motions at given strengths, and the size of what is hidden in them."""
    motions = move(plan, ingredients, strengths, steps)
    plane = needs_plane(plan, ingredients)
    blind = plan.line or not tracker.with_y
    return motions, effect_size(motions, tracker.noise, plane and not blind, known)


def find_strength(plan: Plan, ingredient, tracker: Tracker, target: float, known: Known):
    """Strength whose size comes nearest to the target, and that size, by bisection."""
    if not ingredient.sized:
        _, size = size_at(plan, [ingredient], [1.0], tracker, COARSE, known)
        return 1.0, size.largest
    low, high, tried = np.log(2e-3), 0.0, []
    middle = np.log(0.15)
    for _ in range(SEARCH):
        strength = float(np.exp(middle))
        _, size = size_at(plan, [ingredient], [strength], tracker, COARSE, known)
        miss = np.log(max(size.largest, 1e-3) / target)
        tried.append((abs(miss), strength, size.largest))
        if abs(miss) < 0.15:
            break
        low, high = (low, middle) if miss > 0 else (middle, high)
        middle = 0.5 * (low + high)
    return min(tried)[1:]


def shown(seed: int, kind: str, ids, sizes, clean: float, rng: np.random.Generator) -> Campaign:
    """One try: plan, ingredients, tracker and strengths drawn."""
    ingredients = pick(kind, rng, ids)
    plan = pick_plan(kind, rng, ingredients)
    only_known = any(each.known for each in ingredients)
    force = rng.random() < (0.5 if only_known else 0.05)
    tracker = draw_tracker(rng, rng.random() < clean, not plan.line, force)
    if any(each.plane for each in ingredients):
        tracker = replace(tracker, with_y=True)
    known = state_friction(plan, rng, only_known or (kind != "single_speed" and rng.random() < 0.1))
    target = np.exp(rng.uniform(*np.log(sizes)))
    found = [find_strength(plan, each, tracker, target, known) for each in ingredients]
    least = min((value for _, value in found), default=sizes[0])
    if least < sizes[0]:  # what cannot be made larger is recorded better
        noise = round(max(BEST_NOISE, 0.9 * tracker.noise * least / sizes[0]), 6)
        found = [(strength, value * tracker.noise / noise) for strength, value in found]
        tracker = replace(tracker, noise=noise)
    strengths = tuple(strength for strength, _ in found)
    motions, size = size_at(plan, ingredients, strengths, tracker, FINE, known)
    alone = (size.largest,) if len(found) == 1 else tuple(value for _, value in found)
    hidden = tuple(ingredients)
    return Campaign(seed, kind, plan, hidden, strengths, tracker, motions, size, alone, known)


def shortfall(made: Campaign, sizes: tuple[float, float]) -> float:
    """How far a campaign is from the sizes asked for (logarithm) and from two stick-slip runs."""
    misses = [
        max(np.log(sizes[0] / value), np.log(value / sizes[1]), 0.0)
        for each, value in zip(made.ingredients, made.alone, strict=True)
        if each.sized
    ]
    moving = sum(0.02 < share < 0.98 for share in made.stick_shares)
    return float(sum(misses)) + (0.0 if moving >= 2 else 2.0)


def draw_campaign(
    seed: int,
    kind: str,
    ids: Sequence[str] = (),
    sizes: tuple[float, float] = SIZES,
    clean: float = 0.6,
    tries: int = 6,
) -> Campaign:
    """A campaign from a seed alone.

    Parameters
    ----------
    kind : one of KINDS
    ids : effects or laws out of the catalogue to hide; drawn if empty
    sizes : noise units between which each ingredient's own size is drawn
    clean : part of the campaigns recorded with white noise only
    tries : campaigns drawn at most until the sizes are met and at least two runs stick and slip
    """
    rng = np.random.default_rng(seed)
    best, least = None, np.inf
    for _ in range(tries):
        made = shown(seed, kind, ids, sizes, clean, rng)
        missing = shortfall(made, sizes)
        if missing < least:
            best, least = made, missing
        if missing < NEAR:
            break
    return best


def answer(campaign: Campaign) -> dict:
    """What the product should find, and what it was not told."""
    names = [each.id for each in campaign.ingredients]
    verdict = {"none": "none", "unknown": "unknown", "single_speed": "class"}
    effects = names if campaign.kind in ("effects", "two") else []
    if campaign.kind == "single_speed":
        effects = ["film_drag", "structural_damping"]
    return {
        "verdict": verdict.get(campaign.kind, "named"),
        "effects": effects,
        "hidden": names,
        "forms": [each.form for each in campaign.ingredients],
        "strengths": list(campaign.strengths),
        "size": asdict(campaign.size) | {"largest": campaign.size.largest},
        "size_alone": list(campaign.alone),
        "kind": campaign.kind,
        "seed": campaign.seed,
        "plan": campaign.plan.name,
        "degrees_of_freedom": 1 if campaign.plan.line else 3,
        "tracker": asdict(campaign.tracker),
        "known": campaign.known,
        "mu_s": campaign.plan.runs[0].hidden.mu_s,
        "mu_k": campaign.plan.runs[0].hidden.mu_k,
        "stick_shares": campaign.stick_shares,
    }
