"""Every effect of the catalogue with its laws and the places from which a fit sets out."""

from __future__ import annotations

from dataclasses import dataclass
from math import log10

from cosim.gap.estimation.drive import SECOND
from cosim.gap.shooting.free_parameter import FreeParameter

from .candidate import Candidate


@dataclass(frozen=True)
class Scales:
    """What is typical of a campaign.

    speed : sliding speed, m/s; distance : slid in a run, m; heat : made in a run, J;
    duration : of a run, s; stiffness : of one spring, N/m; travel : stroke of the block, m;
    mass, kg; force : normal force, N; extension : of a spring as installed, m
    """

    speed: float
    distance: float
    heat: float
    duration: float
    stiffness: float
    travel: float
    mass: float
    force: float
    extension: float = 0.0


def candidates(scales: Scales) -> tuple[Candidate, ...]:
    """All laws of all effects, in the catalogue's order; several starts of one law are several."""
    makers = (
        _lateral_friction,
        _turning_surface,
        _static_strengthening,
        _velocity_weakening,
        _film_drag,
        _thermal_weakening,
        _run_in,
        _spring_hardening,
        _structural_damping,
        _speed_ripple,
        _surface_pattern,
        _load_dependence,
        _spring_misalignment,
        _stick_stiffness,
    )
    return tuple(candidate for maker in makers for candidate in maker(scales))


#: Friction across the motion is part of what turning surfaces and crooked springs show.
_ACROSS = {"lateral_friction.ratio": 1.0}


#: Next to none is no other motion than none, but a stiff one: it takes a thousand times as long.
_LEAST_ACROSS = 0.05


def _lateral_friction(s: Scales):
    yield Candidate("lateral_friction", "isotropic", (), _ACROSS, lateral=True)
    for share in (0.8, 0.5):
        ratio = FreeParameter("lateral_friction.ratio", share, 0.1, _LEAST_ACROSS, 1.0)
        yield Candidate("lateral_friction", "less than along the motion", (ratio,), _ACROSS, True)


def _turning_surface(s: Scales):
    for across in (_ACROSS, {}):
        for sign in (0.5, -0.5):
            free_parameter = FreeParameter("turning_surface.curvature", sign, 0.2, -20.0, 20.0)
            form = "disc friction" if across else "friction along x"
            yield Candidate("turning_surface", form, (free_parameter,), across, lateral=True)


#: A usual hold, s.
_HOLD = 0.5


def _static_strengthening(s: Scales):
    rate = FreeParameter("static_strengthening.rate", 0.03, 0.02, 0.0, 2.0)
    yield Candidate(
        "static_strengthening",
        "logarithmic",
        (rate,),
        {"static_strengthening.hold_time": 0.01},
        grows=2.0,
    )
    for time in (0.03, 0.5):
        onset = FreeParameter("static_strengthening.hold_time", time, 0.5, 1e-4, 30.0, log=True)
        yield Candidate(
            "static_strengthening",
            "logarithmic after an onset",
            (rate, onset),
            grows=log10(1.0 + _HOLD / time),
        )
    for time in (0.1, 0.5):
        yield Candidate(
            "static_strengthening",
            "saturating",
            (
                FreeParameter("static_strengthening.saturating", 0.05, 0.03, 0.0, 5.0),
                # over a much shorter time it would be another mu_s, not a law of the hold
                FreeParameter(
                    "static_strengthening.saturation_time",
                    time,
                    0.5,
                    0.03,
                    30.0,
                    log=True,
                    plain_below=True,
                ),
            ),
            grows=1.0,
        )


def _velocity_weakening(s: Scales):
    part = 0.15
    for name in ("linear", "hyperbolic", "inverse_root"):
        free_parameter = FreeParameter(
            f"velocity_weakening.{name}",
            part / s.speed,
            0.1 / s.speed,
            0.0,
            {"linear": 10.0 / s.speed}.get(name, 1e3 / s.speed),
        )
        yield Candidate("velocity_weakening", name, (free_parameter,))
    peak = FreeParameter("velocity_weakening.stribeck", 0.15, 0.1, 0.0, 10.0)
    for share in (0.3, 1.0):
        # over a much smaller speed it would be another mu_s, not a law of the sliding speed
        speed = FreeParameter(
            "velocity_weakening.stribeck_speed",
            share * s.speed,
            0.4,
            0.1 * s.speed,
            1e2 * s.speed,
            log=True,
            plain_below=True,
        )
        yield Candidate("velocity_weakening", "stribeck", (peak, speed))


def _film_drag(s: Scales):
    drag = 0.02 * s.force / s.speed
    yield Candidate(
        "film_drag",
        "linear",
        (FreeParameter("film_drag.coefficient", drag, drag, 0.0, 1e3 * drag),),
    )
    root = 0.02 * s.force / s.speed**0.5
    yield Candidate(
        "film_drag",
        "root",
        (FreeParameter("film_drag.root_coefficient", root, root, 0.0, 1e3 * root),),
    )


