"""Asperities that melt in passing limit mu_k: as (T_m - T) / sqrt(v), boundary friction.

Evans, Nye & Cheeseman, Proc. R. Soc. A (1976): the heat mu_a H v of a contact at melting is what
warms the ice that it passes, and what both bodies conduct from it at any speed,

    mu_a H v = (T_m - T) (C e sqrt(v / l) + 8 k / (pi l)),

the second from a disc of the diameter l into half-spaces, for it alone is left at a Peclet number
v l / kappa below 1. Dry and boundary friction blend as in Churchill & Usagi, AIChE J. 18 (1972),
exponent 2, which is smooth down to v = 0:

    1 / mu_m^2 = 1 / mu_dry^2 + 1 / mu_a^2.

Melt carries where it is thicker than the contact is rough. In passing l it grows to
h = sqrt(2 eta l v / (rho L)), and asperities that are higher bear exp(-(h / s)^2) of the load,
which is Tustin's exp(-v / v_c) of mixed lubrication (J. IEE 94, 1947):

    mu = mu_m + (mu_dry - mu_m) exp(-v / v_c),    v_c = s^2 rho L / (2 eta l).

So friction tends to the dry value at rest at any temperature, the melting point too.
"""

from math import exp, pi, sqrt

from ...quantity import Table, quantity
from ..effect import Case, Effect


class AsperityMelting(Table):
    """Asperities that melt in passing limit mu_k: as (T_m - T) / sqrt(v), boundary friction.

    mu_a = (T_m - T) (C e / sqrt(l v) + 8 k / (pi l v)) / H: the heat mu_a H v of a contact of
    length l that slides for l / v warms ice of effusivity e from the interface temperature T to
    melting, 0 degC, and both bodies conduct from it. mu_k is what is left as v -> 0 and, where the
    contact is rough, below the speed at which melt carries, so mu_s >= mu_k stays the static value.

    length : l, length of an asperity's contact along the sliding: that of a grain; 0 is off
    hardness : H, pressure that an asperity of ice bears: some 1e7 near melting to 3e7 in the cold
    effusivity : e of the ice, sqrt(k rho c)
    constant : C: 1.128 isothermal contact, 1.329 uniform heat flux and melting in the mean, 0.886
        uniform flux and melting at the trailing edge
    conductivity : k, of both bodies together, which conduct from the contact at any speed: 2.2 of
        ice, 0.5 of a belt; 0 leaves that out
    roughness : s, of a contact's two faces: melt carries where it is thicker; 0 is at any speed
    """

    length: float = quantity(0.0, "m", ge=0, le=1, typical=(1e-4, 1e-2))
    hardness: float = quantity(2e7, "Pa", ge=1e3, le=1e10, typical=(3e6, 3e7))
    effusivity: float = quantity(2034.0, "W.s0.5/(m2.K)", ge=1, le=1e6, typical=(1900.0, 2200.0))
    constant: float = quantity(1.128, "1", ge=0.1, le=10, typical=(0.886, 1.329))
    conductivity: float = quantity(2.7, "W/(m.K)", ge=0, le=1e4, typical=(2.4, 5.0))
    roughness: float = quantity(1e-8, "m", ge=0, le=1e-3, typical=(1e-8, 1e-6))


MELTING_POINT = 0.0  # of ice, degC
FINEST_COLD = 1e-12  # K; a temperature this near to melting is there, but for rounding
VISCOSITY = 1.79e-3  # of water at 0 degC, Pa s
LATENT_HEAT = 3.06e8  # that melts a volume of ice, J/m3


def warming(length: float, hardness: float, effusivity: float, constant: float) -> float:
    """l (H / (C e))^2, K^2 s/m."""
    ratio = hardness / (constant * effusivity)
    return length * (ratio * ratio)


def conducting(length: float, effusivity: float, constant: float, conductivity: float) -> float:
    """Root of the speed at which both bodies conduct as much as the ice takes in passing."""
    if length == 0.0:
        return 0.0
    return 8.0 * conductivity / (pi * constant * effusivity * sqrt(length))


def carrying_speed(length: float, roughness: float) -> float:
    """v_c, m/s: the speed at which melt is as thick as the contact is rough."""
    if length == 0.0:
        return 0.0
    return roughness * roughness * LATENT_HEAT / (2.0 * VISCOSITY * length)


def melting(
    mu: float,
    speed: float,
    temperature: float,
    warming: float,
    conducting: float,
    carrying_speed: float,
) -> float:
    """Friction that melts asperities; the dry value at speed 0."""
    cold = MELTING_POINT - temperature
    melted = 0.0  # melting ice takes no warming, and its melt has no dry friction
    if cold > FINEST_COLD:
        # the speed at which warming in passing alone would leave as much
        passing = speed
        if conducting > 0.0:
            root = sqrt(speed)
            part = root / (root + conducting)
            passing = speed * (part * part)
        melted = mu * cold / sqrt(cold * cold + warming * mu * mu * passing)
    if carrying_speed > 0.0:
        melted = melted + (mu - melted) * exp(-speed / carrying_speed)
    return melted


EFFECT = Effect(
    id="asperity_melting",
    table=AsperityMelting,
    switch=("length",),
    enters="friction",
    axis="sliding speed",
    source="Evans, Nye & Cheeseman, Proc. R. Soc. A (1976): 1/sqrt(v) well below melting",
    terms=(melting,),
    derived=(warming, conducting, carrying_speed),
    feels_melting=("length",),
    case=Case({"length": 1e-3}),
)
