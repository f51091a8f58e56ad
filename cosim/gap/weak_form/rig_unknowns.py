"""What is unknown of every rig, whatever its friction does.

Rung 0 is the user's model: an ideal contact that holds mu_s N and slides at mu_k N, springs and
zeros within their stated errors. Beside it, with names of their own: the contact, which is no
switch, and the scatter of friction from run to run.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from cosim.gap.data import Campaign, MeasuredRun
from cosim.gap.weak_form.constants import (
    CONTACT_DELAY,
    CONTACT_FALL,
    CONTACT_SPEED,
    CREEP,
    CREEP_SPEED,
    OWN_STATIC,
    STATIC_FLOOR,
)
from cosim.gap.weak_form.corners import corner_contact
from cosim.gap.weak_form.rows import Response, RunRows
from cosim.gap.weak_form.unknowns import Unknown, column

#: Names of what is of the rig.
MU_K, MU_S, SPRINGS, ZERO_NAME, SPEED = "mu_k", "mu_s", "springs", "zero", "speed"
CONTACT, SCATTER = "contact", "scatter"


@dataclass(frozen=True)
class Level:
    """How large friction is, to state other numbers as parts of it."""

    kinetic: float
    static: float

    @classmethod
    def of(cls, runs: list[RunRows]) -> Level:
        """Medians over the runs, of what balances springs and inertia in slip and at break-away."""
        kinetic, static = [], []
        for run in runs:
            track = run.track
            slips = track.slips_mask
            if slips.any():
                force = run.restoring[slips] + track.run.mass * track.acceleration[slips]
                kinetic.append(np.median(force * track.direction[slips]) / run.weight)
            static += [event.force / run.weight for event in run.events]
        mu_k = abs(float(np.median(kinetic))) if kinetic else 0.2
        return cls(max(mu_k, 1e-3), abs(float(np.median(static))) if static else 1.3 * mu_k)


def rung_zero(campaign: Campaign, runs: list[RunRows]) -> list[Unknown]:
    """Coefficients, springs of each set-up, zero of each run."""
    setups = {setup_of(run.track.run): run.track.run for run in runs}
    return [
        Unknown(MU_K, "", lambda run: Response(force=_kinetic(campaign, run)), np.eye(1)),
        Unknown(MU_S, "", lambda run: Response(static=_static(run, run.weight)), np.eye(1)),
        *(
            Unknown(SPRINGS, setup_of(run), _springs(run.mass, run.stiffness),
                    campaign.errors.stiffness**2 * np.eye(1))
            for run in setups.values()
        ),
        Unknown(ZERO_NAME, "", lambda run: Response(
            place=np.full((run.track.time.size, 1), campaign.zero_sd(run.track.run))),
            np.eye(1), per_run=True),
    ]  # fmt: skip


def setup_of(run: MeasuredRun) -> str:
    """Mass and springs, in words."""
    return f"{run.mass:g} kg, {run.stiffness:g} N/m"


def contact(level: Level) -> list[Unknown]:
    """How the contact lets go: more friction at low speeds, less under fast loading, creep."""

    def slow(run: RunRows) -> Response:
        excess = np.exp(-np.abs(run.track.sliding) / CONTACT_SPEED)
        return Response(force=column(run.weight * run.track.direction * excess))

    def loading(run: RunRows) -> Response:
        own = run.track.run
        return Response(static=_static(run, own.total_stiffness * abs(own.surface_speed)))

    def creep(run: RunRows) -> Response:
        load = np.clip(np.abs(run.restoring) / (level.static * run.weight), 0.0, 1.0)
        speed = run.track.run.surface_speed
        give = run.track.run.total_stiffness / (level.static * run.weight)  # of bristles, per m
        with_surface = speed * np.column_stack([load**4, np.full_like(load, give)])
        by_load = np.sign(speed) * np.column_stack([load, load**3, load**9])
        return Response(speed=-np.hstack([with_surface, by_load]))

    return [
        Unknown(CONTACT, "transition", slow, (CONTACT_FALL * level.kinetic) ** 2 * np.eye(1)),
        Unknown(CONTACT, "loading", loading, CONTACT_DELAY**2 * np.eye(1)),
        Unknown(CONTACT, "creep", creep, np.diag(np.square([*CREEP, *[CREEP_SPEED] * 3]))),
        *corner_contact(),
    ]


def scatter(level: Level) -> list[Unknown]:
    """Friction of each run, kinetic and static together, and static friction alone by a part."""

    def both(run: RunRows) -> Response:
        kinetic = run.weight * level.kinetic * run.track.direction
        return Response(force=column(kinetic), static=_static(run, run.weight * level.static))

    return [
        Unknown(SCATTER, "both", both, np.eye(1), per_run=True),
        _static_of_runs(SCATTER, "static", level, OWN_STATIC),
    ]


def reading(level: Level) -> Unknown:
    """How well break-aways are read off a track in a run, beside their scatter."""
    return _static_of_runs("break-away", "", level, STATIC_FLOOR)


def _static_of_runs(name: str, variant: str, level: Level, part: float) -> Unknown:
    """Static friction alone, in each run by another part."""

    def alone(run: RunRows) -> Response:
        return Response(static=_static(run, run.weight * level.static))

    return Unknown(name, variant, alone, part**2 * np.eye(1), per_run=True)


def set_points(campaign: Campaign) -> Unknown:
    """By which part the surface of each run is faster than stated."""

    def faster(run: RunRows) -> Response:
        return Response(speed=np.full((run.track.time.size, 1), run.track.run.surface_speed))

    return Unknown(SPEED, "", faster, campaign.errors.surface_speed**2 * np.eye(1), per_run=True)


def _kinetic(campaign: Campaign, run: RunRows) -> np.ndarray:
    """(n, 1) kinetic friction at a coefficient of 1, N; over the speed as a stated table has it."""
    table, speed = campaign.friction_table, np.abs(run.track.sliding)
    part = 1.0 if table is None else table.at(speed) / table.level
    return column(run.weight * run.track.direction * part)


def _static(run: RunRows, force: float) -> np.ndarray:
    """(events, 1) the same force at every break-away, along the surface's motion, N."""
    return np.full((len(run.events), 1), force)


def _springs(mass: float, stiffness: float) -> Callable[[RunRows], Response]:
    def stiffer(run: RunRows) -> Response:
        on = float((run.track.run.mass, run.track.run.stiffness) == (mass, stiffness))
        held = column([-on * event.force for event in run.events])
        return Response(force=column(-on * run.restoring), static=held)

    return stiffer
