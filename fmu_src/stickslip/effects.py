"""The catalogue of effects: what each adds to the plain model, with its parameters.

The plain model is Coulomb friction along x alone, linear springs and a steady belt. Every effect
is a block of a scenario, a group of FMU parameters `block.parameter`, and off at its defaults, so
that the plain model, one effect or several are the same kernel with other numbers.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Self

from pydantic import model_validator

from .quantity import Table, quantity


class LateralFriction(Table):
    """Friction along the local relative velocity: lateral and spin components."""

    ratio: float = quantity(
        0.0,
        "1",
        "friction across the motion relative to that along x: 0 along x only, 1 along the local "
        "relative velocity",
        ge=0,
        le=1,
        typical=(0.5, 1.0),
    )


class TurningSurface(Table):
    """The surface is a turning slab: its speed varies over the disc and has a lateral part."""

    curvature: float = quantity(
        0.0,
        "1/m",
        "1/R of a surface that turns about (0, R); 0 is a belt",
        ge=-20,
        le=20,
        typical=(-4.0, 4.0),
    )


class StaticStrengthening(Table):
    """Static friction grows with the time at rest: with its logarithm, or up to a limit."""

    rate: float = quantity(
        0.0, "1", "growth of mu_s per decade of hold time", ge=0, le=2, typical=(0.01, 0.3)
    )
    hold_time: float = quantity(
        0.01, "s", "hold time above which mu_s grows: log10(1 + t / hold_time)", gt=0
    )
    saturating: float = quantity(
        0.0, "1", "growth of mu_s that a long hold comes to", ge=0, le=5, typical=(0.02, 0.5)
    )
    saturation_time: float = quantity(
        0.3, "s", "hold time over which it does: 1 - exp(-t / saturation_time)", gt=0
    )


class VelocityWeakening(Table):
    """Kinetic friction falls with the local sliding speed."""

    linear: float = quantity(
        0.0, "s/m", "part of mu_k lost per m/s, down to none left", ge=0, typical=(0.1, 2.0)
    )
    hyperbolic: float = quantity(
        0.0, "s/m", "delta of mu_k / (1 + delta v)", ge=0, typical=(0.2, 5.0)
    )
    inverse_root: float = quantity(
        0.0, "s/m", "c of mu_k / sqrt(1 + c v): 1/sqrt(v) at high speed", ge=0, typical=(0.5, 50.0)
    )
    stribeck: float = quantity(
        0.0, "1", "peak above mu_k at rest, as part of mu_k", ge=0, le=10, typical=(0.1, 1.0)
    )
    stribeck_speed: float = quantity(
        0.05, "m/s", "speed over which the peak decays: exp(-v / stribeck_speed)", gt=0
    )


class FilmDrag(Table):
    """Friction grows with the sliding speed: a film of melt or water is sheared."""

    coefficient: float = quantity(
        0.0, "N.s/m", "force of the whole contact per sliding speed", ge=0, typical=(0.05, 5.0)
    )
    root_coefficient: float = quantity(
        0.0,
        "N",
        "force of the whole contact at 1 m/s, growing with the root of the local speed",
        ge=0,
        typical=(0.05, 2.0),
    )


class ThermalWeakening(Table):
    """Kinetic friction falls as friction heat gathers at the interface, and recovers in time."""

    per_joule: float = quantity(
        0.0, "1/J", "part of mu_k lost per joule of recent friction heat", ge=0, typical=(0.05, 5.0)
    )
    relaxation_time: float = quantity(
        5.0, "s", "time in which recent heat is forgotten", gt=0, typical=(0.3, 30.0)
    )
    curvature: float = quantity(
        -1.0, "1", "of the decline of mu_k: -1 linear, 0 exponential, 1 hyperbolic", ge=-1, le=1
    )


class RunIn(Table):
    """Kinetic friction drifts with the distance slid: wear, polishing, wetting."""

    change: float = quantity(
        0.0, "1", "final change of mu_k, part of it", ge=-0.95, le=5, typical=(-0.5, 0.5)
    )
    distance: float = quantity(
        1.0, "m", "distance over which the change is approached exponentially", gt=0
    )


class SpringHardening(Table):
    """Springs stiffen with their extension, or with its change since then: a cubic term."""

    cubic: float = quantity(
        0.0, "N/m3", "k_3 of the spring force k e + k_3 (e - e_n)^3", ge=0, typical=(500.0, 5e4)
    )
    neutral_extension: float = quantity(
        0.0, "m", "extension e_n at which the cubic term vanishes: 0, or as installed", ge=0
    )


class StructuralDamping(Table):
    """A viscous force against the frame."""

    coefficient: float = quantity(
        0.0, "N.s/m", "force per velocity of the block", ge=0, typical=(0.05, 2.0)
    )
    rotational: float = quantity(
        0.0, "N.m.s", "moment per angular velocity of the block", ge=0, typical=(1e-5, 1e-2)
    )


def _second_amplitude():
    return quantity(
        0.0,
        "1",
        "amplitude of the second harmonic as part of the first's",
        ge=0,
        le=1,
        typical=(0.1, 0.6),
    )


def _second_phase():
    return quantity(0.0, "deg", "phase of the second harmonic where that of the first is nothing")


class SpeedRipple(Table):
    """The speed of the surface is periodic in time."""

    amplitude: float = quantity(
        0.0, "1", "amplitude as part of the speed", ge=0, le=1, typical=(0.02, 0.3)
    )
    frequency: float = quantity(1.0, "Hz", "frequency", gt=0, le=1000, typical=(0.1, 10.0))
    phase_deg: float = quantity(0.0, "deg", "phase at the start")
    second_amplitude: float = _second_amplitude()
    second_phase_deg: float = _second_phase()


class SurfacePattern(Table):
    """Friction is periodic in the place on the surface."""

    amplitude: float = quantity(
        0.0, "1", "amplitude as part of mu_s and mu_k", ge=0, le=1, typical=(0.02, 0.4)
    )
    wavelength: float = quantity(
        0.1, "m", "length of a period along the surface", gt=0, typical=(0.005, 1.0)
    )
    phase_deg: float = quantity(0.0, "deg", "phase where the block stands at the start")
    second_amplitude: float = _second_amplitude()
    second_phase_deg: float = _second_phase()


class SurfaceScatter(Table):
    """Friction scatters from place to place on the surface: a random field, the same every time."""

    deviation: float = quantity(
        0.0, "1", "standard deviation as part of mu_s and mu_k", ge=0, le=0.5, typical=(0.02, 0.3)
    )
    correlation_length: float = quantity(
        0.02, "m", "distance over which the field forgets itself: exp(-(d/L)^2 / 2)", gt=0
    )
    seed: int = quantity(1, "1", "which field it is", ge=0, le=2**31 - 1)


class LoadDependence(Table):
    """Friction coefficients fall (or grow) with the normal force."""

    exponent: float = quantity(
        0.0, "1", "n of mu (N / reference_force)^-n", ge=-2, le=2, typical=(-0.5, 0.5)
    )
    reference_force: float = quantity(
        6.57, "N", "normal force at which mu_s and mu_k hold (0.67 kg)", gt=0
    )


class SpringMisalignment(Table):
    """The springs stand off the axis: turned by an angle, or with anchors shifted sideways."""

    angle_deg: float = quantity(
        0.0, "deg", "turn of every spring about its attachment", ge=-60, le=60, typical=(-10, 10)
    )
    lateral_offset: float = quantity(
        0.0, "m", "shift of all anchors along y", ge=-1, le=1, typical=(-0.03, 0.03)
    )


class StickStiffness(Table):
    """Stick is judged by a part of the spring force: the study counts one spring of four."""

    ratio: float = quantity(
        1.0,
        "1",
        "part of the load that stick is judged by: 1 all, 0.25 the study",
        gt=0,
        le=1,
        typical=(0.25, 0.75),
    )


class TemperatureDependence(Table):
    """Friction falls linearly as the interface warms, up to the melting point (0 degC).

    Ice on rock, 0.52 at -20 degC to 0.02 at melting: mu_k = 0.52, reference_degC = -20,
    sensitivity = (1 - 0.02 / 0.52) / 20.
    """

    sensitivity: float = quantity(
        0.0, "1/K", "part of mu_k lost per kelvin above reference_degC", ge=0, typical=(0.01, 0.12)
    )
    static_sensitivity: float = quantity(
        0.0, "1/K", "part of mu_s lost per kelvin above reference_degC", ge=0, typical=(0.01, 0.12)
    )
    reference_degC: float = quantity(
        -8.0, "degC", "interface temperature at which mu_k and mu_s hold", ge=-273.15, le=0
    )


class AsperityMelting(Table):
    """Asperities that melt in passing limit mu_k: as (T_m - T) / sqrt(v), boundary friction.

    mu_a = C e (T_m - T) / (H sqrt(l v)): the heat mu_a H v of a contact of length l that slides for
    l / v warms ice of effusivity e from the interface temperature T to melting, 0 degC. mu_k is
    what is left as v -> 0, so mu_s >= mu_k stays the static value.
    """

    length: float = quantity(
        0.0,
        "m",
        "l, length of an asperity's contact along the sliding: that of a grain; 0 is off",
        ge=0,
        le=1,
        typical=(1e-4, 1e-2),
    )
    hardness: float = quantity(
        2e7,
        "Pa",
        "H, pressure that an asperity of ice bears: some 1e7 near melting to 3e7 in the cold",
        ge=1e3,
        le=1e10,
        typical=(3e6, 3e7),
    )
    effusivity: float = quantity(
        2034.0,
        "W.s0.5/(m2.K)",
        "e of the ice, sqrt(k rho c)",
        ge=1,
        le=1e6,
        typical=(1900.0, 2200.0),
    )
    constant: float = quantity(
        1.128,
        "1",
        "C: 1.128 isothermal contact, 1.329 uniform heat flux and melting in the mean, 0.886 "
        "uniform flux and melting at the trailing edge",
        ge=0.1,
        le=10,
        typical=(0.886, 1.329),
    )


class MeltFilm(Table):
    """A film of melt that its own shear melts: friction with the root of the speed, hydrodynamic.

    mu_f = sqrt(2 eta v rho L / l) / p, where the pressure p is the load on the wetted part of the
    contact. The melt is taken to move with the surface; in Couette flow, at half its speed, the
    same friction belongs to half the length.
    """

    wetted_share: float = quantity(
        0.0,
        "1",
        "part of the contact's area that the film fills; p is the mean pressure over it; 0 is off",
        ge=0,
        le=1,
        typical=(3e-4, 3e-2),
    )
    length: float = quantity(
        1e-3,
        "m",
        "l, way along the sliding over which a film grows: that of a wetted patch",
        ge=1e-9,
        le=10,
        typical=(1e-4, 1e-2),
    )
    viscosity: float = quantity(
        1.79e-3, "Pa.s", "eta of water at 0 degC", gt=0, le=1e3, typical=(1.79e-3, 3e-3)
    )
    latent_heat: float = quantity(
        3.06e8,
        "J/m3",
        "rho L, heat that melts a volume of ice",
        gt=0,
        le=1e10,
        typical=(3.0e8, 3.1e8),
    )


class MixedLubrication(Table):
    """Water of the melting face floods part of the contact and is sheared in place of dry friction.

    Its mean thickness h is an input: that of the heat model in a coupled run. It fills the share
    w = f h / (h + s) of a surface of roughness s, h / w thick there, and bears that share of the
    load: mu = (1 - w) mu_dry + w^2 eta v / (h p), p the mean pressure.
    """

    share: float = quantity(
        0.0,
        "1",
        "f, part of the contact that water can fill; 0 is off, 1 a surface that ends up afloat",
        ge=0,
        le=1,
        typical=(0.2, 1.0),
    )
    roughness: float = quantity(
        5e-6,
        "m",
        "s, of both faces together: water as thick as this fills half of what it can",
        ge=1e-9,
        le=1e-2,
        typical=(1e-6, 1e-4),
    )
    viscosity: float = quantity(
        1.79e-3, "Pa.s", "eta of water at 0 degC", gt=0, le=1e3, typical=(1.79e-3, 3e-3)
    )


class RateAndState(Table):
    """Friction follows the speed and the age of the contact (Dieterich's ageing law): slow belts.

    mu_k + a ln(v / v*) + b ln(v* theta / D), theta' = 1 - v theta / D. The age also says what a
    contact at rest holds; mu_s is then not used.
    """

    direct: float = quantity(0.0, "1", "a, direct effect of the speed", ge=0, typical=(0.005, 0.1))
    evolution: float = quantity(0.0, "1", "b, effect of the age", ge=0, typical=(0.005, 0.15))
    distance: float = quantity(
        1e-5, "m", "D, way over which contacts are renewed", gt=0, typical=(1e-6, 1e-3)
    )
    reference_speed: float = quantity(
        1e-4, "m/s", "v*, at which mu_k holds in steady sliding", gt=0, typical=(1e-5, 1e-2)
    )
    creep_speed: float = quantity(
        1e-6,
        "m/s",
        "v_c, the law's sqrt(v^2 + v_c^2) for v: at rest it is as at this speed",
        ge=1e-9,
        typical=(1e-7, 1e-5),
    )
    initial_age: float = quantity(
        1.0, "s", "age of the contact at the start", gt=0, typical=(0.1, 100.0)
    )


class EffectBlocks(Table):
    """One block for each effect, all off."""

    lateral_friction: LateralFriction = LateralFriction()
    turning_surface: TurningSurface = TurningSurface()
    static_strengthening: StaticStrengthening = StaticStrengthening()
    velocity_weakening: VelocityWeakening = VelocityWeakening()
    film_drag: FilmDrag = FilmDrag()
    thermal_weakening: ThermalWeakening = ThermalWeakening()
    run_in: RunIn = RunIn()
    spring_hardening: SpringHardening = SpringHardening()
    structural_damping: StructuralDamping = StructuralDamping()
    speed_ripple: SpeedRipple = SpeedRipple()
    surface_pattern: SurfacePattern = SurfacePattern()
    surface_scatter: SurfaceScatter = SurfaceScatter()
    load_dependence: LoadDependence = LoadDependence()
    spring_misalignment: SpringMisalignment = SpringMisalignment()
    stick_stiffness: StickStiffness = StickStiffness()
    temperature_dependence: TemperatureDependence = TemperatureDependence()
    asperity_melting: AsperityMelting = AsperityMelting()
    melt_film: MeltFilm = MeltFilm()
    rate_and_state: RateAndState = RateAndState()
    mixed_lubrication: MixedLubrication = MixedLubrication()

    @model_validator(mode="after")
    def _check(self) -> Self:
        if self.speed_ripple.amplitude == 1.0 and self.speed_ripple.frequency > 100.0:
            raise ValueError("speed_ripple: a full ripple above 100 Hz is no belt")
        return self


@dataclass(frozen=True)
class Effect:
    """An entry of the catalogue.

    Attributes
    ----------
    id : name of the scenario block, of the FMU parameter group and of the candidate in `gap`
    switch : the parameters any of which turns it on, most telling first
    enters : where in the model: friction, springs, surface, contact
    source : where the effect is named or its law comes from
    """

    id: str
    switch: tuple[str, ...]
    enters: str
    source: str

    @property
    def block(self) -> type[Table]:
        """The parameters: names, units, defaults, bounds."""
        return EffectBlocks.model_fields[self.id].annotation

    @property
    def sentence(self) -> str:
        """What it adds to the plain model."""
        return self.block.__doc__.split("\n")[0]


CATALOGUE = tuple(
    Effect(*entry)
    for entry in (
        (
            "lateral_friction",
            ("ratio",),
            "friction",
            "Goyal, Ruina & Papadopoulos, Wear 143 (1991); named as missing by the source study",
        ),
        (
            "turning_surface",
            ("curvature",),
            "surface",
            "the source study's rotating slab, whose turning it leaves out",
        ),
        (
            "static_strengthening",
            ("rate", "saturating"),
            "contact",
            "Dieterich, J. Geophys. Res. 77 (1972); Schulson & Fortt, 0.3 a decade on ice",
        ),
        (
            "velocity_weakening",
            ("hyperbolic", "linear", "inverse_root", "stribeck"),
            "friction",
            "Leine et al., Nonlinear Dynamics 16 (1998); Stribeck (1902); boundary friction of ice",
        ),
        (
            "film_drag",
            ("coefficient", "root_coefficient"),
            "friction",
            "Couette film; hydrodynamic friction of ice grows with the root of the speed",
        ),
        (
            "thermal_weakening",
            ("per_joule",),
            "friction",
            "frictional heating, lumped: Bowden & Hughes, Proc. R. Soc. A 172 (1939)",
        ),
        (
            "run_in",
            ("change",),
            "friction",
            "wear, polishing and wetting, named by the source study",
        ),
        (
            "spring_hardening",
            ("cubic",),
            "springs",
            "the source study: springs stiffen beyond a few centimetres",
        ),
        ("structural_damping", ("coefficient", "rotational"), "springs", "damping of a real rig"),
        (
            "speed_ripple",
            ("amplitude",),
            "surface",
            "the source study: the speed of the belt is not steady",
        ),
        (
            "surface_pattern",
            ("amplitude",),
            "friction",
            "waves along the track, as in paper-on-paper records (Colas et al., 2019)",
        ),
        (
            "surface_scatter",
            ("deviation",),
            "friction",
            "the source study's statistical friction, as a field on the surface",
        ),
        (
            "load_dependence",
            ("exponent",),
            "friction",
            "the source study's literature: friction of ice falls with the load",
        ),
        (
            "spring_misalignment",
            ("angle_deg", "lateral_offset"),
            "springs",
            "the source study: spring angles only estimated",
        ),
        (
            "stick_stiffness",
            ("ratio",),
            "contact",
            "a fault of the source study: one spring instead of four in stick",
        ),
        (
            "rate_and_state",
            ("evolution", "direct"),
            "contact",
            "Dieterich (1979); saline ice: Lishman et al. (2011)",
        ),
        (
            "temperature_dependence",
            ("sensitivity", "static_sensitivity"),
            "friction",
            "ice on rock, linear to the melting point: McCarthy et al. (2017)",
        ),
        (
            "asperity_melting",
            ("length",),
            "friction",
            "Evans, Nye & Cheeseman, Proc. R. Soc. A (1976): 1/sqrt(v) well below melting",
        ),
        (
            "melt_film",
            ("wetted_share",),
            "friction",
            "Oksanen & Keinonen, Wear 78 (1982): sqrt(v) near melting",
        ),
        (
            "mixed_lubrication",
            ("share",),
            "friction",
            "melt water shares the load with the dry contact: Colbeck, J. Glaciol. 34 (1988)",
        ),
    )
)
