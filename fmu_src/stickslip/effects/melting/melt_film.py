"""A film of melt that its own shear melts: hydrodynamic friction, with the root of the speed.

Oksanen & Keinonen, Wear 78 (1982). The whole load on a film that the shear itself melts gives
mu_f = sqrt(2 eta v rho L / l) / p; it meets what friction is left of the solid contact as in
Churchill & Usagi, AIChE J. 18 (1972): mu^2 = mu_b^2 + mu_f^2.
"""

from math import pi, sqrt

from ...quantity import Table, quantity
from ..effect import Case, Effect


class MeltFilm(Table):
    """A film of melt that its own shear melts: friction with the root of the speed, hydrodynamic.

    mu_f = sqrt(2 eta v rho L / l) / p, where the pressure p is the load on the wetted part of the
    contact. The melt is taken to move with the surface; in Couette flow, at half its speed, the
    same friction belongs to half the length.

    wetted_share : part of the contact's area that the film fills; p is the mean pressure over it; 0
        is off
    length : l, distance along the sliding over which a film grows: that of a wetted patch
    viscosity : eta of water at 0 degC
    latent_heat : rho L, heat that melts a volume of ice
    """

    wetted_share: float = quantity(0.0, "1", ge=0, le=1, typical=(3e-4, 3e-2))
    length: float = quantity(1e-3, "m", ge=1e-9, le=10, typical=(1e-4, 1e-2))
    viscosity: float = quantity(1.79e-3, "Pa.s", gt=0, le=1e3, typical=(1.79e-3, 3e-3))
    latent_heat: float = quantity(3.06e8, "J/m3", gt=0, le=1e10, typical=(3.0e8, 3.1e8))


def film_square(
    wetted_share: float,
    length: float,
    viscosity: float,
    latent_heat: float,
    radius: float,
    normal_force: float,
) -> float:
    """(mu_f)^2 / v, s/m; the pressure is the load on what the film covers."""
    area = wetted_share * pi * (radius * radius)
    shear = 2.0 * viscosity * latent_heat / length  # (Pa)^2 s/m
    per_force = area / normal_force
    return shear * (per_force * per_force)


def melting(mu: float, speed: float, film_square: float) -> float:
    """Friction of the solid contact and the film."""
    return sqrt(mu * mu + film_square * speed)


EFFECT = Effect(
    id="melt_film",
    table=MeltFilm,
    switch=("wetted_share",),
    enters="friction",
    axis="sliding speed",
    source="Oksanen & Keinonen, Wear 78 (1982): sqrt(v) near melting",
    terms=(melting,),
    derived=(film_square,),
    case=Case({"wetted_share": 0.01}, window=(0.0, 8.0)),
)