def _thermal_weakening(s: Scales):
    for time in (0.5, 5.0, 50.0):
        # the heat that is remembered, of what a run makes
        heat = s.heat * min(1.0, time / s.duration)
        weak = FreeParameter("thermal_weakening.per_joule", 0.1 / heat, 0.1 / heat, 0.0, 1e3 / heat)
        memory = FreeParameter("thermal_weakening.relaxation_time", time, 0.5, 0.02, 1e4, log=True)
        yield Candidate("thermal_weakening", "relaxing", (weak, memory))
    bend = FreeParameter("thermal_weakening.curvature", 0.0, 0.3, -1.0, 1.0)
    yield Candidate("thermal_weakening", "relaxing, bent", (weak, memory, bend))


def _run_in(s: Scales):
    for share in (0.1, 0.5):
        for change in (0.1, -0.1):
            yield Candidate(
                "run_in",
                "exponential",
                (
                    FreeParameter("run_in.change", change, 0.1, -0.95, 5.0),
                    FreeParameter(
                        "run_in.distance",
                        share * s.distance,
                        0.5,
                        1e-3 * s.distance,
                        1e2 * s.distance,
                        log=True,
                    ),
                ),
            )


def _spring_hardening(s: Scales):
    cubic = 0.1 * s.stiffness / s.travel**2
    hardening = FreeParameter("spring_hardening.cubic", cubic, cubic, 0.0, 1e4 * cubic)
    yield Candidate("spring_hardening", "cubic", (hardening,))
    if s.extension != 0.0:  # as found by pulling at the block in its place
        yield Candidate(
            "spring_hardening",
            "cubic as installed",
            (hardening,),
            {"spring_hardening.neutral_extension": s.extension},
        )


def _structural_damping(s: Scales):
    drag = 0.02 * (4.0 * s.stiffness * s.mass) ** 0.5  # a hundredth of the critical one
    for much in (1.0, 15.0):
        yield Candidate(
            "structural_damping",
            "viscous",
            (
                FreeParameter(
                    "structural_damping.coefficient", much * drag, drag, 0.0, 100.0 * drag
                ),
            ),
        )


def _second(effect: str):
    """What is periodic is seldom a sine: its second harmonic, relative to the first."""
    return tuple(FreeParameter(f"{effect}.{part}", 0.0, 0.1, -0.7, 0.7) for part in SECOND)


def _periodic(effect: str, period: FreeParameter, form: str):
    """A sine, and one with its second harmonic; a scan says where they start."""
    free_parameters = (
        FreeParameter(f"{effect}.amplitude", 0.1, 0.05, 0.0, 1.0),
        period,
        FreeParameter(f"{effect}.phase_deg", 0.0, 30.0, per_run=True),
    )
    yield Candidate(effect, form, free_parameters, periodic=period.key)
    yield Candidate(
        effect,
        f"{form} and second harmonic",
        free_parameters + _second(effect),
        periodic=period.key,
    )


def _speed_ripple(s: Scales):
    frequency = FreeParameter("speed_ripple.frequency", 1.0, 0.2 / s.duration, 0.05, 50.0)
    yield from _periodic("speed_ripple", frequency, "sine")
    way = FreeParameter("speed_ripple.wavelength", 0.1, 0.02, 1e-3, 10.0, log=True)
    yield from _periodic("speed_ripple", way, "sine of a roller")


def _surface_pattern(s: Scales):
    length = FreeParameter("surface_pattern.wavelength", 0.1, 0.02, 1e-3, 10.0, log=True)
    yield from _periodic("surface_pattern", length, "sine")


def _load_dependence(s: Scales):
    for sign in (0.1, -0.1):
        yield Candidate(
            "load_dependence",
            "power law",
            (FreeParameter("load_dependence.exponent", sign, 0.1, -2.0, 2.0),),
            {"load_dependence.reference_force": s.force},
        )


def _spring_misalignment(s: Scales):
    for across in (_ACROSS, {}):
        for sign in (3.0, -3.0):
            yield Candidate(
                "spring_misalignment",
                "angle",
                (FreeParameter("spring_misalignment.angle_deg", sign, 2.0, -60.0, 60.0),),
                across,
                True,
            )
        for sign in (0.005, -0.005):
            yield Candidate(
                "spring_misalignment",
                "offset",
                (FreeParameter("spring_misalignment.lateral_offset", sign, 0.003, -1.0, 1.0),),
                across,
                True,
            )


def _stick_stiffness(s: Scales):
    for part in (0.8, 0.5, 0.3):
        yield Candidate(
            "stick_stiffness",
            "part of the springs",
            (FreeParameter("stick_stiffness.ratio", part, 0.15, 0.05, 1.0),),
        )
